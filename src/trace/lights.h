// The lights of a scene that are not its environment, as directions are drawn to them.
//
// Bodies are in nobody's way: a ray gathers the light of all that it meets, and goes on.  Only
// the eye sees the nearest alone.
#ifndef AG_TRACE_LIGHTS_H
#define AG_TRACE_LIGHTS_H

#include "physics/lang.glsl"
#include "scene/scene.h"

typedef struct trace_light {
    ag_light_kind kind;
    bool seen;      // by the eye
    vec3 position;  // m
    vec3 direction; // the way the light travels; a tube's axis
    vec3 x, y;      // half axes, m
    vec3 intensity;
    vec3 radiance; // of the body, nit; 0 without one
    vec2 cone;     // of a spot
    float radius;  // m; a sun's sine
    float cosine;  // of a sun's angular radius
    float inverse_range2;
    float power; // for choosing: cd in the direction of most
} trace_light;

typedef struct trace_lights {
    trace_light *all;
    size_t count;
    bool bodies; // some has a body
    float ambient[9][3];
    bool ambient_present;
} trace_lights;

// `only`: this light alone shines, where its id is not 0.
AG_CHECK ag_status lights_init(const ag_scene *scene, ag_light only, trace_lights *l);
void lights_finish(trace_lights *l); // zero is allowed

// A place that is lit: where it is, and which way it faces.
typedef struct lit_place {
    vec3 position, normal;
} lit_place;

// A direction in which a light was found.
typedef struct light_found {
    vec3 direction; // unit
    float distance; // m; infinite for suns
    vec3 radiance;  // over the density; without extent: irradiance of what faces it, over its
                    // probability
    float density;  // of the direction, 1/sr, the choice of the light in it; 0 = without extent
} light_found;

// The weights by which the lights of a place are chosen, added up.
float lights_weight(const trace_lights *l, const lit_place *p);

// Choose a light by `pick` and a direction by `u`.  `total` is lights_weight().  False: no light.
bool lights_sample(const trace_lights *l, const lit_place *p, float total, float pick, vec2 u,
                   light_found *found);

// The bodies that a ray from the place meets nearer than `distance`, suns where it is infinite.
// Each one's radiance is given to `met` with the density that lights_sample() has for it.
typedef void lights_met(void *context, vec3 radiance, float density);
void lights_along(const trace_lights *l, const lit_place *p, float total, vec3 direction,
                  float distance, lights_met *met, void *context);

// The nearest body that the eye sees between `near` and `far`, else a sun where `suns` are asked
// for; `*radiance` its light.
bool lights_seen(const trace_lights *l, vec3 eye, vec3 direction, float near, float far, bool suns,
                 vec3 *radiance);

// The light of the ambient ones at a normal: irradiance over pi.
vec3 lights_ambient(const trace_lights *l, vec3 normal);

#endif
