// A surface under lights of extent, whatever their shape.
//
// A shape says three things of itself, in the surface's own frame (surface_shine); surface_shone
// makes radiance of them for every `model`.  A new shape needs no new surface.
#ifndef AG_PHYSICS_SURFACE_LIGHT_GLSL
#define AG_PHYSICS_SURFACE_LIGHT_GLSL

#include "physics/light_sky.glsl"
#include "physics/light_sphere.glsl"
#include "physics/surface.glsl"

// The frame in which lights are asked: z = normal, x = tangent.
STRUCT(surface_frame) {
    vec3 x;
    vec3 y;
    vec3 n;
    vec3 v; // towards the eye, in the frame
    real ax;
    real ay;
};

// A light in that frame; the first two per unit of it, whatever its unit.
STRUCT(surface_shine) {
    real irradiance; // of the surface, the horizon regarded
    vec2 lobe;       // GGX without Fresnel, and with the factor (1 - v.h)^5
    vec3 middle;     // unit, up: from where the irradiance comes on the whole
    vec3 nearest;    // unit, up: of the light's directions, the nearest to the mirror's
};

static inline surface_frame surface_frame_from(surface s, vec3 n, vec3 wo)
{
    surface_frame f;
    real NoV = surface_cosine(n, wo);
    vec3 side = wo - dot(n, wo) * n;
    real length2 = dot(side, side);
    vec3 other = max(n[0], -n[0]) < 0.7f ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f, 1.0f, 0.0f);
    other = other - dot(other, n) * n;
    f.n = n;
    // A round lobe has its x where the eye is.
    f.x = length2 > 1e-12f ? side / sqrt(length2) : normalize(other);
    f.v = vec3(sqrt(max(1.0f - NoV * NoV, 0.0f)), 0.0f, NoV);
    f.ax = sqrt(s.a2);
    f.ay = f.ax;
    if ((s.model & SURFACE_DISTRIBUTION) == SURFACE_ANISOTROPIC) {
        f.ay = sqrt(s.a2_across);
        f.v = f.v[0] * vec3(dot(s.tangent, f.x), dot(cross(n, s.tangent), f.x), 0.0f);
        f.v = vec3(f.v[0], f.v[1], NoV);
        f.x = s.tangent;
    }
    f.y = cross(n, f.x);
    return f;
}

static inline vec3 surface_frame_in(surface_frame f, vec3 d)
{
    return vec3(dot(d, f.x), dot(d, f.y), dot(d, f.n));
}

// The lobe's other shadowing and distribution, by their ratio to GGX's at the direction l.
static inline real surface_ratio(surface s, surface_frame f, vec3 l)
{
    vec3 h = f.v + l;
    real NoL = max(l[2], 1e-3f);
    real smith = microfacet_v_anisotropic(f.v, l, f.ax, f.ay);
    if ((s.model & SURFACE_DISTRIBUTION) == SURFACE_BLINN) {
        real NoH = h[2] / sqrt(max(dot(h, h), 1e-12f));
        real ggx = microfacet_d_anisotropic(h, f.ax, f.ay) * smith * NoL;
        return microfacet_blinn(NoH, s.shininess) / max(ggx, 1e-12f);
    }
    return microfacet_v_schlick(f.v[2], NoL, microfacet_schlick_k(s.roughness)) / smith;
}

// Radiance towards the eye, per unit of the light.
static inline vec3 surface_shone(surface s, surface_frame f, surface_shine light)
{
    vec3 h = f.v + light.middle;
    real VoH = min(0.5f * sqrt(dot(h, h)), 1.0f);
    vec3 base = surface_base(s, f.v[2], light.middle[2], dot(f.v, light.middle), VoH);
    vec2 lobe = light.lobe;
    if ((s.model & SURFACE_DISTRIBUTION) == SURFACE_BLINN)
        lobe = vec2(lobe[0] * surface_ratio(s, f, light.nearest), 0.0f);
    else if ((s.model & SURFACE_SHADOWING) == SURFACE_SCHLICK_GGX)
        lobe = lobe * surface_ratio(s, f, light.nearest);
    return light.irradiance * base + surface_lobe(s, lobe[0] - lobe[1], lobe[1]);
}

// ---- Spheres and suns --------------------------------------------------------

// From where the visible part of the cap shines on the whole: its axis; raised half way to its
// highest point where the horizon cuts it.
static inline vec3 light_cap_middle(light_cap cap)
{
    real up = max(cap.axis[2], 0.5f * (cap.axis[2] + cap.sin_s));
    return normalize(vec3(cap.axis[0], cap.axis[1], max(up, 1e-3f)));
}

// The direction in the cap nearest to the mirror's, and up.
static inline vec3 light_cap_nearest(light_cap cap, vec3 v)
{
    vec3 r = vec3(-v[0], -v[1], v[2]);
    real c = dot(r, cap.axis);
    vec3 off = r - c * cap.axis;
    real inside = dot(off, off);
    vec3 rim = cap.cos_s * cap.axis + cap.sin_s / sqrt(max(inside, 1e-12f)) * off;
    vec3 d = c >= cap.cos_s ? r : rim;
    return normalize(vec3(d[0], d[1], max(d[2], 1e-3f)));
}

// As surface_direct for a light of extent: times the irradiance that the light gives to a
// surface facing it (light_sphere.glsl says what that is), this is the radiance towards wo.
// `cap.axis` in the frame of n and wo.
static inline vec3 surface_cap(surface s, vec3 n, vec3 wo, light_cap cap)
{
    surface_frame f = surface_frame_from(s, n, wo);
    light_cap local;
    local.axis = normalize(surface_frame_in(f, cap.axis));
    local.sin_s = cap.sin_s;
    local.cos_s = cap.cos_s;
    surface_shine light;
    light.irradiance = light_cap_cosine(local);
    light.lobe = light_cap_ggx(local, f.v, f.ax, f.ay);
    light.middle = light_cap_middle(local);
    light.nearest = light_cap_nearest(local, f.v);
    return surface_shone(s, f, light);
}

// ---- The sky -----------------------------------------------------------------

// The DFG table's pair, computed, for lobes that are not round.
static inline vec2 surface_sky(surface_material m, vec3 n, vec3 wo)
{
    real NoV = surface_cosine(n, wo);
    vec3 v = vec3(dot(m.tangent, wo), dot(cross(n, m.tangent), wo), 0.0f);
    v = sqrt(max(1.0f - NoV * NoV, 0.0f) / max(dot(v, v), 1e-12f)) * v;
    real alpha = max(m.roughness * m.roughness, SURFACE_MIN_ALPHA);
    vec2 alphas = microfacet_alphas(alpha, m.anisotropy);
    vec2 sky = light_sky_ggx(vec3(v[0], v[1], NoV), alphas[0], alphas[1]);
    return vec2(sky[0] - sky[1], sky[1]);
}

#endif
