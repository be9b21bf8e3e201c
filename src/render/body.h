// The bodies of lights, as they are seen.
#ifndef AG_RENDER_BODY_H
#define AG_RENDER_BODY_H

#include "render/lights.h"

// The indices of the grids that bodies are; body.vert knows the rest.
AG_CHECK ag_status body_create(gpu_device *device, gpu_buffer *indices);

// Draw all that the view may see.
void body_draw(VkCommandBuffer cmd, const gpu_buffer *indices, const lights *l, const view *v);

// How much coarser than the finest a light's grid is in this view; GPU_BODY_LEVELS: nothing can
// be seen of it.
uint32_t body_level(const view *v, const gpu_light *light);

// The points of a light's grid, and its triangles.
enum { BODY_POINTS = (GPU_BODY_COLUMNS + 1) * (GPU_BODY_ROWS + 1) };
void body_place(const gpu_light *light, uint32_t level, float points[BODY_POINTS][3]);
const uint32_t *body_triangles(const gpu_buffer *indices, uint32_t level, uint32_t *count);

// Flat lights are dark behind.
bool body_shows_front(const gpu_light *light, const gpu_frame *frame);

#endif
