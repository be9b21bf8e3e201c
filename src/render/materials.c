// The materials of a scene on the device: a descriptor set each.
#include "render/materials.h"

#include "base/log.h"
#include "physics/surface.glsl"

#include <math.h>
#include <stdlib.h>

static uint32_t textures_of(const ag_material_desc *material)
{
    uint32_t bits = 0;
    for (uint32_t slot = 0; slot < GPU_TEXTURE_COUNT; slot++)
        if (textures_use(material, slot)->texture.id)
            bits |= 1u << slot;
    return bits;
}

static bool is_plain(const ag_texture_use *use)
{
    bool unscaled =
        (use->scale[0] == 0 && use->scale[1] == 0) || (use->scale[0] == 1 && use->scale[1] == 1);
    return use->uv_set == 0 && unscaled && use->rotation_rad == 0 && use->offset[0] == 0 &&
           use->offset[1] == 0;
}

static bool needs_general_uv(const ag_material_desc *material)
{
    for (uint32_t slot = 0; slot < GPU_TEXTURE_COUNT; slot++) {
        const ag_texture_use *use = textures_use(material, slot);
        if (use->texture.id && !is_plain(use))
            return true;
    }
    return false;
}

static uint32_t alpha_mode(ag_alpha_mode mode)
{
    switch (mode) {
    case AG_ALPHA_MASK: return GPU_ALPHA_MASK;
    case AG_ALPHA_BLEND: return GPU_ALPHA_BLEND;
    case AG_ALPHA_OPAQUE: break;
    }
    return GPU_ALPHA_OPAQUE;
}

void materials_classify(const ag_scene *scene, gpu_surface_constants *constants)
{
    uint32_t first[3][2][2][SURFACE_MODELS] = { 0 }; // of its class, from 1; [alpha mode][unlit]
                                                     // [has textures][model]
    for (int pass = 0; pass < 2; pass++)             // first gather, then hand out
        for (size_t i = 0; i < scene->materials_count; i++) {
            const ag_material_desc *material = &scene->materials[i];
            uint32_t bits = textures_of(material), mode = alpha_mode(material->alpha_mode);
            if (material->unlit)
                bits &= 1u << GPU_TEXTURE_BASE_COLOR;
            uint32_t model = material->unlit ? 0 : material_model(material);
            uint32_t *head = &first[mode][material->unlit][bits != 0][model];
            if (!*head) {
                *head = (uint32_t)i + 1;
                constants[i] = (gpu_surface_constants) { 0 };
            }
            gpu_surface_constants *all = &constants[*head - 1];
            all->textures |= bits;
            all->general_uv |= needs_general_uv(material);
            all->alpha_mode = mode;
            all->unlit = material->unlit;
            all->model = model;
            if (pass == 1)
                constants[i] = *all;
        }
}

// KHR_texture_transform: translation * rotation * scale, v pointing down.
static void set_transform(const ag_texture_use *use, uint32_t slot, gpu_material *out)
{
    bool unscaled = use->scale[0] == 0 && use->scale[1] == 0;
    float x = unscaled ? 1 : use->scale[0], y = unscaled ? 1 : use->scale[1];
    float c = cosf(use->rotation_rad), s = sinf(use->rotation_rad);
    out->uv_u[slot] = (float3) { c * x, s * y, use->offset[0] };
    out->uv_v[slot] = (float3) { -s * x, c * y, use->offset[1] };
    out->uv1 |= use->uv_set ? 1u << slot : 0;
}

