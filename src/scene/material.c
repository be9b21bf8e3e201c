// Materials, checked and clamped to their ranges.
#include "base/array.h"
#include "base/log.h"
#include "scene/scene.h"
#include "scene/vector.h"

ag_material_desc ag_material_default(void)
{
    return (ag_material_desc) {
        .base_color = { 1.0f, 1.0f, 1.0f, 1.0f },
        .metallic = 1.0f,
        .roughness = 1.0f,
        .normal_scale = 1.0f,
        .occlusion_strength = 1.0f,
        .ior = 1.5f,
        .specular = 1.0f,
        .specular_color = { 1.0f, 1.0f, 1.0f },
        .shininess = 100.0f,
        .conductor_n = { 1.0f, 1.0f, 1.0f },
        .conductor_k = { 5.0f, 5.0f, 5.0f },
        .f82_tint = { 1.0f, 1.0f, 1.0f },
        .reflectiveness = 0.5f,
        .alpha_cutoff = 0.5f,
    };
}

void material_textures(ag_material_desc *desc, ag_texture_use *uses[MATERIAL_TEXTURES])
{
    uses[0] = &desc->base_color_texture;
    uses[1] = &desc->metallic_roughness_texture;
    uses[2] = &desc->normal_texture;
    uses[3] = &desc->occlusion_texture;
    uses[4] = &desc->emissive_texture;
    uses[5] = &desc->specular_texture;
    uses[6] = &desc->specular_color_texture;
}

static bool use_is_sound(const ag_scene *scene, const ag_texture_use *use)
{
    return use->texture.id <= scene->textures_count && use->uv_set <= 1 &&
           all_finite(use->offset, 2) && all_finite(use->scale, 2) && isfinite(use->rotation_rad);
}

static bool numbers_are_finite(const ag_material_desc *desc)
{
    const float scalars[] = {
        desc->metallic,
        desc->roughness,
        desc->normal_scale,
        desc->occlusion_strength,
        desc->ior,
        desc->specular,
        desc->diffuse_roughness,
        desc->shininess,
        desc->anisotropy,
        desc->anisotropy_rotation_rad,
        desc->reflectiveness,
        desc->alpha_cutoff,
    };
    return all_finite(scalars, sizeof scalars / sizeof *scalars) &&
           all_finite(desc->base_color, 4) && all_finite(desc->emissive, 3) &&
           all_finite(desc->specular_color, 3) && all_finite(desc->conductor_n, 3) &&
           all_finite(desc->conductor_k, 3) && all_finite(desc->f82_tint, 3);
}

static bool choices_are_known(const ag_material_desc *desc)
{
    return (unsigned)desc->diffuse <= AG_DIFFUSE_EON &&
           (unsigned)desc->distribution <= AG_DISTRIBUTION_BLINN &&
           (unsigned)desc->shadowing <= AG_SHADOWING_SCHLICK &&
           (unsigned)desc->fresnel <= AG_FRESNEL_F82 &&
           (unsigned)desc->layering <= AG_LAYERING_BLEND;
}

static bool is_conductor(const ag_material_desc *desc)
{
    return desc->conductor_n[0] > 0.0f && desc->conductor_n[1] > 0.0f &&
           desc->conductor_n[2] > 0.0f;
}

static float clamp(float value, float low, float high)
{
    return fminf(fmaxf(value, low), high);
}

static float clamp01(float value)
{
    return clamp(value, 0.0f, 1.0f);
}

static void clamp_ranges(ag_material_desc *desc)
{
    for (int i = 0; i < 4; i++)
        desc->base_color[i] = clamp01(desc->base_color[i]);
    for (int i = 0; i < 3; i++) {
        desc->emissive[i] = fmaxf(desc->emissive[i], 0.0f);
        desc->specular_color[i] = fmaxf(desc->specular_color[i], 0.0f);
        desc->conductor_n[i] = clamp(desc->conductor_n[i], 1e-3f, 1e3f);
        desc->conductor_k[i] = clamp(desc->conductor_k[i], 0.0f, 1e3f);
        desc->f82_tint[i] = clamp01(desc->f82_tint[i]);
    }
    desc->metallic = clamp01(desc->metallic);
    desc->roughness = clamp01(desc->roughness);
    desc->occlusion_strength = clamp01(desc->occlusion_strength);
    desc->specular = clamp01(desc->specular);
    desc->diffuse_roughness =
        clamp(desc->diffuse_roughness, 0.0f, desc->diffuse == AG_DIFFUSE_EON ? 1.0f : 1.5707963f);
    desc->shininess = clamp(desc->shininess, 0.0f, 1e6f);
    desc->anisotropy = clamp01(desc->anisotropy);
    desc->reflectiveness = clamp01(desc->reflectiveness);
    desc->ior = desc->ior == 0.0f ? 0.0f : fmaxf(desc->ior, 1.0f);
    desc->alpha_cutoff = fmaxf(desc->alpha_cutoff, 0.0f);
}

