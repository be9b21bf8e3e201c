// The images of a window that wait their turn to be seen.
#include "gpu/swapchain.h"

#include "base/log.h"

enum { ACQUIRE_NS = 100 * 1000 * 1000 }; // some windows give no image while they are hidden

// ---- The surface -------------------------------------------------------------

static ag_status check_support(gpu_device *device, const gpu_swapchain *s)
{
    VkBool32 supported = VK_FALSE;
    ag_status status =
        gpu_check(device,
                  vkGetPhysicalDeviceSurfaceSupportKHR(device->physical, device->queue_family,
                                                       s->surface, &supported),
                  "vkGetPhysicalDeviceSurfaceSupportKHR");
    if (!status && !supported)
        status = log_fail(&device->log, AG_ERROR_DEVICE,
                          "%s cannot show pictures in this window; choose another device",
                          device->info.name);
    return status;
}

static ag_status choose_format(gpu_device *device, gpu_swapchain *s)
{
    VkSurfaceFormatKHR formats[64];
    uint32_t count = 64;
    VkResult result =
        vkGetPhysicalDeviceSurfaceFormatsKHR(device->physical, s->surface, &count, formats);
    if (result != VK_SUCCESS && result != VK_INCOMPLETE)
        return gpu_check(device, result, "vkGetPhysicalDeviceSurfaceFormatsKHR");
    for (uint32_t i = 0; i < count; i++) {
        VkFormat format = formats[i].format;
        if (format == VK_FORMAT_B8G8R8A8_UNORM || format == VK_FORMAT_R8G8B8A8_UNORM) {
            s->format = formats[i];
            return AG_OK;
        }
    }
    return log_fail(&device->log, AG_ERROR_DEVICE, "the window shows no pictures of 8 bits");
}

ag_status gpu_swapchain_create(gpu_device *device, VkSurfaceKHR surface, gpu_swapchain *s)
{
    *s = (gpu_swapchain) { .surface = surface };
    ag_status status = check_support(device, s);
    if (!status)
        status = choose_format(device, s);
    if (status)
        gpu_swapchain_destroy(device, s);
    return status;
}

// ---- Its images --------------------------------------------------------------

// All but the surface and the old swapchain, from which the next one is made.
static void destroy_images(gpu_device *device, gpu_swapchain *s)
{
    if (!s->swapchain)
        return;
    vkDeviceWaitIdle(device->device);
    for (uint32_t i = 0; i < s->count; i++) {
        vkDestroyImageView(device->device, s->views[i], NULL);
        vkDestroySemaphore(device->device, s->drawn[i], NULL);
        s->views[i] = VK_NULL_HANDLE;
        s->drawn[i] = VK_NULL_HANDLE;
    }
    vkDestroySemaphore(device->device, s->acquired, NULL);
    s->acquired = VK_NULL_HANDLE;
    s->count = 0;
}

void gpu_swapchain_destroy(gpu_device *device, gpu_swapchain *s)
{
    destroy_images(device, s);
    if (s->swapchain) // else the device may know no windows
        vkDestroySwapchainKHR(device->device, s->swapchain, NULL);
    if (s->surface)
        vkDestroySurfaceKHR(device->instance, s->surface, NULL);
    *s = (gpu_swapchain) { 0 };
}

static ag_status create_semaphore(gpu_device *device, VkSemaphore *semaphore)
{
    const VkSemaphoreCreateInfo info = { .sType = VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO };
    return gpu_check(device, vkCreateSemaphore(device->device, &info, NULL, semaphore),
                     "vkCreateSemaphore");
}

static ag_status create_view(gpu_device *device, VkFormat format, VkImage image, VkImageView *view)
{
    const VkImageViewCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image,
        .viewType = VK_IMAGE_VIEW_TYPE_2D,
        .format = format,
        .subresourceRange = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1 },
    };
    return gpu_check(device, vkCreateImageView(device->device, &info, NULL, view),
                     "vkCreateImageView");
}

static ag_status create_images(gpu_device *device, gpu_swapchain *s)
{
    uint32_t count = GPU_SWAPCHAIN_IMAGES_MAX;
    ag_status status =
        gpu_check(device, vkGetSwapchainImagesKHR(device->device, s->swapchain, &count, s->images),
                  "vkGetSwapchainImagesKHR");
    if (!status)
        status = create_semaphore(device, &s->acquired);
    for (; s->count < count && !status; s->count++) {
        status = create_view(device, s->format.format, s->images[s->count], &s->views[s->count]);
        if (!status)
            status = create_semaphore(device, &s->drawn[s->count]);
    }
    return status;
}

