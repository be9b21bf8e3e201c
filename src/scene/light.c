// Punctual lights with their defaults filled in.
#include "base/array.h"
#include "base/log.h"
#include "scene/scene.h"
#include "scene/vector.h"

static const float half_pi = 1.57079632679f, quarter_pi = 0.785398163397f;

static bool numbers_are_sound(const ag_light_desc *desc)
{
    const float scalars[] = { desc->intensity, desc->range_m, desc->cone_inner_rad,
                              desc->cone_outer_rad };
    return all_finite(scalars, 4) && all_finite(desc->position, 3) &&
           all_finite(desc->direction, 3) && all_finite(desc->color, 3) && desc->intensity >= 0 &&
           desc->range_m >= 0 && desc->color[0] >= 0 && desc->color[1] >= 0 && desc->color[2] >= 0;
}

static void fill_defaults(ag_light_desc *desc)
{
    if (vec3_is_zero(vec3_from(desc->color)))
        desc->color[0] = desc->color[1] = desc->color[2] = 1.0f;
    vec3 direction = vec3_unit(vec3_from(desc->direction));
    if (vec3_is_zero(direction))
        direction = (vec3) { 0.0f, 0.0f, -1.0f };
    vec3_store(direction, desc->direction);
    if (desc->cone_outer_rad == 0.0f)
        desc->cone_outer_rad = quarter_pi;
}

static bool cone_is_sound(const ag_light_desc *desc)
{
    return desc->cone_inner_rad >= 0.0f && desc->cone_inner_rad < desc->cone_outer_rad &&
           desc->cone_outer_rad <= half_pi;
}

ag_status ag_scene_add_light(ag_scene *scene, const ag_light_desc *desc, ag_light *light)
{
    *light = (ag_light) { 0 };
    if ((unsigned)desc->kind > AG_LIGHT_DIRECTIONAL || !numbers_are_sound(desc))
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "A light has an unknown kind, a number that is not finite, or a negative "
                        "intensity, range or colour.");
    ag_light_desc made = *desc;
    fill_defaults(&made);
    if (made.kind == AG_LIGHT_SPOT && !cone_is_sound(&made))
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "A spot light's cone is %g to %g rad: it must be 0 <= inner < outer <= "
                        "pi/2.",
                        (double)made.cone_inner_rad, (double)made.cone_outer_rad);
    if (!array_reserve(&scene->lights, &scene->lights_capacity, scene->lights_count + 1,
                       sizeof *scene->lights))
        return log_fail(&scene->log, AG_ERROR_MEMORY, "There is no memory for a light.");
    scene->lights[scene->lights_count++] = made;
    light->id = (uint32_t)scene->lights_count;
    scene->revision++;
    return AG_OK;
}
