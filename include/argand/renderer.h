// The renderer: a Vulkan device, and pictures of scenes made on it.
//
// Threads: a device and its renderers belong to one thread at a time; distinct
// devices are independent.  A device outlives its renderers.
#ifndef ARGAND_RENDERER_H
#define ARGAND_RENDERER_H

#include <argand/base.h>
#include <argand/image.h>
#include <argand/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

// ---- Devices ---------------------------------------------------------------

typedef enum ag_device_kind {
    AG_DEVICE_OTHER = 0,
    AG_DEVICE_DISCRETE,
    AG_DEVICE_INTEGRATED,
    AG_DEVICE_VIRTUAL,
    AG_DEVICE_CPU, // Mesa's lavapipe
} ag_device_kind;

typedef struct ag_device_info {
    char name[256];
    char driver[256]; // name and version
    ag_device_kind kind;
    bool usable;           // has all that Argand needs
    char missing[128];     // else the first thing it lacks
    uint32_t max_size;     // px, the largest picture made without tiles
    uint64_t memory_bytes; // of the largest device-local heap
} ag_device_info;

// List the Vulkan devices: up to `capacity` into `infos`, how many there are into
// `*count` (infos may be NULL).  AG_ERROR_DEVICE when there is no Vulkan driver at all.
AG_CHECK ag_status ag_device_list(const ag_log *log, ag_device_info *infos, size_t capacity,
                                  size_t *count);

typedef struct ag_device_desc {
    const ag_log *log; // NULL -> stderr
    // "auto": the best GPU, else the CPU; "cpu"; an index of ag_device_list; or a part
    // of a name, case ignored.  NULL -> "auto".
    const char *select;
    bool validate; // the Khronos validation layer with synchronisation validation;
                   // its messages come as errors.  AG_ERROR_DEVICE where it is absent.
    bool windows;  // pictures will be shown in windows (argand/window.h)
} ag_device_desc;

typedef struct ag_device ag_device;

// Open a device.  NULL desc -> defaults.  Unless MESA_SHADER_CACHE_DIR is set, it is set
// for this process, to a folder of Argand's cache: open the first device before other
// threads read the environment.
AG_CHECK ag_status ag_device_create(const ag_device_desc *desc, ag_device **device);
AG_API void ag_device_destroy(ag_device *device); // NULL is allowed

// Borrowed from the device.
AG_API const ag_device_info *ag_device_describe(const ag_device *device);

// How many messages the validation layer has given so far.
AG_API uint32_t ag_device_validation_messages(const ag_device *device);

// ---- Pictures --------------------------------------------------------------

typedef struct ag_renderer ag_renderer;

AG_CHECK ag_status ag_renderer_create(ag_device *device, ag_renderer **renderer);
AG_API void ag_renderer_destroy(ag_renderer *renderer); // NULL is allowed

typedef enum ag_tonemap {
    AG_TONEMAP_NEUTRAL = 0, // Khronos PBR Neutral
    AG_TONEMAP_NONE,        // clip
    AG_TONEMAP_REINHARD,
    AG_TONEMAP_ACES,           // Hill's fit of RRT and ODT
    AG_TONEMAP_ACES_NARKOWICZ, // Narkowicz' curve
    AG_TONEMAP_AGX,
} ag_tonemap;

// How display-linear light is coded in 8 bits.
typedef enum ag_transfer {
    AG_TRANSFER_SRGB = 0, // IEC 61966-2-1, both branches
    AG_TRANSFER_GAMMA_22, // the power 1/2.2: darker parts come out up to twice as bright
} ag_transfer;

typedef enum ag_background {
    AG_BACKGROUND_ENVIRONMENT = 0,
    AG_BACKGROUND_TRANSPARENT,
    AG_BACKGROUND_COLOR,
} ag_background;

typedef enum ag_quality {
    AG_QUALITY_DEFAULT = 0, // 4 samples a pixel on edges
    AG_QUALITY_FAST,        // 1 sample a pixel; diffuse image light by 9 coefficients
    AG_QUALITY_BEST,        // 32 jittered frames accumulated
} ag_quality;

// How the highlights of lights of extent are found.
typedef enum ag_area_lights {
    AG_AREA_LIGHTS_EXACT = 0, // docs/sphere-light.md and docs/area-lights.md
    // What it is compared with: linearly transformed cosines (Heitz et al. 2016); the
    // representative point (Karis 2013), which rectangles and disks do not have.
    AG_AREA_LIGHTS_LTC,
    AG_AREA_LIGHTS_REPRESENTATIVE_POINT,
} ag_area_lights;

