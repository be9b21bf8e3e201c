// A device image with its memory and the view of all of it.
#include "gpu/image.h"

VkImageAspectFlags gpu_format_aspect(VkFormat format)
{
    return format == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

static ag_status create_image(gpu_device *device, gpu_image *image)
{
    const gpu_image_desc *desc = &image->desc;
    const VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .flags = desc->cube ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = desc->format,
        .extent = { desc->width, desc->height, 1 },
        .mipLevels = desc->mips,
        .arrayLayers = desc->cube ? 6 : 1,
        .samples = (VkSampleCountFlagBits)desc->samples,
        .tiling = VK_IMAGE_TILING_OPTIMAL,
        .usage = desc->usage,
    };
    ag_status status = gpu_check(device, vkCreateImage(device->device, &info, NULL, &image->image),
                                 "vkCreateImage");
    if (status)
        return status;
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(device->device, image->image, &needs);
    status = gpu_memory_allocate(device, &needs, GPU_MEMORY_DEVICE, false, &image->memory);
    if (status)
        return status;
    return gpu_check(
        device,
        vkBindImageMemory(device->device, image->image, image->memory.memory, image->memory.offset),
        "vkBindImageMemory");
}

static ag_status create_view(gpu_device *device, gpu_image *image)
{
    const VkImageViewCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
        .image = image->image,
        .viewType = image->desc.cube ? VK_IMAGE_VIEW_TYPE_CUBE : VK_IMAGE_VIEW_TYPE_2D,
        .format = image->desc.format,
        .components = image->desc.swizzle,
        .subresourceRange = { gpu_format_aspect(image->desc.format), 0, VK_REMAINING_MIP_LEVELS, 0,
                              VK_REMAINING_ARRAY_LAYERS },
    };
    return gpu_check(device, vkCreateImageView(device->device, &info, NULL, &image->view),
                     "vkCreateImageView");
}

ag_status gpu_image_create(gpu_device *device, const gpu_image_desc *desc, gpu_image *image)
{
    *image = (gpu_image) { .desc = *desc };
    if (!desc->mips)
        image->desc.mips = 1;
    if (!desc->samples)
        image->desc.samples = 1;
    ag_status status = create_image(device, image);
    if (!status)
        status = create_view(device, image);
    if (status)
        gpu_image_destroy(device, image);
    return status;
}

void gpu_image_destroy(gpu_device *device, gpu_image *image)
{
    vkDestroyImageView(device->device, image->view, NULL);
    vkDestroyImage(device->device, image->image, NULL);
    gpu_memory_free(device, &image->memory);
    *image = (gpu_image) { 0 };
}
