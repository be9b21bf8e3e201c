// Triangles that shine, as directions are drawn to them.
#ifndef AG_TRACE_EMITTERS_H
#define AG_TRACE_EMITTERS_H

#include "trace/world.h"

typedef struct emitter {
    vec3 a, b, c; // corners, world space
    vec3 area;    // twice its area, along its front
    uint32_t instance, triangle;
} emitter;

typedef struct emitters {
    const world *world;
    size_t count;
    emitter *all;     // those on which something shines, instance by instance
    float *sums;      // [count + 1], running, of power
    uint32_t *guides; // [count + 1]: where even steps through the sum begin
    uint32_t **where; // [instances][triangles]: in `all`, UINT32_MAX: it is dark; NULL: all are
    vec3 center;      // of power, and the mean square of the distance from it
    float spread2;
} emitters;

AG_CHECK ag_status emitters_init(const world *w, emitters *e);
void emitters_finish(emitters *e); // zero is allowed

// What arrives of them at a place, roughly: irradiance without shadows, the mean over all ways that
// it and they may face.
float emitters_irradiance(const emitters *e, vec3 at);

// A place on one, seen from `from`.
typedef struct emitter_found {
    vec3 direction; // unit
    float distance;
    float density; // of the direction, 1/sr
    hit at;        // the place
} emitter_found;

bool emitters_sample(const emitters *e, vec3 from, float pick, vec2 u, emitter_found *found);

// The density with which emitters_sample() finds the direction of a hit from where the ray began.
float emitters_density(const emitters *e, const hit *h, vec3 direction);

#endif
