// Real spherical harmonics up to order 2, and irradiance from them.
//
// A function on the sphere is sum_i c[i] Y_i(d), i = l (l + 1) + m:
// Y_00, Y_1-1, Y_10, Y_11, Y_2-2 .. Y_22, in the order and with the signs of
// Ramamoorthi & Hanrahan 2001, eq. 3 (about y, z, x of a unit direction d).
#ifndef AG_PHYSICS_SH_GLSL
#define AG_PHYSICS_SH_GLSL

#include "physics/lang.glsl"

static const real SH_0 = 0.28209479177387814f;  // sqrt(1 / 4pi)
static const real SH_1 = 0.48860251190291992f;  // sqrt(3 / 4pi)
static const real SH_2 = 1.09254843059207907f;  // sqrt(15 / 4pi)
static const real SH_20 = 0.31539156525252005f; // sqrt(5 / 16pi)
static const real SH_22 = 0.54627421529603953f; // sqrt(15 / 16pi)

static inline real sh_basis(uint i, vec3 d)
{
    switch (i) {
    case 0u: return SH_0;
    case 1u: return SH_1 * d[1];
    case 2u: return SH_1 * d[2];
    case 3u: return SH_1 * d[0];
    case 4u: return SH_2 * d[0] * d[1];
    case 5u: return SH_2 * d[1] * d[2];
    case 6u: return SH_20 * (3.0f * d[2] * d[2] - 1.0f);
    case 7u: return SH_2 * d[0] * d[2];
    case 8u: return SH_22 * (d[0] * d[0] - d[1] * d[1]);
    }
    return 0.0f;
}

// Irradiance / pi on a surface of normal n, from the coefficients of the radiance around
// it: each order is scaled by the clamped cosine's pi, 2pi/3, pi/4 (Ramamoorthi &
// Hanrahan 2001, eqs. 7-9) over pi.  Order 2 may ring below zero; light may not.
static inline vec3 sh_irradiance(const vec3 c[9], vec3 n)
{
    vec3 e = SH_0 * c[0];
    e += (SH_1 * 2.0f / 3.0f) * (n[1] * c[1] + n[2] * c[2] + n[0] * c[3]);
    e += (SH_2 * 0.25f) * (n[0] * n[1] * c[4] + n[1] * n[2] * c[5] + n[0] * n[2] * c[7]);
    e += (SH_20 * 0.25f) * (3.0f * n[2] * n[2] - 1.0f) * c[6];
    e += (SH_22 * 0.25f) * (n[0] * n[0] - n[1] * n[1]) * c[8];
    return max(e, 0.0f);
}

#endif
