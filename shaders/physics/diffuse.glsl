// Diffuse reflection.
//
// Symbols: NoL, NoV, LoV = cosines between normal, directions to the light and to the eye,
// the first two in [0, 1]; albedo, rho = reflectance; sigma = standard deviation of the
// slopes' angle, rad; r = roughness of EON in [0, 1].  BRDFs in 1/sr.
#ifndef AG_PHYSICS_DIFFUSE_GLSL
#define AG_PHYSICS_DIFFUSE_GLSL

#include "physics/lang.glsl"

// Lambert's BRDF, 1/sr, of a surface that reflects `albedo` of what it receives.
static inline vec3 diffuse_lambert(vec3 albedo)
{
    return albedo * INV_PI;
}

// Where light and eye are on the same side of the normal, the roughness of Oren & Nayar sends
// more back: sin(a) tan(b) cos(phi) of their eq. 30, a and b being the greater and the smaller
// of the two angles with the normal.  Multiplied out it needs neither angles nor tangent
// vectors; Fujii, "A tiny improvement of Oren-Nayar reflectance model".
static inline real diffuse_retroreflection(real NoL, real NoV, real LoV)
{
    return (LoV - NoL * NoV) / max(max(NoL, NoV), 1e-6f);
}

// The integral of max(diffuse_retroreflection, 0) NoL over all light, for an eye at NoV.
static inline real diffuse_retroreflected(real NoV)
{
    real s = sqrt(max(1.0f - NoV * NoV, 0.0f));
    return s * (atan2(s, NoV) - s * NoV) +
           (2.0f / 3.0f) * s * NoV * (1.0f + s + s * s) / (1.0f + s);
}

// A and B of Oren & Nayar 1994, eq. 30: without interreflection.
static inline vec2 diffuse_oren_nayar_ab(real sigma)
{
    real s2 = sigma * sigma;
    return vec2(1.0f - 0.5f * s2 / (s2 + 0.33f), 0.45f * s2 / (s2 + 0.09f));
}

static inline vec3 diffuse_oren_nayar(vec3 rho, real sigma, real NoL, real NoV, real LoV)
{
    vec2 ab = diffuse_oren_nayar_ab(sigma);
    real back = max(diffuse_retroreflection(NoL, NoV, LoV), 0.0f);
    return rho * (INV_PI * (ab[0] + ab[1] * back));
}

// What it reflects of a white sky, for rho = 1.
static inline real diffuse_oren_nayar_albedo(real sigma, real NoV)
{
    vec2 ab = diffuse_oren_nayar_ab(sigma);
    return ab[0] + ab[1] * INV_PI * diffuse_retroreflected(NoV);
}

// EON: Portsmouth, Kutz & Hill 2025.  One bounce is Fujii's model, the rest returns all that
// it loses.  Fujii's A, and the albedo of one bounce for rho = 1, as A (1 + r diffuse_eon_rise).
static inline real diffuse_eon_a(real r)
{
    return 1.0f / (1.0f + (0.5f - 2.0f / 3.0f * INV_PI) * r);
}

static inline real diffuse_eon_rise(real NoV)
{
    real s = sqrt(max(1.0f - NoV * NoV, 0.0f));
    return INV_PI * (diffuse_retroreflected(NoV) - (2.0f / 3.0f) * s);
}

static inline vec3 diffuse_eon(vec3 rho, real r, real NoL, real NoV, real LoV)
{
    real a = diffuse_eon_a(r);
    real s = LoV - NoL * NoV;
    real back = s > 0.0f ? diffuse_retroreflection(NoL, NoV, LoV) : s;
    real lost_v = max(1.0f - a * (1.0f + r * diffuse_eon_rise(NoV)), 0.0f);
    real lost_l = max(1.0f - a * (1.0f + r * diffuse_eon_rise(NoL)), 0.0f);
    real mean = a * (1.0f + (2.0f / 3.0f - 28.0f / 15.0f * INV_PI) * r);
    vec3 more = rho * rho * mean / (1.0f - rho * (1.0f - mean)); // of all further bounces
    return INV_PI * (rho * (a * (1.0f + r * back)) +
                     more * (lost_v * lost_l / max(1.0f - mean, 1e-6f)));
}

// What it reflects of a white sky.
static inline vec3 diffuse_eon_albedo(vec3 rho, real r, real NoV)
{
    real a = diffuse_eon_a(r);
    real once = a * (1.0f + r * diffuse_eon_rise(NoV));
    real mean = a * (1.0f + (2.0f / 3.0f - 28.0f / 15.0f * INV_PI) * r);
    return rho * once + rho * rho * (mean * max(1.0f - once, 0.0f)) / (1.0f - rho * (1.0f - mean));
}

#endif
