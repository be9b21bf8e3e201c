// The reference: the same scenes, path traced.
//
// The surfaces, lights and files of ag_renderer, and none of its approximations: light is
// followed by Monte Carlo until it ends (Kajiya 1986; multiple importance sampling, Veach &
// Guibas 1995).  Needs no graphics device.  docs/reference.md says what it computes.
//
// Threads: a reference belongs to one thread at a time; it works on all cores.
#ifndef ARGAND_REFERENCE_H
#define ARGAND_REFERENCE_H

#include <argand/base.h>
#include <argand/image.h>
#include <argand/renderer.h>
#include <argand/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

// Which directions light is looked for in: all three have the same mean, as far as floats
// go: a sun of 1e12 nit in a sky of 1e3 leaves the lights' directions little for the rest.
typedef enum ag_estimator {
    AG_ESTIMATOR_BOTH = 0, // by the lights and by the surface, weighted
    AG_ESTIMATOR_LIGHTS,   // by the lights alone (what has no density there is not seen)
    AG_ESTIMATOR_SURFACE,  // by the surface alone; lights without extent stay
} ag_estimator;

typedef struct ag_reference_options {
    uint32_t max_bounces; // after the first surface; 0 -> until Russian roulette ends the path
    bool direct_only;     // no bounces: light comes straight from where it was made
    bool unshadowed;      // nothing stands before a light, and paths end at the first surface:
                          // with `direct_only`, what ag_renderer approximates
    float clamp;          // of what one path adds by one light, exposed; 0 -> none
    uint32_t seed;        // the same seed gives the same bytes on any number of threads
    bool keep_aovs;       // ag_reference_aov will be asked
    ag_estimator estimator;
    ag_progress progress; // of preparing: stage "prepare"
} ag_reference_options;

typedef struct ag_reference ag_reference;

// Prepare a picture without a sample.  `scene` is borrowed; when it has changed,
// ag_reference_restart and _destroy are all that may be called; `camera` NULL -> ag_scene_frame's
// automatic view; of `picture` (NULL -> defaults) quality and area_lights are not looked at;
// `options` NULL -> defaults. AG_ERROR_ARGUMENT as ag_renderer_render; AG_ERROR_MEMORY.
AG_CHECK ag_status ag_reference_create(const ag_scene *scene, const ag_camera_desc *camera,
                                       const ag_render_options *picture,
                                       const ag_reference_options *options,
                                       ag_reference **reference);
AG_API void ag_reference_destroy(ag_reference *reference); // NULL is allowed

// Begin again, as if made anew of the scene as it is now.  What has not changed of it is not
// prepared again: another camera, picture or options, lights and the environment's rotation take
// next to no time, set materials little, all else what it took at first.  On failure the reference
// stays as it was; then, where the scene has changed, it can be restarted or destroyed only.
AG_CHECK ag_status ag_reference_restart(ag_reference *reference, const ag_camera_desc *camera,
                                        const ag_render_options *picture,
                                        const ag_reference_options *options);

// When to stop; the first that comes true.  All 0 -> 64 samples.
typedef struct ag_reference_goal {
    uint32_t samples; // a pixel, those from before among them; 0 -> no limit
    double seconds;   // of this call; 0 -> no limit
    float noise;      // see ag_reference_state; 0 -> no limit
    // Stage "trace", asked every 1024 paths at the latest, some milliseconds.  Returning false
    // ends the call with AG_ERROR_CANCELLED; what has been gathered stays, and the picture is
    // sound, though some of its parts have more samples than others.
    ag_progress progress;
} ag_reference_goal;

// Add samples to every pixel.
AG_CHECK ag_status ag_reference_trace(ag_reference *reference, const ag_reference_goal *goal);

typedef struct ag_reference_state {
    uint32_t samples; // a pixel
    // The estimated relative error: each pixel's standard error over its luminance (at least
    // a twentieth of the picture's mean), averaged.  0 below two samples.
    float noise;
    uint64_t rays;               // traced so far
    double prepare_ms, trace_ms; // wall time
} ag_reference_state;
AG_API ag_reference_state ag_reference_describe(const ag_reference *reference);

// What has been gathered, as ag_renderer_render would give it.
AG_CHECK ag_status ag_reference_picture(const ag_reference *reference, ag_image **image);

// What else is known of what each pixel sees first, RGBA32F, its mean over the samples.
typedef enum ag_aov {
    AG_AOV_ALBEDO = 0, // what the surface reflects of a white sky; Blinn's lobe not counted
    AG_AOV_NORMAL,     // world space, the shading normal towards the eye
    AG_AOV_DEPTH,      // m along the camera's axis, in all three; where nothing is, 0
    AG_AOV_DIRECT,     // exposed radiance: seen itself, or straight from lights by one surface
    AG_AOV_INDIRECT,   // exposed radiance: the rest; direct + indirect = the picture before bloom
} ag_aov;
// AG_ERROR_ARGUMENT without keep_aovs.
AG_CHECK ag_status ag_reference_aov(const ag_reference *reference, ag_aov aov, ag_image **image);

#ifdef __cplusplus
}
#endif
#endif
