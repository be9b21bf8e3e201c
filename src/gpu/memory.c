// Device memory: a few large blocks, cut into pieces.
#include "gpu/memory.h"

#include "base/log.h"
#include "base/pages.h"

#include <stdlib.h>

enum { BLOCK_SIZE = 32 << 20, PIECE_MAX = 8 << 20 };

typedef struct gpu_block {
    struct gpu_block *next;
    VkDeviceMemory memory;
    void *mapped;
    VkDeviceSize size, used;
    uint32_t type, pieces;
    bool linear;
} gpu_block;

struct gpu_heap {
    gpu_device *device;
    gpu_block *blocks;
};

ag_status gpu_heap_create(gpu_device *device, gpu_heap **out)
{
    gpu_heap *heap = calloc(1, sizeof *heap);
    *out = heap;
    if (!heap)
        return log_fail(&device->log, AG_ERROR_MEMORY, "no memory for the device's heap");
    heap->device = device;
    return AG_OK;
}

static void block_destroy(gpu_device *device, gpu_block *block)
{
    vkFreeMemory(device->device, block->memory, NULL);
    free(block);
}

void gpu_heap_destroy(gpu_heap *heap)
{
    if (!heap)
        return;
    while (heap->blocks) {
        gpu_block *block = heap->blocks;
        heap->blocks = block->next;
        block_destroy(heap->device, block);
    }
    free(heap);
}

// The memory type that has all of `must` and most of `wish`; UINT32_MAX when none.
static uint32_t find_type(const gpu_device *device, uint32_t allowed, VkMemoryPropertyFlags must,
                          VkMemoryPropertyFlags wish)
{
    uint32_t found = UINT32_MAX;
    for (uint32_t i = 0; i < device->memory.memoryTypeCount; i++) {
        VkMemoryPropertyFlags flags = device->memory.memoryTypes[i].propertyFlags;
        if (!(allowed >> i & 1) || (flags & must) != must)
            continue;
        if ((flags & wish) == wish)
            return i;
        if (found == UINT32_MAX)
            found = i;
    }
    return found;
}

static uint32_t type_for(const gpu_device *device, uint32_t allowed, gpu_memory_use use)
{
    const VkMemoryPropertyFlags host =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    switch (use) {
    case GPU_MEMORY_UPLOAD: return find_type(device, allowed, host, 0);
    case GPU_MEMORY_READBACK:
        return find_type(device, allowed, host, VK_MEMORY_PROPERTY_HOST_CACHED_BIT);
    case GPU_MEMORY_DEVICE: break;
    }
    return find_type(device, allowed, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
}

static ag_status block_create(gpu_device *device, VkDeviceSize size, uint32_t type, bool mapped,
                              gpu_block **out)
{
    gpu_block *block = calloc(1, sizeof *block);
    *out = NULL;
    if (!block)
        return log_fail(&device->log, AG_ERROR_MEMORY, "no memory for a block of device memory");
    *block = (gpu_block) { .size = size, .type = type };
    const VkMemoryAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .allocationSize = size,
        .memoryTypeIndex = type,
    };
    ag_status status = gpu_check(
        device, vkAllocateMemory(device->device, &info, NULL, &block->memory), "vkAllocateMemory");
    // A CPU device's memory is ordinary memory: the host can reach all of it.  Shared
    // blocks are not filled to the end, and so are left in small pages.
    bool ordinary =
        device->info.kind == AG_DEVICE_CPU && size != BLOCK_SIZE &&
        (device->memory.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT);
    void *address = NULL;
    if (!status && (mapped || ordinary))
        status = gpu_check(
            device, vkMapMemory(device->device, block->memory, 0, VK_WHOLE_SIZE, 0, &address),
            "vkMapMemory");
    if (ordinary)
        pages_prefer_large(address, (size_t)size);
    block->mapped = mapped ? address : NULL;
    if (status) {
        block_destroy(device, block);
        return status;
    }
    *out = block;
    return AG_OK;
}

static VkDeviceSize align(VkDeviceSize value, VkDeviceSize alignment)
{
    return (value + alignment - 1) / alignment * alignment;
}

ag_status gpu_memory_allocate(gpu_device *device, const VkMemoryRequirements *needs,
                              gpu_memory_use use, bool linear, gpu_memory *memory)
{
    *memory = (gpu_memory) { 0 };
    bool mapped = use != GPU_MEMORY_DEVICE;
    uint32_t type = type_for(device, needs->memoryTypeBits, use);
    if (type == UINT32_MAX)
        return log_fail(&device->log, AG_ERROR_DEVICE, "%s has no memory for such a resource",
                        device->info.name);
    gpu_heap *heap = device->heap;
    gpu_block *block = heap->blocks;
    bool small = needs->size <= PIECE_MAX;
    for (; small && block; block = block->next)
        if (block->type == type && block->linear == linear && !block->mapped == !mapped &&
            block->size == BLOCK_SIZE &&
            align(block->used, needs->alignment) + needs->size <= block->size)
            break;
    if (!small || !block) {
        ag_status status =
            block_create(device, small ? BLOCK_SIZE : needs->size, type, mapped, &block);
        if (status)
            return status;
        block->linear = linear;
        block->next = heap->blocks;
        heap->blocks = block;
    }
    VkDeviceSize offset = align(block->used, needs->alignment);
    block->used = offset + needs->size;
    block->pieces++;
    *memory = (gpu_memory) { block->memory, offset, mapped ? (char *)block->mapped + offset : NULL,
                             block };
    return AG_OK;
}

void gpu_memory_free(gpu_device *device, gpu_memory *memory)
{
    gpu_block *block = memory->block;
    *memory = (gpu_memory) { 0 };
    if (!block || --block->pieces > 0)
        return;
    for (gpu_block **link = &device->heap->blocks; *link; link = &(*link)->next)
        if (*link == block) {
            *link = block->next;
            break;
        }
    block_destroy(device, block);
}
