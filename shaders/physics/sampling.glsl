// Sample points and the directions made of them.
//
// Directions are in the tangent frame, n = (0, 0, 1).  Points are in [0, 1)^2.
#ifndef AG_PHYSICS_SAMPLING_GLSL
#define AG_PHYSICS_SAMPLING_GLSL

#include "physics/microfacet.glsl"

// Van der Corput's radical inverse in base 2: the bits of i mirrored behind the point.
// The low byte is dropped, so that float holds the result exactly and it stays below 1.
static inline real sampling_van_der_corput(uint i)
{
    i = (i << 16) | (i >> 16);
    i = ((i & 0x00ff00ffu) << 8) | ((i & 0xff00ff00u) >> 8);
    i = ((i & 0x0f0f0f0fu) << 4) | ((i & 0xf0f0f0f0u) >> 4);
    i = ((i & 0x33333333u) << 2) | ((i & 0xccccccccu) >> 2);
    i = ((i & 0x55555555u) << 1) | ((i & 0xaaaaaaaau) >> 1);
    return to_real(i >> 8) * (1.0f / 16777216.0f);
}

// Point i of Hammersley's set of `count`.
static inline vec2 sampling_hammersley(uint i, uint count)
{
    return vec2((to_real(i) + 0.5f) / to_real(count), sampling_van_der_corput(i));
}

// A point of a Gaussian about 0 in the plane, none beyond `cut`: Box & Muller 1958, with the
// radius cut by the inverse of its distribution.  A picture's filter that is sampled so needs
// no weights: Ernst, Stamminger & Greiner 2006.
static inline vec2 sampling_gaussian(vec2 u, real deviation, real cut)
{
    real within = 1.0f - exp(-cut * cut / (2.0f * deviation * deviation));
    real r = deviation * sqrt(-2.0f * log(1.0f - within * u[0]));
    real phi = 2.0f * PI * u[1];
    return vec2(r * cos(phi), r * sin(phi));
}

// Density cos / pi.
static inline vec3 sampling_cosine(vec2 u)
{
    real r = sqrt(u[0]);
    real phi = 2.0f * PI * u[1];
    return vec3(r * cos(phi), r * sin(phi), sqrt(max(1.0f - u[0], 0.0f)));
}

// A visible GGX normal seen from wo: a point of a spherical cap is, plus the stretched
// eye direction, a visible normal of the stretched surface.  Dupuy & Benyoub 2023,
// listing 3.
static inline vec3 sampling_visible_normal(vec3 wo, real alpha, vec2 u)
{
    vec3 v = normalize(vec3(alpha * wo[0], alpha * wo[1], wo[2]));
    real phi = 2.0f * PI * u[0];
    real z = (1.0f - u[1]) * (1.0f + v[2]) - v[2];
    real s = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    vec3 h = vec3(s * cos(phi), s * sin(phi), z) + v;
    return normalize(vec3(alpha * h[0], alpha * h[1], max(h[2], 0.0f)));
}

// Density of that normal h, 1/sr.  Heitz 2018, eq. 3.
static inline real sampling_visible_normal_density(vec3 wo, vec3 h, real alpha)
{
    real a2 = alpha * alpha;
    real VoH = max(dot(wo, h), 0.0f);
    return microfacet_g1(wo[2], a2) * VoH * microfacet_d(h[2], a2) / wo[2];
}

// ---- Lobes -------------------------------------------------------------------

// How far down the spherical cap of visible normals must reach, so that all that reflects
// upwards is in it.  Eto & Tokuyoshi 2023, eqs. 5 and 6.
static inline real sampling_ggx_bound(vec3 wo, real ax, real ay)
{
    real a = min(min(ax, ay), 1.0f);
    real s = 1.0f + sqrt(wo[0] * wo[0] + wo[1] * wo[1]);
    return (1.0f - a * a) * s * s / (s * s + a * a * wo[2] * wo[2]);
}

// A half vector of an anisotropic GGX lobe: a visible normal of those that may reflect upwards.
// wo.z > 0; wi = reflect(-wo, h) may still be below the horizon: no light comes from there.
// Neither h.z nor the radius is formed from z, which has lost their digits.
static inline vec3 sampling_ggx(vec3 wo, real ax, real ay, vec2 u)
{
    vec3 v = normalize(vec3(ax * wo[0], ay * wo[1], wo[2]));
    real k = sampling_ggx_bound(wo, ax, ay);
    real below = u[1] * (1.0f + k * v[2]); // the top of the cap
    real s = sqrt(max(below * (2.0f - below), 0.0f));
    real phi = 2.0f * PI * u[0];
    real z = (1.0f - u[1]) * (1.0f + k * v[2]) + (1.0f - k) * v[2];
    return normalize(vec3(ax * (s * cos(phi) + v[0]), ay * (s * sin(phi) + v[1]), z));
}

