// The Vulkan instance and the physical devices behind it.
#include "gpu/instance.h"

#include "base/log.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NO_DRIVER                                                                                  \
    "no Vulkan driver was found; install one (Debian: mesa-vulkan-drivers renders on any CPU)"

static bool validation_layer_present(void)
{
    VkLayerProperties layers[64];
    uint32_t count = 64;
    VkResult result = vkEnumerateInstanceLayerProperties(&count, layers);
    if (result != VK_SUCCESS && result != VK_INCOMPLETE)
        return false;
    for (uint32_t i = 0; i < count; i++)
        if (strcmp(layers[i].layerName, "VK_LAYER_KHRONOS_validation") == 0)
            return true;
    return false;
}

enum { EXTENSIONS_MAX = 128 };

static bool ends_with(const char *text, const char *end)
{
    size_t length = strlen(text), wanted = strlen(end);
    return length >= wanted && strcmp(text + length - wanted, end) == 0;
}

// The names of VK_KHR_surface and its platforms, into `all`; how many there are.
static uint32_t surface_extensions(VkExtensionProperties all[EXTENSIONS_MAX],
                                   const char *names[EXTENSIONS_MAX])
{
    uint32_t count = EXTENSIONS_MAX, found = 0;
    VkResult result = vkEnumerateInstanceExtensionProperties(NULL, &count, all);
    if (result != VK_SUCCESS && result != VK_INCOMPLETE)
        return 0;
    // Without this folder there is no Wayland, and a layer of Mesa's would complain.
    bool wayland = getenv("XDG_RUNTIME_DIR");
    for (uint32_t i = 0; i < count; i++) {
        const char *name = all[i].extensionName;
        if (ends_with(name, "_surface") && (wayland || !strstr(name, "wayland")))
            names[found++] = name;
    }
    return found;
}

ag_status gpu_instance_create(const ag_log *log, bool validate, bool windows, VkInstance *instance)
{
    *instance = VK_NULL_HANDLE;
    if (validate && !validation_layer_present())
        return log_fail(log, AG_ERROR_DEVICE,
                        "the Vulkan validation layer is not installed "
                        "(Debian: vulkan-validationlayers)");
    const VkValidationFeatureEnableEXT enables[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT,
    };
    const VkValidationFeaturesEXT features = {
        .sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
        .enabledValidationFeatureCount = 1,
        .pEnabledValidationFeatures = enables,
    };
    const char *const layers[] = { "VK_LAYER_KHRONOS_validation" };
    VkExtensionProperties present[EXTENSIONS_MAX];
    const char *extensions[EXTENSIONS_MAX + 1];
    uint32_t extension_count = windows ? surface_extensions(present, extensions) : 0;
    if (validate)
        extensions[extension_count++] = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    const VkApplicationInfo application = {
        .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
        .pApplicationName = "argand",
        .pEngineName = "argand",
        .apiVersion = VK_API_VERSION_1_3,
    };
    const VkInstanceCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
        .pNext = validate ? &features : NULL,
        .pApplicationInfo = &application,
        .enabledLayerCount = validate ? 1 : 0,
        .ppEnabledLayerNames = layers,
        .enabledExtensionCount = extension_count,
        .ppEnabledExtensionNames = extensions,
    };
    VkResult result = vkCreateInstance(&info, NULL, instance);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        return log_fail(log, AG_ERROR_DEVICE, NO_DRIVER);
    if (result != VK_SUCCESS)
        return log_fail(log, AG_ERROR_DEVICE, "vkCreateInstance failed with code %d", result);
    return AG_OK;
}

ag_status gpu_instance_devices(const ag_log *log, VkInstance instance,
                               VkPhysicalDevice devices[GPU_DEVICES_MAX], uint32_t *count)
{
    *count = GPU_DEVICES_MAX;
    VkResult result = vkEnumeratePhysicalDevices(instance, count, devices);
    if ((result != VK_SUCCESS && result != VK_INCOMPLETE) || *count == 0) {
        *count = 0;
        return log_fail(log, AG_ERROR_DEVICE, NO_DRIVER);
    }
    return AG_OK;
}

uint32_t gpu_queue_family(VkPhysicalDevice physical)
{
    VkQueueFamilyProperties families[32];
    uint32_t count = 32;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
    for (uint32_t i = 0; i < count; i++)
        if (families[i].queueFlags & VK_QUEUE_GRAPHICS_BIT)
            return i;
    return UINT32_MAX;
}

