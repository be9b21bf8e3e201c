// Image-based light: where a direction lies in the images, and what is hidden of it.
//
// Right-handed, +Y up.  An equirectangular image has its centre at +X, its top at +Y;
// u, v in [0, 1] from its top left corner.  roughness = perceptual, alpha = roughness^2.
#ifndef AG_PHYSICS_ENVIRONMENT_GLSL
#define AG_PHYSICS_ENVIRONMENT_GLSL

#include "physics/lang.glsl"

// v would be acos(d.y) / pi; atan2 keeps its digits at the poles, where acos loses half
// of them (and in GLSL implementations more).
static inline vec2 environment_uv(vec3 d)
{
    real u = 0.5f + atan2(d[2], d[0]) * (0.5f * INV_PI);
    real v = atan2(sqrt(d[0] * d[0] + d[2] * d[2]), d[1]) * INV_PI;
    return vec2(u, v);
}

static inline vec3 environment_direction(vec2 uv)
{
    real phi = (uv[0] - 0.5f) * 2.0f * PI;
    real theta = uv[1] * PI;
    return vec3(sin(theta) * cos(phi), cos(theta), sin(theta) * sin(phi));
}

// A point of a face of Vulkan's cube maps (+X -X +Y -Y +Z -Z); s, t in [-1, 1], to the
// right and down.  Not normalised.  Vulkan 1.3, "Cube Map Face Selection".
static inline vec3 environment_cube_direction(uint face, real s, real t)
{
    switch (face) {
    case 0u: return vec3(1.0f, -t, -s);
    case 1u: return vec3(-1.0f, -t, s);
    case 2u: return vec3(s, 1.0f, t);
    case 3u: return vec3(s, -1.0f, -t);
    case 4u: return vec3(s, -t, 1.0f);
    }
    return vec3(-s, -t, -1.0f);
}

// How much of a pixel a sun covers whose light travels along `sun`, by the sine of its angular
// radius: d is seen in the pixel's middle, dx and dy in those of its neighbours, all of them
// unit.  The edge is as wide as the pixel.
static inline real environment_sun_share(vec3 d, vec3 dx, vec3 dy, vec3 sun, real sin_radius)
{
    vec3 c = cross(d, sun), cx = cross(dx, sun), cy = cross(dy, sun);
    real apart = sqrt(dot(c, c)); // the sine of the angle
    real to_x = sqrt(dot(cx, cx)) - apart, to_y = sqrt(dot(cy, cy)) - apart;
    real width = max(to_x, -to_x) + max(to_y, -to_y);
    real edge = (sin_radius - apart) / max(width, 1e-7f) + 0.5f;
    return dot(d, sun) < 0.0f ? clamp(edge, 0.0f, 1.0f) : 0.0f;
}

// The level of the prefiltered cube that is filtered for `roughness`, and back.  The
// parabola spends the levels on smooth surfaces, whose lobes differ most.
static inline real environment_mip(real roughness, real mip_count)
{
    return (mip_count - 1.0f) * roughness * (2.0f - roughness);
}

static inline real environment_roughness(real mip, real mip_count)
{
    return 1.0f - sqrt(max(1.0f - mip / (mip_count - 1.0f), 0.0f));
}

// The mean direction of the lobe's light, D V cos over the hemisphere, for r = reflect(-wo,
// n): r drawn to n as the surface gets rough, and more so at grazing angles, where the
// horizon cuts the lobe.  A rational fit of our own to the integral, the share of r right
// to .02 (root mean square); Lagarde & de Rousiers' (2014, listing 22), without the
// angle, to .11.
static inline vec3 environment_dominant(vec3 n, vec3 r, real alpha)
{
    real NoV = clamp(dot(n, r), 0.0f, 1.0f);
    real a2 = alpha * alpha;
    real bend = 0.2580f * a2 / (a2 + NoV * NoV + 0.000001f) + 1.3520f * a2 - 1.1857f * alpha * NoV;
    return normalize(mix(n, r, (1.0f - alpha) / (1.0f + bend)));
}

// A lobe drawn out along `tangent` is looked up about the mirror direction of a normal bent
// towards the eye in the plane of that direction.  The mix is that of Filament's document,
// "Anisotropy" of image based lights, with its exponent of 4.
static inline vec3 environment_bent_normal(vec3 n, vec3 wo, vec3 tangent, real anisotropy,
                                           real roughness)
{
    vec3 across = cross(n, tangent);
    vec3 bent = cross(cross(across, wo), across);
    real straight = 1.0f - anisotropy * (1.0f - roughness);
    straight = straight * straight;
    bent = bent / sqrt(max(dot(bent, bent), 1e-12f));
    return normalize(mix(bent, n, straight * straight));
}

// How much of the reflected image light reaches a surface whose share `ao` of the sky is
// open.  Lagarde & de Rousiers 2014, listing 26.
static inline real environment_specular_occlusion(real NoV, real ao, real alpha)
{
    return clamp(pow(NoV + ao, exp2(-16.0f * alpha - 1.0f)) - 1.0f + ao, 0.0f, 1.0f);
}

// A normal map can reflect a ray into the surface that carries it; fade such light out.
// `n` is the geometric normal.  Russell 2015, "Horizon Occlusion for Normal Mapped
// Reflections".
static inline real environment_horizon_occlusion(vec3 r, vec3 n)
{
    real h = clamp(1.0f + dot(r, n), 0.0f, 1.0f);
    return h * h;
}

#endif
