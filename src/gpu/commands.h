// Commands: recorded, submitted, waited for.
#ifndef AG_GPU_COMMANDS_H
#define AG_GPU_COMMANDS_H

#include "gpu/buffer.h"
#include "gpu/image.h"

// One command buffer and the fence that tells when it is done.
typedef struct gpu_commands {
    VkCommandBuffer buffer;
    VkFence fence;
    bool pending; // submitted and not yet waited for
} gpu_commands;

AG_CHECK ag_status gpu_commands_create(gpu_device *device, gpu_commands *commands);
void gpu_commands_destroy(gpu_device *device, gpu_commands *commands); // waits; zero is allowed

// Waits for what was submitted before, and drops what was recorded and not submitted.
AG_CHECK ag_status gpu_commands_begin(gpu_device *device, gpu_commands *commands);
AG_CHECK ag_status gpu_commands_submit(gpu_device *device, gpu_commands *commands);
// The same, with colours written after `before` is signalled, and `after` signalled at the end.
AG_CHECK ag_status gpu_commands_submit_between(gpu_device *device, gpu_commands *commands,
                                               VkSemaphore before, VkSemaphore after);
AG_CHECK ag_status gpu_commands_wait(gpu_device *device, gpu_commands *commands);

// What happens to an image (or to memory) on one side of a barrier.
typedef struct gpu_access {
    VkPipelineStageFlags2 stage;
    VkAccessFlags2 access;
    VkImageLayout layout; // ignored by gpu_barrier_memory
} gpu_access;

extern const gpu_access GPU_ACCESS_NONE;           // nothing: contents are dropped
extern const gpu_access GPU_ACCESS_COLOR;          // drawn to and resolved to
extern const gpu_access GPU_ACCESS_DEPTH;          // depth attachment
extern const gpu_access GPU_ACCESS_SAMPLED;        // read by fragment and compute shaders
extern const gpu_access GPU_ACCESS_TRANSFER_READ;  // copied from
extern const gpu_access GPU_ACCESS_TRANSFER_WRITE; // copied to
extern const gpu_access GPU_ACCESS_HOST_READ;      // read by the host (memory only)
extern const gpu_access GPU_ACCESS_COMPUTE_WRITE;  // storage written (memory only)
extern const gpu_access GPU_ACCESS_GEOMETRY;       // vertices, indices, shader storage

void gpu_barrier_image(const gpu_commands *commands, const gpu_image *image, gpu_access before,
                       gpu_access after);
void gpu_barrier_memory(const gpu_commands *commands, gpu_access before, gpu_access after);

#endif
