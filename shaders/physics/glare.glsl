// Glare: light that the eye scatters, and that veils what is around its source.
#ifndef AG_PHYSICS_GLARE_GLSL
#define AG_PHYSICS_GLARE_GLSL

#include "physics/lang.glsl"

// CIE 146:2002, the general equation of Vos & van den Berg, for a person of 25 years with brown
// eyes: it holds from .1 to 100 degrees from the source.
static const real GLARE_AGE = 1.0f + 0.0256f; // 1 + (25 / 62.5)^4
static const real GLARE_PIGMENT = 0.5f;

// Luminance of the veil for each lux at the eye, in 1/sr.
static inline real glare(real degrees)
{
    return 10.0f / (degrees * degrees * degrees) +
           (5.0f / (degrees * degrees) + 0.1f * GLARE_PIGMENT / degrees) * GLARE_AGE +
           0.0025f * GLARE_PIGMENT;
}

// The same as a sum of Gaussians: how much of the light is scattered into those with standard
// deviations from `from` to `to` degrees.  A mixture of Gaussians whose weight for each step of
// ln s is 2 pi C 2^(1 - n/2) / Gamma(n/2) s^(2 - n) is C / angle^n: docs/physics.md.  The
// equation's constant is left out.
static inline real glare_share(real from, real to)
{
    const real tau = 6.2831853f, square_degree = 3.0461742e-4f, root = 0.7978846f; // sqrt(2 / pi)
    real cubic = 10.0f * root * (1.0f / from - 1.0f / to);
    real quadratic = 5.0f * GLARE_AGE * log(to / from);
    real linear = 0.1f * GLARE_PIGMENT * GLARE_AGE * root * (to - from);
    return square_degree * tau * (cubic + quadratic + linear);
}

#endif
