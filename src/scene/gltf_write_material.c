// Materials on their way into a .glb: the words of glTF and its extensions where they have
// them, ARGAND_materials for the rest.
#include "scene/gltf_write.h"

#include <math.h>
#include <string.h>

static const float ones[4] = { 1, 1, 1, 1 }, zeros[3] = { 0 };

// ---- Which are shown ---------------------------------------------------------------------

static void choose_textures(gltf_writer *w, const ag_material_desc *desc)
{
    ag_material_desc copy = *desc;
    ag_texture_use *uses[MATERIAL_TEXTURES];
    material_textures(&copy, uses);
    for (int i = 0; i < MATERIAL_TEXTURES; i++)
        if (uses[i]->texture.id)
            w->textures[uses[i]->texture.id - 1] = 0;
}

// Give those that are not left out their indices, in rising order.
static void number(uint32_t *indices, size_t count)
{
    uint32_t next = 0;
    for (size_t i = 0; i < count; i++)
        if (indices[i] != GLTF_NONE)
            indices[i] = next++;
}

void gltf_write_choose(gltf_writer *w)
{
    const ag_scene *scene = w->scene;
    for (size_t i = 0; i < scene->materials_count; i++)
        w->materials[i] = GLTF_NONE;
    for (size_t i = 0; i < scene->textures_count; i++)
        w->textures[i] = GLTF_NONE;
    for (size_t i = 0; i < scene->instances_count; i++) {
        const scene_instance *instance = &scene->instances[i];
        const ag_material_desc *desc = &scene->materials[instance->material];
        if (!gltf_write_shows(instance))
            continue;
        if (desc->normal_texture.texture.id || desc->anisotropy > 0.0f)
            w->tangents[instance->mesh] = true;
        if (instance->material && w->materials[instance->material] == GLTF_NONE) {
            w->materials[instance->material] = 0;
            choose_textures(w, desc);
        }
    }
    number(w->materials, scene->materials_count);
    number(w->textures, scene->textures_count);
}

// ---- One material ------------------------------------------------------------------------

static void put_transform(gltf_writer *w, json_t *info, const ag_texture_use *use)
{
    if (use->offset[0] == 0.0f && use->offset[1] == 0.0f && use->rotation_rad == 0.0f &&
        use->scale[0] == 1.0f && use->scale[1] == 1.0f)
        return;
    json_t *transform = gltf_put_extension(w, info, "KHR_texture_transform");
    gltf_put_floats_unless(w, transform, "offset", use->offset, 2, zeros);
    gltf_put_float_unless(w, transform, "rotation", use->rotation_rad, 0.0f);
    gltf_put_floats_unless(w, transform, "scale", use->scale, 2, ones);
}

// The texture info, for what stands beside it; NULL where there is none.
static json_t *put_use(gltf_writer *w, json_t *object, const char *key, const ag_texture_use *use)
{
    if (!use->texture.id)
        return NULL;
    json_t *info = gltf_put_object(w, object, key);
    gltf_put_index(w, info, "index", w->textures[use->texture.id - 1]);
    if (use->uv_set)
        gltf_put_index(w, info, "texCoord", use->uv_set);
    put_transform(w, info, use);
    return info;
}

static void put_metallic_roughness(gltf_writer *w, json_t *material, const ag_material_desc *d)
{
    json_t *pbr = json_object();
    gltf_put_floats_unless(w, pbr, "baseColorFactor", d->base_color, 4, ones);
    put_use(w, pbr, "baseColorTexture", &d->base_color_texture);
    gltf_put_float_unless(w, pbr, "metallicFactor", d->metallic, 1.0f);
    gltf_put_float_unless(w, pbr, "roughnessFactor", d->roughness, 1.0f);
    put_use(w, pbr, "metallicRoughnessTexture", &d->metallic_roughness_texture);
    gltf_put_unless_empty(w, material, "pbrMetallicRoughness", pbr);
}

