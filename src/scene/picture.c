// What a picture is asked to be.
#include "scene/picture.h"

#include "base/log.h"

#include <math.h>

enum { SIZE_DEFAULT = 1024, SIZE_MAX_PX = 1 << 16 };

static bool choices_are_known(const ag_render_options *o)
{
    return (unsigned)o->tonemap <= AG_TONEMAP_AGX &&
           (unsigned)o->background <= AG_BACKGROUND_COLOR &&
           (unsigned)o->quality <= AG_QUALITY_BEST && (unsigned)o->format <= AG_FORMAT_RGBA32F &&
           (unsigned)o->area_lights <= AG_AREA_LIGHTS_REPRESENTATIVE_POINT &&
           (unsigned)o->transfer <= AG_TRANSFER_GAMMA_22;
}

static bool white_is_in_range(const ag_render_options *o)
{
    float kelvin = o->white_balance_k, tint = o->white_balance_tint;
    return kelvin == 0 || (kelvin >= 1667 && kelvin <= 25000 && tint >= -150 && tint <= 150);
}

ag_status picture_check(const ag_scene *scene, ag_render_options *o)
{
    const uint32_t all =
        AG_PART_SEEN | AG_PART_LIGHTS | AG_PART_DIFFUSE | AG_PART_SPECULAR | AG_PART_EMITTED;
    const ag_log *log = &scene->log;
    if (!o->width && !o->height)
        o->width = o->height = SIZE_DEFAULT;
    if (!o->width || !o->height || o->width > SIZE_MAX_PX || o->height > SIZE_MAX_PX)
        return log_fail(log, AG_ERROR_ARGUMENT, "a picture of %ux%u pixels is not in 1 to %d",
                        o->width, o->height, SIZE_MAX_PX);
    if (o->exposure == 0)
        o->exposure = ag_scene_exposure(scene);
    if (!(o->exposure > 0 && isfinite(o->exposure)))
        return log_fail(log, AG_ERROR_ARGUMENT, "an exposure of %g is not above 0",
                        (double)o->exposure);
    if (!white_is_in_range(o))
        return log_fail(
            log, AG_ERROR_ARGUMENT,
            "a white balance of %g K and tint %g is not in 1667 to 25000 and -150 to 150",
            (double)o->white_balance_k, (double)o->white_balance_tint);
    if (!(o->bloom >= 0 && o->bloom <= 1))
        return log_fail(log, AG_ERROR_ARGUMENT, "a bloom of %g is no share of 0 to 1",
                        (double)o->bloom);
    if (!choices_are_known(o))
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "a render option has a value that its enumeration lacks");
    if (o->parts & ~all)
        return log_fail(log, AG_ERROR_ARGUMENT, "parts %#x of a picture's light are not known",
                        o->parts & ~all);
    if (o->light.id > scene->lights_count)
        return log_fail(log, AG_ERROR_ARGUMENT, "light %u is not one of the scene's %zu",
                        o->light.id, scene->lights_count);
    if (!o->parts)
        o->parts = all;
    return AG_OK;
}

rgb_matrix picture_exposure(const ag_render_options *o)
{
    rgb_matrix m = o->white_balance_k == 0
                       ? white_kept()
                       : white_balance(o->white_balance_k, o->white_balance_tint);
    m.red *= o->exposure;
    m.green *= o->exposure;
    m.blue *= o->exposure;
    return m;
}

ag_status picture_view(const ag_scene *scene, const ag_camera_desc *camera,
                       const ag_render_options *options, view *v)
{
    float min[3], max[3];
    bool visible = scene_bounds(scene, min, max);
    ag_camera_desc automatic;
    if (!camera) {
        ag_orbit orbit = ag_orbit_auto();
        automatic = ag_scene_frame(scene, &orbit, (float)options->width / (float)options->height);
        camera = &automatic;
    }
    if (!scene_camera_is_sound(camera))
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "the camera has a number that is not finite or out of its range");
    *v = view_make(camera, options->width, options->height, visible ? min : NULL, max);
    for (size_t i = 0; i < scene->lights_count; i++)
        if (light_is_seen(&scene->lights[i]))
            view_include(v, camera, scene->lights[i].position, light_reach(&scene->lights[i]));
    return AG_OK;
}
