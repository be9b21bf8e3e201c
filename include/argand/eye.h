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
#include <argand/image.h>
#include <argand/reference.h>
#include <argand/renderer.h>
#include <argand/scene.h>

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

// ---- Metering --------------------------------------------------------------

typedef enum ag_meter {
    AG_METER_CENTER = 0, // three quarters of the weight are within a quarter of the shorter side
    AG_METER_AVERAGE,    // all counts alike
    AG_METER_SPOT,       // a disk alone
} ag_meter;

// How a picture is metered: by the mean luminance of what is left after the darkest and the
// brightest are cut.  Black counts; what is transparent, or a background of a given colour, does
// not, being no light of the scene.
typedef struct ag_metering {
    ag_meter meter;
    float spot_x, spot_y; // of SPOT: to the right of the picture's middle and down, in widths and
                          // heights, -0.5 to 0.5
    float spot_radius;    // in shorter sides of the picture, at most 1; 0 -> 0.05
    float low, high;      // from the low to the high share of the pixels in the order of their
                          // luminance, 0 to 1, is metered; both 0 -> 0.1 and 0.9
    float min_ev100, max_ev100; // limits of what the meter says; both 0 -> those of what it can
                                // see, -10 to 21.75
    float compensation_ev;      // stops brighter than that; after the limits
} ag_metering;

// Meter a linear picture, RGBA32F, that was made with the linear factor `exposure` and no white
// balance.  NULL metering -> defaults.  AG_ERROR_ARGUMENT on what is out of range.
AG_CHECK ag_status ag_image_meter(const ag_log *log, const ag_image *linear, float exposure,
                                  const ag_metering *metering, float *ev100);

// Meter what ag_renderer_render would make a picture of: drawn small, of 160 px, whatever size
// is asked for, and summed up on the device.  It takes the same thing for the same things each
// time, and keeps what pictures of full size need; of `options` neither exposure nor white balance
// nor look matter.  Errors as ag_renderer_render has them.
AG_CHECK ag_status ag_renderer_meter(ag_renderer *renderer, const ag_scene *scene,
                                     const ag_camera_desc *camera, const ag_render_options *options,
                                     const ag_metering *metering, float *ev100);

// The same of what ag_reference_create would make a picture of, with 16 samples a pixel.
AG_CHECK ag_status ag_reference_meter(const ag_scene *scene, const ag_camera_desc *camera,
                                      const ag_render_options *picture,
                                      const ag_reference_options *options,
                                      const ag_metering *metering, float *ev100);

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
