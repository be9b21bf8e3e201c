// The textures of a scene on the device.
#include "render/textures.h"

#include "base/array.h"
#include "base/log.h"
#include "image/image.h"
#include "render/texture_jobs.h"

#include "interop/scene.glsl"

#include <stdlib.h>

texture_kind textures_kind(const ag_material_desc *material, uint32_t slot)
{
    switch (slot) {
    case GPU_TEXTURE_BASE_COLOR:
        return material->alpha_mode == AG_ALPHA_OPAQUE ? TEXTURE_COLOR : TEXTURE_COLOR_ALPHA;
    case GPU_TEXTURE_METALLIC_ROUGHNESS: return TEXTURE_ROUGHNESS_METALLIC;
    case GPU_TEXTURE_NORMAL: return TEXTURE_NORMAL;
    case GPU_TEXTURE_OCCLUSION: return TEXTURE_OCCLUSION;
    case GPU_TEXTURE_SPECULAR: return TEXTURE_SPECULAR;
    default: return TEXTURE_COLOR;
    }
}

const ag_texture_use *textures_use(const ag_material_desc *material, uint32_t slot)
{
    const ag_texture_use *const uses[GPU_TEXTURE_COUNT] = {
        [GPU_TEXTURE_BASE_COLOR] = &material->base_color_texture,
        [GPU_TEXTURE_METALLIC_ROUGHNESS] = &material->metallic_roughness_texture,
        [GPU_TEXTURE_NORMAL] = &material->normal_texture,
        [GPU_TEXTURE_OCCLUSION] = &material->occlusion_texture,
        [GPU_TEXTURE_EMISSIVE] = &material->emissive_texture,
        [GPU_TEXTURE_SPECULAR] = &material->specular_texture,
        [GPU_TEXTURE_SPECULAR_COLOR] = &material->specular_color_texture,
    };
    return uses[slot];
}

// ---- Which image a texture has ---------------------------------------------

typedef struct image_key {
    const ag_image *image;
    uint32_t index;
} image_key;

static int by_address(const void *a, const void *b)
{
    const image_key *x = a, *y = b;
    return x->image < y->image ? -1 : x->image > y->image;
}

static ag_status index_images(const ag_scene *scene, textures *t)
{
    size_t images = scene->images_count, count = scene->textures_count;
    t->image_count = images;
    t->images = calloc(images * TEXTURE_KINDS + 1, sizeof *t->images);
    t->image_of = calloc(count + 1, sizeof *t->image_of);
    image_key *keys = calloc(images + 1, sizeof *keys);
    if (!t->images || !t->image_of || !keys) {
        free(keys);
        return log_fail(&scene->log, AG_ERROR_MEMORY, "no memory for %zu textures", count);
    }
    for (size_t i = 0; i < images; i++)
        keys[i] = (image_key) { scene->images[i], (uint32_t)i };
    qsort(keys, images, sizeof *keys, by_address);
    for (size_t i = 0; i < count; i++) {
        const image_key key = { scene->textures[i].image, 0 };
        const image_key *found = bsearch(&key, keys, images, sizeof *keys, by_address);
        t->image_of[i] = found->index; // a texture's image is always among the scene's
    }
    free(keys);
    return AG_OK;
}

// ---- Uploads -----------------------------------------------------------------

// One job for every image and every way that some material reads it, unless it is there already.
static size_t list_jobs(const ag_scene *scene, textures *t, texture_job *jobs, bool *seen)
{
    size_t count = 0;
    for (size_t m = 0; m < scene->materials_count; m++)
        for (uint32_t slot = 0; slot < GPU_TEXTURE_COUNT; slot++) {
            const ag_material_desc *material = &scene->materials[m];
            uint32_t id = textures_use(material, slot)->texture.id;
            if (!id)
                continue;
            texture_kind kind = textures_kind(material, slot);
            size_t place = t->image_of[id - 1] * (size_t)TEXTURE_KINDS + kind;
            if (!seen[place] && !t->images[place].image)
                jobs[count++] = (texture_job) { .image = scene->textures[id - 1].image,
                                                .target = &t->images[place],
                                                .kind = kind };
            seen[place] = true;
        }
    return count;
}

ag_status textures_complete(gpu_device *device, const ag_scene *scene, bool release,
                            gpu_upload *upload, textures *t)
{
    texture_job *jobs = calloc(t->image_count * TEXTURE_KINDS + 1, sizeof *jobs);
    bool *seen = calloc(t->image_count * TEXTURE_KINDS + 1, sizeof *seen);
    ag_status status = AG_OK;
    if (!jobs || !seen)
        status = log_fail(&device->log, AG_ERROR_MEMORY, "no memory to upload textures");
    if (!status) {
        size_t count = list_jobs(scene, t, jobs, seen);
        status = texture_jobs_run(device, upload, release, jobs, count);
    }
    free(jobs);
    free(seen);
    return status;
}

bool textures_at_hand(const ag_scene *scene, const textures *t)
{
    for (size_t m = 0; m < scene->materials_count; m++)
        for (uint32_t slot = 0; slot < GPU_TEXTURE_COUNT; slot++) {
            const ag_material_desc *material = &scene->materials[m];
            uint32_t id = textures_use(material, slot)->texture.id;
            if (!id)
                continue;
            texture_kind kind = textures_kind(material, slot);
            if (!t->images[t->image_of[id - 1] * (size_t)TEXTURE_KINDS + kind].image &&
                !scene->textures[id - 1].image->pixels)
                return false;
        }
    return true;
}

