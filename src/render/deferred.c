// Frames that are shaded when all that can be seen is known.
#include "render/deferred.h"

#include "base/log.h"
#include "physics/display.glsl"
#include "render/variants.h"
#include "scene/picture.h"

#include <string.h>

enum {
    GROUP = 64,          // places that a workgroup shades: listed.glsl
    GROUPS_MAX = 0xffff, // of a dispatch
};

// ---- Whether -------------------------------------------------------------------

// Instances, lights, and nothing.
static uint32_t source_count(const ag_renderer *r, const picture *p)
{
    return p->draws.instance_count + r->resident.lights.count + 1;
}

// Materials.
static uint32_t list_count(const picture *p)
{
    return (uint32_t)p->scene->materials_count;
}

static uint32_t bits_for(uint64_t values)
{
    uint32_t bits = 0;
    while (1ull << bits < values)
        bits++;
    return bits;
}

static uint32_t triangle_bits(const ag_renderer *r, const picture *p)
{
    uint32_t most = r->resident.lights.bodies < r->resident.lights.count ? GPU_BODY_TRIANGLES : 1;
    for (uint32_t i = 0; i < p->draws.count; i++) {
        uint32_t count = p->scene->meshes[p->draws.items[i].mesh].index_count / 3;
        most = count > most ? count : most;
    }
    return bits_for(most);
}

// Holes need textures, which the host may have given away; blending needs an order.
static bool is_opaque(const ag_renderer *r, const picture *p)
{
    for (uint32_t i = 0; i < p->draws.count; i++)
        if (r->resident.materials.constants[p->draws.items[i].material].alpha_mode)
            return false;
    return true;
}

static bool texels_fit(const ag_renderer *r, const picture *p)
{
    VkDeviceSize limit = r->device->limits.maxTexelBufferElements;
    return r->resident.geometry.vertices.size / 16 <= limit &&
           r->resident.geometry.indices.size / 4 <= limit &&
           p->draws.instance_count * 3ull <= limit;
}

bool deferred_fits(const ag_renderer *r, const picture *p)
{
    return r->device->info.kind == AG_DEVICE_CPU && !r->forward_only && is_opaque(r, p) &&
           texels_fit(r, p) && triangle_bits(r, p) + bits_for(source_count(r, p)) <= 32 &&
           list_count(p) <= SHADE_LISTS_MAX;
}

// ---- What ids stand for ------------------------------------------------------------

static bool shows_background(const ag_renderer *r, const picture *p)
{
    const lights *l = &r->resident.lights;
    bool suns = l->ends[GPU_LIGHTS_PUNCTUAL] < l->bodies;
    return p->background && (r->resident.surround.present || suns);
}

static void name_instances(const ag_renderer *r, const picture *p)
{
    for (uint32_t i = 0; i < p->draws.count; i++) {
        const draw *d = &p->draws.items[i];
        const geometry_range *range = &r->resident.geometry.ranges[d->mesh];
        for (uint32_t k = 0; k < d->instance_count; k++)
            r->visibility.sources[d->first_instance + k] =
                (shade_source) { .list = d->material,
                                 .first_index = range->first_index,
                                 .first_vertex = (uint32_t)range->first_vertex,
                                 .indices = p->scene->meshes[d->mesh].indices };
    }
}

// All lights, whether they have a body or not.
static void name_lights(const ag_renderer *r, const picture *p)
{
    const lights *l = &r->resident.lights;
    const gpu_light *all = l->all.memory.mapped;
    uint32_t tone = variants_tone_early(p);
    const rgb_matrix m = picture_exposure(p->options);
    float seen = p->options->parts & AG_PART_SEEN ? 1.0f : 0.0f;
    for (uint32_t i = 0; i < l->count; i++) {
        const float *light = &all[i].radiance.x;
        vec3 c = seen * vec3(light[0], light[1], light[2]);
        c = min(white_balanced(c, m.red, m.green, m.blue), 60000.0f);
        if (tone != GPU_TONE_LINEAR)
            c = display(tone, c);
        r->visibility.sources[p->draws.instance_count + i] =
            (shade_source) { .list = list_count(p), .color = { c[0], c[1], c[2], 1 } };
        uint32_t level = body_level(&p->view, &all[i]);
        if (i >= l->bodies && level < GPU_BODY_LEVELS)
            body_place(&all[i], level, r->visibility.bodies[i - l->bodies]);
    }
}

