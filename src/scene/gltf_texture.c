// Textures and samplers (spec 3.8.2, 3.8.4), with EXT_texture_webp.
#include "scene/gltf.h"

#include <stdlib.h>
#include <string.h>

static ag_status read_wrap(const gltf_at *sampler, const char *key, ag_wrap *wrap)
{
    gltf_at at = gltf_member(sampler, key);
    uint64_t value = GLTF_REPEAT;
    ag_status status = gltf_uint(sampler, key, UINT32_MAX, &value);
    if (status)
        return status;
    switch (value) {
    case GLTF_REPEAT: *wrap = AG_WRAP_REPEAT; return AG_OK;
    case GLTF_MIRRORED_REPEAT: *wrap = AG_WRAP_MIRROR; return AG_OK;
    case GLTF_CLAMP_TO_EDGE: *wrap = AG_WRAP_CLAMP; return AG_OK;
    default:
        return gltf_fail(&at, AG_ERROR_FORMAT, "%llu is not a wrapping mode",
                         (unsigned long long)value);
    }
}

static ag_status read_mag(const gltf_at *sampler, ag_texture_desc *desc)
{
    gltf_at at = gltf_member(sampler, "magFilter");
    uint64_t value = GLTF_LINEAR;
    ag_status status = gltf_uint(sampler, "magFilter", UINT32_MAX, &value);
    if (!status && value != GLTF_LINEAR && value != GLTF_NEAREST)
        return gltf_fail(&at, AG_ERROR_FORMAT, "%llu is not a magnification filter",
                         (unsigned long long)value);
    desc->mag = value == GLTF_NEAREST ? AG_FILTER_NEAREST : AG_FILTER_LINEAR;
    return status;
}

static ag_status read_min(const gltf_at *sampler, ag_texture_desc *desc)
{
    gltf_at at = gltf_member(sampler, "minFilter");
    uint64_t value = GLTF_LINEAR_MIPMAP_LINEAR;
    ag_status status = gltf_uint(sampler, "minFilter", UINT32_MAX, &value);
    if (status)
        return status;
    bool mips = value >= GLTF_NEAREST_MIPMAP_NEAREST && value <= GLTF_LINEAR_MIPMAP_LINEAR;
    if (!mips && value != GLTF_NEAREST && value != GLTF_LINEAR)
        return gltf_fail(&at, AG_ERROR_FORMAT, "%llu is not a minification filter",
                         (unsigned long long)value);
    bool near = value == GLTF_NEAREST || value == GLTF_NEAREST_MIPMAP_NEAREST ||
                value == GLTF_NEAREST_MIPMAP_LINEAR;
    bool mip_near = value == GLTF_NEAREST_MIPMAP_NEAREST || value == GLTF_LINEAR_MIPMAP_NEAREST;
    desc->min = near ? AG_FILTER_NEAREST : AG_FILTER_LINEAR;
    desc->mip = mip_near ? AG_FILTER_NEAREST : AG_FILTER_LINEAR;
    desc->no_mips = !mips;
    return AG_OK;
}

static ag_status read_sampler(const gltf_at *texture, const gltf_at *samplers,
                              ag_texture_desc *desc)
{
    uint32_t index = GLTF_NONE;
    ag_status status = gltf_index(texture, "sampler", gltf_length(samplers), "samplers", &index);
    if (status || index == GLTF_NONE)
        return status;
    gltf_at sampler = gltf_item(samplers, index);
    status = read_wrap(&sampler, "wrapS", &desc->wrap_u);
    if (!status)
        status = read_wrap(&sampler, "wrapT", &desc->wrap_v);
    if (!status)
        status = read_mag(&sampler, desc);
    return status ? status : read_min(&sampler, desc);
}

static ag_status read_texture(const gltf_at *at, const gltf_at *samplers, gltf_texture *texture)
{
    gltf_file *file = at->file;
    gltf_at webp;
    texture->image = GLTF_NONE;
    ag_status status = read_sampler(at, samplers, &texture->desc);
    if (!status)
        status = gltf_index(at, "source", file->image_count, "images", &texture->image);
    if (!status)
        status = gltf_extension(at, "EXT_texture_webp", &webp);
    if (!status)
        status = gltf_index(&webp, "source", file->image_count, "images", &texture->image);
    if (status)
        return status;
    if (texture->image == GLTF_NONE)
        gltf_warn_once(at, GLTF_WARNED_IMAGE, "has no image that can be read; it is left out");
    else
        file->images[texture->image].used = true;
    return AG_OK;
}

ag_status gltf_textures_read(gltf_file *file)
{
    gltf_at root = gltf_root(file), textures = gltf_member(&root, "textures"), samplers, images;
    ag_status status = gltf_objects(&root, "samplers", &samplers);
    if (!status)
        status = gltf_objects(&root, "images", &images);
    if (status)
        return status;
    file->images = calloc(gltf_length(&images) + 1, sizeof *file->images);
    if (!file->images)
        return gltf_no_memory(&images);
    file->image_count = gltf_length(&images);
    for (size_t i = 0; i < file->texture_count && !status; i++) {
        gltf_at at = gltf_item(&textures, i);
        if (file->textures[i].used)
            status = read_texture(&at, &samplers, &file->textures[i]);
    }
    return status;
}

ag_status gltf_textures_add(gltf_file *file)
{
    ag_status status = AG_OK;
    for (size_t i = 0; i < file->texture_count && !status; i++) {
        gltf_texture *texture = &file->textures[i];
        if (!texture->used || texture->image == GLTF_NONE)
            continue;
        gltf_image *image = &file->images[file->images[texture->image].same];
        image->adopted = true; // taken over even on failure
        status = scene_adopt_texture(file->scene, image->image, &texture->desc, &texture->texture);
    }
    return status;
}
