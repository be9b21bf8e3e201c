// From a scene to a picture: what is needed is made resident, then tile by tile and
// frame by frame it is drawn.
#include "render/renderer.h"

#include "base/clock.h"
#include "base/log.h"
#include "image/image.h"
#include "render/body.h"
#include "render/deferred.h"
#include "render/frame.h"
#include "render/pixels.h"
#include "scene/bloom.h"
#include "scene/picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    TILE_CPU = 2048, // 4 samples of colour and depth are 32 bytes a pixel of host memory
    TILE_GPU = 4096,
    BEST_FRAMES = 32,
};

ag_status ag_renderer_create(ag_device *device, ag_renderer **out)
{
    *out = NULL;
    ag_renderer *r = calloc(1, sizeof *r);
    if (!r)
        return log_fail(&device->log, AG_ERROR_MEMORY, "no memory for a renderer");
    r->device = device;
    ag_status status = gpu_commands_create(device, &r->commands);
    if (!status)
        status = bindings_create(device, &r->bindings);
    if (!status)
        status = gpu_buffer_create(device, sizeof(gpu_frame), VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                   GPU_MEMORY_UPLOAD, &r->frame);
    if (!status)
        status = body_create(device, &r->body);
    if (status) {
        ag_renderer_destroy(r);
        return status;
    }
    *out = r;
    return AG_OK;
}

void ag_renderer_destroy(ag_renderer *r)
{
    if (!r)
        return;
    gpu_commands_destroy(r->device, &r->commands);
    resident_destroy(r->device, &r->resident);
    targets_destroy(r->device, &r->targets);
    targets_destroy(r->device, &r->metered);
    visibility_destroy(r->device, &r->visibility);
    pipelines_destroy(r->device, &r->pipelines);
    gpu_buffer_destroy(r->device, &r->frame);
    gpu_buffer_destroy(r->device, &r->instances);
    gpu_buffer_destroy(r->device, &r->body);
    gpu_buffer_destroy(r->device, &r->histogram);
    bindings_destroy(r->device, &r->bindings);
    free(r);
}

// ---- What is asked -------------------------------------------------------------

static bool has_blending(const ag_scene *scene)
{
    for (size_t i = 0; i < scene->instances_count; i++)
        if (scene->materials[scene->instances[i].material].alpha_mode == AG_ALPHA_BLEND)
            return true;
    return false;
}

static ag_status plan(const ag_scene *scene, const ag_camera_desc *camera,
                      const ag_render_options *options, picture *p)
{
    *p = (picture) {
        .scene = scene,
        .options = options,
        .frames = options->quality == AG_QUALITY_BEST ? BEST_FRAMES : 1,
        .background = options->background == AG_BACKGROUND_ENVIRONMENT,
    };
    ag_status status = picture_view(scene, camera, options, &p->view);
    if (status)
        return status;
    // Light is mixed before the tone curve wherever pictures or surfaces are mixed.
    p->hdr = options->format == AG_FORMAT_RGBA32F || p->frames > 1 || has_blending(scene);
    return draws_make(scene, &p->view, &p->draws);
}

// ---- Preparing the device --------------------------------------------------------

static ag_status upload_instances(ag_renderer *r, const draws *d)
{
    ag_status status = gpu_buffer_ensure(r->device, d->instance_count * sizeof(gpu_instance),
                                         VK_BUFFER_USAGE_VERTEX_BUFFER_BIT |
                                             VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT,
                                         GPU_MEMORY_UPLOAD, &r->instances);
    if (!status)
        memcpy(r->instances.memory.mapped, d->instances, d->instance_count * sizeof(gpu_instance));
    return status;
}

static void write_frame_set(ag_renderer *r)
{
    const VkDescriptorSet set = r->bindings.frame;
    const surround *s = &r->resident.surround;
    const lights *l = &r->resident.lights;
    bindings_write_buffer(r->device, set, 0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, r->frame.buffer, 0,
                          VK_WHOLE_SIZE);
    bindings_write_image(r->device, set, 1, s->cube.view, r->bindings.linear);
    bindings_write_image(r->device, set, 2, s->image.view, r->bindings.panorama);
    bindings_write_image(r->device, set, 3, s->dfg.view, r->bindings.linear);
    bindings_write_buffer(r->device, set, 4, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, l->near.buffer, 0,
                          VK_WHOLE_SIZE);
    bindings_write_image(r->device, set, 5, s->irradiance.view, r->bindings.linear);
    bindings_write_buffer(r->device, set, 6, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, l->all.buffer, 0,
                          VK_WHOLE_SIZE);
    bindings_write_buffer(r->device, set, 7, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, l->clusters.buffer,
                          0, VK_WHOLE_SIZE);
    bindings_write_image(r->device, set, 8, s->ltc.view, r->bindings.linear);
    if (r->targets.radiance.view)
        bindings_write_image(r->device, r->bindings.picture, 0, r->targets.radiance.view,
                             r->bindings.linear);
    if (r->targets.sum.view)
        bindings_write_image(r->device, r->bindings.sum, 0, r->targets.sum.view,
                             r->bindings.linear);
}