// Density of wi, 1/sr; 0 below the horizon.  That of all visible normals has k = 1.
static inline real sampling_ggx_density(vec3 wo, vec3 wi, real ax, real ay)
{
    if (wi[2] <= 0.0f)
        return 0.0f;
    vec3 v = vec3(ax * wo[0], ay * wo[1], wo[2]);
    real reach = sampling_ggx_bound(wo, ax, ay) * wo[2] + sqrt(dot(v, v));
    return 0.5f * microfacet_d_anisotropic(wo + wi, ax, ay) / reach;
}

// 1 - exp(-x), x >= 0.
static inline real sampling_fall(real x)
{
    return x < 0.03f ? x * (1.0f - x * (0.5f - x / 6.0f)) : 1.0f - exp(-x);
}

// A direction of light by Blinn's lobe, its half vector of density (shininess + 1) / 2 pi
// (n.h)^shininess; Blinn 1977.  It may be below the horizon.
static inline vec3 sampling_blinn(vec3 wo, real shininess, vec2 u)
{
    real x = -2.0f * log(1.0f - u[0]) / (shininess + 1.0f);
    real s = sqrt(sampling_fall(x)); // cos^2 = exp(-x)
    real phi = 2.0f * PI * u[1];
    return reflect(-wo, vec3(s * cos(phi), s * sin(phi), exp(-0.5f * x)));
}

// Density of wi, 1/sr; 0 below the horizon.
static inline real sampling_blinn_density(vec3 wo, vec3 wi, real shininess)
{
    vec3 h = wo + wi;
    real VoH = max(0.5f * sqrt(dot(h, h)), 1e-6f);
    real lobe = 0.125f * (shininess + 1.0f) * microfacet_blinn(0.5f * h[2] / VoH, shininess) / VoH;
    return wi[2] > 0.0f ? lobe : 0.0f;
}

// EON's lobe, for any albedo: a cosine, cut at the horizon and sent through a matrix, and a
// share of all directions alike.  Portsmouth, Kutz & Hill 2025, whose listings have the fit;
// roughness in [0, 1].
STRUCT(sampling_eon_lobe) {
    real a; // the matrix (a 0 b, 0 c 0, d 0 1), its x axis below wo
    real b;
    real c;
    real d;
    real cut;   // the part of the unit disk that is left of the cosine's
    real share; // of all directions
    vec2 x;
};

static inline sampling_eon_lobe sampling_eon_lobe_from(vec3 wo, real roughness)
{
    real r = roughness;
    real z = wo[2];
    real s = sqrt(wo[0] * wo[0] + wo[1] * wo[1]);
    sampling_eon_lobe l;
    l.a = 1.0f + r * (0.303392f + (0.111709f * z - 0.518982f) * z +
                      (0.335918f * z - 0.276266f) * r);
    l.b = r * (1.15859f * z - 1.16407f + (0.150815f - 0.150105f * z) * r) / (z * z * z - 1.43545f);
    l.c = 1.0f + r * (0.20013f + (0.261777f * z - 0.506373f) * z);
    l.d = r * (0.540852f + (0.475392f * z - 1.01625f) * z) / ((z + 0.0725628f) * z - 1.0743f);
    l.cut = 0.5f + 0.5f / sqrt(l.d * l.d + 1.0f);
    l.share = pow(r, 0.1f) *
              (0.162925f + ((0.538233f - 0.290822f * z) * z - 0.372058f) * z);
    l.x = s > 0.0f ? vec2(wo[0], wo[1]) / s : vec2(1.0f, 0.0f);
    return l;
}

static inline vec3 sampling_eon(vec3 wo, real roughness, vec2 u)
{
    sampling_eon_lobe l = sampling_eon_lobe_from(wo, roughness);
    real phi = 2.0f * PI * u[1];
    bool even = u[0] < l.share;
    real part = even ? u[0] / l.share : (u[0] - l.share) / (1.0f - l.share);
    real r = sqrt(even ? 1.0f - part * part : part);
    real x = r * cos(phi);
    real y = r * sin(phi);
    if (even)
        return vec3(x, y, part);
    x = -mix(sqrt(max(1.0f - y * y, 0.0f)), x, l.cut);
    real z = sqrt(max(1.0f - x * x - y * y, 0.0f));
    vec3 w = vec3(l.a * x + l.b * z, l.c * y, max(l.d * x + z, 1e-6f));
    return normalize(vec3(w[0] * l.x[0] - w[1] * l.x[1], w[0] * l.x[1] + w[1] * l.x[0], w[2]));
}

// Density of wi, 1/sr; 0 below the horizon.
static inline real sampling_eon_density(vec3 wo, vec3 wi, real roughness)
{
    sampling_eon_lobe l = sampling_eon_lobe_from(wo, roughness);
    real x = wi[0] * l.x[0] + wi[1] * l.x[1];
    real y = wi[1] * l.x[0] - wi[0] * l.x[1];
    real ac = l.a - l.b * l.d;
    vec3 w = vec3(l.c * (x - l.b * wi[2]), ac * y, l.c * (l.a * wi[2] - l.d * x));
    real scale = l.c * ac / dot(w, w);
    real lobe = INV_PI * scale * scale * max(w[2], 0.0f) / l.cut;
    return wi[2] > 0.0f ? mix(lobe, 0.5f * INV_PI, l.share) : 0.0f;
}

#endif
