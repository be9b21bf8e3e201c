// The Vulkan instance and the physical devices behind it.
#ifndef AG_GPU_INSTANCE_H
#define AG_GPU_INSTANCE_H

#include <argand/renderer.h>

#include <vulkan/vulkan.h>

// Make an instance.  With `validate` the Khronos layer is on, with synchronisation
// validation; with `windows` every kind of surface that the drivers have.
AG_CHECK ag_status gpu_instance_create(const ag_log *log, bool validate, bool windows,
                                       VkInstance *instance);

enum { GPU_DEVICES_MAX = 32 };

// The physical devices, in the loader's order; at least one.
AG_CHECK ag_status gpu_instance_devices(const ag_log *log, VkInstance instance,
                                        VkPhysicalDevice devices[GPU_DEVICES_MAX], uint32_t *count);

// What a device is, and whether it has all that Argand needs.
void gpu_device_describe(VkPhysicalDevice physical, ag_device_info *info);

// The index of the device that `select` (see ag_device_desc) means.
AG_CHECK ag_status gpu_device_select(const ag_log *log, const char *select,
                                     const ag_device_info *infos, uint32_t count, uint32_t *index);

// The first queue family that draws; UINT32_MAX when there is none.
uint32_t gpu_queue_family(VkPhysicalDevice physical);

#endif
