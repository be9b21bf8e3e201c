// One tile of a picture: recorded, drawn, and brought back to the host.
#include "render/frame.h"

#include "render/body.h"
#include "render/clusters.h"
#include "render/deferred.h"
#include "render/variants.h"
#include "scene/picture.h"

#include "physics/color.glsl"
#include "physics/sampling.glsl"

#include <math.h>
#include <string.h>

// ---- Recording ---------------------------------------------------------------

static void set_area(VkCommandBuffer cmd, uint32_t width, uint32_t height, bool nothing)
{
    const VkViewport viewport = { 0, 0, (float)width, (float)height, 0, 1 };
    const VkRect2D scissor = { { 0, 0 }, { nothing ? 0 : width, nothing ? 0 : height } };
    vkCmdSetViewport(cmd, 0, 1, &viewport);
    vkCmdSetScissor(cmd, 0, 1, &scissor);
    vkCmdSetCullMode(cmd, VK_CULL_MODE_NONE);
    vkCmdSetFrontFace(cmd, VK_FRONT_FACE_COUNTER_CLOCKWISE);
}

static void bind_set(VkCommandBuffer cmd, VkPipelineLayout layout, uint32_t index,
                     VkDescriptorSet set)
{
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, index, 1, &set, 0, NULL);
}

// Draws `first` to `last`; one triangle of each new material when warming up.
static ag_status record_draws(ag_renderer *r, const picture *p, uint32_t first, uint32_t last,
                              bool warm_up)
{
    VkCommandBuffer cmd = r->commands.buffer;
    VkPipeline bound = VK_NULL_HANDLE;
    uint32_t material = UINT32_MAX;
    if (first < last)
        vkCmdBindIndexBuffer(cmd, r->resident.geometry.indices.buffer, 0, VK_INDEX_TYPE_UINT32);
    for (uint32_t i = first; i < last; i++) {
        const draw *d = &p->draws.items[i];
        if (d->material != material) {
            VkPipeline pipeline;
            ag_status status = variants_surface(r, p, PIPELINE_SURFACE, d->material, &pipeline);
            if (status)
                return status;
            if (pipeline != bound)
                vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
            bound = pipeline;
            material = d->material;
            bind_set(cmd, r->bindings.surfaces, 1, r->resident.materials.sets[material]);
        } else if (warm_up) {
            continue;
        }
        const geometry_range *range = &r->resident.geometry.ranges[d->mesh];
        vkCmdSetCullMode(cmd, d->cull);
        vkCmdSetFrontFace(cmd,
                          d->mirrored ? VK_FRONT_FACE_CLOCKWISE : VK_FRONT_FACE_COUNTER_CLOCKWISE);
        vkCmdDrawIndexed(cmd, warm_up ? 3 : range->index_count, warm_up ? 1 : d->instance_count,
                         range->first_index, range->first_vertex, d->first_instance);
    }
    return AG_OK;
}

static ag_status record_bodies(ag_renderer *r, const picture *p)
{
    const lights *l = &r->resident.lights;
    VkPipeline pipeline;
    if (l->bodies == l->count)
        return AG_OK;
    ag_status status = variants_beside(r, p, PIPELINE_BODY, &pipeline);
    if (status)
        return status;
    vkCmdBindPipeline(r->commands.buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    body_draw(r->commands.buffer, &r->body, l, &p->view);
    return AG_OK;
}

static ag_status record_background(ag_renderer *r, const picture *p)
{
    VkCommandBuffer cmd = r->commands.buffer;
    VkPipeline pipeline;
    ag_status status = variants_beside(r, p, PIPELINE_BACKGROUND, &pipeline);
    if (status)
        return status;
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vkCmdSetCullMode(cmd, VK_CULL_MODE_NONE);
    vkCmdDraw(cmd, 3, 1, 0, 0);
    return AG_OK;
}

static ag_status record_scene(ag_renderer *r, const picture *p, bool warm_up)
{
    VkCommandBuffer cmd = r->commands.buffer;
    const targets_desc *desc = &r->targets.desc;
    const VkBuffer vertices[] = { r->resident.geometry.vertices.buffer, r->instances.buffer };
    const VkDeviceSize offsets[] = { 0, 0 };
    set_area(cmd, desc->width, desc->height, warm_up);
    bind_set(cmd, r->bindings.surfaces, 0, r->bindings.frame);
    if (p->draws.count)
        vkCmdBindVertexBuffers(cmd, 0, 2, vertices, offsets);
    ag_status status = record_draws(r, p, 0, p->draws.opaque_count, warm_up);
    if (!status)
        status = record_bodies(r, p);
    if (!status && p->background)
        status = record_background(r, p);
    if (!status)
        status = record_draws(r, p, p->draws.opaque_count, p->draws.count, warm_up);
    return status;
}

float4 frame_backdrop(const picture *p)
{
    if (p->options->background != AG_BACKGROUND_COLOR)
        return (float4) { 0, 0, 0, 0 };
    if (!(p->options->parts & AG_PART_SEEN))
        return (float4) { 0, 0, 0, 1 };
    const float *c = p->options->background_color;
    return (float4) { color_srgb_decode_channel(c[0]), color_srgb_decode_channel(c[1]),
                      color_srgb_decode_channel(c[2]), 1 };
}

static void begin_rendering(VkCommandBuffer cmd, const targets *t, VkImageView color,
                            VkImageView resolve, bool depth, VkAttachmentLoadOp load, float4 clear)
{
    const VkRenderingAttachmentInfo color_info = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = color,
        .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        .resolveMode = resolve ? VK_RESOLVE_MODE_AVERAGE_BIT : VK_RESOLVE_MODE_NONE,
        .resolveImageView = resolve,
        .resolveImageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        .loadOp = load,
        .storeOp = resolve ? VK_ATTACHMENT_STORE_OP_DONT_CARE : VK_ATTACHMENT_STORE_OP_STORE,
        .clearValue.color.float32 = { clear.x, clear.y, clear.z, clear.w },
    };
    const VkRenderingAttachmentInfo depth_info = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = t->depth.view,
        .imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .storeOp = VK_ATTACHMENT_STORE_OP_DONT_CARE,
    };
    const VkRenderingInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
        .renderArea = { { 0, 0 }, { t->desc.width, t->desc.height } },
        .layerCount = 1,
        .colorAttachmentCount = 1,
        .pColorAttachments = &color_info,
        .pDepthAttachment = depth ? &depth_info : NULL,
    };
    vkCmdBeginRendering(cmd, &info);
}