static void default_scales(ag_material_desc *desc)
{
    ag_texture_use *uses[MATERIAL_TEXTURES];
    material_textures(desc, uses);
    for (int i = 0; i < MATERIAL_TEXTURES; i++)
        if (uses[i]->scale[0] == 0.0f && uses[i]->scale[1] == 0.0f)
            uses[i]->scale[0] = uses[i]->scale[1] = 1.0f;
}

static ag_status check(const ag_scene *scene, ag_material_desc *desc)
{
    if (!numbers_are_finite(desc))
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "A material's number is infinite or not a number.");
    if (!choices_are_known(desc))
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "A material's diffuse, distribution, shadowing, fresnel or layering is "
                        "none of the listed ones.");
    if (desc->fresnel == AG_FRESNEL_CONDUCTOR && !is_conductor(desc))
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "A material's conductor_n is not above 0: (%g %g %g).",
                        (double)desc->conductor_n[0], (double)desc->conductor_n[1],
                        (double)desc->conductor_n[2]);
    if ((unsigned)desc->alpha_mode > AG_ALPHA_BLEND)
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "A material's alpha mode is none of the listed ones.");
    ag_texture_use *uses[MATERIAL_TEXTURES];
    material_textures(desc, uses);
    for (int i = 0; i < MATERIAL_TEXTURES; i++)
        if (!use_is_sound(scene, uses[i]))
            return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                            "A material uses texture %u with uv set %u: the texture must be one of "
                            "the scene's %zu, the set 0 or 1, the transform finite.",
                            uses[i]->texture.id, uses[i]->uv_set, scene->textures_count);
    return AG_OK;
}

// `*place` becomes what `desc` says, or stays as it is.
static ag_status make(const ag_scene *scene, const ag_material_desc *desc, ag_material_desc *place)
{
    ag_material_desc made = *desc;
    ag_status status = check(scene, &made);
    if (status)
        return status;
    clamp_ranges(&made);
    default_scales(&made);
    made.name = place->name;
    if (!name_set(&made.name, desc->name))
        return log_fail(&scene->log, AG_ERROR_MEMORY, "There is no memory for a material's name.");
    *place = made;
    return AG_OK;
}

ag_status ag_scene_add_material(ag_scene *scene, const ag_material_desc *desc,
                                ag_material *material)
{
    *material = (ag_material) { 0 };
    ag_material_desc made = { 0 };
    if (!array_reserve(&scene->materials, &scene->materials_capacity, scene->materials_count + 1,
                       sizeof *scene->materials))
        return log_fail(&scene->log, AG_ERROR_MEMORY, "There is no memory for a material.");
    ag_status status = make(scene, desc, &made);
    if (status)
        return status;
    material->id = (uint32_t)scene->materials_count;
    scene->materials[scene->materials_count++] = made;
    scene->revision++;
    return AG_OK;
}

ag_status ag_scene_set_material(ag_scene *scene, ag_material material, const ag_material_desc *desc)
{
    if (material.id == 0 || material.id >= scene->materials_count)
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "Material %u is to be changed: the scene has 1 to %zu.", material.id,
                        scene->materials_count - 1);
    ag_status status = make(scene, desc, &scene->materials[material.id]);
    if (!status)
        scene->materials_revision++;
    return status;
}

bool ag_scene_material(const ag_scene *scene, size_t index, ag_material_desc *desc)
{
    if (index + 1 >= scene->materials_count)
        return false;
    *desc = scene->materials[index + 1];
    return true;
}
