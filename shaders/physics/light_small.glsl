// Flat lights and tubes that are so small, or so far, that their corners' rounding in float would
// leave nothing of them: as points.
//
// All in the surface's frame, z = normal; `area` = a vector along the light's normal as long as
// its area, the results per unit of its radiance.
#ifndef AG_PHYSICS_LIGHT_SMALL_GLSL
#define AG_PHYSICS_LIGHT_SMALL_GLSL

#include "physics/fresnel.glsl"
#include "physics/microfacet.glsl"

// So much smaller than the lobe is wide that it is a point to it, within .2 %.
static const real LIGHT_SMALL = 0.03f;

static inline bool light_is_small(vec3 centre, real half_size, real alpha)
{
    real most = LIGHT_SMALL * alpha;
    return half_size * half_size < most * most * dot(centre, centre);
}

// The solid angle of what faces the surface.
static inline real light_small_angle(vec3 centre, vec3 area)
{
    real d2 = max(dot(centre, centre), 1e-30f);
    return max(-dot(area, centre), 0.0f) / (d2 * sqrt(d2));
}

static inline real light_small_irradiance(vec3 centre, vec3 area)
{
    real d = sqrt(max(dot(centre, centre), 1e-30f));
    return light_small_angle(centre, area) * max(centre[2] / d, 0.0f);
}

// GGX without Fresnel, and with the factor (1 - v.h)^5.
static inline vec2 light_small_ggx(vec3 centre, vec3 area, vec3 v, real ax, real ay)
{
    vec3 l = centre / sqrt(max(dot(centre, centre), 1e-30f));
    vec3 h = v + l;
    real lobe = microfacet_d_anisotropic(h, ax, ay) *
                microfacet_v_anisotropic(v, vec3(l[0], l[1], max(l[2], 1e-6f)), ax, ay) *
                light_small_irradiance(centre, area);
    return vec2(lobe, lobe * pow5(1.0f - min(0.5f * sqrt(dot(h, h)), 1.0f)));
}

#endif
