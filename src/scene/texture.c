// Textures: an image and how it is sampled.
#include "base/array.h"
#include "base/log.h"
#include "image/image.h"
#include "scene/scene.h"

static bool holds_image(const ag_scene *scene, const ag_image *image)
{
    for (size_t i = 0; i < scene->images_count; i++)
        if (scene->images[i] == image)
            return true;
    return false;
}

static bool wrap_known(ag_wrap wrap)
{
    return (unsigned)wrap <= AG_WRAP_CLAMP;
}

static bool filter_known(ag_filter filter)
{
    return (unsigned)filter <= AG_FILTER_NEAREST;
}

static ag_status check(const ag_scene *scene, const ag_image *image, const ag_texture_desc *desc)
{
    if (!image || image->format != AG_FORMAT_RGBA8)
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "A texture needs an image of the format RGBA8.");
    if (!wrap_known(desc->wrap_u) || !wrap_known(desc->wrap_v) || !filter_known(desc->mag) ||
        !filter_known(desc->min) || !filter_known(desc->mip))
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "A texture's wrap or filter is none of the listed ones.");
    return AG_OK;
}

static bool reserve(ag_scene *scene)
{
    return array_reserve(&scene->images, &scene->images_capacity, scene->images_count + 1,
                         sizeof(ag_image *)) &&
           array_reserve(&scene->textures, &scene->textures_capacity, scene->textures_count + 1,
                         sizeof *scene->textures);
}

ag_status scene_adopt_texture(ag_scene *scene, ag_image *image, const ag_texture_desc *desc,
                              ag_texture *texture)
{
    *texture = (ag_texture) { 0 };
    bool held = holds_image(scene, image);
    ag_status status = check(scene, image, desc);
    if (status == AG_OK && !reserve(scene))
        status = log_fail(&scene->log, AG_ERROR_MEMORY, "There is no memory for a texture.");
    if (status != AG_OK) {
        if (!held)
            ag_image_destroy(image);
        return status;
    }
    if (!held)
        scene->images[scene->images_count++] = image;
    scene_texture *made = &scene->textures[scene->textures_count++];
    *made = (scene_texture) { .image = image, .desc = *desc };
    made->desc.image = NULL;
    texture->id = (uint32_t)scene->textures_count;
    scene->revision++;
    return AG_OK;
}

ag_status ag_scene_add_texture(ag_scene *scene, const ag_texture_desc *desc, ag_texture *texture)
{
    *texture = (ag_texture) { 0 };
    ag_status status = check(scene, desc->image, desc);
    if (status != AG_OK)
        return status;
    ag_image *copy;
    ag_image_desc image = { .width = desc->image->width,
                            .height = desc->image->height,
                            .format = desc->image->format,
                            .pixels = desc->image->pixels };
    status = ag_image_create(&scene->log, &image, &copy);
    return status == AG_OK ? scene_adopt_texture(scene, copy, desc, texture) : status;
}