// An image of one texel.
static ag_status upload_texel(gpu_device *device, gpu_upload *upload, VkFormat format,
                              const void *texel, gpu_image *image)
{
    const gpu_image_desc desc = {
        .format = format,
        .width = 1,
        .height = 1,
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
    };
    ag_status status = gpu_image_create(device, &desc, image);
    if (status)
        return status;
    gpu_upload_image_begin(upload, image);
    status = gpu_upload_image_level(upload, image, 0, 0, 4, texel);
    gpu_upload_image_end(upload, image);
    return status;
}

static ag_status upload_stand_ins(gpu_device *device, gpu_upload *upload, textures *t)
{
    static const uint8_t white[4] = { 255, 255, 255, 255 };
    static const uint16_t flat[2] = { 0x3800, 0x3800 }; // .5, which no byte is
    ag_status status = upload_texel(device, upload, VK_FORMAT_R8G8B8A8_UNORM, white, &t->white);
    return status ? status : upload_texel(device, upload, VK_FORMAT_R16G16_SFLOAT, flat, &t->flat);
}

ag_status textures_create(gpu_device *device, const ag_scene *scene, bool release,
                          gpu_upload *upload, textures *t)
{
    *t = (textures) { 0 };
    ag_status status = index_images(scene, t);
    if (!status)
        status = upload_stand_ins(device, upload, t);
    return status ? status : textures_complete(device, scene, release, upload, t);
}

void textures_destroy(gpu_device *device, textures *t)
{
    for (size_t i = 0; i < t->image_count * TEXTURE_KINDS && t->images; i++)
        gpu_image_destroy(device, &t->images[i]);
    for (size_t i = 0; i < t->sampler_count; i++)
        vkDestroySampler(device->device, t->samplers[i], NULL);
    gpu_image_destroy(device, &t->white);
    gpu_image_destroy(device, &t->flat);
    free(t->images);
    free(t->image_of);
    free(t->samplers);
    free(t->sampler_descs);
    *t = (textures) { 0 };
}

// ---- Samplers ----------------------------------------------------------------

static VkSamplerAddressMode address_mode(ag_wrap wrap)
{
    switch (wrap) {
    case AG_WRAP_MIRROR: return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case AG_WRAP_CLAMP: return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    case AG_WRAP_REPEAT: break;
    }
    return VK_SAMPLER_ADDRESS_MODE_REPEAT;
}

static VkFilter filter_of(ag_filter filter)
{
    return filter == AG_FILTER_NEAREST ? VK_FILTER_NEAREST : VK_FILTER_LINEAR;
}

static bool same_sampling(const ag_texture_desc *a, const ag_texture_desc *b)
{
    return a->wrap_u == b->wrap_u && a->wrap_v == b->wrap_v && a->mag == b->mag &&
           a->min == b->min && a->mip == b->mip && a->no_mips == b->no_mips;
}

static ag_status sampler_for(gpu_device *device, textures *t, const ag_texture_desc *desc,
                             VkSampler *sampler)
{
    for (size_t i = 0; i < t->sampler_count; i++)
        if (same_sampling(&t->sampler_descs[i], desc)) {
            *sampler = t->samplers[i];
            return AG_OK;
        }
    size_t wanted = t->sampler_count + 1;
    if (!array_reserve(&t->samplers, &t->sampler_capacity, wanted, sizeof *t->samplers) ||
        !array_reserve(&t->sampler_descs, &t->sampler_desc_capacity, wanted,
                       sizeof *t->sampler_descs))
        return log_fail(&device->log, AG_ERROR_MEMORY, "no memory for a sampler");
    bool smooth = desc->min == AG_FILTER_LINEAR && desc->mag == AG_FILTER_LINEAR && !desc->no_mips;
    // Two levels cost a CPU device twice the time, for a difference that the comparison with
    // path tracers does not show (docs/measured.md).
    bool blend_mips = desc->mip == AG_FILTER_LINEAR && device->info.kind != AG_DEVICE_CPU;
    const VkSamplerCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
        .magFilter = filter_of(desc->mag),
        .minFilter = filter_of(desc->min),
        .mipmapMode = blend_mips ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST,
        .addressModeU = address_mode(desc->wrap_u),
        .addressModeV = address_mode(desc->wrap_v),
        .addressModeW = VK_SAMPLER_ADDRESS_MODE_REPEAT,
        .anisotropyEnable = smooth && device->anisotropy > 1.0f,
        .maxAnisotropy = device->anisotropy,
        // .25 keeps the minification filter apart from the magnification filter where
        // there are no mips: Vulkan 1.3, VkSamplerCreateInfo, note on OpenGL's filters.
        .maxLod = desc->no_mips ? 0.25f : VK_LOD_CLAMP_NONE,
    };
    ag_status status =
        gpu_check(device, vkCreateSampler(device->device, &info, NULL, sampler), "vkCreateSampler");
    if (status)
        return status;
    t->samplers[t->sampler_count] = *sampler;
    t->sampler_descs[t->sampler_count++] = *desc;
    return AG_OK;
}

ag_status textures_bind(gpu_device *device, textures *t, const ag_scene *scene,
                        const ag_texture_use *use, texture_kind kind, VkImageView *view,
                        VkSampler *sampler)
{
    const ag_texture_desc plain = { 0 };
    if (!use->texture.id) {
        *view = kind == TEXTURE_NORMAL ? t->flat.view : t->white.view;
        return sampler_for(device, t, &plain, sampler);
    }
    size_t texture = use->texture.id - 1;
    *view = t->images[t->image_of[texture] * (size_t)TEXTURE_KINDS + kind].view;
    return sampler_for(device, t, &scene->textures[texture].desc, sampler);
}
