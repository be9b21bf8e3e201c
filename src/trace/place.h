// A place on a surface that a ray has found: where it is, which way it faces, what it is made of.
#ifndef AG_TRACE_PLACE_H
#define AG_TRACE_PLACE_H

#include "physics/surface.glsl"
#include "trace/world.h"

typedef struct place {
    vec3 position;
    vec3 origin; // of rays that leave it: just above the curved surface that its normals tell of
    vec3 face;   // of the triangle, unit, on the side of the ray
    vec3 normal; // of the shading, unit; the mirror direction about it is above the face
    vec3 base_color;
    vec3 emission; // nit, towards wo
    surface_material material;
    bool unlit;
} place;

// Many hits wait for memory together: tell it that place_at() will ask for them.
void place_expect(const hit *const *hits, size_t count);

// `wo` back along the ray, unit.
place place_at(const world *w, const hit *h, vec3 wo);

// What shines from a hit along wo, nit.
vec3 place_emission(const world *w, const hit *h, vec3 wo);

#endif
