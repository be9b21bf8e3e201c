// The Vulkan device: everything that Argand needs of one, opened once.
#include "gpu/device.h"

#include "base/cache.h"
#include "base/log.h"
#include "gpu/instance.h"
#include "gpu/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

ag_status gpu_check(const gpu_device *device, VkResult result, const char *what)
{
    switch (result) {
    case VK_SUCCESS: return AG_OK;
    case VK_ERROR_OUT_OF_HOST_MEMORY:
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return log_fail(&device->log, AG_ERROR_MEMORY,
                        "%s: %s is out of memory; try a smaller picture or smaller textures", what,
                        device->info.name);
    case VK_ERROR_DEVICE_LOST:
        return log_fail(&device->log, AG_ERROR_DEVICE, "%s: the device %s was lost", what,
                        device->info.name);
    default:
        return log_fail(&device->log, AG_ERROR_DEVICE, "%s failed on %s with Vulkan code %d", what,
                        device->info.name, result);
    }
}

static VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                 VkDebugUtilsMessageTypeFlagsEXT types,
                                                 const VkDebugUtilsMessengerCallbackDataEXT *data,
                                                 void *user)
{
    (void)severity;
    (void)types;
    gpu_device *device = user;
    atomic_fetch_add(&device->validation_messages, 1);
    log_write(&device->log, AG_LOG_ERROR, "validation: %s", data->pMessage);
    return VK_FALSE;
}

static ag_status listen(gpu_device *device)
{
    PFN_vkCreateDebugUtilsMessengerEXT create =
        (PFN_vkCreateDebugUtilsMessengerEXT)vkGetInstanceProcAddr(device->instance,
                                                                  "vkCreateDebugUtilsMessengerEXT");
    const VkDebugUtilsMessengerCreateInfoEXT info = {
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                           VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                       VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT,
        .pfnUserCallback = on_message,
        .pUserData = device,
    };
    return gpu_check(device, create(device->instance, &info, NULL, &device->messenger),
                     "vkCreateDebugUtilsMessengerEXT");
}

static ag_status open_physical(gpu_device *device, const char *select)
{
    VkPhysicalDevice devices[GPU_DEVICES_MAX];
    ag_device_info infos[GPU_DEVICES_MAX];
    uint32_t count, chosen = 0;
    ag_status status = gpu_instance_devices(&device->log, device->instance, devices, &count);
    if (status)
        return status;
    for (uint32_t i = 0; i < count; i++)
        gpu_device_describe(devices[i], &infos[i]);
    status = gpu_device_select(&device->log, select, infos, count, &chosen);
    if (status)
        return status;
    device->physical = devices[chosen];
    device->info = infos[chosen];
    device->queue_family = gpu_queue_family(device->physical);
    vkGetPhysicalDeviceMemoryProperties(device->physical, &device->memory);
    VkPhysicalDeviceProperties props;
    vkGetPhysicalDeviceProperties(device->physical, &props);
    device->limits = props.limits;
    log_write(&device->log, AG_LOG_INFO, "device: %s (%s)", device->info.name, device->info.driver);
    return AG_OK;
}

// Pictures in windows are asked for: see that they can be had.
static ag_status check_swapchain(const gpu_device *device)
{
    VkExtensionProperties all[512];
    uint32_t count = 512;
    VkResult result = vkEnumerateDeviceExtensionProperties(device->physical, NULL, &count, all);
    if (result != VK_SUCCESS && result != VK_INCOMPLETE)
        return gpu_check(device, result, "vkEnumerateDeviceExtensionProperties");
    for (uint32_t i = 0; i < count; i++)
        if (strcmp(all[i].extensionName, VK_KHR_SWAPCHAIN_EXTENSION_NAME) == 0)
            return AG_OK;
    return log_fail(&device->log, AG_ERROR_DEVICE,
                    "%s cannot show pictures in a window: its driver has no swapchain",
                    device->info.name);
}