// How many tiles of at most `limit` px cover `size`, and how large the even ones are.
static uint32_t tile_count(uint32_t size, uint32_t limit)
{
    return (size + limit - 1) / limit;
}

static uint32_t tile_size(uint32_t size, uint32_t limit)
{
    uint32_t count = tile_count(size, limit);
    return (size + count - 1) / count;
}

static uint32_t tile_limit(const ag_renderer *r)
{
    uint32_t limit = r->device->info.kind == AG_DEVICE_CPU ? TILE_CPU : TILE_GPU;
    return limit < r->device->info.max_size ? limit : r->device->info.max_size;
}

static ag_status prepare(ag_renderer *r, picture *p, ag_render_stats *stats)
{
    const ag_render_options *o = p->options;
    ag_status status = resident_things(r, p->scene, false, &stats->upload_ms);
    if (!status)
        status = lights_write(r->device, p->scene, o, &r->resident.lights);
    if (!status)
        status = upload_instances(r, &p->draws);
    if (status)
        return status;
    p->deferred = deferred_fits(r, p);
    surround_shown shown = p->deferred ? SURROUND_BY_HOST : SURROUND_BY_DEVICE;
    status = resident_surround(r, p->scene, p->background ? shown : SURROUND_HIDDEN, stats);
    if (status)
        return status;
    uint32_t limit = tile_limit(r);
    const targets_desc desc = {
        .width = tile_size(o->width, limit),
        .height = tile_size(o->height, limit),
        .samples = o->quality == AG_QUALITY_DEFAULT ? 4 : 1,
        .hdr = p->hdr,
        .sum = p->frames > 1,
        .deferred = p->deferred,
        .format = o->format,
    };
    status = targets_ensure(r->device, &desc, &r->targets);
    if (!status && p->deferred)
        status = deferred_prepare(r, p);
    if (status)
        return status;
    write_frame_set(r);
    double start = clock_ms();
    status = frame_warm_up(r, p);
    stats->compile_ms = clock_ms() - start;
    return status;
}

// ---- Drawing ---------------------------------------------------------------------

static bool tell(const ag_progress *progress, const char *stage, double fraction)
{
    return !progress->update || progress->update(progress->user, stage, fraction);
}

static ag_status draw_tile(ag_renderer *r, const picture *p, view_rect tile, double done,
                           double share)
{
    for (uint32_t i = 0; i < p->frames; i++) {
        if (!tell(&p->options->progress, "render", done + share * i / p->frames))
            return log_fail(&r->device->log, AG_ERROR_CANCELLED, "the render was cancelled");
        ag_status status = frame_draw(r, p, tile, i);
        if (status)
            return status;
    }
    return AG_OK;
}

static ag_status draw_tiles(ag_renderer *r, const picture *p, ag_image *image,
                            ag_render_stats *stats)
{
    // Tiles are of one size; the last ones reach over the edge and are cut on the way out.
    const targets_desc *desc = &r->targets.desc;
    uint32_t across = tile_count(p->options->width, tile_limit(r));
    uint32_t down = tile_count(p->options->height, tile_limit(r));
    stats->tiles = across * down;
    for (uint32_t i = 0; i < stats->tiles; i++) {
        view_rect tile = { i % across * desc->width, i / across * desc->height, desc->width,
                           desc->height };
        double start = clock_ms(), share = 1.0 / stats->tiles;
        ag_status status = draw_tile(r, p, tile, i * share, share);
        if (status)
            return status;
        double drawn = clock_ms();
        if (image)
            pixels_place(r->targets.pixels.memory.mapped, tile, image);
        stats->frame_ms += drawn - start;
        stats->readback_ms += clock_ms() - drawn;
    }
    return AG_OK;
}

static ag_status render(ag_renderer *r, picture *p, ag_image **out, ag_render_stats *stats)
{
    ag_status status = prepare(r, p, stats);
    if (status || p->into)
        return status ? status : draw_tiles(r, p, NULL, stats);
    const ag_image_desc desc = { p->options->width, p->options->height, p->options->format, NULL };
    ag_image *image;
    status = ag_image_create(&r->device->log, &desc, &image);
    if (status)
        return status;
    status = draw_tiles(r, p, image, stats);
    if (status)
        ag_image_destroy(image);
    else
        *out = image;
    return status;
}

