// Where the eye is and what it sees.
#ifndef AG_SCENE_VIEW_H
#define AG_SCENE_VIEW_H

#include <argand/scene.h>

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

// Where the line of sight through (x, y) px of the picture begins, m, and its unit direction.
void view_ray(const view *v, float x, float y, float origin[3], float direction[3]);

// Where a point is seen: px; false where it lies behind the eye.
bool view_project(const view *v, const float point[3], float place[2]);

// m along the line of sight, negative behind the eye.
float view_depth(const view *v, const float point[3]);

#endif
