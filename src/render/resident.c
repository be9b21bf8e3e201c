// What of a scene is on the device.
#include "render/renderer.h"

#include "base/clock.h"
#include "base/log.h"
#include "image/image.h"

#include <stdlib.h>

static void destroy_things(gpu_device *device, resident *r)
{
    geometry_destroy(device, &r->geometry);
    materials_destroy(device, &r->materials);
    textures_destroy(device, &r->textures);
    r->scene = 0;
}

static bool released(const ag_scene *scene)
{
    for (size_t i = 0; i < scene->images_count; i++)
        if (!scene->images[i]->pixels)
            return true;
    return false;
}

static ag_status make_things(ag_renderer *renderer, const ag_scene *scene, bool release,
                             gpu_upload *upload)
{
    gpu_device *device = renderer->device;
    resident *r = &renderer->resident;
    destroy_things(device, r);
    if (released(scene))
        return log_fail(&device->log, AG_ERROR_ARGUMENT,
                        "the scene's images were released when another renderer took them or "
                        "before it was changed; load it again");
    ag_status status = geometry_create(device, scene, upload, &r->geometry);
    if (!status)
        status = textures_create(device, scene, release, upload, &r->textures);
    if (!status)
        status = materials_create(device, &renderer->bindings, scene, &r->textures, &r->materials);
    return status;
}

// Materials alone were set to others.
static ag_status renew_materials(ag_renderer *renderer, const ag_scene *scene, gpu_upload *upload)
{
    gpu_device *device = renderer->device;
    resident *r = &renderer->resident;
    ag_status status = textures_complete(device, scene, false, upload, &r->textures);
    if (status)
        return status;
    materials_destroy(device, &r->materials);
    return materials_create(device, &renderer->bindings, scene, &r->textures, &r->materials);
}

ag_status resident_things(ag_renderer *renderer, const ag_scene *scene, bool release,
                          double *upload_ms)
{
    resident *r = &renderer->resident;
    bool there = r->scene == scene->id && r->revision == scene->revision;
    if (there && r->materials_revision == scene->materials_revision)
        return AG_OK;
    if (there && !textures_at_hand(scene, &r->textures))
        return log_fail(&renderer->device->log, AG_ERROR_ARGUMENT,
                        "a material that was set reads an image as none did before, but the "
                        "scene's images were released when a renderer took them");
    double start = clock_ms();
    gpu_upload upload;
    ag_status status = gpu_upload_begin(renderer->device, &upload);
    if (!status)
        status = there ? renew_materials(renderer, scene, &upload)
                       : make_things(renderer, scene, release, &upload);
    if (!status)
        status = gpu_upload_end(&upload);
    gpu_upload_finish(&upload);
    *upload_ms += clock_ms() - start;
    if (status) {
        destroy_things(renderer->device, r); // now that nothing is copied into them any more
        return status;
    }
    r->scene = scene->id;
    r->revision = scene->revision;
    r->materials_revision = scene->materials_revision;
    return AG_OK;
}

// All of it, or where it is `there` what is missing to show it.
static ag_status make_surround(ag_renderer *renderer, const ag_scene *scene, surround_shown shown,
                               bool there, gpu_upload *upload, ag_render_stats *stats)
{
    const ag_image *equirect;
    surround *s = &renderer->resident.surround;
    if (!there)
        surround_destroy(renderer->device, s);
    double start = clock_ms();
    ag_status status = scene_environment_open(scene, &equirect);
    double opened = clock_ms() - start;
    if (status)
        return status;
    status = there ? surround_show(renderer->device, equirect, shown, upload, s)
                   : surround_create(renderer->device, equirect, shown, upload,
                                     &stats->environment_cached, &stats->bake_ms, s);
    stats->bake_ms += opened;
    scene_environment_close(scene, equirect);
    return status;
}

ag_status resident_surround(ag_renderer *renderer, const ag_scene *scene, surround_shown shown,
                            ag_render_stats *stats)
{
    resident *r = &renderer->resident;
    bool there =
        r->surrounded == scene->id && r->environment_revision == scene->environment_revision;
    if (there && surround_shows(&r->surround, shown))
        return AG_OK;
    double start = clock_ms();
    gpu_upload upload;
    ag_status status = gpu_upload_begin(renderer->device, &upload);
    r->surrounded = 0;
    if (!status)
        status = make_surround(renderer, scene, shown, there, &upload, stats);
    if (!status)
        status = gpu_upload_end(&upload);
    gpu_upload_finish(&upload);
    stats->upload_ms += clock_ms() - start - stats->bake_ms;
    if (status) {
        surround_destroy(renderer->device, &r->surround);
        return status;
    }
    r->surrounded = scene->id;
    r->environment_revision = scene->environment_revision;
    return AG_OK;
}

void resident_destroy(gpu_device *device, resident *r)
{
    destroy_things(device, r);
    surround_destroy(device, &r->surround);
    lights_destroy(device, &r->lights);
    *r = (resident) { 0 };
}
