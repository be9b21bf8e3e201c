// Lights: KHR_lights_punctual, and what the three extensions that hold lights share.
//
// A light shines along its node's -Z; a tube lies along its X, a hemisphere's colour is at its
// Y.  Scale touches the size of EXT_lights_area only.
#include "scene/gltf.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const float half_pi = 1.57079632679f;

// ---- KHR_lights_punctual ---------------------------------------------------------

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

// A size of `extras`, which are free for all: what cannot be meant is ignored.
static float extra_size(const gltf_at *light, const char *key, float below)
{
    gltf_at extras = gltf_member(light, "extras"), at = gltf_member(&extras, key);
    if (!at.json)
        return 0.0f;
    double value = json_is_number(at.json) ? json_number_value(at.json) : -1.0;
    if (value >= 0.0 && (float)value < below)
        return (float)value;
    gltf_warn_once(&at, GLTF_WARNED_EXTRAS, "is no size that a light can have; it is ignored");
    return 0.0f;
}

// Sizes that the extension has no word for: a sphere's in metres, a sun's in radians.
static void read_size(const gltf_at *light, ag_light_desc *desc)
{
    bool is_directional = desc->kind == AG_LIGHT_DIRECTIONAL;
    float size = is_directional ? extra_size(light, "angularRadius", half_pi)
                                : extra_size(light, "radius", FLT_MAX);
    if (size == 0.0f)
        return;
    if (desc->kind == AG_LIGHT_SPOT) {
        gltf_warn_once(light, GLTF_WARNED_SPOT, "a spot light has no radius; it is ignored");
        return;
    }
    desc->kind = is_directional ? AG_LIGHT_SUN : AG_LIGHT_SPHERE;
    *(is_directional ? &desc->angular_radius_rad : &desc->radius_m) = size;
}

static ag_status read_punctual(const gltf_at *light, ag_light_desc *desc)
{
    static const gltf_light_kind kinds[] = { { "point", AG_LIGHT_POINT },
                                             { "directional", AG_LIGHT_DIRECTIONAL },
                                             { "spot", AG_LIGHT_SPOT },
                                             { 0 } };
    ag_status status = gltf_light_read_kind(light, kinds, &desc->kind);
    if (!status && desc->kind == AG_LIGHT_SPOT)
        status = read_cone(light, desc);
    if (!status && desc->kind != AG_LIGHT_DIRECTIONAL)
        status = gltf_float_in(light, "range", 0.0f, FLT_MAX, &desc->range_m);
    if (!status)
        read_size(light, desc);
    return status;
}

// ---- What the extensions share ---------------------------------------------------

ag_status gltf_light_read_kind(const gltf_at *light, const gltf_light_kind *kinds,
                               ag_light_kind *kind)
{
    gltf_at at = gltf_member(light, "type");
    const char *type = "";
    ag_status status = gltf_require(light, "type");
    if (!status)
        status = gltf_string(light, "type", &type);
    if (status)
        return status;
    for (; kinds->type; kinds++)
        if (strcmp(kinds->type, type) == 0) {
            *kind = kinds->kind;
            return AG_OK;
        }
    return gltf_fail(&at, AG_ERROR_FORMAT, "\"%.20s\" is not a kind of light", type);
}

typedef struct light_extension {
    const char *name;
    float intensity; // where the file gives none
    ag_status (*read)(const gltf_at *light, ag_light_desc *desc);
} light_extension;

static const light_extension extensions[GLTF_LIGHT_EXTENSIONS] = {
    [GLTF_LIGHT_PUNCTUAL] = { "KHR_lights_punctual", 1.0f, read_punctual },
    [GLTF_LIGHT_AREA] = { "EXT_lights_area", 1000.0f, gltf_light_read_area },
    [GLTF_LIGHT_ARGAND] = { "ARGAND_lights", 1.0f, gltf_light_read_argand },
};

ag_status gltf_lights_count(gltf_file *file)
{
    gltf_at root = gltf_root(file), extension, lights;
    ag_status status = AG_OK;
    for (int i = 0; i < GLTF_LIGHT_EXTENSIONS && !status; i++) {
        status = gltf_extension(&root, extensions[i].name, &extension);
        if (!status)
            status = gltf_objects(&extension, "lights", &lights);
        if (!status)
            file->light_count[i] = gltf_length(&lights);
    }
    return status;
}

