// Materials (spec 3.9) with KHR_materials_unlit, _emissive_strength, _ior, _specular and
// _anisotropy, and uses of textures with KHR_texture_transform.
#include "scene/gltf.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

static ag_status read_transform(const gltf_at *info, uint64_t *uv_set, ag_texture_use *use)
{
    gltf_at transform;
    ag_status status = gltf_extension(info, "KHR_texture_transform", &transform);
    if (status || !transform.json)
        return status;
    status = gltf_floats(&transform, "offset", 2, use->offset);
    if (!status)
        status = gltf_float(&transform, "rotation", &use->rotation_rad);
    if (!status)
        status = gltf_floats(&transform, "scale", 2, use->scale);
    if (!status)
        status = gltf_uint(&transform, "texCoord", UINT32_MAX, uv_set);
    return status;
}

// The place of a texture use is handed back for the members that some have beside it.
static ag_status read_use(const gltf_at *object, const char *key, gltf_at *info,
                          ag_texture_use *use)
{
    gltf_file *file = object->file;
    uint32_t texture = GLTF_NONE;
    uint64_t uv_set = 0;
    ag_status status = gltf_object(object, key, info);
    if (status || !info->json)
        return status;
    use->scale[0] = use->scale[1] = 1.0f;
    status = gltf_require(info, "index");
    if (!status)
        status = gltf_index(info, "index", file->texture_count, "textures", &texture);
    if (!status)
        status = gltf_uint(info, "texCoord", UINT32_MAX, &uv_set);
    if (!status)
        status = read_transform(info, &uv_set, use);
    if (status)
        return status;
    if (uv_set > 1) {
        gltf_warn_once(info, GLTF_WARNED_UV,
                       "texCoord %llu is not supported, only 0 and 1; the texture is left out",
                       (unsigned long long)uv_set);
        return AG_OK;
    }
    use->uv_set = (uint32_t)uv_set;
    use->texture.id = texture + 1;
    file->textures[texture].used = true;
    return AG_OK;
}

static ag_status read_metallic_roughness(const gltf_at *at, ag_material_desc *desc)
{
    gltf_at pbr, info;
    ag_status status = gltf_object(at, "pbrMetallicRoughness", &pbr);
    if (status || !pbr.json)
        return status;
    status = gltf_floats_in(&pbr, "baseColorFactor", 4, 0.0f, 1.0f, desc->base_color);
    if (!status)
        status = gltf_float_in(&pbr, "metallicFactor", 0.0f, 1.0f, &desc->metallic);
    if (!status)
        status = gltf_float_in(&pbr, "roughnessFactor", 0.0f, 1.0f, &desc->roughness);
    if (!status)
        status = read_use(&pbr, "baseColorTexture", &info, &desc->base_color_texture);
    if (!status)
        status =
            read_use(&pbr, "metallicRoughnessTexture", &info, &desc->metallic_roughness_texture);
    return status;
}

static ag_status read_surface(const gltf_at *at, ag_material_desc *desc)
{
    gltf_at info;
    ag_status status = read_use(at, "normalTexture", &info, &desc->normal_texture);
    if (!status)
        status = gltf_float(&info, "scale", &desc->normal_scale);
    if (!status)
        status = read_use(at, "occlusionTexture", &info, &desc->occlusion_texture);
    if (!status)
        status = gltf_float_in(&info, "strength", 0.0f, 1.0f, &desc->occlusion_strength);
    if (!status)
        status = gltf_bool(at, "doubleSided", &desc->double_sided);
    return status;
}

static ag_status read_emission(const gltf_at *at, ag_material_desc *desc)
{
    gltf_at info, extension;
    float strength = 1.0f;
    ag_status status = read_use(at, "emissiveTexture", &info, &desc->emissive_texture);
    if (!status)
        status = gltf_floats_in(at, "emissiveFactor", 3, 0.0f, 1.0f, desc->emissive);
    if (!status)
        status = gltf_extension(at, "KHR_materials_emissive_strength", &extension);
    if (!status)
        status = gltf_float_in(&extension, "emissiveStrength", 0.0f, FLT_MAX, &strength);
    for (int i = 0; i < 3; i++)
        desc->emissive[i] *= strength;
    return status;
}

static ag_status read_alpha(const gltf_at *at, ag_material_desc *desc)
{
    gltf_at place = gltf_member(at, "alphaMode");
    const char *mode = "OPAQUE";
    ag_status status = gltf_string(at, "alphaMode", &mode);
    if (!status)
        status = gltf_float_in(at, "alphaCutoff", 0.0f, FLT_MAX, &desc->alpha_cutoff);
    if (status)
        return status;
    if (strcmp(mode, "OPAQUE") == 0)
        desc->alpha_mode = AG_ALPHA_OPAQUE;
    else if (strcmp(mode, "MASK") == 0)
        desc->alpha_mode = AG_ALPHA_MASK;
    else if (strcmp(mode, "BLEND") == 0)
        desc->alpha_mode = AG_ALPHA_BLEND;
    else
        return gltf_fail(&place, AG_ERROR_FORMAT, "\"%.20s\" is not OPAQUE, MASK or BLEND", mode);
    return AG_OK;
}

