// Paths of light, followed from the eye.
#ifndef AG_TRACE_PATH_H
#define AG_TRACE_PATH_H

#include <argand/reference.h>

#include "physics/white_balance.glsl"
#include "scene/view.h"
#include "trace/albedo.h"
#include "trace/emitters.h"
#include "trace/lights.h"
#include "trace/sky.h"
#include "trace/world.h"

// What paths meet, and how they are to be followed.
typedef struct path_scene {
    world world;
    trace_sky sky;
    trace_lights lights;
    emitters emitters;
    albedo_table albedo;
    view view;
    ag_render_options picture;
    rgb_matrix exposure; // by the picture's options
    ag_reference_options options;
} path_scene;

typedef struct path_result {
    vec3 direct, indirect; // exposed radiance
    float alpha;
    vec3 albedo, normal; // of the first surface
    float depth;
    uint32_t rays;
} path_result;

// Samples [from, from + count) of a pixel, count at most PATH_BUNDLE.
typedef struct path_work {
    uint32_t x, y, from, count;
} path_work;

// Follow the samples of some pixels, together at most PATH_BUNDLE, side by side; results in the
// same order.
enum { PATH_BUNDLE = SKY_MANY };
void path_follow(const path_scene *s, const path_work *work, size_t pixels, path_result *results);

#endif