ag_status deferred_prepare(ag_renderer *r, const picture *p)
{
    const targets_desc *desc = &r->targets.desc;
    const lights *l = &r->resident.lights;
    size_t sum = desc->sum ? (size_t)desc->width * desc->height : 0;
    ag_status status = visibility_allocate(r->device, source_count(r, p), l->count - l->bodies, sum,
                                           &r->visibility);
    if (status)
        return status;
    name_instances(r, p);
    name_lights(r, p);
    r->visibility.triangle_bits = triangle_bits(r, p);
    shade_source *nothing = &r->visibility.sources[source_count(r, p) - 1];
    nothing->list = list_count(p);
    nothing->color[3] = p->background ? 1 : 0;
    return AG_OK;
}

// ---- What is seen --------------------------------------------------------------------

// clip_from_world times the rows of an instance.
static void chain(const float4x4 *clip, const gpu_instance *instance, float out[4][4])
{
    const float4 last = { 0, 0, 0, 1 };
    const float *rows[4] = { &instance->rows[0].x, &instance->rows[1].x, &instance->rows[2].x,
                             &last.x };
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            double sum = 0;
            for (int i = 0; i < 4; i++)
                sum += (double)clip->m[i][row] * (double)rows[i][column];
            out[column][row] = (float)sum;
        }
}

static raster_object *add_instances(const ag_renderer *r, const picture *p, const gpu_frame *frame,
                                    raster_object *out)
{
    for (uint32_t i = 0; i < p->draws.count; i++) {
        const draw *d = &p->draws.items[i];
        const scene_mesh *mesh = &p->scene->meshes[d->mesh];
        bool both = d->cull == VK_CULL_MODE_NONE;
        for (uint32_t k = d->first_instance; k < d->first_instance + d->instance_count; k++) {
            *out = (raster_object) { .positions = mesh->vertices->position,
                                     .stride = sizeof *mesh->vertices,
                                     .indices = mesh->indices,
                                     .triangle_count = mesh->index_count / 3,
                                     .id = (uint32_t)((uint64_t)k << r->visibility.triangle_bits),
                                     .left = both || !d->mirrored,
                                     .right = both || d->mirrored };
            chain(&frame->clip_from_world, &p->draws.instances[k], out++->clip);
        }
    }
    return out;
}

static raster_object *add_bodies(const ag_renderer *r, const picture *p, const gpu_frame *frame,
                                 raster_object *out)
{
    const lights *l = &r->resident.lights;
    const gpu_light *all = l->all.memory.mapped;
    for (uint32_t i = l->bodies; i < l->count; i++) {
        uint32_t level = body_level(&p->view, &all[i]), count;
        if (level == GPU_BODY_LEVELS || !body_shows_front(&all[i], frame))
            continue;
        const uint32_t *indices = body_triangles(&r->body, level, &count);
        *out = (raster_object) { .positions = r->visibility.bodies[i - l->bodies][0],
                                 .stride = sizeof *r->visibility.bodies[0],
                                 .indices = indices,
                                 .triangle_count = count,
                                 .id = (uint32_t)((uint64_t)(p->draws.instance_count + i)
                                                  << r->visibility.triangle_bits),
                                 .left = true,
                                 .right = true };
        memcpy(out++->clip, frame->clip_from_world.m, sizeof out->clip);
    }
    return out;
}

// List what this frame shows.
static ag_status see(ag_renderer *r, const picture *p)
{
    const targets_desc *desc = &r->targets.desc;
    visibility *v = &r->visibility;
    raster_object *end = add_instances(r, p, r->frame.memory.mapped, v->objects);
    end = add_bodies(r, p, r->frame.memory.mapped, end);
    v->list.triangle_bits = v->triangle_bits;
    v->list.sources = v->sources;
    v->list.source_count = source_count(r, p);
    v->list.list_count = list_count(p);
    bool seen = raster_begin(&v->raster, desc->width, desc->height, desc->samples, v->objects,
                             (size_t)(end - v->objects)) &&
                shade_list_count(&v->list, &v->raster);
    return seen ? AG_OK
                : log_fail(&r->device->log, AG_ERROR_MEMORY, "no memory for %llu triangles",
                           (unsigned long long)p->draws.triangles);
}

// ---- Shading ---------------------------------------------------------------------------

static void record_dispatch(const ag_renderer *r, VkPipeline pipeline, gpu_list list)
{
    VkCommandBuffer cmd = r->commands.buffer;
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    do {
        const uint32_t most = GROUPS_MAX * GROUP, end = list.first + list.count;
        const gpu_list part = { list.first, list.count < most ? list.count : most };
        vkCmdPushConstants(cmd, r->bindings.shading, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof part,
                           &part);
        vkCmdDispatch(cmd, part.count ? (part.count + GROUP - 1) / GROUP : 1, 1, 1);
        list = (gpu_list) { part.first + part.count, end - part.first - part.count };
    } while (list.count);
}