ag_status ag_renderer_take(ag_renderer *r, ag_scene *scene, double *upload_ms)
{
    double unwanted;
    if (!upload_ms)
        upload_ms = &unwanted;
    *upload_ms = 0;
    return resident_things(r, scene, true, upload_ms);
}

// For those who want to hear what was chosen.
static void tell_choices(const ag_renderer *r, const picture *p, const ag_render_stats *stats)
{
    const ag_log *log = &r->device->log;
    const view *v = &p->view;
    log_write(log, AG_LOG_INFO, "camera: at %g %g %g m, looking along %g %g %g, %s",
              (double)v->eye[0], (double)v->eye[1], (double)v->eye[2], (double)v->forward[0],
              (double)v->forward[1], (double)v->forward[2],
              v->orthographic ? "orthographic" : "perspective");
    log_write(log, AG_LOG_INFO, "environment: %s",
              !r->resident.surround.present ? "none"
              : stats->environment_cached   ? "found in the cache"
                                            : "prepared");
    log_write(log, AG_LOG_INFO,
              "drawn: %u instances in %u draws, %llu triangles, %u lights, %u tile%s, %u "
              "sample%s a pixel",
              stats->instances, stats->draws, (unsigned long long)stats->triangles,
              r->resident.lights.count, stats->tiles, stats->tiles == 1 ? "" : "s", stats->samples,
              stats->samples == 1 ? "" : "s");
}

// Into `*image`, or into `into` where that is not NULL.
static ag_status make(ag_renderer *r, const ag_scene *scene, const ag_camera_desc *camera,
                      const ag_render_options *options, const gpu_image *into, ag_image **image,
                      ag_render_stats *stats)
{
    ag_render_options checked = options ? *options : (ag_render_options) { 0 };
    *stats = (ag_render_stats) { 0 };
    picture p;
    ag_status status = picture_check(scene, &checked);
    if (!status)
        status = plan(scene, camera, &checked, &p);
    if (status)
        return status;
    p.into = into;
    stats->draws = p.draws.count;
    stats->instances = p.draws.instance_count;
    stats->triangles = p.draws.triangles;
    stats->samples = p.frames * (checked.quality == AG_QUALITY_DEFAULT ? 4 : 1);
    status = render(r, &p, image, stats);
    if (!status)
        tell_choices(r, &p, stats);
    draws_finish(&p.draws);
    return status;
}

static ag_status make_bloomed(ag_renderer *r, const ag_scene *scene, const ag_camera_desc *camera,
                              const ag_render_options *options, ag_image **image,
                              ag_render_stats *stats)
{
    ag_render_options checked = *options;
    ag_status status = picture_check(scene, &checked);
    if (status)
        return status;
    const ag_render_options light = bloom_light(&checked);
    ag_image *linear = NULL;
    status = make(r, scene, camera, &light, NULL, &linear, stats);
    if (status)
        return status;
    double start = clock_ms();
    status = bloom_finish(&r->device->log, linear, &checked, image);
    stats->bloom_ms = clock_ms() - start;
    ag_image_destroy(linear);
    return status;
}

ag_status ag_renderer_render(ag_renderer *r, const ag_scene *scene, const ag_camera_desc *camera,
                             const ag_render_options *options, ag_image **image,
                             ag_render_stats *stats)
{
    ag_render_stats unwanted;
    *image = NULL;
    if (!stats)
        stats = &unwanted;
    return options && options->bloom != 0 ? make_bloomed(r, scene, camera, options, image, stats)
                                          : make(r, scene, camera, options, NULL, image, stats);
}

ag_status renderer_draw_into(ag_renderer *r, const ag_scene *scene, const ag_camera_desc *camera,
                             const ag_render_options *options, const gpu_image *into,
                             ag_render_stats *stats)
{
    return make(r, scene, camera, options, into, NULL, stats);
}

ag_status renderer_draw_light(ag_renderer *r, const ag_scene *scene, const ag_camera_desc *camera,
                              const ag_render_options *options)
{
    ag_render_options checked = *options;
    ag_render_stats unwanted = { 0 };
    picture p;
    checked.quality = options->quality == AG_QUALITY_FAST ? AG_QUALITY_FAST : AG_QUALITY_BEST;
    ag_status status = picture_check(scene, &checked);
    if (!status)
        status = plan(scene, camera, &checked, &p);
    if (status)
        return status;
    p.frames = 1;
    status = prepare(r, &p, &unwanted);
    if (!status)
        status = draw_tiles(r, &p, NULL, &unwanted);
    draws_finish(&p.draws);
    return status;
}
