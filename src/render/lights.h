// The lights of a scene on the device.
//
// Punctual lights and those of extent stand in one buffer, sorted by kind; few punctual ones
// also in a uniform buffer, which a CPU device reads faster.  Ambient lights are one sum.
#ifndef AG_RENDER_LIGHTS_H
#define AG_RENDER_LIGHTS_H

#include <argand/renderer.h>

#include "gpu/buffer.h"
#include "render/view.h"
#include "scene/scene.h"

#include "interop/scene.glsl"

typedef struct lights {
    gpu_buffer near;     // gpu_light[GPU_LIGHTS_NEAR]
    gpu_buffer all;      // gpu_light[count]
    gpu_buffer clusters; // of one tile of the picture; see clusters.h
    uint32_t count, ends[GPU_LIGHT_GROUPS];
    uint32_t bodies; // index of the first light that has one
    bool ambient_present;
    float3 ambient[9]; // ambient_light of ambient.glsl
} lights;

// Write the scene's lights, as far as they are part of the picture: the others are dark.  Where
// there are many, each that has no range gets one: beyond it the light would add nothing that
// can be seen at the picture's exposure.  Pictures of floats are yet to be exposed.
AG_CHECK ag_status lights_write(gpu_device *device, const ag_scene *scene,
                                const ag_render_options *options, lights *l);
void lights_destroy(gpu_device *device, lights *l); // zero is allowed

// The lights' part of the surfaces' constants, and of a frame.
void lights_constants(const lights *l, gpu_surface_constants *constants);
void lights_frame(const lights *l, gpu_frame *frame);

#endif
