// The eye: how bright light is shown, as a camera counts it, and how an eye gets used to it.
//
// EV100 is a luminance: a surface of L nit is metered as EV100 = log2(L 100 / 12.5), and what
// reaches 1 in the picture is 1.2 * 2^EV100 nit, so that a metered surface comes out at .104 of
// linear light.  docs/eye.md has the sources.
//
// Threads: any number of them may call what takes neither renderer nor scene.
#ifndef ARGAND_EYE_H
#define ARGAND_EYE_H

#include <argand/base.h>

#ifdef __cplusplus
extern "C" {
#endif

// ---- Exposure --------------------------------------------------------------

// The linear factor of ag_render_options and ag_scene_set_exposure, and back.
AG_API float ag_exposure_from_ev100(float ev100);
AG_API float ag_ev100_from_exposure(float exposure); // above 0

// A camera's settings, each above 0: log2(N^2 / t * 100 / S) with the f-number N, the shutter's
// time t in seconds and the sensitivity S as ISO counts it.
AG_API float ag_ev100_from_camera(float aperture, float shutter_s, float iso);

// ---- White balance -----------------------------------------------------------
//
// ag_render_options.white_balance_k is the colour temperature of the light that things stand in,
// which is then shown as D65, the white of Rec. 709: of a lamp up to 4000 K, of daylight from
// 5000 K on (6504 K changes nothing), between them in between.  The tint says how far it is
// greener than that, in 3000ths of CIE 1960's u and v.  It is linear, comes after exposure and
// before the tone curve, and leaves a grey thing under that light as bright as it was.

// ---- Adaptation ------------------------------------------------------------

// How long an eye takes: after each such time 1/e of the way, in stops, is left.
typedef struct ag_adaptation {
    float to_bright_s; // where the view is brighter than before; 0 -> 0.4, below 0 -> at once
    float to_dark_s;   // where it is darker; 0 -> 1.2, below 0 -> at once
} ag_adaptation;

// Where an eye at `ev100` is `seconds` (at least 0) after the view became `target_ev100`.  Two
// steps are as far as one of both times: any frame rate sees the same.  NULL -> defaults.
AG_API float ag_eye_adapt(const ag_adaptation *adaptation, float ev100, float target_ev100,
                          float seconds);

#ifdef __cplusplus
}
#endif
#endif
