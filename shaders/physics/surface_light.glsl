// The metallic-roughness surface under a sphere light or a sun.
#ifndef AG_PHYSICS_SURFACE_LIGHT_GLSL
#define AG_PHYSICS_SURFACE_LIGHT_GLSL

#include "physics/light_sphere.glsl"
#include "physics/surface.glsl"

// As surface_direct for a light of extent: times the irradiance that the light gives to a
// surface facing it (light_sphere.glsl says what that is), this is the radiance towards wo.
// `cap.axis` in the frame of n and wo.
static inline vec3 surface_cap(surface s, vec3 n, vec3 wo, light_cap cap)
{
    // The lobe is round: x is where the eye is.
    real NoV = surface_cosine(n, wo);
    vec3 side = wo - dot(n, wo) * n;
    real length2 = dot(side, side);
    vec3 other = max(n[0], -n[0]) < 0.7f ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f, 1.0f, 0.0f);
    other = other - dot(other, n) * n;
    vec3 x = length2 > 1e-12f ? side / sqrt(length2) : normalize(other);
    vec3 y = cross(n, x);
    vec3 axis = vec3(dot(cap.axis, x), dot(cap.axis, y), dot(cap.axis, n));
    light_cap local;
    local.axis = normalize(axis);
    local.sin_s = cap.sin_s;
    local.cos_s = cap.cos_s;
    vec3 v = vec3(sqrt(max(1.0f - NoV * NoV, 0.0f)), 0.0f, NoV);

    real alpha = sqrt(s.a2);
    vec2 lobe = light_cap_ggx(local, v, alpha, alpha);
    return light_cap_cosine(local) * diffuse_lambert(s.lambert) +
           s.f0 * (lobe[0] - lobe[1]) + vec3(s.f90, s.f90, s.f90) * lobe[1];
}

#endif
