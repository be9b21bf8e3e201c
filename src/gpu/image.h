// A device image with its memory and the view of all of it.
#ifndef AG_GPU_IMAGE_H
#define AG_GPU_IMAGE_H

#include "gpu/memory.h"

typedef struct gpu_image_desc {
    VkFormat format;
    uint32_t width, height;
    uint32_t mips;    // 0 -> 1
    uint32_t samples; // 0 -> 1
    bool cube;        // six layers
    VkImageUsageFlags usage;
    VkComponentMapping swizzle; // of the view; zero = identity
} gpu_image_desc;

typedef struct gpu_image {
    VkImage image;
    VkImageView view;
    gpu_image_desc desc;
    gpu_memory memory;
} gpu_image;

AG_CHECK ag_status gpu_image_create(gpu_device *device, const gpu_image_desc *desc,
                                    gpu_image *image);
void gpu_image_destroy(gpu_device *device, gpu_image *image); // zero is allowed

VkImageAspectFlags gpu_format_aspect(VkFormat format);

#endif