static ag_status open_logical(gpu_device *device, bool windows)
{
    if (windows) {
        ag_status status = check_swapchain(device);
        if (status)
            return status;
    }
    VkPhysicalDeviceFeatures present;
    vkGetPhysicalDeviceFeatures(device->physical, &present);
    // On a CPU an anisotropic tap costs seven plain ones.
    bool anisotropic = present.samplerAnisotropy && device->info.kind != AG_DEVICE_CPU;
    device->anisotropy = 1.0f;
    if (anisotropic)
        device->anisotropy =
            device->limits.maxSamplerAnisotropy < 8.0f ? device->limits.maxSamplerAnisotropy : 8.0f;

    VkPhysicalDeviceVulkan13Features v13 = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
        .dynamicRendering = VK_TRUE,
        .synchronization2 = VK_TRUE,
        .maintenance4 = VK_TRUE, // shaders may leave each other's outputs unread
    };
    VkPhysicalDeviceVulkan12Features v12 = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
        .pNext = &v13,
        .scalarBlockLayout = VK_TRUE,
    };
    const float priority = 1.0f;
    const VkDeviceQueueCreateInfo queue = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
        .queueFamilyIndex = device->queue_family,
        .queueCount = 1,
        .pQueuePriorities = &priority,
    };
    const VkPhysicalDeviceFeatures enabled = {
        .samplerAnisotropy = anisotropic,
        .fullDrawIndexUint32 = present.fullDrawIndexUint32, // meshes above 2^24 vertices
    };
    const char *const extensions[] = { VK_KHR_SWAPCHAIN_EXTENSION_NAME };
    const VkDeviceCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
        .pNext = &v12,
        .enabledExtensionCount = windows ? 1 : 0,
        .ppEnabledExtensionNames = extensions,
        .queueCreateInfoCount = 1,
        .pQueueCreateInfos = &queue,
        .pEnabledFeatures = &enabled,
    };
    ag_status status = gpu_check(
        device, vkCreateDevice(device->physical, &info, NULL, &device->device), "vkCreateDevice");
    if (status)
        return status;
    device->windows = windows;
    vkGetDeviceQueue(device->device, device->queue_family, 0, &device->queue);
    return AG_OK;
}

static ag_status make_pools(gpu_device *device)
{
    const VkCommandPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
        .queueFamilyIndex = device->queue_family,
    };
    ag_status status =
        gpu_check(device, vkCreateCommandPool(device->device, &pool, NULL, &device->command_pool),
                  "vkCreateCommandPool");
    if (status)
        return status;
    const VkPipelineCacheCreateInfo cache = { .sType =
                                                  VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO };
    status = gpu_check(device,
                       vkCreatePipelineCache(device->device, &cache, NULL, &device->pipeline_cache),
                       "vkCreatePipelineCache");
    return status ? status : gpu_heap_create(device, &device->heap);
}

// Mesa compiles shaders anew in every process unless it may keep them; without its
// cache some also run at half speed.
static void keep_compiled_shaders(const ag_log *log)
{
    char path[CACHE_PATH_MAX];
    if (!getenv("MESA_SHADER_CACHE_DIR") && cache_directory("mesa", path))
        setenv("MESA_SHADER_CACHE_DIR", path, 0);
    else if (!getenv("MESA_SHADER_CACHE_DIR"))
        log_write(log, AG_LOG_INFO, "no folder for compiled shaders can be written");
}

ag_status ag_device_create(const ag_device_desc *desc, ag_device **out)
{
    const ag_device_desc defaults = { 0 };
    if (!desc)
        desc = &defaults;
    *out = NULL;
    gpu_device *device = calloc(1, sizeof *device);
    if (!device)
        return log_fail(desc->log, AG_ERROR_MEMORY, "no memory for a device");
    device->log = log_resolve(desc->log);
    keep_compiled_shaders(&device->log);
    ag_status status =
        gpu_instance_create(&device->log, desc->validate, desc->windows, &device->instance);
    if (!status && desc->validate)
        status = listen(device);
    if (!status)
        status = open_physical(device, desc->select);
    if (!status)
        status = open_logical(device, desc->windows);
    if (!status)
        status = make_pools(device);
    if (status) {
        ag_device_destroy(device);
        return status;
    }
    *out = device;
    return AG_OK;
}

void ag_device_destroy(ag_device *device)
{
    if (!device)
        return;
    if (device->device) {
        vkDeviceWaitIdle(device->device);
        gpu_heap_destroy(device->heap);
        vkDestroyPipelineCache(device->device, device->pipeline_cache, NULL);
        vkDestroyCommandPool(device->device, device->command_pool, NULL);
        vkDestroyDevice(device->device, NULL);
    }
    if (device->messenger) {
        PFN_vkDestroyDebugUtilsMessengerEXT destroy =
            (PFN_vkDestroyDebugUtilsMessengerEXT)vkGetInstanceProcAddr(
                device->instance, "vkDestroyDebugUtilsMessengerEXT");
        destroy(device->instance, device->messenger, NULL);
    }
    if (device->instance)
        vkDestroyInstance(device->instance, NULL);
    free(device);
}

const ag_device_info *ag_device_describe(const ag_device *device)
{
    return &device->info;
}

uint32_t ag_device_validation_messages(const ag_device *device)
{
    return atomic_load(&device->validation_messages);
}
