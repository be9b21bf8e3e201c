// Fresnel reflectance: how much of the light a smooth boundary sends back.
//
// Symbols: f0, f90 = reflectance at normal and at grazing incidence; c = cosine between
// the direction and the (micro-)normal, in [0, 1]; n, k = real index of refraction and
// extinction coefficient, relative to the outside.  All unitless; light unpolarised.
#ifndef AG_PHYSICS_FRESNEL_GLSL
#define AG_PHYSICS_FRESNEL_GLSL

#include "physics/lang.glsl"

static inline real pow5(real x)
{
    real x2 = x * x;
    return x2 * x2 * x;
}

// Schlick 1994, eq. 24, with the value at grazing incidence as a parameter.
static inline vec3 fresnel_schlick(vec3 f0, real f90, real c)
{
    real w = pow5(1.0f - c);
    return f0 * (1.0f - w) + f90 * w;
}

// The mean of fresnel_schlick over the cosine-weighted hemisphere,
// 2 int F(c) c dc: f0 + (f90 - f0) / 21.
static inline vec3 fresnel_schlick_mean(vec3 f0, real f90)
{
    return f0 * (20.0f / 21.0f) + f90 * (1.0f / 21.0f);
}

// Reflectance of a dielectric at normal incidence.  Index 0 gives 1, the meaning that
// KHR_materials_ior gives to it.
static inline real fresnel_f0_dielectric(real ior)
{
    real r = (ior - 1.0f) / (ior + 1.0f);
    return r * r;
}

// Reflectance of a conductor at normal incidence.
static inline real fresnel_f0_conductor(real n, real k)
{
    real k2 = k * k;
    return ((n - 1.0f) * (n - 1.0f) + k2) / ((n + 1.0f) * (n + 1.0f) + k2);
}

// Exact Fresnel equations of a dielectric; 1 under total internal reflection.
// Born & Wolf 1999, section 1.5.2, eq. 21.
static inline real fresnel_dielectric(real c, real ior)
{
    real g2 = ior * ior - 1.0f + c * c; // (ior cos of the refracted ray)^2
    if (g2 <= 0.0f)
        return 1.0f;
    real g = sqrt(g2);
    real s = (c - g) / (c + g);
    real p = (ior * ior * c - g) / (ior * ior * c + g);
    return 0.5f * (s * s + p * p);
}

// Exact Fresnel equations of a conductor.  Born & Wolf 1999, section 14.2, with the
// square root of the complex index taken apart: a + ib = sqrt((n + ik)^2 - sin^2).
static inline real fresnel_conductor(real c, real n, real k)
{
    real c2 = c * c;
    real s2 = 1.0f - c2;
    real t = n * n - k * k - s2;
    real ab = sqrt(t * t + 4.0f * n * n * k * k); // a^2 + b^2
    real a = sqrt(max(0.5f * (ab + t), 0.0f));
    real rs = (ab + c2 - 2.0f * a * c) / max(ab + c2 + 2.0f * a * c, 1e-12f);
    real p = c2 * ab + s2 * s2;
    real q = 2.0f * a * c * s2;
    return 0.5f * rs * (1.0f + (p - q) / max(p + q, 1e-12f));
}

static inline vec3 fresnel_conductor_rgb(real c, vec3 n, vec3 k)
{
    return vec3(fresnel_conductor(c, n[0], k[0]), fresnel_conductor(c, n[1], k[1]),
                fresnel_conductor(c, n[2], k[2]));
}

// 2 int F(c) c dc by the two Gauss nodes of that weight.
static inline vec3 fresnel_conductor_mean(vec3 n, vec3 k)
{
    return 0.36391726f * fresnel_conductor_rgb(0.35505103f, n, k) +
           0.63608274f * fresnel_conductor_rgb(0.84494897f, n, k);
}

// What metals lack of Schlick's value towards grazing angles: times this, subtracted.
// Lazanyi & Szirmay-Kalos 2005, eq. 4.  Its cosine-weighted mean, 2 int c^2 (1 - c)^6 dc, is
// 1 / 126.
static inline real fresnel_dip(real c)
{
    real x = 1.0f - c;
    return pow5(x) * x * c;
}

// The factor of fresnel_dip for a reflectance of `tint` times Schlick's at c = 1/7, 82
// degrees, where the dip is deepest.  Kutz, Hasan & Edmondson 2021, "F82-tint".
static inline vec3 fresnel_f82(vec3 f0, vec3 tint)
{
    return (1.0f - tint) * fresnel_schlick(f0, 1.0f, 1.0f / 7.0f) / fresnel_dip(1.0f / 7.0f);
}

#endif
