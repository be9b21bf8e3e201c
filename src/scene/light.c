// Lights with their defaults filled in.
#include "base/array.h"
#include "base/log.h"
#include "scene/scene.h"
#include "scene/vector.h"

static const float half_pi = 1.57079632679f, quarter_pi = 0.785398163397f;
static const float sun_radius_rad = 0.00465f; // as seen from the Earth

// ---- What is allowed ---------------------------------------------------------

static bool all_at_least_0(const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!(values[i] >= 0))
            return false;
    return all_finite(values, count);
}

static bool numbers_are_sound(const ag_light_desc *d)
{
    const float sizes[] = { d->intensity, d->range_m,  d->radius_m,          d->width_m,
                            d->height_m,  d->length_m, d->angular_radius_rad };
    const float cone[] = { d->cone_inner_rad, d->cone_outer_rad };
    return all_at_least_0(sizes, 7) && all_finite(cone, 2) && all_finite(d->position, 3) &&
           all_finite(d->direction, 3) && all_finite(d->up, 3) && all_at_least_0(d->color, 3) &&
           all_at_least_0(d->ground_color, 3) && all_finite(&d->harmonics[0][0], 27);
}

static bool cone_is_sound(const ag_light_desc *desc)
{
    return desc->cone_inner_rad >= 0.0f && desc->cone_inner_rad < desc->cone_outer_rad &&
           desc->cone_outer_rad <= half_pi;
}

static ag_status check_angles(const ag_scene *scene, const ag_light_desc *d)
{
    if (d->kind == AG_LIGHT_SPOT && !cone_is_sound(d))
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "A spot light's cone is %g to %g rad: it must be 0 <= inner < outer <= "
                        "pi/2.",
                        (double)d->cone_inner_rad, (double)d->cone_outer_rad);
    if (d->kind == AG_LIGHT_SUN && d->angular_radius_rad >= half_pi)
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "A sun's angular radius is %g rad: it must be below pi/2.",
                        (double)d->angular_radius_rad);
    return AG_OK;
}

// ---- Defaults ----------------------------------------------------------------

static vec3 default_direction(ag_light_kind kind)
{
    switch (kind) {
    case AG_LIGHT_TUBE: return (vec3) { 1.0f, 0.0f, 0.0f };
    case AG_LIGHT_HEMISPHERIC: return (vec3) { 0.0f, 1.0f, 0.0f };
    default: return (vec3) { 0.0f, 0.0f, -1.0f };
    }
}

// `up` square to the direction, kept where it is to a float's precision; any such where it has
// no part of that kind.
static vec3 square_up(vec3 direction, vec3 up)
{
    if (vec3_is_zero(up))
        up = (vec3) { 0.0f, 1.0f, 0.0f };
    up = vec3_unit(up);
    float part = vec3_dot(up, direction);
    if (fabsf(part) <= 4.0f * FLT_EPSILON)
        return up;
    up = vec3_unit(vec3_sub(up, vec3_scale(direction, part)));
    return vec3_is_zero(up) ? vec3_perpendicular(direction) : up;
}

void light_square_up(const float direction[3], const float up[3], float square[3])
{
    vec3_store(square_up(vec3_from(direction), vec3_from(up)), square);
}

static void fill_defaults(ag_light_desc *d)
{
    if (vec3_is_zero(vec3_from(d->color)))
        d->color[0] = d->color[1] = d->color[2] = 1.0f;
    vec3 direction = vec3_unit(vec3_from(d->direction));
    if (vec3_is_zero(direction))
        direction = default_direction(d->kind);
    vec3_store(direction, d->direction);
    light_square_up(d->direction, d->up, d->up);
    if (d->cone_outer_rad == 0.0f)
        d->cone_outer_rad = quarter_pi;
    if (d->angular_radius_rad == 0.0f)
        d->angular_radius_rad = sun_radius_rad;
}

// ---- Lights ------------------------------------------------------------------

// `*place` becomes what `desc` says, or stays as it is.
static ag_status make(const ag_scene *scene, const ag_light_desc *desc, ag_light_desc *place)
{
    if ((unsigned)desc->kind > AG_LIGHT_HARMONICS || !numbers_are_sound(desc))
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "A light has an unknown kind, a number that is not finite, or a negative "
                        "intensity, range, size or colour.");
    ag_light_desc made = *desc;
    fill_defaults(&made);
    ag_status status = check_angles(scene, &made);
    if (status)
        return status;
    made.name = place->name;
    if (!name_set(&made.name, desc->name))
        return log_fail(&scene->log, AG_ERROR_MEMORY, "There is no memory for a light's name.");
    *place = made;
    return AG_OK;
}

