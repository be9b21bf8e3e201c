// The renderer's state.
#ifndef AG_RENDER_RENDERER_H
#define AG_RENDER_RENDERER_H

#include "gpu/commands.h"
#include "render/bindings.h"
#include "render/geometry.h"
#include "render/lights.h"
#include "render/materials.h"
#include "render/pipelines.h"
#include "render/surround.h"
#include "render/targets.h"
#include "render/textures.h"
#include "render/visibility.h"

// What of a scene is on the device.
typedef struct resident {
    uint64_t scene, revision, materials_revision; // what the things were made from; 0 = nothing
    uint64_t surrounded, environment_revision;    // what the surround was made from
    geometry geometry;
    textures textures;
    materials materials;
    surround surround;
    lights lights; // as the last picture needed them
} resident;

struct ag_renderer {
    gpu_device *device;
    bindings bindings;
    pipelines pipelines;
    targets targets;
    visibility visibility;
    resident resident;
    bool forward_only;    // for tests: never deferred
    gpu_buffer frame;     // gpu_frame
    gpu_buffer instances; // gpu_instance
    gpu_buffer body;      // indices of the grid that a light's body is
    gpu_commands commands;
    targets metered;      // as `targets`, of the small pictures that are metered
    gpu_buffer histogram; // of one
};

// Have the scene's things on the device: what is there and unchanged is kept.  `release`:
// give the scene's pixels back as they are uploaded.
AG_CHECK ag_status resident_things(ag_renderer *renderer, const ag_scene *scene, bool release,
                                   double *upload_ms);

// Have what surrounds the scene on the device, and where it is shown as a picture.
AG_CHECK ag_status resident_surround(ag_renderer *renderer, const ag_scene *scene,
                                     surround_shown shown, ag_render_stats *stats);
void resident_destroy(gpu_device *device, resident *r); // zero is allowed

// Make a picture as ag_renderer_render does, into an image of its size: 8 bits, as they are
// coded, sampled by shaders before and after.
AG_CHECK ag_status renderer_draw_into(ag_renderer *renderer, const ag_scene *scene,
                                      const ag_camera_desc *camera,
                                      const ag_render_options *options, const gpu_image *into,
                                      ag_render_stats *stats);

// Draw one frame of one sample a pixel and leave it in renderer->targets.pixels, premultiplied.
AG_CHECK ag_status renderer_draw_light(ag_renderer *renderer, const ag_scene *scene,
                                       const ag_camera_desc *camera,
                                       const ag_render_options *options);

#endif
