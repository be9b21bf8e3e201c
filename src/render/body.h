// The bodies of lights, as they are seen.
#ifndef AG_RENDER_BODY_H
#define AG_RENDER_BODY_H

#include "gpu/buffer.h"

#include "interop/scene.glsl"

// The indices of the grid that every body is; body.vert knows the rest.
AG_CHECK ag_status body_create(gpu_device *device, gpu_buffer *indices);

// Draw those of `count` lights.
void body_draw(VkCommandBuffer cmd, const gpu_buffer *indices, uint32_t first, uint32_t count);

#endif
