// Diffuse reflection.
#ifndef AG_PHYSICS_DIFFUSE_GLSL
#define AG_PHYSICS_DIFFUSE_GLSL

#include "physics/lang.glsl"

// Lambert's BRDF, 1/sr, of a surface that reflects `albedo` of what it receives.
static inline vec3 diffuse_lambert(vec3 albedo)
{
    return albedo * INV_PI;
}

#endif