// The first thing that the device lacks; NULL when it has all.
static const char *missing_part(VkPhysicalDevice physical, const VkPhysicalDeviceProperties *props)
{
    if (props->apiVersion < VK_API_VERSION_1_3)
        return "Vulkan 1.3";
    if (gpu_queue_family(physical) == UINT32_MAX)
        return "a graphics queue";
    VkPhysicalDeviceVulkan13Features v13 = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES
    };
    VkPhysicalDeviceVulkan12Features v12 = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, .pNext = &v13
    };
    VkPhysicalDeviceFeatures2 features = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                           .pNext = &v12 };
    vkGetPhysicalDeviceFeatures2(physical, &features);
    if (!v13.dynamicRendering)
        return "dynamicRendering";
    if (!v13.synchronization2)
        return "synchronization2";
    if (!v13.maintenance4)
        return "maintenance4";
    if (!v12.scalarBlockLayout)
        return "scalarBlockLayout";
    if (props->limits.maxUniformBufferRange < 65536)
        return "uniform buffers of 64 KiB";
    if (!(props->limits.framebufferColorSampleCounts & props->limits.framebufferDepthSampleCounts &
          VK_SAMPLE_COUNT_4_BIT))
        return "4 samples a pixel";
    return NULL;
}

static ag_device_kind kind_of(VkPhysicalDeviceType type)
{
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU: return AG_DEVICE_DISCRETE;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU: return AG_DEVICE_INTEGRATED;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU: return AG_DEVICE_VIRTUAL;
    case VK_PHYSICAL_DEVICE_TYPE_CPU: return AG_DEVICE_CPU;
    default: return AG_DEVICE_OTHER;
    }
}

void gpu_device_describe(VkPhysicalDevice physical, ag_device_info *info)
{
    VkPhysicalDeviceDriverProperties driver = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES
    };
    VkPhysicalDeviceProperties2 props = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                          .pNext = &driver };
    vkGetPhysicalDeviceProperties2(physical, &props);
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    const char *missing = missing_part(physical, &props.properties);

    *info = (ag_device_info) {
        .kind = kind_of(props.properties.deviceType),
        .usable = !missing,
        .max_size = props.properties.limits.maxImageDimension2D,
    };
    snprintf(info->name, sizeof info->name, "%s", props.properties.deviceName);
    snprintf(info->driver, sizeof info->driver, "%.80s %.160s", driver.driverName,
             driver.driverInfo);
    snprintf(info->missing, sizeof info->missing, "%s", missing ? missing : "");
    for (uint32_t i = 0; i < memory.memoryHeapCount; i++)
        if ((memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) &&
            memory.memoryHeaps[i].size > info->memory_bytes)
            info->memory_bytes = memory.memoryHeaps[i].size;
}

static bool contains_ignoring_case(const char *text, const char *part)
{
    size_t length = strlen(part);
    for (; *text; text++) {
        size_t i = 0;
        while (i < length && text[i] &&
               tolower((unsigned char)text[i]) == tolower((unsigned char)part[i]))
            i++;
        if (i == length)
            return true;
    }
    return false;
}

static int rank(const ag_device_info *info)
{
    static const int by_kind[] = {
        [AG_DEVICE_OTHER] = 1,   [AG_DEVICE_DISCRETE] = 4, [AG_DEVICE_INTEGRATED] = 3,
        [AG_DEVICE_VIRTUAL] = 2, [AG_DEVICE_CPU] = 0,
    };
    return info->usable ? by_kind[info->kind] : -1;
}

ag_status gpu_device_select(const ag_log *log, const char *select, const ag_device_info *infos,
                            uint32_t count, uint32_t *index)
{
    if (!select)
        select = "auto";
    bool automatic = strcmp(select, "auto") == 0, cpu = strcmp(select, "cpu") == 0;
    char *end;
    unsigned long number = strtoul(select, &end, 10);
    bool numeric = isdigit((unsigned char)*select) && *end == 0;

    const ag_device_info *best = NULL;
    for (uint32_t i = 0; i < count; i++) {
        bool fits = automatic ? infos[i].usable
                    : cpu     ? infos[i].kind == AG_DEVICE_CPU
                    : numeric ? i == number
                              : contains_ignoring_case(infos[i].name, select);
        if (fits && (!best || rank(&infos[i]) > rank(best)))
            best = &infos[i];
    }
    if (!best)
        return log_fail(log, AG_ERROR_DEVICE,
                        "no Vulkan device is '%s'; `argand devices` lists the %u there %s", select,
                        count, count == 1 ? "is" : "are");
    if (!best->usable)
        return log_fail(log, AG_ERROR_DEVICE, "%s cannot be used: it lacks %s", best->name,
                        best->missing);
    *index = (uint32_t)(best - infos);
    return AG_OK;
}

ag_status ag_device_list(const ag_log *log, ag_device_info *infos, size_t capacity, size_t *count)
{
    *count = 0;
    VkInstance instance;
    ag_status status = gpu_instance_create(log, false, false, &instance);
    if (status)
        return status;
    VkPhysicalDevice devices[GPU_DEVICES_MAX];
    uint32_t found;
    status = gpu_instance_devices(log, instance, devices, &found);
    for (uint32_t i = 0; i < found && infos && i < capacity; i++)
        gpu_device_describe(devices[i], &infos[i]);
    *count = found;
    vkDestroyInstance(instance, NULL);
    return status;
}
