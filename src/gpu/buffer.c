// A buffer with its memory.
#include "gpu/buffer.h"

ag_status gpu_buffer_create(gpu_device *device, VkDeviceSize size, VkBufferUsageFlags usage,
                            gpu_memory_use use, gpu_buffer *buffer)
{
    *buffer = (gpu_buffer) { .size = size ? size : 16 };
    const VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = buffer->size,
        .usage = usage,
    };
    ag_status status = gpu_check(
        device, vkCreateBuffer(device->device, &info, NULL, &buffer->buffer), "vkCreateBuffer");
    if (!status) {
        VkMemoryRequirements needs;
        vkGetBufferMemoryRequirements(device->device, buffer->buffer, &needs);
        status = gpu_memory_allocate(device, &needs, use, true, &buffer->memory);
    }
    if (!status)
        status = gpu_check(device,
                           vkBindBufferMemory(device->device, buffer->buffer, buffer->memory.memory,
                                              buffer->memory.offset),
                           "vkBindBufferMemory");
    if (status)
        gpu_buffer_destroy(device, buffer);
    return status;
}

void gpu_buffer_destroy(gpu_device *device, gpu_buffer *buffer)
{
    vkDestroyBuffer(device->device, buffer->buffer, NULL);
    gpu_memory_free(device, &buffer->memory);
    *buffer = (gpu_buffer) { 0 };
}

ag_status gpu_buffer_ensure(gpu_device *device, VkDeviceSize size, VkBufferUsageFlags usage,
                            gpu_memory_use use, gpu_buffer *buffer)
{
    if (buffer->buffer && buffer->size >= size)
        return AG_OK;
    gpu_buffer_destroy(device, buffer);
    return gpu_buffer_create(device, size, usage, use, buffer);
}

ag_status gpu_buffer_view(gpu_device *device, const gpu_buffer *buffer, VkFormat format,
                          VkBufferView *view)
{
    const VkBufferViewCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO,
        .buffer = buffer->buffer,
        .format = format,
        .range = VK_WHOLE_SIZE,
    };
    return gpu_check(device, vkCreateBufferView(device->device, &info, NULL, view),
                     "vkCreateBufferView");
}