// The window's size where it has one of its own, else the one that is asked for.
static VkExtent2D choose_extent(const VkSurfaceCapabilitiesKHR *can, uint32_t width,
                                uint32_t height)
{
    VkExtent2D e = can->currentExtent;
    if (e.width != UINT32_MAX)
        return e;
    e = (VkExtent2D) { width, height };
    const VkExtent2D low = can->minImageExtent, high = can->maxImageExtent;
    e.width = e.width < low.width ? low.width : e.width > high.width ? high.width : e.width;
    e.height = e.height < low.height ? low.height : e.height > high.height ? high.height : e.height;
    return e;
}

static ag_status replace(gpu_device *device, gpu_swapchain *s, const VkSurfaceCapabilitiesKHR *can)
{
    uint32_t count = can->minImageCount + 1;
    if (can->maxImageCount && count > can->maxImageCount)
        count = can->maxImageCount;
    const bool opaque = can->supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
    const VkSwapchainCreateInfoKHR info = {
        .sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR,
        .surface = s->surface,
        .minImageCount = count,
        .imageFormat = s->format.format,
        .imageColorSpace = s->format.colorSpace,
        .imageExtent = s->extent,
        .imageArrayLayers = 1,
        .imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
        .preTransform = can->currentTransform,
        .compositeAlpha =
            opaque ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR,
        .presentMode = VK_PRESENT_MODE_FIFO_KHR,
        .clipped = VK_TRUE,
        .oldSwapchain = s->swapchain,
    };
    destroy_images(device, s);
    VkSwapchainKHR made = VK_NULL_HANDLE;
    VkResult result = vkCreateSwapchainKHR(device->device, &info, NULL, &made);
    vkDestroySwapchainKHR(device->device, s->swapchain, NULL);
    s->swapchain = made;
    ag_status status = gpu_check(device, result, "vkCreateSwapchainKHR");
    if (!status)
        status = create_images(device, s);
    s->stale = status != AG_OK;
    return status;
}

// Have a swapchain that fits the window; not `*ready`: the window has no area.
static ag_status fit(gpu_device *device, gpu_swapchain *s, uint32_t width, uint32_t height,
                     bool *ready)
{
    VkSurfaceCapabilitiesKHR can;
    ag_status status = gpu_check(
        device, vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device->physical, s->surface, &can),
        "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
    if (status)
        return status;
    VkExtent2D extent = choose_extent(&can, width, height);
    *ready = extent.width && extent.height;
    if (!*ready || (s->swapchain && !s->stale && extent.width == s->extent.width &&
                    extent.height == s->extent.height))
        return AG_OK;
    s->extent = extent;
    return replace(device, s, &can);
}

// ---- Frames ------------------------------------------------------------------

ag_status gpu_swapchain_acquire(gpu_device *device, gpu_swapchain *s, uint32_t width,
                                uint32_t height, bool *ready)
{
    enum { ATTEMPTS = 4 }; // the window may change again and again while we look
    *ready = false;
    for (int i = 0; i < ATTEMPTS; i++) {
        ag_status status = fit(device, s, width, height, ready);
        if (status || !*ready)
            return status;
        VkResult result = vkAcquireNextImageKHR(device->device, s->swapchain, ACQUIRE_NS,
                                                s->acquired, VK_NULL_HANDLE, &s->current);
        *ready = result == VK_SUCCESS || result == VK_SUBOPTIMAL_KHR;
        s->stale = result == VK_SUBOPTIMAL_KHR || result == VK_ERROR_OUT_OF_DATE_KHR;
        if (*ready || result == VK_TIMEOUT || result == VK_NOT_READY)
            return AG_OK;
        if (result != VK_ERROR_OUT_OF_DATE_KHR)
            return gpu_check(device, result, "vkAcquireNextImageKHR");
    }
    return AG_OK;
}

ag_status gpu_swapchain_present(gpu_device *device, gpu_swapchain *s, gpu_commands *commands)
{
    ag_status status =
        gpu_commands_submit_between(device, commands, s->acquired, s->drawn[s->current]);
    if (status) {
        s->stale = true; // `acquired` is left as it is: a new one is needed
        return status;
    }
    const VkPresentInfoKHR info = {
        .sType = VK_STRUCTURE_TYPE_PRESENT_INFO_KHR,
        .waitSemaphoreCount = 1,
        .pWaitSemaphores = &s->drawn[s->current],
        .swapchainCount = 1,
        .pSwapchains = &s->swapchain,
        .pImageIndices = &s->current,
    };
    VkResult result = vkQueuePresentKHR(device->queue, &info);
    if (result != VK_SUBOPTIMAL_KHR && result != VK_ERROR_OUT_OF_DATE_KHR)
        return gpu_check(device, result, "vkQueuePresentKHR");
    s->stale = true;
    return AG_OK;
}
