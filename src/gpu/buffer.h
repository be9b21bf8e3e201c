// A buffer with its memory.
#ifndef AG_GPU_BUFFER_H
#define AG_GPU_BUFFER_H

#include "gpu/memory.h"

typedef struct gpu_buffer {
    VkBuffer buffer;
    VkDeviceSize size;
    gpu_memory memory; // .mapped: the host's address, where the host may touch it
} gpu_buffer;

// `size` 0 makes one of 16 bytes, so that there is always something to bind.
AG_CHECK ag_status gpu_buffer_create(gpu_device *device, VkDeviceSize size,
                                     VkBufferUsageFlags usage, gpu_memory_use use,
                                     gpu_buffer *buffer);
void gpu_buffer_destroy(gpu_device *device, gpu_buffer *buffer); // zero is allowed

// Have at least `size` bytes: kept when large enough, else made anew (contents lost).
AG_CHECK ag_status gpu_buffer_ensure(gpu_device *device, VkDeviceSize size,
                                     VkBufferUsageFlags usage, gpu_memory_use use,
                                     gpu_buffer *buffer);

// The buffer's elements as texels of `format`; to be destroyed with vkDestroyBufferView.
AG_CHECK ag_status gpu_buffer_view(gpu_device *device, const gpu_buffer *buffer, VkFormat format,
                                   VkBufferView *view);

#endif
