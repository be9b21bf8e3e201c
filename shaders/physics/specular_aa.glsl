// Specular anti-aliasing: the spread of normals inside a pixel becomes roughness.
//
// Symbols: dndx, dndy = change of the unit normal from a pixel to the next one;
// alpha = roughness^2.
#ifndef AG_PHYSICS_SPECULAR_AA_GLSL
#define AG_PHYSICS_SPECULAR_AA_GLSL

#include "physics/lang.glsl"

// Tokuyoshi & Kaplanyan 2019, listing for isotropic roughness: a Gaussian pixel filter of
// variance 1 / (2 pi) px^2, the added roughness bounded by .18.
static inline real specular_aa_alpha2(real alpha2, vec3 dndx, vec3 dndy)
{
    real variance = (0.5f * INV_PI) * (dot(dndx, dndx) + dot(dndy, dndy));
    return min(alpha2 + min(2.0f * variance, 0.18f), 1.0f);
}

#endif
