// Device memory: a few large blocks, cut into pieces.
//
// Vulkan limits the number of allocations (4096 is common), not that of buffers, so
// small resources share blocks.  A block is given back when its last piece is.
#ifndef AG_GPU_MEMORY_H
#define AG_GPU_MEMORY_H

#include "gpu/device.h"

typedef struct gpu_heap gpu_heap;

typedef enum gpu_memory_use {
    GPU_MEMORY_DEVICE,   // touched by the device only
    GPU_MEMORY_UPLOAD,   // written by the host, coherent
    GPU_MEMORY_READBACK, // read by the host, coherent, cached where there is such
} gpu_memory_use;

typedef struct gpu_memory {
    VkDeviceMemory memory;
    VkDeviceSize offset;
    void *mapped; // host address of `offset`; NULL for GPU_MEMORY_DEVICE
    struct gpu_block *block;
} gpu_memory;

AG_CHECK ag_status gpu_heap_create(gpu_device *device, gpu_heap **heap);
void gpu_heap_destroy(gpu_heap *heap); // NULL is allowed; all pieces must be free

// `linear` tells buffers from optimally tiled images, which may not share a page.
AG_CHECK ag_status gpu_memory_allocate(gpu_device *device, const VkMemoryRequirements *needs,
                                       gpu_memory_use use, bool linear, gpu_memory *memory);
void gpu_memory_free(gpu_device *device, gpu_memory *memory); // zero is allowed

#endif