ag_status gltf_lights_of_node(const gltf_at *at, gltf_node *node)
{
    gltf_at extension;
    ag_status status = AG_OK;
    for (int i = 0; i < GLTF_LIGHT_EXTENSIONS && !status; i++) {
        node->light[i] = GLTF_NONE;
        status = gltf_extension(at, extensions[i].name, &extension);
        if (!status)
            status = gltf_index(&extension, "light", at->file->light_count[i], "lights",
                                &node->light[i]);
    }
    return status;
}

// The unit vector of a column of `world`, `sign` times; zero where it has no length.  One that is
// unit to a float's precision is kept, so that what was written is read back.
static void take_axis(const double world[16], int column, double sign, float out[3])
{
    const double *axis = &world[4 * column];
    double square = axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2];
    double length = fabs(square - 1.0) <= (double)FLT_EPSILON ? 1.0 : sqrt(square);
    for (int i = 0; i < 3 && length > 0.0; i++)
        out[i] = (float)(sign * axis[i] / length);
}

static double largest_scale(const double world[16])
{
    double square = 0.0;
    for (int c = 0; c < 3; c++) {
        const double *axis = &world[4 * c];
        square = fmax(square, axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    }
    return sqrt(square);
}

// Sizes of ARGAND_lights are metres whatever the scale; those of EXT_lights_area grow with it.
static void place(const double world[16], bool grows, ag_light_desc *desc)
{
    for (int i = 0; i < 3; i++)
        desc->position[i] = (float)world[12 + i];
    switch (desc->kind) {
    case AG_LIGHT_TUBE: take_axis(world, 0, 1.0, desc->direction); break;
    case AG_LIGHT_HEMISPHERIC: take_axis(world, 1, 1.0, desc->direction); break;
    default: take_axis(world, 2, -1.0, desc->direction);
    }
    if (desc->kind != AG_LIGHT_RECT && desc->kind != AG_LIGHT_DISK)
        return;
    take_axis(world, 1, 1.0, desc->up);
    if (!grows)
        return;
    float *const sizes[] = { &desc->radius_m, &desc->width_m, &desc->height_m };
    for (int i = 0; i < 3; i++)
        *sizes[i] = (float)fmin((double)*sizes[i] * largest_scale(world), (double)FLT_MAX);
}

static bool is_black(const float color[3])
{
    return color[0] == 0.0f && color[1] == 0.0f && color[2] == 0.0f;
}

static ag_status add_light(gltf_file *file, uint32_t node, int which)
{
    const light_extension *e = &extensions[which];
    gltf_at root = gltf_root(file), extension;
    ag_status status = gltf_extension(&root, e->name, &extension);
    if (status)
        return status;
    gltf_at lights = gltf_member(&extension, "lights");
    gltf_at at = gltf_item(&lights, file->nodes[node].light[which]);
    gltf_at nodes = gltf_member(&root, "nodes"), node_at = gltf_item(&nodes, node);
    ag_light_desc desc = { .color = { 1.0f, 1.0f, 1.0f }, .intensity = e->intensity };
    status = gltf_string(&node_at, "name", &desc.name);
    if (!status)
        status = gltf_string(&at, "name", &desc.name);
    if (!status)
        status = gltf_floats_in(&at, "color", 3, 0.0f, FLT_MAX, desc.color);
    if (!status)
        status = gltf_float_in(&at, "intensity", 0.0f, FLT_MAX, &desc.intensity);
    if (!status)
        status = e->read(&at, &desc);
    // A black light would come out white: zero stands for the default there.
    if (status || is_black(desc.color))
        return status;
    place(file->nodes[node].world, which == GLTF_LIGHT_AREA, &desc);
    ag_light light;
    return ag_scene_add_light(file->scene, &desc, &light);
}

ag_status gltf_lights_add(gltf_file *file, uint32_t node)
{
    const uint32_t *light = file->nodes[node].light;
    ag_status status = AG_OK;
    // Beside one of Argand's own the others are for those who cannot read it.
    if (light[GLTF_LIGHT_ARGAND] != GLTF_NONE)
        return add_light(file, node, GLTF_LIGHT_ARGAND);
    for (int i = 0; i < GLTF_LIGHT_EXTENSIONS && !status; i++)
        if (light[i] != GLTF_NONE)
            status = add_light(file, node, i);
    return status;
}
