// Where the eye is and what it sees: one camera, cut into tiles.
#ifndef AG_RENDER_VIEW_H
#define AG_RENDER_VIEW_H

#include <argand/scene.h>

#include "interop/scene.glsl"

// A rectangle of the picture, px from its top left corner.
typedef struct view_rect {
    uint32_t x, y, width, height;
} view_rect;

typedef struct view {
    uint32_t width, height;            // px, of the whole picture
    float eye[3];                      // m
    float right[3], up[3], forward[3]; // unit, world space
    float half_x, half_y; // of the picture: tangents of the half angles, or m if orthographic
    float near_m, far_m;
    bool orthographic;
} view;

// `min` and `max` bound what is visible; NULL when nothing is.
view view_make(const ag_camera_desc *camera, uint32_t width, uint32_t height, const float min[3],
               const float max[3]);

// Move the planes that the camera does not give, to have a ball between them.
void view_include(view *v, const ag_camera_desc *camera, const float center[3], float radius);

// The camera's part of a frame for one tile; `jitter` moves the samples within their
// pixels, px to the right and down.
void view_frame(const view *v, view_rect tile, const float jitter[2], gpu_frame *frame);

// m along the line of sight, negative behind the eye.
float view_depth(const view *v, const float point[3]);

#endif
