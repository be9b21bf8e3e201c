// The bodies of lights, as they are seen.
#ifndef AG_RENDER_BODY_H
#define AG_RENDER_BODY_H

#include "render/lights.h"

// The indices of the grids that bodies are; body.vert knows the rest.
AG_CHECK ag_status body_create(gpu_device *device, gpu_buffer *indices);

// Draw all that the view may see.
void body_draw(VkCommandBuffer cmd, const gpu_buffer *indices, const lights *l, const view *v);

#endif