// Surfaces and background into the picture, or into `radiance` when something follows.
static ag_status record_surfaces(ag_renderer *r, const picture *p, bool warm_up)
{
    const targets *t = &r->targets;
    const gpu_image *out = p->hdr ? &t->radiance : &t->picture;
    const gpu_image *drawn = t->desc.samples > 1 ? &t->samples : out;
    // What was there is dropped, but the pass before must be done with it.
    gpu_access before = GPU_ACCESS_COLOR, before_depth = GPU_ACCESS_DEPTH;
    before.layout = before_depth.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    before.stage |= VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COPY_BIT;
    gpu_barrier_image(&r->commands, out, before, GPU_ACCESS_COLOR);
    if (drawn != out)
        gpu_barrier_image(&r->commands, drawn, before, GPU_ACCESS_COLOR);
    gpu_barrier_image(&r->commands, &t->depth, before_depth, GPU_ACCESS_DEPTH);

    const float4 nothing = { 0, 0, 0, 0 };
    begin_rendering(r->commands.buffer, t, drawn->view, drawn != out ? out->view : VK_NULL_HANDLE,
                    true, VK_ATTACHMENT_LOAD_OP_CLEAR, p->hdr ? nothing : frame_backdrop(p));
    ag_status status = record_scene(r, p, warm_up);
    vkCmdEndRendering(r->commands.buffer);
    return status;
}

// One full-screen pass from `from` (a set that reads it) into `into`.
static ag_status record_pass(ag_renderer *r, pipeline_kind kind, uint32_t tone,
                             VkDescriptorSet from, const gpu_image *into, bool keep, bool warm_up,
                             gpu_resolve push)
{
    VkCommandBuffer cmd = r->commands.buffer;
    VkPipeline pipeline;
    ag_status status = variants_pass(r, kind, into->desc.format, tone, &pipeline);
    if (status)
        return status;
    const float4 nothing = { 0, 0, 0, 0 };
    begin_rendering(cmd, &r->targets, into->view, VK_NULL_HANDLE, false,
                    keep ? VK_ATTACHMENT_LOAD_OP_LOAD : VK_ATTACHMENT_LOAD_OP_CLEAR, nothing);
    set_area(cmd, r->targets.desc.width, r->targets.desc.height, warm_up);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    bind_set(cmd, r->bindings.pictures, 0, from);
    vkCmdPushConstants(cmd, r->bindings.pictures, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof push,
                       &push);
    vkCmdDraw(cmd, 3, 1, 0, 0);
    vkCmdEndRendering(cmd);
    return AG_OK;
}

