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
    vec3 mean;       // direction of that irradiance; not unit: shorter as it is spread
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

// The lobe's other shadowing and distribution, by their ratio to GGX's where in the light the lobe
// finds most: nearest to the mirror direction under a lobe much narrower than the light, in its
// middle under a much wider one.  A cap of sine s has 1 - |mean|^2 = s^2 / 2.
static inline real surface_ratio(surface s, surface_frame f, surface_shine light)
{
    real length2 = dot(light.mean, light.mean);
    real spread = max(2.0f - 2.0f * length2, 0.0f);
    real alpha = max(f.ax, f.ay);
    vec3 middle = light.mean / sqrt(max(length2, 1e-12f));
    vec3 l = normalize(mix(middle, light.nearest, spread / (spread + 3.0f * alpha * alpha)));
    vec3 h = f.v + l;
    real NoL = max(l[2], 1e-3f);
    real smith = microfacet_v_anisotropic(f.v, l, f.ax, f.ay);
    if ((s.model & SURFACE_DISTRIBUTION) == SURFACE_BLINN) {
        real NoH = h[2] / sqrt(max(dot(h, h), 1e-12f));
        real ggx = microfacet_d_anisotropic(h, f.ax, f.ay) * smith * NoL;
        return microfacet_blinn(NoH, s.shininess) / max(ggx, 1e-12f);
    }
    return microfacet_v_schlick(f.v[2], NoL, s.schlick_k) / smith;
}

// Radiance towards the eye, per unit of the light.
static inline vec3 surface_shone(surface s, surface_frame f, surface_shine light)
{
    real LoV = dot(f.v, light.mean);
    real VoH = sqrt(clamp(0.5f + 0.5f * LoV, 0.0f, 1.0f));
    vec3 base = surface_base(s, f.v[2], light.mean[2], LoV, VoH);
    vec2 lobe = light.lobe;
    if ((s.model & SURFACE_DISTRIBUTION) == SURFACE_BLINN)
        lobe = vec2(lobe[0] * surface_ratio(s, f, light), 0.0f);
    else if ((s.model & SURFACE_SHADOWING) == SURFACE_SCHLICK_GGX)
        lobe = lobe * surface_ratio(s, f, light);
    return light.irradiance * base + surface_lobe(s, lobe[0] - lobe[1], lobe[1]);
}

// ---- Spheres and suns --------------------------------------------------------

// The mean direction of the irradiance that the cap gives, not a unit vector.  Above the horizon
// it is the second moment of a cap, a + b axis axis^T, by the normal; where the horizon cuts it,
// its height is a fit to the limits of small caps and of hemispheres, right to .05, and its
// length goes to 1 as the cap sinks.
static inline vec3 light_cap_mean(light_cap cap)
{
    real c = cap.cos_s;
    real z = cap.axis[2];
    real level = sqrt(max(1.0f - z * z, 0.0f));
    // a and b over the irradiance of a facing surface, sin_s^2 / 2.
    real third = (1.0f + c + c * c) / (1.0f + c) * (2.0f / 3.0f);
    real a = 1.0f / (1.0f + c) - 0.5f * third;
    real b = third - a;
    real height = max(z, max(cap.sin_s, 1e-6f));
    real up = a / height + b * height;
    real along = b * level;
    if (z < cap.sin_s) {
        real q = max(z / height, -1.0f);
        real low = min(q, 0.0f);
        real whole = sqrt(up * up + b * b * c * c);
        real size = 1.0f - (0.5f + 0.5f * q) * (1.0f - whole);
        up = up * mix(0.471f + q * (0.5f + 0.029f * q), 1.0f - low * low, 1.0f - c);
        along = sqrt(max(size * size - up * up, 0.0f));
    }
    real turn = along / max(level, 1e-6f);
    return vec3(turn * cap.axis[0], turn * cap.axis[1], max(up, 0.0f));
}

// The direction in the cap nearest to the mirror's; as high as `mean` where the horizon cuts it.
static inline vec3 light_cap_nearest(light_cap cap, vec3 v, vec3 mean)
{
    vec3 r = vec3(-v[0], -v[1], v[2]);
    real c = dot(r, cap.axis);
    vec3 off = r - c * cap.axis;
    vec3 rim = cap.cos_s * cap.axis + cap.sin_s / sqrt(max(dot(off, off), 1e-12f)) * off;
    vec3 d = c >= cap.cos_s ? r : rim;
    real low = cap.axis[2] < cap.sin_s ? mean[2] : 0.0f;
    return normalize(vec3(d[0], d[1], max(d[2], max(low, 1e-3f))));
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
    light.mean = light_cap_mean(local);
    light.nearest = light_cap_nearest(local, f.v, light.mean);
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
