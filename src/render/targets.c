// What is drawn into: the images of one tile, and the way its pixels leave.
#include "render/targets.h"

VkFormat targets_picture_format(ag_format format)
{
    return format == AG_FORMAT_RGBA8 ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R32G32B32A32_SFLOAT;
}

VkFormat targets_surface_format(const targets_desc *desc)
{
    return desc->hdr ? VK_FORMAT_R16G16B16A16_SFLOAT : targets_picture_format(desc->format);
}

static ag_status create(gpu_device *device, const targets_desc *desc, VkFormat format,
                        uint32_t samples, VkImageUsageFlags usage, gpu_image *image)
{
    const gpu_image_desc info = { .format = format,
                                  .width = desc->width,
                                  .height = desc->height,
                                  .samples = samples,
                                  .usage = usage };
    return gpu_image_create(device, &info, image);
}

static bool same(const targets_desc *a, const targets_desc *b)
{
    return a->width == b->width && a->height == b->height && a->samples == b->samples &&
           a->hdr == b->hdr && a->sum == b->sum && a->format == b->format &&
           a->deferred == b->deferred;
}

static ag_status create_images(gpu_device *device, const targets_desc *desc, targets *t)
{
    const VkImageUsageFlags color = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    VkFormat surface = targets_surface_format(desc), picture = targets_picture_format(desc->format);
    ag_status status = create(device, desc, VK_FORMAT_D32_SFLOAT, desc->samples,
                              VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, &t->depth);
    if (!status && desc->samples > 1)
        status = create(device, desc, surface, desc->samples, color, &t->samples);
    if (!status && desc->hdr)
        status = create(device, desc, surface, 1, color | VK_IMAGE_USAGE_SAMPLED_BIT, &t->radiance);
    if (!status && desc->sum)
        status = create(device, desc, VK_FORMAT_R32G32B32A32_SFLOAT, 1,
                        color | VK_IMAGE_USAGE_SAMPLED_BIT, &t->sum);
    if (!status)
        status =
            create(device, desc, picture, 1, color | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, &t->picture);
    return status;
}

ag_status targets_ensure(gpu_device *device, const targets_desc *desc, targets *t)
{
    if (t->pixels.buffer && same(&t->desc, desc))
        return AG_OK;
    targets_destroy(device, t);
    t->desc = *desc;
    ag_status status = desc->deferred ? AG_OK : create_images(device, desc, t);
    VkDeviceSize texel = desc->format == AG_FORMAT_RGBA8 ? 4 : 16;
    if (!status)
        status =
            gpu_buffer_create(device, texel * desc->width * desc->height,
                              VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                              GPU_MEMORY_READBACK, &t->pixels);
    if (status)
        targets_destroy(device, t);
    return status;
}

void targets_destroy(gpu_device *device, targets *t)
{
    gpu_image_destroy(device, &t->depth);
    gpu_image_destroy(device, &t->samples);
    gpu_image_destroy(device, &t->radiance);
    gpu_image_destroy(device, &t->sum);
    gpu_image_destroy(device, &t->picture);
    gpu_buffer_destroy(device, &t->pixels);
    *t = (targets) { 0 };
}

void targets_read_back(const gpu_commands *commands, const targets *t)
{
    gpu_barrier_image(commands, &t->picture, GPU_ACCESS_COLOR, GPU_ACCESS_TRANSFER_READ);
    const VkBufferImageCopy region = {
        .imageSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1 },
        .imageExtent = { t->desc.width, t->desc.height, 1 },
    };
    vkCmdCopyImageToBuffer(commands->buffer, t->picture.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           t->pixels.buffer, 1, &region);
    gpu_barrier_memory(commands, GPU_ACCESS_TRANSFER_WRITE, GPU_ACCESS_HOST_READ);
}

static VkExtent3D reach(const targets *t, const gpu_image *image, uint32_t x, uint32_t y)
{
    uint32_t width = image->desc.width - x, height = image->desc.height - y;
    return (VkExtent3D) { width < t->desc.width ? width : t->desc.width,
                          height < t->desc.height ? height : t->desc.height, 1 };
}

void targets_hand_over(const gpu_commands *commands, const targets *t, const gpu_image *image,
                       uint32_t x, uint32_t y)
{
    const VkImageSubresourceLayers all = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1 };
    const VkOffset3D at = { (int32_t)x, (int32_t)y, 0 };
    const VkExtent3D extent = reach(t, image, x, y);
    gpu_barrier_image(commands, image, GPU_ACCESS_SAMPLED, GPU_ACCESS_TRANSFER_WRITE);
    if (t->desc.deferred) {
        const VkBufferImageCopy region = { .bufferRowLength = t->desc.width,
                                           .imageSubresource = all,
                                           .imageOffset = at,
                                           .imageExtent = extent };
        vkCmdCopyBufferToImage(commands->buffer, t->pixels.buffer, image->image,
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    } else {
        const VkImageCopy region = {
            .srcSubresource = all, .dstSubresource = all, .dstOffset = at, .extent = extent
        };
        gpu_barrier_image(commands, &t->picture, GPU_ACCESS_COLOR, GPU_ACCESS_TRANSFER_READ);
        vkCmdCopyImage(commands->buffer, t->picture.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                       image->image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    }
    gpu_barrier_image(commands, image, GPU_ACCESS_TRANSFER_WRITE, GPU_ACCESS_SAMPLED);
}