static gpu_material pack(const ag_material_desc *d)
{
    gpu_material m = {
        .base_color = { d->base_color[0], d->base_color[1], d->base_color[2], d->base_color[3] },
        .emissive = { d->emissive[0], d->emissive[1], d->emissive[2] },
        .metallic = d->metallic,
        .specular_color = { d->specular_color[0], d->specular_color[1], d->specular_color[2] },
        .specular = d->specular,
        .roughness = d->roughness,
        .dielectric_f0 = fresnel_f0_dielectric(d->ior),
        .normal_scale = d->normal_scale,
        .occlusion_strength = d->occlusion_strength,
        .alpha_cutoff = d->alpha_cutoff,
        .anisotropy = d->anisotropy,
        .anisotropy_direction = { cosf(d->anisotropy_rotation_rad),
                                  sinf(d->anisotropy_rotation_rad) },
        .diffuse_roughness = d->diffuse_roughness,
        .shininess = d->shininess,
        .reflectiveness = d->reflectiveness,
        .conductor_n = { d->conductor_n[0], d->conductor_n[1], d->conductor_n[2] },
        .conductor_k = { d->conductor_k[0], d->conductor_k[1], d->conductor_k[2] },
        .f82_tint = { d->f82_tint[0], d->f82_tint[1], d->f82_tint[2] },
    };
    for (uint32_t slot = 0; slot < GPU_TEXTURE_COUNT; slot++)
        set_transform(textures_use(d, slot), slot, &m);
    return m;
}

static ag_status create_pool(gpu_device *device, uint32_t count, materials *m)
{
    const VkDescriptorPoolSize sizes[] = {
        { VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, count },
        { VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, count * GPU_TEXTURE_COUNT },
    };
    const VkDescriptorPoolCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = count,
        .poolSizeCount = 2,
        .pPoolSizes = sizes,
    };
    return gpu_check(device, vkCreateDescriptorPool(device->device, &info, NULL, &m->pool),
                     "vkCreateDescriptorPool");
}

static ag_status fill_set(gpu_device *device, const ag_scene *scene, textures *t, size_t index,
                          VkDeviceSize stride, materials *m)
{
    const ag_material_desc *desc = &scene->materials[index];
    gpu_material *packed = (gpu_material *)((char *)m->uniforms.memory.mapped + stride * index);
    *packed = pack(desc);
    bindings_write_buffer(device, m->sets[index], 0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
                          m->uniforms.buffer, stride * index, sizeof(gpu_material));
    for (uint32_t slot = 0; slot < GPU_TEXTURE_COUNT; slot++) {
        VkImageView view;
        VkSampler sampler;
        ag_status status = textures_bind(device, t, scene, textures_use(desc, slot),
                                         textures_kind(desc, slot), &view, &sampler);
        if (status)
            return status;
        bindings_write_image(device, m->sets[index], 1 + slot, view, sampler);
    }
    return AG_OK;
}

ag_status materials_create(gpu_device *device, const bindings *b, const ag_scene *scene,
                           textures *t, materials *m)
{
    *m = (materials) { 0 };
    uint32_t count = (uint32_t)scene->materials_count;
    VkDeviceSize align = device->limits.minUniformBufferOffsetAlignment;
    VkDeviceSize stride = (sizeof(gpu_material) + align - 1) / align * align;
    m->sets = calloc(count, sizeof *m->sets);
    m->constants = calloc(count, sizeof *m->constants);
    if (!m->sets || !m->constants) {
        materials_destroy(device, m);
        return log_fail(&device->log, AG_ERROR_MEMORY, "no memory for %u materials", count);
    }
    materials_classify(scene, m->constants);
    ag_status status = gpu_buffer_create(device, stride * count, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                         GPU_MEMORY_UPLOAD, &m->uniforms);
    if (!status)
        status = create_pool(device, count, m);
    for (uint32_t i = 0; i < count && !status; i++) {
        const VkDescriptorSetAllocateInfo info = {
            .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
            .descriptorPool = m->pool,
            .descriptorSetCount = 1,
            .pSetLayouts = &b->material_set,
        };
        status = gpu_check(device, vkAllocateDescriptorSets(device->device, &info, &m->sets[i]),
                           "vkAllocateDescriptorSets");
        if (!status)
            status = fill_set(device, scene, t, i, stride, m);
    }
    if (status)
        materials_destroy(device, m);
    return status;
}

void materials_destroy(gpu_device *device, materials *m)
{
    gpu_buffer_destroy(device, &m->uniforms);
    vkDestroyDescriptorPool(device->device, m->pool, NULL);
    free(m->sets);
    free(m->constants);
    *m = (materials) { 0 };
}
