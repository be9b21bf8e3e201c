// Which pipeline draws what of a picture.
#include "render/variants.h"

#include "physics/display.glsl"

uint32_t variants_tone(const ag_render_options *o)
{
    if (o->format == AG_FORMAT_RGBA32F)
        return GPU_TONE_LINEAR;
    return (uint32_t)o->tonemap | (o->transfer == AG_TRANSFER_GAMMA_22 ? DISPLAY_GAMMA_22 : 0);
}

uint32_t variants_tone_early(const picture *p)
{
    return p->hdr ? GPU_TONE_LINEAR : variants_tone(p->options);
}

static uint32_t environment_kind(const ag_renderer *r, const picture *p)
{
    if (!r->resident.surround.present)
        return GPU_ENVIRONMENT_NONE;
    return p->options->quality == AG_QUALITY_FAST ? GPU_ENVIRONMENT_HARMONICS
                                                  : GPU_ENVIRONMENT_CUBE;
}

ag_status variants_surface(ag_renderer *r, const picture *p, pipeline_kind kind, uint32_t material,
                           VkPipeline *pipeline)
{
    pipeline_key key = { .kind = kind, .constants = r->resident.materials.constants[material] };
    if (!key.constants.unlit) {
        key.constants.environment = environment_kind(r, p);
        lights_constants(&r->resident.lights, &key.constants);
        if (key.constants.groups & ~(1u << GPU_LIGHTS_PUNCTUAL))
            key.constants.method = (uint32_t)p->options->area_lights;
    }
    key.constants.tone = variants_tone_early(p);
    if (kind == PIPELINE_SHADE) {
        key.constants.alpha_mode = GPU_ALPHA_OPAQUE; // holes are cut already
    } else {
        key.format = targets_surface_format(&r->targets.desc);
        key.constants.samples = r->targets.desc.samples;
    }
    return pipelines_get(r->device, &r->bindings, &r->pipelines, &key, pipeline);
}

ag_status variants_beside(ag_renderer *r, const picture *p, pipeline_kind kind,
                          VkPipeline *pipeline)
{
    pipeline_key key = { .kind = kind,
                         .format = targets_surface_format(&r->targets.desc),
                         .constants.tone = variants_tone_early(p),
                         .constants.samples = r->targets.desc.samples };
    gpu_surface_constants lit = { 0 };
    lights_constants(&r->resident.lights, &lit);
    if (kind == PIPELINE_BACKGROUND) {
        key.constants.environment = r->resident.surround.present;
        key.constants.groups = lit.groups & 1u << GPU_LIGHTS_CAP;
    }
    return pipelines_get(r->device, &r->bindings, &r->pipelines, &key, pipeline);
}

ag_status variants_pass(ag_renderer *r, pipeline_kind kind, VkFormat format, uint32_t tone,
                        VkPipeline *pipeline)
{
    const pipeline_key key = { .kind = kind,
                               .format = format,
                               .constants = { .samples = 1, .tone = tone } };
    return pipelines_get(r->device, &r->bindings, &r->pipelines, &key, pipeline);
}
