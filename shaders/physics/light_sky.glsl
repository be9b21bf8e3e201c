// The GGX lobe under a white sky: its albedo, isotropic or not, without a table.
//
// The sky is the cap of light_sphere.glsl with its axis along the normal and 90 degrees wide; its
// ellipse is never cut.  Here it is all that the light is, so that the weight (w.s) / s3 of
// docs/sphere-light.md, section 3, must be right up to the rim, where it is infinite: rings of
// equal steps in angle at Gauss nodes of sqrt(1 - rho^2) take the pole out.
#ifndef AG_PHYSICS_LIGHT_SKY_GLSL
#define AG_PHYSICS_LIGHT_SKY_GLSL

#include "physics/light_sphere.glsl"

static inline vec2 light_sky_node(light_cone cone, vec3 v, vec3 stretch, real rho, real cos_t,
                                  real sin_t)
{
    vec2 d = light_cone_disc(cone, rho * cos_t, rho * sin_t);
    vec3 q = d[0] * cone.n1 + d[1] * cone.n2;
    real s3 = sqrt(max(1.0f - dot(q, q), 1e-9f));
    vec3 h = stretch * (q + s3 * cone.axis);
    real h1 = 1.0f / sqrt(dot(h, h));
    real vh = max(dot(v, h), 0.0f);
    vec3 l = (2.0f * vh * h1 * h1) * h - v;
    vec3 sv = stretch * v;
    vec3 sl = stretch * l;
    real NoL = max(l[2], 0.0f);
    real g = NoL / max(s3 * (sqrt(dot(sv, sv)) * NoL + sqrt(dot(sl, sl)) * v[2]), LIGHT_TINY);
    return vec2(vh * g, vh * g * pow5(1.0f - min(vh * h1, 1.0f)));
}

// Six nodes, the first at the angle whose cosine and sine are given.
static inline vec2 light_sky_ring(light_cone cone, vec3 v, vec3 stretch, real rho, real c, real s)
{
    vec2 sum = vec2(0.0f, 0.0f);
    for (int i = 0; i < 6; i++) {
        sum = sum + light_sky_node(cone, v, stretch, rho, c, s);
        real turned = 0.5f * c - 0.8660254f * s;
        s = 0.8660254f * c + 0.5f * s;
        c = turned;
    }
    return sum / 6.0f;
}

// x without Fresnel, y with Schlick's factor (1 - v.h)^5: f0 (x - y) + f90 y is the radiance
// towards v under a sky of radiance 1.  v.z > 0; alpha in (0, 1].
static inline vec2 light_sky_ggx(vec3 v, real ax, real ay)
{
    light_cap sky;
    sky.axis = vec3(0.0f, 0.0f, 1.0f);
    sky.sin_s = 1.0f;
    sky.cos_s = 0.0f;
    real m = max(ax, ay);
    light_cone cone = light_cone_from_cap(sky, light_rim_side(sky.axis), v, v[2],
                                          vec3(m / ax, m / ay, m), m * m * m / (ax * ay));
    vec3 stretch = vec3(ax, ay, 1.0f);
    // z = .1127, .5, .8873 of Gauss-Legendre; rho = sqrt(1 - z^2); the weight is 2 z w.
    vec2 outer = light_sky_ring(cone, v, stretch, 0.99362887f, 0.96592583f, 0.25881905f);
    vec2 middle = light_sky_ring(cone, v, stretch, 0.86602540f, 0.70710678f, 0.70710678f);
    vec2 inner = light_sky_ring(cone, v, stretch, 0.46119591f, 0.96592583f, 0.25881905f);
    vec2 sum = 0.06261204f * outer + 0.44444444f * middle + 0.49294352f * inner;
    return min(2.0f * cone.area, 2.0f) * sum;
}

#endif
