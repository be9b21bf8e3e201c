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

#endif
