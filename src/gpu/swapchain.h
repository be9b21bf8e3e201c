// The images of a window that wait their turn to be seen.
#ifndef AG_GPU_SWAPCHAIN_H
#define AG_GPU_SWAPCHAIN_H

#include "gpu/commands.h"

enum { GPU_SWAPCHAIN_IMAGES_MAX = 16 };

typedef struct gpu_swapchain {
    VkSurfaceKHR surface;
    VkSurfaceFormatKHR format; // 8 bits, not decoded: what is written is what is shown
    VkSwapchainKHR swapchain;
    VkExtent2D extent;
    uint32_t count, current;
    VkImage images[GPU_SWAPCHAIN_IMAGES_MAX];
    VkImageView views[GPU_SWAPCHAIN_IMAGES_MAX];
    VkSemaphore drawn[GPU_SWAPCHAIN_IMAGES_MAX];
    VkSemaphore acquired;
    bool stale; // no longer fits its window
} gpu_swapchain;

// Take over a surface, whether this fails or not.
AG_CHECK ag_status gpu_swapchain_create(gpu_device *device, VkSurfaceKHR surface, gpu_swapchain *s);
void gpu_swapchain_destroy(gpu_device *device, gpu_swapchain *s); // zero is allowed

// Get the next image of a window of this size in px; the swapchain is made anew when the window
// has changed.  Not `*ready`: there is none to be had now, the window is hidden or has no area.
AG_CHECK ag_status gpu_swapchain_acquire(gpu_device *device, gpu_swapchain *s, uint32_t width,
                                         uint32_t height, bool *ready);

// Submit what draws the acquired image (which leaves it as a colour attachment), then show it.
AG_CHECK ag_status gpu_swapchain_present(gpu_device *device, gpu_swapchain *s,
                                         gpu_commands *commands);

#endif
