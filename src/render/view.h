// A view on its way to the device: one camera, cut into tiles.
#ifndef AG_RENDER_VIEW_H
#define AG_RENDER_VIEW_H

#include "interop/scene.glsl"
#include "scene/view.h"

// A rectangle of the picture, px from its top left corner.
typedef struct view_rect {
    uint32_t x, y, width, height;
} view_rect;

// The camera's part of a frame for one tile; `jitter` moves the samples within their
// pixels, px to the right and down.
void view_frame(const view *v, view_rect tile, const float jitter[2], gpu_frame *frame);

#endif
