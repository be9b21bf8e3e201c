// The Vulkan device: everything that Argand needs of one, opened once.
#ifndef AG_GPU_DEVICE_H
#define AG_GPU_DEVICE_H

#include <argand/renderer.h>

#include <stdatomic.h>
#include <vulkan/vulkan.h>

typedef struct ag_device gpu_device;

struct ag_device {
    ag_log log;
    VkInstance instance;
    VkDebugUtilsMessengerEXT messenger; // only under validation
    atomic_uint validation_messages;
    VkPhysicalDevice physical;
    VkPhysicalDeviceMemoryProperties memory;
    VkPhysicalDeviceLimits limits;
    VkDevice device;
    VkQueue queue;
    uint32_t queue_family;
    VkCommandPool command_pool;
    VkPipelineCache pipeline_cache;
    struct gpu_heap *heap; // see memory.h
    ag_device_info info;
    float anisotropy; // the largest that is worth its cost; 1 = none
    bool windows;     // can show pictures in them
};

// AG_OK, or the failure of `what` told and turned into a status.
AG_CHECK ag_status gpu_check(const gpu_device *device, VkResult result, const char *what);

#endif
