// What surrounds a scene.
#include "scene/environment.h"

#include "base/log.h"
#include "image/image.h"
#include "scene/scene.h"
#include "scene/vector.h"

#include <string.h>

// Radiance above this (the sun's disk has 1.6e9 nit) is cut, so that sums stay finite.
static const float brightest = 1e12f;

// Radiance that is negative or not a number becomes black.
static void mend_pixels(ag_image *image)
{
    float *value = image->pixels;
    size_t count = (size_t)image->width * image->height * 4;
    for (size_t i = 0; i < count; i++)
        value[i] = value[i] > 0.0f ? fminf(value[i], brightest) : 0.0f;
}

static ag_status copy_image(const ag_log *log, const ag_image *image, ag_image **copy)
{
    if (!image || image->format != AG_FORMAT_RGBA32F)
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "An environment needs an image of the format RGBA32F, as HDR and EXR files "
                        "give.");
    ag_image_desc desc = { .width = image->width,
                           .height = image->height,
                           .format = image->format,
                           .pixels = image->pixels };
    ag_status status = ag_image_create(log, &desc, copy);
    if (status == AG_OK)
        mend_pixels(*copy);
    return status;
}

ag_status ag_scene_set_environment(ag_scene *scene, const ag_environment_desc *desc)
{
    if ((unsigned)desc->kind > AG_ENVIRONMENT_NONE || !isfinite(desc->rotation_rad) ||
        !isfinite(desc->intensity) || desc->intensity < 0.0f)
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "An environment has an unknown kind, or a rotation or an intensity that is "
                        "negative or not finite.");
    ag_image *image = NULL;
    if (desc->kind == AG_ENVIRONMENT_IMAGE) {
        ag_status status = copy_image(&scene->log, desc->image, &image);
        if (status != AG_OK)
            return status;
    }
    if (image || scene->environment || desc->kind != scene->environment_kind)
        scene->environment_revision++;
    ag_image_destroy(scene->environment);
    scene->environment = image;
    scene->environment_kind = desc->kind;
    scene->environment_rotation_rad = desc->rotation_rad;
    scene->environment_intensity = desc->intensity == 0.0f ? 1.0f : desc->intensity;
    return AG_OK;
}

ag_status scene_environment_open(const ag_scene *scene, const ag_image **image)
{
    *image = scene->environment;
    if (scene->environment_kind == AG_ENVIRONMENT_IMAGE ||
        scene->environment_kind == AG_ENVIRONMENT_NONE)
        return AG_OK;
    ag_image *made = NULL;
    ag_status status = scene->environment_kind == AG_ENVIRONMENT_SKY
                           ? sky_create(&scene->log, &made)
                           : studio_create(&scene->log, &made);
    *image = made;
    return status;
}

void scene_environment_close(const ag_scene *scene, const ag_image *image)
{
    if (image != scene->environment)
        ag_image_destroy((ag_image *)(uintptr_t)image);
}
