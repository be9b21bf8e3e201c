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

static inline real exposure_to_ev100(real exposure)
{
    return -log2(1.2f * exposure);
}

// Of a camera's f-number, shutter time in seconds and ISO speed.  ISO 2720; Lagarde & de
// Rousiers 2014, section 5.1.1.
static inline real exposure_ev100_of_camera(real aperture, real shutter, real iso)
{
    return log2(aperture * aperture / shutter * (100.0f / iso));
}

// What a reflected-light meter of K = 12.5 gives for a luminance in nit, and back.  The same.
static inline real exposure_metered_ev100(real luminance)
{
    return log2(luminance * (100.0f / 12.5f));
}

static inline real exposure_metered_luminance(real ev100)
{
    return 12.5f / 100.0f * exp2(ev100);
}

#endif
