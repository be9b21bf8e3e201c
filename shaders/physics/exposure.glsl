// Exposure: from luminance to what the sensor saturates at.
#ifndef AG_PHYSICS_EXPOSURE_GLSL
#define AG_PHYSICS_EXPOSURE_GLSL

#include "physics/lang.glsl"

// Factor to luminance in nit at an exposure value for ISO 100: 1 / L_max with
// L_max = 78 / (100 * .65) * 2^EV.  ISO 12232; Lagarde & de Rousiers 2014, section 5.1.2.
static inline real exposure_from_ev100(real ev100)
{
    return 1.0f / (1.2f * exp2(ev100));
}

#endif