static ag_status read_dielectric(const gltf_at *at, ag_material_desc *desc)
{
    gltf_at ior, specular, info;
    ag_status status = gltf_extension(at, "KHR_materials_ior", &ior);
    if (!status)
        status = gltf_float_in(&ior, "ior", 0.0f, FLT_MAX, &desc->ior);
    if (!status && desc->ior > 0.0f && desc->ior < 1.0f) {
        gltf_warn_once(&ior, GLTF_WARNED_RANGE, "ior %g is taken as 1", (double)desc->ior);
        desc->ior = 1.0f;
    }
    if (!status)
        status = gltf_extension(at, "KHR_materials_specular", &specular);
    if (!status)
        status = gltf_float_in(&specular, "specularFactor", 0.0f, 1.0f, &desc->specular);
    if (!status)
        status = gltf_floats_in(&specular, "specularColorFactor", 3, 0.0f, FLT_MAX,
                                desc->specular_color);
    if (!status)
        status = read_use(&specular, "specularTexture", &info, &desc->specular_texture);
    if (!status)
        status = read_use(&specular, "specularColorTexture", &info, &desc->specular_color_texture);
    return status;
}

static ag_status read_anisotropy(const gltf_at *at, ag_material_desc *desc)
{
    gltf_at anisotropy;
    ag_status status = gltf_extension(at, "KHR_materials_anisotropy", &anisotropy);
    if (!status)
        status = gltf_float_in(&anisotropy, "anisotropyStrength", 0.0f, 1.0f, &desc->anisotropy);
    if (!status)
        status = gltf_float(&anisotropy, "anisotropyRotation", &desc->anisotropy_rotation_rad);
    if (!status && gltf_member(&anisotropy, "anisotropyTexture").json)
        gltf_warn_once(&anisotropy, GLTF_WARNED_ANISOTROPY,
                       "anisotropyTexture is not supported; the factors alone are used");
    return status;
}

static ag_status read_material(const gltf_at *at, ag_material_desc *desc)
{
    gltf_at unlit;
    *desc = ag_material_default();
    ag_status status = gltf_string(at, "name", &desc->name);
    if (!status)
        status = read_metallic_roughness(at, desc);
    if (!status)
        status = read_surface(at, desc);
    if (!status)
        status = read_emission(at, desc);
    if (!status)
        status = read_alpha(at, desc);
    if (!status)
        status = read_dielectric(at, desc);
    if (!status)
        status = read_anisotropy(at, desc);
    if (!status)
        status = gltf_material_read_argand(at, desc);
    if (!status)
        status = gltf_extension(at, "KHR_materials_unlit", &unlit);
    if (!status)
        desc->unlit = unlit.json != NULL;
    return status;
}

// Mark the materials of one mesh, each mesh once.
static ag_status mark_used(const gltf_at *mesh)
{
    gltf_file *file = mesh->file;
    gltf_at primitives;
    ag_status status = gltf_objects(mesh, "primitives", &primitives);
    for (size_t i = 0; !status && i < gltf_length(&primitives); i++) {
        gltf_at primitive = gltf_item(&primitives, i);
        uint32_t material = GLTF_NONE;
        status = gltf_index(&primitive, "material", file->material_count, "materials", &material);
        if (!status && material != GLTF_NONE)
            file->materials[material].used = true;
    }
    return status;
}

static ag_status mark_reached(gltf_file *file, const gltf_at *meshes)
{
    bool *seen = calloc(file->mesh_count + 1, sizeof *seen);
    ag_status status = seen ? AG_OK : gltf_no_memory(meshes);
    for (size_t i = 0; i < file->reached_count && !status; i++) {
        uint32_t mesh = file->nodes[file->reached[i]].mesh;
        if (mesh == GLTF_NONE || seen[mesh])
            continue;
        seen[mesh] = true;
        gltf_at at = gltf_item(meshes, mesh);
        status = mark_used(&at);
    }
    free(seen);
    return status;
}

ag_status gltf_materials_read(gltf_file *file)
{
    gltf_at root = gltf_root(file), materials, textures, meshes = gltf_member(&root, "meshes");
    ag_status status = gltf_objects(&root, "materials", &materials);
    if (!status)
        status = gltf_objects(&root, "textures", &textures);
    if (status)
        return status;
    file->materials = calloc(gltf_length(&materials) + 1, sizeof *file->materials);
    file->textures = calloc(gltf_length(&textures) + 1, sizeof *file->textures);
    if (!file->materials || !file->textures)
        return gltf_no_memory(&root);
    file->material_count = gltf_length(&materials);
    file->texture_count = gltf_length(&textures);
    status = mark_reached(file, &meshes);
    for (size_t i = 0; i < file->material_count && !status; i++) {
        gltf_at at = gltf_item(&materials, i);
        if (file->materials[i].used)
            status = read_material(&at, &file->materials[i].desc);
    }
    return status;
}

// Turn the file's texture indices into the scene's ids.
static void translate_textures(const gltf_file *file, ag_material_desc *desc)
{
    ag_texture_use *uses[MATERIAL_TEXTURES];
    material_textures(desc, uses);
    for (int i = 0; i < MATERIAL_TEXTURES; i++)
        if (uses[i]->texture.id)
            uses[i]->texture = file->textures[uses[i]->texture.id - 1].texture;
}

ag_status gltf_materials_add(gltf_file *file)
{
    ag_status status = AG_OK;
    for (size_t i = 0; i < file->material_count && !status; i++) {
        gltf_material *material = &file->materials[i];
        if (!material->used)
            continue;
        if (file->options.skip_images && material->desc.emissive_texture.texture.id)
            memset(material->desc.emissive, 0, sizeof material->desc.emissive);
        translate_textures(file, &material->desc);
        status = ag_scene_add_material(file->scene, &material->desc, &material->material);
    }
    return status;
}