// What of the light is in a picture; linear pictures of the parts sum to the whole.  What is left
// out is black, not away: it still hides what is behind it.
typedef enum ag_part {
    AG_PART_SEEN = 1,     // what shines into the eye itself: background, lights' bodies, emission
    AG_PART_LIGHTS = 2,   // surfaces under lights, ambient ones among them
    AG_PART_DIFFUSE = 4,  // surfaces under the environment: their base
    AG_PART_SPECULAR = 8, // and their lobe
    AG_PART_EMITTED = 16, // surfaces under emissive ones: only ag_reference has it
} ag_part;

typedef struct ag_render_options {
    uint32_t width, height; // px; 0 -> 1024.  Above the device's limit: tiles
    ag_format format;       // RGBA8: tone-mapped and coded; RGBA32F: linear, exposed
    ag_quality quality;
    ag_tonemap tonemap;
    ag_transfer transfer;
    ag_area_lights area_lights;
    ag_background background;
    float background_color[3]; // sRGB-coded, shown as it is, not exposed
    float exposure;            // linear factor; 0 -> ag_scene_exposure()
    float white_balance_k;     // of the light that comes out white, 1667 to 25000 (eye.h); 0 -> off
    float white_balance_tint;  // how much greener that light is, -150 to 150
    float bloom;               // share of the light, in [0, 1], as of ag_image_bloom; 0 -> none
    uint32_t parts;            // ag_part, or-ed; 0 -> all
    ag_light light;            // AG_PART_LIGHTS is this one alone; 0 -> all
    ag_progress progress;      // stage "render"
} ag_render_options;

// The look of the text that a built-in scene comes from, as far as it is not in the scene:
// sets `tonemap` and `transfer`, nothing else.  False, and nothing is set, for a scene that
// comes from no text or is not there.  Highlights of extent stay exact: that the texts'
// are not is an erratum of theirs; `area_lights` has their method.
AG_API bool ag_demo_look(const char *name, ag_render_options *options);

// Milliseconds of wall time that one render spent, and what it drew.
typedef struct ag_render_stats {
    double bake_ms, compile_ms, upload_ms, frame_ms, readback_ms, bloom_ms;
    double show_ms; // in a window: layers and presentation
    uint32_t draws, instances, tiles, samples;
    uint64_t triangles;
    bool environment_cached; // found on disk, not baked
} ag_render_stats;

// Put a scene's meshes and textures on the device ahead of the first picture, and free its
// images in host memory as they arrive: for programs that need each scene once, this saves
// their size at the peak.  From then on only this renderer can draw the scene, and only as
// long as nothing was added to it and no other scene was drawn in between; AG_ERROR_ARGUMENT
// otherwise.  Lights, environment and exposure may change, and materials that read no image
// in a way that none did before.  A failure half-way may already have freed some.  `upload_ms`,
// what it took, may be NULL.
AG_CHECK ag_status ag_renderer_take(ag_renderer *renderer, ag_scene *scene, double *upload_ms);

// Make a picture.  Meshes, textures and the environment are kept on the device until a
// different scene is rendered or something is added to it; lights and materials that are set cost
// no upload but their own.  The scene is not needed afterwards.
// `camera` NULL -> ag_scene_frame's automatic view.  `stats` may be NULL.
AG_CHECK ag_status ag_renderer_render(ag_renderer *renderer, const ag_scene *scene,
                                      const ag_camera_desc *camera,
                                      const ag_render_options *options, ag_image **image,
                                      ag_render_stats *stats);

// Show a linear picture, RGBA32F: what RGBA8 would be of the same light, by `look`'s tonemap and
// transfer, and over its background_color where its background is that; the linear picture
// then has to be one over AG_BACKGROUND_TRANSPARENT.  Any number of threads may call it.
AG_CHECK ag_status ag_image_display(const ag_log *log, const ag_image *linear,
                                    const ag_render_options *look, ag_image **shown);

// Scatter a share of a linear picture's light as the eye does (CIE 146:2002, docs/physics.md), as
// if its height were seen under 45 degrees.  A share of .2 is then a young eye's.  No light is
// lost: beyond the edges lies the mirror image.  RGBA32F, exposed or not; alpha is scattered with
// the light.  NaN counts as 0, what is beyond 1e30 as that.  On all cores; any number of threads
// may call it.  AG_ERROR_ARGUMENT on bytes or a share outside of [0, 1].
AG_CHECK ag_status ag_image_bloom(const ag_log *log, const ag_image *linear, float share,
                                  ag_image **scattered);

#ifdef __cplusplus
}
#endif
#endif
