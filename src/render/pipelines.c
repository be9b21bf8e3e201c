// Every pipeline of the renderer, each made when it is first needed.
#include "render/pipelines.h"

#include "base/array.h"
#include "base/log.h"
#include "render/geometry.h"
#include "render/shaders.h"

#include <stdlib.h>
#include <string.h>

_Static_assert(sizeof(pipeline_key) == 8 + sizeof(gpu_surface_constants), "no padding");

typedef struct pipelines_entry {
    pipeline_key key;
    VkPipeline pipeline;
} pipelines_entry;

static gpu_pipeline_desc describe(const bindings *b, const pipeline_key *key)
{
    gpu_pipeline_desc desc = {
        .vertex = shader_fullscreen_vert(),
        .layout = b->pictures,
        .color_format = (VkFormat)key->format,
        .samples = key->constants.samples,
        .constants = (const uint32_t *)&key->constants,
        .constant_count = sizeof key->constants / 4,
    };
    bool blended = key->constants.alpha_mode == GPU_ALPHA_BLEND;
    switch (key->kind) {
    case PIPELINE_SURFACE:
        desc.vertex = shader_surface_vert();
        desc.fragment = key->constants.alpha_mode == GPU_ALPHA_MASK ? shader_cutout_frag()
                                                                    : shader_surface_frag();
        desc.layout = b->surfaces;
        desc.vertices = geometry_vertex_input();
        desc.has_depth = desc.depth_test = true;
        desc.depth_write = !blended;
        desc.blend = blended ? GPU_BLEND_OVER : GPU_BLEND_NONE;
        break;
    case PIPELINE_BODY:
        desc.vertex = shader_body_vert();
        desc.fragment = shader_body_frag();
        desc.layout = b->surfaces;
        desc.has_depth = desc.depth_test = desc.depth_write = true;
        break;
    case PIPELINE_BACKGROUND:
        desc.fragment = shader_background_frag();
        desc.layout = b->surfaces;
        desc.has_depth = desc.depth_test = true;
        break;
    case PIPELINE_ACCUMULATE:
        desc.fragment = shader_accumulate_frag();
        desc.blend = GPU_BLEND_ADD;
        break;
    case PIPELINE_RESOLVE: desc.fragment = shader_resolve_frag(); break;
    case PIPELINE_LAYER:
        desc.vertex = shader_layer_vert();
        desc.fragment = shader_layer_frag();
        desc.layout = b->layers;
        desc.blend = GPU_BLEND_OVER;
        break;
    }
    return desc;
}

static ag_status create_compute(gpu_device *device, const bindings *b, const pipeline_key *key,
                                VkPipeline *pipeline)
{
    gpu_compute_desc desc = {
        .shader = shader_shade_comp(),
        .layout = b->shading,
        .constants = (const uint32_t *)&key->constants,
        .constant_count = sizeof key->constants / 4,
    };
    if (key->kind == PIPELINE_METER) {
        desc.shader = shader_meter_comp();
        desc.layout = b->metering;
    }
    return gpu_compute_create(device, &desc, pipeline);
}

static ag_status create_graphics(gpu_device *device, const bindings *b, const pipeline_key *key,
                                 VkPipeline *pipeline)
{
    const gpu_pipeline_desc desc = describe(b, key);
    return gpu_pipeline_create(device, &desc, pipeline);
}

ag_status pipelines_get(gpu_device *device, const bindings *b, pipelines *p,
                        const pipeline_key *key, VkPipeline *pipeline)
{
    for (size_t i = 0; i < p->count; i++)
        if (memcmp(&p->entries[i].key, key, sizeof *key) == 0) {
            *pipeline = p->entries[i].pipeline;
            return AG_OK;
        }
    if (!array_reserve(&p->entries, &p->capacity, p->count + 1, sizeof *p->entries))
        return log_fail(&device->log, AG_ERROR_MEMORY, "no memory for a pipeline");
    ag_status status = key->kind >= PIPELINE_SHADE ? create_compute(device, b, key, pipeline)
                                                   : create_graphics(device, b, key, pipeline);
    if (!status)
        p->entries[p->count++] = (pipelines_entry) { *key, *pipeline };
    return status;
}

void pipelines_destroy(gpu_device *device, pipelines *p)
{
    for (size_t i = 0; i < p->count; i++)
        vkDestroyPipeline(device->device, p->entries[i].pipeline, NULL);
    free(p->entries);
    *p = (pipelines) { 0 };
}
