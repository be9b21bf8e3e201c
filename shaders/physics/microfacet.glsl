// The GGX (Trowbridge-Reitz) microfacet surface, and Blinn's lobe.
//
// Symbols: alpha = roughness^2 (roughness is the perceptual one of glTF), a2 = alpha^2;
// n, wo, wi, h = unit normal, directions to the eye and to the light, half vector;
// NoV NoL NoH = cosines with n, in [0, 1].  D in 1/sr; V = G2 / (4 NoL NoV) in 1/sr,
// G1 unitless, densities in 1/sr.  Anisotropic: ax, ay = alpha along x and y of the surface's
// frame, in which z is the normal.
#ifndef AG_PHYSICS_MICROFACET_GLSL
#define AG_PHYSICS_MICROFACET_GLSL

#include "physics/lang.glsl"

// Distribution of normals.  Walter et al. 2007, eq. 33, with the tangent written out.
static inline real microfacet_d(real NoH, real a2)
{
    real f = 1.0f - NoH * NoH + a2 * NoH * NoH;
    return a2 / (PI * f * f);
}

// The same from H = wo + wi as it comes, not normalised: `across` = |n x H|^2, `along` =
// n.H.  No normalisation, and no cancellation: 1 - NoH^2 in float loses a mirror's peak.
static inline real microfacet_d_half(real across, real along, real a2)
{
    real along2 = along * along;
    real r = (across + along2) / (across + a2 * along2);
    return a2 * INV_PI * r * r;
}

// Height-correlated Smith shadowing-masking.  Heitz 2014, eq. 99 with eq. 72.
static inline real microfacet_v(real NoV, real NoL, real a2)
{
    real gv = NoL * sqrt(NoV * NoV * (1.0f - a2) + a2);
    real gl = NoV * sqrt(NoL * NoL * (1.0f - a2) + a2);
    return 0.5f / (gv + gl);
}

// Smith masking.  Heitz 2014, eq. 43 with eq. 72.
static inline real microfacet_g1(real NoV, real a2)
{
    return 2.0f * NoV / (NoV + sqrt(NoV * NoV * (1.0f - a2) + a2));
}

// The same with the separable form of Schlick 1994, eq. 19: G1 = c / (c (1 - k) + k).
static inline real microfacet_v_schlick(real NoV, real NoL, real k)
{
    return 0.25f / max((NoV * (1.0f - k) + k) * (NoL * (1.0f - k) + k), 1e-12f);
}

// Karis 2013, eq. 4: k under lights; alpha / 2 under image light.
static inline real microfacet_schlick_k(real roughness)
{
    return 0.125f * (roughness + 1.0f) * (roughness + 1.0f);
}

// Anisotropic.  Heitz 2014, eq. 85, of H = wo + wi as it comes.
static inline real microfacet_d_anisotropic(vec3 h, real ax, real ay)
{
    real x = h[0] / ax;
    real y = h[1] / ay;
    real r = dot(h, h) / (x * x + y * y + h[2] * h[2]);
    return r * r * INV_PI / (ax * ay);
}

// Heitz 2014, eq. 99 with eqs. 72 and 86: NoV tan = |(ax x, ay y)|.
static inline real microfacet_v_anisotropic(vec3 v, vec3 l, real ax, real ay)
{
    vec3 sv = vec3(ax * v[0], ay * v[1], v[2]);
    vec3 sl = vec3(ax * l[0], ay * l[1], l[2]);
    return 0.5f / max(l[2] * sqrt(dot(sv, sv)) + v[2] * sqrt(dot(sl, sl)), 1e-12f);
}

// alpha along the two directions; KHR_materials_anisotropy.
static inline vec2 microfacet_alphas(real alpha, real anisotropy)
{
    return vec2(mix(alpha, 1.0f, anisotropy * anisotropy), alpha);
}

// Blinn 1977 as the light models of old have it: of the light, not of the irradiance, and
// neither normalised nor shadowed.  Divided by pi, as Lambert's is: a light of illuminance pi
// gives albedo cos + specular (n.h)^shininess.
static inline real microfacet_blinn(real NoH, real shininess)
{
    return INV_PI * pow(max(NoH, 1e-6f), shininess);
}

// The roughness of GGX whose peak has the same height and total.
static inline real microfacet_blinn_alpha(real shininess)
{
    return sqrt(2.0f / (shininess + 2.0f));
}

#endif
