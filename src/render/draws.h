// What is drawn, and in which order: opaque front to back, then cut-outs, then what
// blends, back to front.  Neighbours of one mesh and material become one instanced draw.
#ifndef AG_RENDER_DRAWS_H
#define AG_RENDER_DRAWS_H

#include "gpu/buffer.h"
#include "render/view.h"
#include "scene/scene.h"

#include "interop/scene.glsl"

typedef struct draw {
    uint32_t mesh, material;
    uint32_t first_instance, instance_count; // of draws.instances
    bool mirrored;                           // the winding is turned round
    VkCullModeFlags cull;
} draw;

typedef struct draws {
    draw *items;
    uint32_t count;
    uint32_t opaque_count; // of items, those before the background: opaque and cut-out
    uint32_t instance_count;
    uint64_t triangles;
    gpu_instance *instances; // in drawing order
} draws;

// Everything of the scene that the view may see.
AG_CHECK ag_status draws_make(const ag_scene *scene, const view *v, draws *d);
void draws_finish(draws *d); // zero is allowed

#endif
