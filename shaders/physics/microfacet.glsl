// The GGX (Trowbridge-Reitz) microfacet surface, isotropic.
//
// Symbols: alpha = roughness^2 (roughness is the perceptual one of glTF), a2 = alpha^2;
// n, wo, wi, h = unit normal, directions to the eye and to the light, half vector;
// NoV NoL NoH = cosines with n, in [0, 1].  D in 1/sr; V = G2 / (4 NoL NoV) in 1/sr,
// G1 unitless, densities in 1/sr.
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

#endif
