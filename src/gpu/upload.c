// Bytes on their way from host memory into device resources.
#include "gpu/upload.h"

#include <string.h>

enum { SLOT_SIZE = 4 << 20, ALIGNMENT = 64 };

ag_status gpu_upload_begin(gpu_device *device, gpu_upload *upload)
{
    *upload = (gpu_upload) { .device = device };
    for (int i = 0; i < 2; i++) {
        gpu_upload_slot *slot = &upload->slots[i];
        ag_status status = gpu_commands_create(device, &slot->commands);
        if (!status)
            status = gpu_buffer_create(device, SLOT_SIZE, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                       GPU_MEMORY_UPLOAD, &slot->staging);
        if (status)
            return status;
    }
    return gpu_commands_begin(device, &upload->slots[0].commands);
}

void gpu_upload_finish(gpu_upload *upload)
{
    for (int i = 0; i < 2 && upload->device; i++) {
        gpu_commands_destroy(upload->device, &upload->slots[i].commands);
        gpu_buffer_destroy(upload->device, &upload->slots[i].staging);
    }
    *upload = (gpu_upload) { 0 };
}

static ag_status next_slot(gpu_upload *upload)
{
    gpu_upload_slot *slot = &upload->slots[upload->current];
    ag_status status = gpu_commands_submit(upload->device, &slot->commands);
    if (status)
        return status;
    upload->current ^= 1;
    upload->used = 0;
    return gpu_commands_begin(upload->device, &upload->slots[upload->current].commands);
}

// Copy up to `size` bytes of data, a multiple of `unit`, into staging; how many fitted
// comes back in *taken, where they begin in *offset.
static ag_status stage(gpu_upload *upload, const void *data, VkDeviceSize size, VkDeviceSize unit,
                       VkDeviceSize *offset, VkDeviceSize *taken)
{
    VkDeviceSize start = (upload->used + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    if (start + (size < unit ? size : unit) > SLOT_SIZE) {
        ag_status status = next_slot(upload);
        if (status)
            return status;
        start = 0;
    }
    VkDeviceSize room = (SLOT_SIZE - start) / unit * unit;
    *taken = size < room ? size : room;
    *offset = start;
    memcpy((char *)upload->slots[upload->current].staging.memory.mapped + start, data, *taken);
    upload->used = start + *taken;
    return AG_OK;
}

ag_status gpu_upload_buffer(gpu_upload *upload, const gpu_buffer *buffer, VkDeviceSize offset,
                            const void *data, VkDeviceSize size)
{
    const char *bytes = data;
    while (size) {
        VkDeviceSize from, taken;
        ag_status status = stage(upload, bytes, size, 4096, &from, &taken);
        if (status)
            return status;
        const gpu_upload_slot *slot = &upload->slots[upload->current];
        const VkBufferCopy region = { from, offset, taken };
        vkCmdCopyBuffer(slot->commands.buffer, slot->staging.buffer, buffer->buffer, 1, &region);
        bytes += taken;
        offset += taken;
        size -= taken;
    }
    return AG_OK;
}

void gpu_upload_image_begin(gpu_upload *upload, const gpu_image *image)
{
    gpu_barrier_image(&upload->slots[upload->current].commands, image, GPU_ACCESS_NONE,
                      GPU_ACCESS_TRANSFER_WRITE);
}

void gpu_upload_image_end(gpu_upload *upload, const gpu_image *image)
{
    gpu_barrier_image(&upload->slots[upload->current].commands, image, GPU_ACCESS_TRANSFER_WRITE,
                      GPU_ACCESS_SAMPLED);
}

ag_status gpu_upload_image_level(gpu_upload *upload, const gpu_image *image, uint32_t mip,
                                 uint32_t layer, uint32_t texel, const void *data)
{
    uint32_t width = image->desc.width >> mip ? image->desc.width >> mip : 1;
    uint32_t height = image->desc.height >> mip ? image->desc.height >> mip : 1;
    VkDeviceSize row = (VkDeviceSize)width * texel;
    const char *bytes = data;
    for (uint32_t y = 0; y < height;) {
        VkDeviceSize from, taken;
        ag_status status = stage(upload, bytes, row * (height - y), row, &from, &taken);
        if (status)
            return status;
        uint32_t rows = (uint32_t)(taken / row);
        const gpu_upload_slot *slot = &upload->slots[upload->current];
        const VkBufferImageCopy region = {
            .bufferOffset = from,
            .imageSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, mip, layer, 1 },
            .imageOffset = { 0, (int32_t)y, 0 },
            .imageExtent = { width, rows, 1 },
        };
        vkCmdCopyBufferToImage(slot->commands.buffer, slot->staging.buffer, image->image,
                               VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
        bytes += taken;
        y += rows;
    }
    return AG_OK;
}

ag_status gpu_upload_end(gpu_upload *upload)
{
    gpu_upload_slot *slot = &upload->slots[upload->current];
    gpu_barrier_memory(&slot->commands, GPU_ACCESS_TRANSFER_WRITE, GPU_ACCESS_GEOMETRY);
    return gpu_commands_submit(upload->device, &slot->commands);
}