ag_status ag_scene_add_light(ag_scene *scene, const ag_light_desc *desc, ag_light *light)
{
    *light = (ag_light) { 0 };
    ag_light_desc made = { 0 };
    if (!array_reserve(&scene->lights, &scene->lights_capacity, scene->lights_count + 1,
                       sizeof *scene->lights))
        return log_fail(&scene->log, AG_ERROR_MEMORY, "There is no memory for a light.");
    ag_status status = make(scene, desc, &made);
    if (status)
        return status;
    scene->lights[scene->lights_count++] = made;
    light->id = (uint32_t)scene->lights_count;
    return AG_OK;
}

ag_status ag_scene_set_light(ag_scene *scene, ag_light light, const ag_light_desc *desc)
{
    if (light.id == 0 || light.id > scene->lights_count)
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "Light %u is to be changed: the scene has 1 to %zu.", light.id,
                        scene->lights_count);
    return make(scene, desc, &scene->lights[light.id - 1]);
}

bool ag_scene_light(const ag_scene *scene, size_t index, ag_light_desc *desc)
{
    if (index >= scene->lights_count)
        return false;
    *desc = scene->lights[index];
    return true;
}

// Order l is scaled by A_l / pi: 1, 2/3, 1/4; the rest is the basis' own factor.
void ag_light_harmonics(const float radiance[9][3], float harmonics[9][3])
{
    const float y0 = 0.28209479f, y1 = 0.48860251f * 2.0f / 3.0f, y2 = 1.09254843f / 4.0f;
    const float y20 = 0.31539157f / 4.0f, y22 = 0.54627422f / 4.0f;
    // Where 1, x, y, z, xy, yz, 3z^2 - 1, xz, x^2 - y^2 stand in the other order.
    const int from[9] = { 0, 3, 1, 2, 4, 5, 6, 7, 8 };
    const float scale[9] = { y0, y1, y1, y1, y2, y2, y20, y2, y22 };
    for (int i = 0; i < 9; i++)
        for (int c = 0; c < 3; c++)
            harmonics[i][c] = scale[i] * radiance[from[i]][c];
}

bool light_has_position(ag_light_kind kind)
{
    switch (kind) {
    case AG_LIGHT_POINT:
    case AG_LIGHT_SPOT:
    case AG_LIGHT_SPHERE:
    case AG_LIGHT_DISK:
    case AG_LIGHT_RECT:
    case AG_LIGHT_TUBE: return true;
    default: return false;
    }
}

bool light_is_ambient(ag_light_kind kind)
{
    return kind >= AG_LIGHT_AMBIENT;
}

float light_reach(const ag_light_desc *d)
{
    switch (d->kind) {
    case AG_LIGHT_SPHERE:
    case AG_LIGHT_DISK: return d->radius_m;
    case AG_LIGHT_RECT: return 0.5f * hypotf(d->width_m, d->height_m);
    case AG_LIGHT_TUBE: return 0.5f * d->length_m + d->radius_m;
    default: return 0.0f;
    }
}

float light_spread(const ag_light_desc *d)
{
    const float pi = 3.14159265f;
    float sine;
    switch (d->kind) {
    case AG_LIGHT_SPHERE: return pi * d->radius_m * d->radius_m;
    case AG_LIGHT_SUN: sine = sinf(d->angular_radius_rad); return pi * sine * sine;
    case AG_LIGHT_DISK:
    case AG_LIGHT_RECT:
    case AG_LIGHT_TUBE: return 1.0f;
    default: return 0.0f;
    }
}

void light_axes(const ag_light_desc *d, float x[3], float y[3])
{
    vec3 to = vec3_from(d->direction), up = vec3_from(d->up);
    float half_x = d->radius_m, half_y = d->radius_m;
    if (d->kind == AG_LIGHT_RECT) {
        half_x = 0.5f * d->width_m;
        half_y = 0.5f * d->height_m;
    }
    vec3_store(vec3_scale(vec3_cross(up, to), half_x), x);
    vec3_store(vec3_scale(up, half_y), y);
    if (d->kind == AG_LIGHT_TUBE)
        vec3_store(vec3_scale(to, 0.5f * d->length_m), x);
}

bool light_is_seen(const ag_light_desc *d)
{
    return light_reach(d) > 0.0f && !d->hidden;
}
