// Lights on their way into a .glb: KHR_lights_punctual for what it has words for,
// ARGAND_lights for the rest, beside which there stands what comes near for other readers.
#include "scene/gltf_write.h"
#include "scene/vector.h"

#include <math.h>

static const float ones[3] = { 1, 1, 1 };

// ---- Its node ----------------------------------------------------------------------------

static void put_column(float world[16], int column, vec3 v)
{
    vec3_store(v, world + 4 * column);
}

// As gltf_light.c reads it: along -Z, a tube along X, a hemisphere's colour at Y.
static json_t *write_node(gltf_writer *w, const ag_light_desc *d)
{
    float world[16] = { [0] = 1, [5] = 1, [10] = 1, [15] = 1 };
    static const float none[3] = { 0 };
    bool has_up = d->kind == AG_LIGHT_RECT || d->kind == AG_LIGHT_DISK;
    float square[3]; // of most kinds `up` says nothing
    light_square_up(d->direction, has_up ? d->up : none, square);
    vec3 direction = vec3_from(d->direction), up = vec3_from(square);
    switch (d->kind) {
    case AG_LIGHT_POINT:
    case AG_LIGHT_SPHERE:
    case AG_LIGHT_AMBIENT:
    case AG_LIGHT_HARMONICS: break;
    case AG_LIGHT_TUBE:
        put_column(world, 0, direction);
        put_column(world, 1, up);
        put_column(world, 2, vec3_cross(direction, up));
        break;
    case AG_LIGHT_HEMISPHERIC:
        put_column(world, 0, vec3_cross(direction, up));
        put_column(world, 1, direction);
        put_column(world, 2, up);
        break;
    default:
        put_column(world, 0, vec3_cross(direction, up));
        put_column(world, 1, up);
        put_column(world, 2, vec3_scale(direction, -1.0f));
    }
    put_column(world, 3, vec3_from(d->position));
    return gltf_write_node(w, world, d->name);
}

static void put_light(gltf_writer *w, json_t *node, const char *extension, json_t *light)
{
    json_t *list = gltf_put_extension(w, w->root, extension);
    gltf_put_index(w, gltf_put_extension(w, node, extension), "light",
                   gltf_append(w, list, "lights", light));
}

// ---- KHR_lights_punctual -----------------------------------------------------------------

static void put_cone(gltf_writer *w, json_t *light, float inner, float outer)
{
    const float right_angle = 1.57079632f; // written out it is not above pi/2
    json_t *spot = gltf_put_object(w, light, "spot");
    gltf_put_float(w, spot, "innerConeAngle", inner);
    if (outer < right_angle)
        gltf_put_float(w, spot, "outerConeAngle", outer);
    else
        gltf_put(w, spot, "outerConeAngle", json_real(1.57079632));
}

// Weights are at most 1 there: what is above goes into the intensity, by a power of two.
static void put_strength(gltf_writer *w, json_t *light, const float color[3], float intensity)
{
    int exponent = 0;
    float most = fmaxf(fmaxf(color[0], color[1]), color[2]), weights[3];
    if (most > 1.0f)
        frexpf(most, &exponent);
    for (int i = 0; i < 3; i++)
        weights[i] = ldexpf(color[i], -exponent);
    gltf_put_floats_unless(w, light, "color", weights, 3, ones);
    gltf_put_float(w, light, "intensity", ldexpf(intensity, exponent));
}

// The mean over all directions of what a tube sends: its radiance times a quarter of its
// surface (Cauchy).
static float tube_intensity(const ag_light_desc *d)
{
    const float pi = 3.14159265f;
    return d->intensity * pi * d->radius_m * (0.5f * d->length_m + d->radius_m);
}