static void bind_compute(const ag_renderer *r, uint32_t index, VkDescriptorSet set)
{
    vkCmdBindDescriptorSets(r->commands.buffer, VK_PIPELINE_BIND_POINT_COMPUTE, r->bindings.shading,
                            index, 1, &set, 0, NULL);
}

static ag_status record_material(ag_renderer *r, const picture *p, uint32_t material, gpu_list list)
{
    VkPipeline pipeline;
    ag_status status = variants_surface(r, p, PIPELINE_SHADE, material, &pipeline);
    if (status)
        return status;
    bind_compute(r, 1, r->resident.materials.sets[material]);
    record_dispatch(r, pipeline, list);
    return AG_OK;
}

static void begin_shading(const ag_renderer *r)
{
    bind_compute(r, 0, r->bindings.frame);
    bind_compute(r, 2, r->bindings.listed);
}

static ag_status record_shading(ag_renderer *r, const picture *p, const shade_list *l)
{
    ag_status status = AG_OK;
    begin_shading(r);
    for (uint32_t i = 0; i < l->list_count && !status; i++) {
        const gpu_list part = { l->firsts[i], l->firsts[i + 1] - l->firsts[i] };
        if (part.count)
            status = record_material(r, p, i, part);
    }
    gpu_barrier_memory(&r->commands, GPU_ACCESS_COMPUTE_WRITE, GPU_ACCESS_HOST_READ);
    return status;
}

// ---- Frames ----------------------------------------------------------------------------

static ag_status run(ag_renderer *r)
{
    ag_status status = gpu_commands_submit(r->device, &r->commands);
    return status ? status : gpu_commands_wait(r->device, &r->commands);
}

static ag_status bind_places(ag_renderer *r, uint32_t count)
{
    const geometry *g = &r->resident.geometry;
    return visibility_bind(r->device, &r->bindings, &g->vertices, &g->indices, &r->instances, count,
                           &r->visibility);
}

ag_status deferred_warm_up(ag_renderer *r, const picture *p)
{
    const gpu_list nothing = { 0, 0 };
    ag_status status = bind_places(r, 1);
    if (!status)
        status = gpu_commands_begin(r->device, &r->commands);
    if (status)
        return status;
    begin_shading(r);
    for (uint32_t i = 0; i < p->draws.count && !status; i++)
        if (i == 0 || p->draws.items[i].material != p->draws.items[i - 1].material)
            status = record_material(r, p, p->draws.items[i].material, nothing);
    return status ? status : run(r);
}

static ag_status shade(ag_renderer *r, const picture *p)
{
    const shade_list *list = &r->visibility.list;
    ag_status status = bind_places(r, list->firsts[list->list_count]);
    if (!status)
        status = gpu_commands_begin(r->device, &r->commands);
    if (status)
        return status;
    shade_list_write(list, r->visibility.places.memory.mapped);
    status = record_shading(r, p, list);
    return status ? status : run(r);
}

static void mix_colors(const ag_renderer *r, const picture *p, uint32_t index)
{
    const float4 under = frame_backdrop(p);
    const panorama behind = { .surround = &r->resident.surround,
                              .frame = r->frame.memory.mapped,
                              .suns = r->resident.lights.all.memory.mapped,
                              .tone = variants_tone_early(p) };
    const shade_mix how = {
        .colors = r->visibility.colors.memory.mapped,
        .background = shows_background(r, p) ? &behind : NULL,
        .backdrop = { under.x, under.y, under.z, under.w },
        .tone = p->hdr ? variants_tone(p->options) : GPU_TONE_LINEAR,
        .weight = 1 / (float)p->frames,
        .sum = r->visibility.sum,
        .first = index == 0,
        .last = index + 1 == p->frames,
        .format = p->options->format,
        .pixels = r->targets.pixels.memory.mapped,
    };
    shade_list_mix(&r->visibility.list, &how);
}

// The finished tile into the image that is shown.
static ag_status hand_over(ag_renderer *r, const picture *p, view_rect tile)
{
    ag_status status = gpu_commands_begin(r->device, &r->commands);
    if (status)
        return status;
    targets_hand_over(&r->commands, &r->targets, p->into, tile.x, tile.y);
    return run(r);
}

ag_status deferred_draw(ag_renderer *r, const picture *p, view_rect tile, uint32_t index)
{
    ag_status status = see(r, p);
    if (!status)
        status = shade(r, p);
    if (!status)
        mix_colors(r, p, index);
    if (!status && p->into && index + 1 == p->frames)
        status = hand_over(r, p, tile);
    return status;
}