// From radiance to the picture: into the sum, and after the last frame out of it.
static ag_status record_resolve(ag_renderer *r, const picture *p, uint32_t index, bool warm_up)
{
    const targets *t = &r->targets;
    gpu_access dropped = GPU_ACCESS_COLOR, sampled_before = GPU_ACCESS_SAMPLED;
    dropped.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    dropped.stage |= VK_PIPELINE_STAGE_2_COPY_BIT;
    sampled_before.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    const gpu_resolve push = { frame_backdrop(p), 1.0f / (float)p->frames };
    bool last = warm_up || index + 1 == p->frames;

    gpu_barrier_image(&r->commands, &t->radiance, GPU_ACCESS_COLOR, GPU_ACCESS_SAMPLED);
    ag_status status = AG_OK;
    if (t->desc.sum) {
        bool first = index == 0;
        gpu_barrier_image(&r->commands, &t->sum, first ? sampled_before : GPU_ACCESS_COLOR,
                          GPU_ACCESS_COLOR);
        status = record_pass(r, PIPELINE_ACCUMULATE, 0, r->bindings.picture, &t->sum, !first,
                             warm_up, push);
        if (!status && last)
            gpu_barrier_image(&r->commands, &t->sum, GPU_ACCESS_COLOR, GPU_ACCESS_SAMPLED);
    }
    if (status || !last)
        return status;
    gpu_barrier_image(&r->commands, &t->picture, dropped, GPU_ACCESS_COLOR);
    return record_pass(r, PIPELINE_RESOLVE, variants_tone(p->options),
                       t->desc.sum ? r->bindings.sum : r->bindings.picture, &t->picture, false,
                       warm_up, push);
}

// ---- Frames ------------------------------------------------------------------

static ag_status record_and_submit(ag_renderer *r, const picture *p, view_rect tile, uint32_t index,
                                   bool warm_up)
{
    bool last = !warm_up && index + 1 == p->frames;
    ag_status status = gpu_commands_begin(r->device, &r->commands);
    if (!status)
        status = record_surfaces(r, p, warm_up);
    if (!status && p->hdr)
        status = record_resolve(r, p, index, warm_up);
    if (!status && last && p->into)
        targets_hand_over(&r->commands, &r->targets, p->into, tile.x, tile.y);
    else if (!status && last)
        targets_read_back(&r->commands, &r->targets);
    if (!status)
        status = gpu_commands_submit(r->device, &r->commands);
    return status ? status : gpu_commands_wait(r->device, &r->commands);
}

// Among numbers of another picture lavapipe would write this one's into the shaders' loops, and
// from then on compile them again in every frame: nothing but zeros keeps it from that.
ag_status frame_warm_up(ag_renderer *r, const picture *p)
{
    memset(r->frame.memory.mapped, 0, sizeof(gpu_frame));
    return p->deferred ? deferred_warm_up(r, p)
                       : record_and_submit(r, p, (view_rect) { 0 }, 0, true);
}

// Where frame `index` samples its pixels: a Gaussian filter of .47 px standard deviation, cut
// at 1.5 px.
static void jitter(uint32_t index, uint32_t frames, float out[2])
{
    out[0] = out[1] = 0;
    if (frames == 1)
        return;
    vec2 at = sampling_gaussian(sampling_hammersley(index, frames), 0.47f, 1.5f);
    out[0] = at[0];
    out[1] = at[1];
}

// The same for all frames of a tile.
static ag_status find_clusters(ag_renderer *r, const picture *p, view_rect tile, uint32_t index,
                               gpu_frame *frame)
{
    lights *l = &r->resident.lights;
    gpu_surface_constants lit = { 0 };
    lights_constants(l, &lit);
    if (!lit.clustered || index > 0)
        return AG_OK;
    ag_status status = clusters_write(r->device, &p->view, tile, l, frame);
    if (!status)
        bindings_write_buffer(r->device, r->bindings.frame, 7, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                              l->clusters.buffer, 0, VK_WHOLE_SIZE);
    return status;
}

// What is no part of the picture is black, not away: it still hides what is behind it.
static void set_parts(const picture *p, gpu_frame *frame)
{
    uint32_t parts = p->options->parts;
    float intensity = frame->environment_intensity;
    frame->seen = parts & AG_PART_SEEN ? 1.0f : 0.0f;
    frame->environment_base = parts & AG_PART_DIFFUSE ? intensity : 0;
    frame->environment_lobe = parts & AG_PART_SPECULAR ? intensity : 0;
}

static void set_exposure(const picture *p, gpu_frame *frame)
{
    const rgb_matrix m = picture_exposure(p->options);
    frame->red = (float3) { m.red[0], m.red[1], m.red[2] };
    frame->green = (float3) { m.green[0], m.green[1], m.green[2] };
    frame->blue = (float3) { m.blue[0], m.blue[1], m.blue[2] };
}

ag_status frame_draw(ag_renderer *r, const picture *p, view_rect tile, uint32_t index)
{
    ag_status status = gpu_commands_wait(r->device, &r->commands);
    if (status)
        return status;
    float offset[2];
    jitter(index, p->frames, offset);
    gpu_frame *frame = r->frame.memory.mapped;
    view_frame(&p->view, tile, offset, frame);
    surround_frame(&r->resident.surround, p->scene, frame);
    set_parts(p, frame);
    set_exposure(p, frame);
    frame->footprint = 1 / sqrtf((float)p->frames);
    lights_frame(&r->resident.lights, frame);
    status = find_clusters(r, p, tile, index, frame);
    if (status)
        return status;
    return p->deferred ? deferred_draw(r, p, tile, index)
                       : record_and_submit(r, p, tile, index, false);
}
