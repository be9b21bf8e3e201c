// ARGAND_lights: the lights that no other extension has (docs/ARGAND_lights.md).
#include "scene/gltf.h"

#include <float.h>
#include <math.h>

static const float half_pi = 1.57079632679f;

static ag_status read_metres(const gltf_at *light, const char *key, float *metres)
{
    ag_status status = gltf_require(light, key);
    return status ? status : gltf_float_in(light, key, 0.0f, FLT_MAX, metres);
}

static ag_status read_tube(const gltf_at *light, ag_light_desc *desc)
{
    ag_status status = read_metres(light, "length", &desc->length_m);
    return status ? status : read_metres(light, "radius", &desc->radius_m);
}

static ag_status read_rect(const gltf_at *light, ag_light_desc *desc)
{
    ag_status status = read_metres(light, "width", &desc->width_m);
    return status ? status : read_metres(light, "height", &desc->height_m);
}

static ag_status read_ground(const gltf_at *light, ag_light_desc *desc)
{
    if (desc->color[0] == 0.0f && desc->color[1] == 0.0f && desc->color[2] == 0.0f)
        desc->color[0] = FLT_MIN; // all zero would come out white
    return gltf_floats_in(light, "groundColor", 3, 0.0f, FLT_MAX, desc->ground_color);
}

static ag_status read_term(const gltf_at *item, float term[3])
{
    if (!json_is_array(item->json) || gltf_length(item) != 3)
        return gltf_fail(item, AG_ERROR_FORMAT, "is not an array of 3 numbers");
    ag_status status = AG_OK;
    for (size_t c = 0; c < 3 && !status; c++) {
        gltf_at number = gltf_item(item, c);
        status = gltf_item_float(&number, &term[c]);
    }
    return status;
}

static ag_status read_terms(const gltf_at *light, ag_light_desc *desc)
{
    gltf_at terms;
    ag_status status = gltf_require(light, "terms");
    if (!status)
        status = gltf_array(light, "terms", &terms);
    if (status)
        return status;
    size_t count = gltf_length(&terms);
    if (count != 4 && count != 9)
        return gltf_fail(&terms, AG_ERROR_FORMAT, "has %zu items instead of 4 or 9", count);
    for (size_t i = 0; i < count && !status; i++) {
        gltf_at item = gltf_item(&terms, i);
        status = read_term(&item, desc->harmonics[i]);
    }
    return status;
}

static ag_status read_sizes(const gltf_at *light, ag_light_desc *desc)
{
    switch (desc->kind) {
    case AG_LIGHT_SPHERE:
    case AG_LIGHT_DISK: return read_metres(light, "radius", &desc->radius_m);
    case AG_LIGHT_RECT: return read_rect(light, desc);
    case AG_LIGHT_TUBE: return read_tube(light, desc);
    case AG_LIGHT_SUN:
        return gltf_float_in(light, "angularRadius", 0.0f, 0.9999f * half_pi,
                             &desc->angular_radius_rad);
    case AG_LIGHT_HEMISPHERIC: return read_ground(light, desc);
    case AG_LIGHT_HARMONICS: return read_terms(light, desc);
    default: return AG_OK;
    }
}

const gltf_light_kind gltf_light_argand_kinds[] = {
    { "sphere", AG_LIGHT_SPHERE },
    { "disk", AG_LIGHT_DISK },
    { "rect", AG_LIGHT_RECT },
    { "tube", AG_LIGHT_TUBE },
    { "sun", AG_LIGHT_SUN },
    { "ambient", AG_LIGHT_AMBIENT },
    { "hemispheric", AG_LIGHT_HEMISPHERIC },
    { "harmonics", AG_LIGHT_HARMONICS },
    { 0 },
};

ag_status gltf_light_read_argand(const gltf_at *light, ag_light_desc *desc)
{
    ag_status status = gltf_light_read_kind(light, gltf_light_argand_kinds, &desc->kind);
    if (!status)
        status = read_sizes(light, desc);
    if (!status && light_has_position(desc->kind))
        status = gltf_float_in(light, "range", 0.0f, FLT_MAX, &desc->range_m);
    return status ? status : gltf_bool(light, "hidden", &desc->hidden);
}
