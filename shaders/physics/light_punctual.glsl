// Lights without extent: point, spot, directional.  KHR_lights_punctual.
//
// A point or spot light of intensity I (cd) gives I * light_point(...) * light_spot(...)
// lux to a surface facing it; a directional light gives its illuminance (lux) as it is.
#ifndef AG_PHYSICS_LIGHT_PUNCTUAL_GLSL
#define AG_PHYSICS_LIGHT_PUNCTUAL_GLSL

#include "physics/lang.glsl"

// Nearer than this the inverse square is held, lest it overflow: 1 mm.
static const real LIGHT_MIN_DISTANCE2 = 0.000001f; // m^2

// The extension's window max(min(1 - (d / range)^4, 1), 0).  `distance2` = d^2 in m^2;
// `inverse_range2` = 1 / range^2, 0 for an unbounded light.
static inline real light_window(real distance2, real inverse_range2)
{
    real x = distance2 * inverse_range2;
    return clamp(1.0f - x * x, 0.0f, 1.0f);
}

// Inverse square, 1/m^2, within the window.
static inline real light_point(real distance2, real inverse_range2)
{
    return light_window(distance2, inverse_range2) / max(distance2, LIGHT_MIN_DISTANCE2);
}

// The extension's precomputed angular falloff: scale and offset of the cosine.
static inline vec2 light_spot_cone(real cos_inner, real cos_outer)
{
    real scale = 1.0f / max(0.001f, cos_inner - cos_outer);
    return vec2(scale, -cos_outer * scale);
}

// `c` = cosine between the light's axis and the direction it shines to the surface.
static inline real light_spot(real c, vec2 cone)
{
    real a = clamp(c * cone[0] + cone[1], 0.0f, 1.0f);
    return a * a;
}

#endif
