// Every pipeline of the renderer, each made when it is first needed.
#ifndef AG_RENDER_PIPELINES_H
#define AG_RENDER_PIPELINES_H

#include "render/bindings.h"

#include "interop/scene.glsl"

typedef enum pipeline_kind {
    PIPELINE_SURFACE,
    PIPELINE_BODY,       // of a light
    PIPELINE_BACKGROUND, // the environment behind everything
    PIPELINE_ACCUMULATE, // a picture into the sum
    PIPELINE_RESOLVE,    // radiance to the picture that leaves
    PIPELINE_LAYER,      // an image in a window
    PIPELINE_SHADE,      // surfaces, from a list; this and what follows compute
    PIPELINE_METER, // the histogram of a picture
} pipeline_kind;

// What tells pipelines apart.  Compared byte by byte: no padding.
typedef struct pipeline_key {
    uint32_t kind;                   // pipeline_kind
    uint32_t format;                 // VkFormat drawn into
    gpu_surface_constants constants; // what the kind does not read stays 0
} pipeline_key;

typedef struct pipelines {
    struct pipelines_entry *entries;
    size_t count, capacity;
} pipelines;

// Owned by the cache.
AG_CHECK ag_status pipelines_get(gpu_device *device, const bindings *b, pipelines *p,
                                 const pipeline_key *key, VkPipeline *pipeline);
void pipelines_destroy(gpu_device *device, pipelines *p); // zero is allowed

#endif