static void put_punctual(gltf_writer *w, json_t *node, const ag_light_desc *d)
{
    static const char *const words[] = {
        [AG_LIGHT_POINT] = "point",
        [AG_LIGHT_SPOT] = "spot",
        [AG_LIGHT_DIRECTIONAL] = "directional",
        [AG_LIGHT_SUN] = "directional",
        [AG_LIGHT_SPHERE] = "point",
        [AG_LIGHT_DISK] = "spot",
        [AG_LIGHT_RECT] = "spot",
        [AG_LIGHT_TUBE] = "point",
    };
    const float half_pi = 1.57079632679f, pi = 3.14159265f;
    float intensity = d->intensity;
    json_t *light = json_object();
    gltf_put_word(w, light, "type", words[d->kind]);
    if (d->kind == AG_LIGHT_SPOT)
        put_cone(w, light, d->cone_inner_rad, d->cone_outer_rad);
    if (d->kind == AG_LIGHT_RECT || d->kind == AG_LIGHT_DISK)
        put_cone(w, light, 0.0f, half_pi);
    if (d->kind == AG_LIGHT_RECT)
        intensity *= d->width_m * d->height_m;
    if (d->kind == AG_LIGHT_DISK)
        intensity *= pi * d->radius_m * d->radius_m;
    if (d->kind == AG_LIGHT_TUBE)
        intensity = tube_intensity(d);
    put_strength(w, light, d->color, intensity);
    if (light_has_position(d->kind))
        gltf_put_float_unless(w, light, "range", d->range_m, 0.0f);
    put_light(w, node, "KHR_lights_punctual", light);
}

// ---- ARGAND_lights -----------------------------------------------------------------------

static void put_terms(gltf_writer *w, json_t *light, const float harmonics[9][3])
{
    json_t *terms = json_array();
    for (int i = 0; i < 9; i++)
        if (json_array_append_new(terms, gltf_numbers(w, harmonics[i], 3)) != 0)
            w->no_memory = true;
    gltf_put(w, light, "terms", terms);
}

static void put_sizes(gltf_writer *w, json_t *light, const ag_light_desc *d)
{
    static const float black[3] = { 0 };
    switch (d->kind) {
    case AG_LIGHT_RECT:
        gltf_put_float(w, light, "width", d->width_m);
        gltf_put_float(w, light, "height", d->height_m);
        break;
    case AG_LIGHT_TUBE:
        gltf_put_float(w, light, "length", d->length_m);
        gltf_put_float(w, light, "radius", d->radius_m);
        break;
    case AG_LIGHT_SPHERE:
    case AG_LIGHT_DISK: gltf_put_float(w, light, "radius", d->radius_m); break;
    case AG_LIGHT_SUN: gltf_put_float(w, light, "angularRadius", d->angular_radius_rad); break;
    case AG_LIGHT_HEMISPHERIC:
        gltf_put_floats_unless(w, light, "groundColor", d->ground_color, 3, black);
        break;
    case AG_LIGHT_HARMONICS: put_terms(w, light, d->harmonics); break;
    default: break;
    }
}

static void put_argand(gltf_writer *w, json_t *node, const ag_light_desc *d)
{
    const gltf_light_kind *word = gltf_light_argand_kinds;
    while (word->kind != d->kind)
        word++;
    json_t *light = json_object();
    gltf_put_word(w, light, "type", word->type);
    gltf_put_floats_unless(w, light, "color", d->color, 3, ones);
    gltf_put_float(w, light, "intensity", d->intensity);
    put_sizes(w, light, d);
    if (light_has_position(d->kind))
        gltf_put_float_unless(w, light, "range", d->range_m, 0.0f);
    if (d->hidden && !light_is_ambient(d->kind))
        gltf_put_true(w, light, "hidden");
    put_light(w, node, "ARGAND_lights", light);
}

void gltf_write_lights(gltf_writer *w)
{
    for (size_t i = 0; i < w->scene->lights_count; i++) {
        const ag_light_desc *d = &w->scene->lights[i];
        json_t *node = write_node(w, d);
        if (d->kind > AG_LIGHT_DIRECTIONAL)
            put_argand(w, node, d);
        if (!light_is_ambient(d->kind))
            put_punctual(w, node, d);
    }
}
