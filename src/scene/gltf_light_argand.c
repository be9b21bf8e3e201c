// ARGAND_lights: the lights that no other extension has, and the exposure
// (docs/ARGAND_lights.md).
#include <argand/eye.h>

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
    case AG_LIGHT_SPHERE: return read_metres(light, "radius", &desc->radius_m);
    case AG_LIGHT_TUBE: return read_tube(light, desc);
    case AG_LIGHT_SUN:
        return gltf_float_in(light, "angularRadius", 0.0f, 0.9999f * half_pi,
                             &desc->angular_radius_rad);
    case AG_LIGHT_HEMISPHERIC: return read_ground(light, desc);
    case AG_LIGHT_HARMONICS: return read_terms(light, desc);
    default: return AG_OK;
    }
}

ag_status gltf_light_read_argand(const gltf_at *light, ag_light_desc *desc)
{
    static const gltf_light_kind kinds[] = { { "sphere", AG_LIGHT_SPHERE },
                                             { "tube", AG_LIGHT_TUBE },
                                             { "sun", AG_LIGHT_SUN },
                                             { "ambient", AG_LIGHT_AMBIENT },
                                             { "hemispheric", AG_LIGHT_HEMISPHERIC },
                                             { "harmonics", AG_LIGHT_HARMONICS },
                                             { 0 } };
    ag_status status = gltf_light_read_kind(light, kinds, &desc->kind);
    if (!status)
        status = read_sizes(light, desc);
    if (!status && (desc->kind == AG_LIGHT_SPHERE || desc->kind == AG_LIGHT_TUBE))
        status = gltf_float_in(light, "range", 0.0f, FLT_MAX, &desc->range_m);
    return status ? status : gltf_bool(light, "hidden", &desc->hidden);
}

// `ev100` counts as a camera does: the luminance that saturates, 1.2 * 2^EV100, becomes 1
// (docs/physics.md).
ag_status gltf_exposure_read(gltf_file *file)
{
    gltf_at root = gltf_root(file), extension, exposure;
    float ev100 = 0.0f, factor = 1.0f;
    ag_status status = gltf_extension(&root, "ARGAND_lights", &extension);
    if (!status)
        status = gltf_object(&extension, "exposure", &exposure);
    if (status || !exposure.json)
        return status;
    bool in_ev = gltf_member(&exposure, "ev100").json,
         in_factor = gltf_member(&exposure, "factor").json;
    if (in_ev == in_factor)
        return gltf_fail(&exposure, AG_ERROR_FORMAT, "must have either ev100 or factor");
    status = gltf_float_in(&exposure, "ev100", -32.0f, 32.0f, &ev100);
    if (!status)
        status = gltf_float_in(&exposure, "factor", 1e-30f, 1e30f, &factor);
    if (status)
        return status;
    return ag_scene_set_exposure(file->scene, in_ev ? ag_exposure_from_ev100(ev100) : factor);
}
