// KHR_lights_punctual: a light shines along its node's -Z; scale does not touch it.
#include "scene/gltf.h"

#include <float.h>
#include <string.h>

static const float half_pi = 1.57079632679f;

static ag_status read_cone(const gltf_at *light, ag_light_desc *desc)
{
    gltf_at spot;
    desc->cone_outer_rad = 0.5f * half_pi;
    ag_status status = gltf_object(light, "spot", &spot);
    if (!status)
        status = gltf_float_in(&spot, "outerConeAngle", 1e-3f, half_pi, &desc->cone_outer_rad);
    if (!status)
        status = gltf_float_in(&spot, "innerConeAngle", 0.0f, 0.999f * desc->cone_outer_rad,
                               &desc->cone_inner_rad);
    return status;
}

static ag_status read_kind(const gltf_at *light, ag_light_desc *desc)
{
    gltf_at at = gltf_member(light, "type");
    const char *type = "";
    ag_status status = gltf_require(light, "type");
    if (!status)
        status = gltf_string(light, "type", &type);
    if (status)
        return status;
    if (strcmp(type, "point") == 0)
        desc->kind = AG_LIGHT_POINT;
    else if (strcmp(type, "directional") == 0)
        desc->kind = AG_LIGHT_DIRECTIONAL;
    else if (strcmp(type, "spot") == 0)
        desc->kind = AG_LIGHT_SPOT;
    else
        return gltf_fail(&at, AG_ERROR_FORMAT, "\"%.20s\" is not a kind of light", type);
    return desc->kind == AG_LIGHT_SPOT ? read_cone(light, desc) : AG_OK;
}

static ag_status read_light(const gltf_at *light, ag_light_desc *desc)
{
    ag_status status = read_kind(light, desc);
    if (!status)
        status = gltf_floats_in(light, "color", 3, 0.0f, FLT_MAX, desc->color);
    if (!status)
        status = gltf_float_in(light, "intensity", 0.0f, FLT_MAX, &desc->intensity);
    if (!status && desc->kind != AG_LIGHT_DIRECTIONAL)
        status = gltf_float_in(light, "range", 0.0f, FLT_MAX, &desc->range_m);
    return status;
}

ag_status gltf_light_add(gltf_file *file, uint32_t node)
{
    gltf_at root = gltf_root(file), extension, lights;
    ag_status status = gltf_extension(&root, "KHR_lights_punctual", &extension);
    if (!status)
        status = gltf_objects(&extension, "lights", &lights);
    if (status)
        return status;
    gltf_at at = gltf_item(&lights, file->nodes[node].light);
    ag_light_desc desc = { .color = { 1.0f, 1.0f, 1.0f }, .intensity = 1.0f };
    status = read_light(&at, &desc);
    // A black light would come out white: zero stands for the default there.
    if (status || (desc.color[0] == 0.0f && desc.color[1] == 0.0f && desc.color[2] == 0.0f))
        return status;
    const double *world = file->nodes[node].world;
    for (int i = 0; i < 3; i++) {
        desc.position[i] = (float)world[12 + i];
        desc.direction[i] = -(float)world[8 + i];
    }
    ag_light light;
    return ag_scene_add_light(file->scene, &desc, &light);
}
