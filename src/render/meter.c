// The exposure that the light of a scene asks for.
#include "render/renderer.h"
#include "scene/metering.h"

#include <string.h>

enum { GROUPS = 16 };

// The pictures of full size keep their targets.
static void exchange_targets(ag_renderer *r)
{
    targets t = r->targets;
    r->targets = r->metered;
    r->metered = t;
}

static gpu_meter describe(const ag_renderer *r, const ag_metering *m, float exposure)
{
    const targets_desc *desc = &r->targets.desc;
    const meter_pattern p = metering_pattern(m, desc->width, desc->height);
    return (gpu_meter) { .width = desc->width,
                         .height = desc->height,
                         .meter = p.meter,
                         .x = p.x,
                         .y = p.y,
                         .radius = p.radius,
                         .shorter = p.shorter,
                         .scale = 1 / exposure };
}

static ag_status bind(ag_renderer *r)
{
    const VkDeviceSize size = METER_BINS * sizeof(uint32_t);
    ag_status status = gpu_buffer_ensure(r->device, size, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                         GPU_MEMORY_READBACK, &r->histogram);
    if (status)
        return status;
    memset(r->histogram.memory.mapped, 0, size);
    bindings_write_buffer(r->device, r->bindings.meter, 0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                          r->targets.pixels.buffer, 0, VK_WHOLE_SIZE);
    bindings_write_buffer(r->device, r->bindings.meter, 1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                          r->histogram.buffer, 0, VK_WHOLE_SIZE);
    return AG_OK;
}

static void record(const ag_renderer *r, VkPipeline pipeline, gpu_meter push)
{
    VkCommandBuffer cmd = r->commands.buffer;
    gpu_barrier_memory(&r->commands, GPU_ACCESS_TRANSFER_WRITE, GPU_ACCESS_GEOMETRY);
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, r->bindings.metering, 0, 1,
                            &r->bindings.meter, 0, NULL);
    vkCmdPushConstants(cmd, r->bindings.metering, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof push,
                       &push);
    vkCmdDispatch(cmd, GROUPS, 1, 1);
    gpu_barrier_memory(&r->commands, GPU_ACCESS_COMPUTE_WRITE, GPU_ACCESS_HOST_READ);
}

// The histogram of what has been drawn.
static ag_status sum_up(ag_renderer *r, gpu_meter push)
{
    const pipeline_key key = { .kind = PIPELINE_METER };
    VkPipeline pipeline;
    ag_status status = pipelines_get(r->device, &r->bindings, &r->pipelines, &key, &pipeline);
    if (!status)
        status = bind(r);
    if (!status)
        status = gpu_commands_begin(r->device, &r->commands);
    if (status)
        return status;
    record(r, pipeline, push);
    status = gpu_commands_submit(r->device, &r->commands);
    return status ? status : gpu_commands_wait(r->device, &r->commands);
}

static float read(const ag_renderer *r, const ag_metering *m)
{
    const uint32_t *counted = r->histogram.memory.mapped;
    uint64_t bins[METER_BINS];
    for (uint32_t i = 0; i < METER_BINS; i++)
        bins[i] = counted[i];
    return metering_ev100(m, bins);
}

ag_status ag_renderer_meter(ag_renderer *r, const ag_scene *scene, const ag_camera_desc *camera,
                            const ag_render_options *options, const ag_metering *metering,
                            float *ev100)
{
    const ag_render_options small = metering_picture(options);
    ag_metering m;
    *ev100 = 0;
    ag_status status = metering_check(&r->device->log, metering, &m);
    if (status)
        return status;
    exchange_targets(r);
    status = renderer_draw_light(r, scene, camera, &small);
    if (!status)
        status = sum_up(r, describe(r, &m, small.exposure));
    if (!status)
        *ev100 = read(r, &m);
    exchange_targets(r);
    return status;
}
