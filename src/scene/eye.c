// The eye: exposure and adaptation.
#include <argand/eye.h>

#include "physics/exposure.glsl"

float ag_exposure_from_ev100(float ev100)
{
    return exposure_from_ev100(ev100);
}

float ag_ev100_from_exposure(float exposure)
{
    return exposure_to_ev100(exposure);
}

float ag_ev100_from_camera(float aperture, float shutter_s, float iso)
{
    return exposure_ev100_of_camera(aperture, shutter_s, iso);
}

static float or_default(float seconds, float otherwise)
{
    return seconds == 0 ? otherwise : seconds;
}

float ag_eye_adapt(const ag_adaptation *adaptation, float ev100, float target_ev100, float seconds)
{
    const ag_adaptation a = adaptation ? *adaptation : (ag_adaptation) { 0 };
    float time =
        target_ev100 > ev100 ? or_default(a.to_bright_s, 0.4f) : or_default(a.to_dark_s, 1.2f);
    // The way left decays by itself, and the target is never passed: exact for steps of any size.
    return time < 0 ? target_ev100
                    : target_ev100 + (ev100 - target_ev100) * expf(-fmaxf(seconds, 0) / time);
}