static void put_surface(gltf_writer *w, json_t *material, const ag_material_desc *d)
{
    json_t *info = put_use(w, material, "normalTexture", &d->normal_texture);
    if (info)
        gltf_put_float_unless(w, info, "scale", d->normal_scale, 1.0f);
    info = put_use(w, material, "occlusionTexture", &d->occlusion_texture);
    if (info)
        gltf_put_float_unless(w, info, "strength", d->occlusion_strength, 1.0f);
    if (d->double_sided)
        gltf_put_true(w, material, "doubleSided");
}

// A factor is at most 1.  As the strength is a power of two, their product is exact.
static void put_emission(gltf_writer *w, json_t *material, const ag_material_desc *d)
{
    float most = fmaxf(fmaxf(d->emissive[0], d->emissive[1]), d->emissive[2]);
    int exponent = 0;
    if (most > 1.0f) {
        float fraction = frexpf(most, &exponent);
        exponent -= fraction == 0.5f; // a power of two itself
        exponent = exponent < 127 ? exponent : 127;
    }
    const float factor[3] = { fminf(ldexpf(d->emissive[0], -exponent), 1.0f),
                              fminf(ldexpf(d->emissive[1], -exponent), 1.0f),
                              fminf(ldexpf(d->emissive[2], -exponent), 1.0f) };
    put_use(w, material, "emissiveTexture", &d->emissive_texture);
    gltf_put_floats_unless(w, material, "emissiveFactor", factor, 3, zeros);
    if (exponent)
        gltf_put_float(w, gltf_put_extension(w, material, "KHR_materials_emissive_strength"),
                       "emissiveStrength", ldexpf(1.0f, exponent));
}

static void put_alpha(gltf_writer *w, json_t *material, const ag_material_desc *d)
{
    static const char *const modes[] = { "OPAQUE", "MASK", "BLEND" };
    if (d->alpha_mode != AG_ALPHA_OPAQUE || d->alpha_cutoff != 0.5f)
        gltf_put_word(w, material, "alphaMode", modes[d->alpha_mode]);
    gltf_put_float_unless(w, material, "alphaCutoff", d->alpha_cutoff, 0.5f);
}

static void put_dielectric(gltf_writer *w, json_t *material, const ag_material_desc *d)
{
    if (d->ior != 1.5f)
        gltf_put_float(w, gltf_put_extension(w, material, "KHR_materials_ior"), "ior", d->ior);
    json_t *specular = json_object();
    gltf_put_float_unless(w, specular, "specularFactor", d->specular, 1.0f);
    gltf_put_floats_unless(w, specular, "specularColorFactor", d->specular_color, 3, ones);
    put_use(w, specular, "specularTexture", &d->specular_texture);
    put_use(w, specular, "specularColorTexture", &d->specular_color_texture);
    gltf_put_extension_unless_empty(w, material, "KHR_materials_specular", specular);
}

static void put_anisotropy(gltf_writer *w, json_t *material, const ag_material_desc *d)
{
    if (d->anisotropy == 0.0f && d->anisotropy_rotation_rad == 0.0f)
        return;
    json_t *anisotropy = gltf_put_extension(w, material, "KHR_materials_anisotropy");
    gltf_put_float_unless(w, anisotropy, "anisotropyStrength", d->anisotropy, 0.0f);
    gltf_put_float_unless(w, anisotropy, "anisotropyRotation", d->anisotropy_rotation_rad, 0.0f);
}

static void write_material(gltf_writer *w, const ag_material_desc *d)
{
    json_t *material = json_object();
    gltf_append(w, w->root, "materials", material);
    gltf_put_name(w, material, d->name);
    put_metallic_roughness(w, material, d);
    put_surface(w, material, d);
    put_emission(w, material, d);
    put_alpha(w, material, d);
    put_dielectric(w, material, d);
    put_anisotropy(w, material, d);
    if (d->unlit)
        gltf_put_extension(w, material, "KHR_materials_unlit");
    gltf_material_write_argand(w, material, d);
}

void gltf_write_materials(gltf_writer *w)
{
    for (size_t i = 0; i < w->scene->materials_count; i++)
        if (w->materials[i] != GLTF_NONE)
            write_material(w, &w->scene->materials[i]);
}
