// The textures of a scene on the device.
#include "render/textures.h"

#include "base/array.h"
#include "base/log.h"
#include "base/threads.h"
#include "image/image.h"
#include "image/mip.h"
#include "interop/scene.glsl"

#include <stdlib.h>

texture_kind textures_kind(uint32_t slot)
{
    switch (slot) {
    case GPU_TEXTURE_BASE_COLOR:
    case GPU_TEXTURE_EMISSIVE:
    case GPU_TEXTURE_SPECULAR_COLOR: return TEXTURE_COLOR;
    case GPU_TEXTURE_NORMAL: return TEXTURE_NORMAL;
    default: return TEXTURE_DATA;
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

typedef struct upload_job {
    const ag_image *image;
    gpu_image *target;
    texture_kind kind;
    void *mips; // levels 1 and below, one after another; made on worker threads
} upload_job;

static void make_mips(void *context, size_t index)
{
    static const image_mip_kind kinds[] = {
        [TEXTURE_COLOR] = IMAGE_MIP_SRGB,
        [TEXTURE_DATA] = IMAGE_MIP_LINEAR,
        [TEXTURE_NORMAL] = IMAGE_MIP_NORMAL,
    };
    upload_job *job = (upload_job *)context + index;
    job->mips = image_mips(job->image, kinds[job->kind]);
}

static ag_status upload_one(gpu_device *device, gpu_upload *upload, const upload_job *job)
{
    const ag_image *image = job->image;
    const gpu_image_desc desc = {
        .format =
            job->kind == TEXTURE_COLOR ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM,
        .width = image->width,
        .height = image->height,
        .mips = image_mip_count(image->width, image->height),
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
    };
    if (!job->mips)
        return log_fail(&device->log, AG_ERROR_MEMORY, "no memory for the mips of a %ux%u texture",
                        image->width, image->height);
    if (image->width > device->info.max_size || image->height > device->info.max_size)
        return log_fail(&device->log, AG_ERROR_UNSUPPORTED,
                        "a texture of %ux%u pixels is more than the %u of %s", image->width,
                        image->height, device->info.max_size, device->info.name);
    ag_status status = gpu_image_create(device, &desc, job->target);
    if (status)
        return status;
    gpu_upload_image_begin(upload, job->target);
    status = gpu_upload_image_level(upload, job->target, 0, 0, 4, image->pixels);
    for (uint32_t mip = 1; mip < desc.mips && !status; mip++) {
        size_t offset = image_mip_offset(image->width, image->height, mip);
        status = gpu_upload_image_level(upload, job->target, mip, 0, 4, (char *)job->mips + offset);
    }
    gpu_upload_image_end(upload, job->target);
    return status;
}

// Mips of a few images at a time, on all cores, then into the device.
static ag_status upload_all(gpu_device *device, gpu_upload *upload, upload_job *jobs, size_t count)
{
    size_t batch = threads_available();
    ag_status status = AG_OK;
    for (size_t i = 0; i < count && !status; i += batch) {
        size_t n = count - i < batch ? count - i : batch;
        parallel_for(n, make_mips, jobs + i);
        for (size_t k = i; k < i + n; k++) {
            if (!status)
                status = upload_one(device, upload, &jobs[k]);
            free(jobs[k].mips);
        }
    }
    return status;
}

static ag_status upload_used(gpu_device *device, const ag_scene *scene, gpu_upload *upload,
                             textures *t)
{
    upload_job *jobs = calloc(t->image_count * TEXTURE_KINDS + 1, sizeof *jobs);
    bool *seen = calloc(t->image_count * TEXTURE_KINDS + 1, sizeof *seen);
    size_t count = 0;
    ag_status status = AG_OK;
    if (!jobs || !seen)
        status = log_fail(&device->log, AG_ERROR_MEMORY, "no memory to upload textures");
    for (size_t m = 0; m < scene->materials_count && !status; m++)
        for (uint32_t slot = 0; slot < GPU_TEXTURE_COUNT; slot++) {
            uint32_t id = textures_use(&scene->materials[m], slot)->texture.id;
            if (!id)
                continue;
            texture_kind kind = textures_kind(slot);
            size_t place = t->image_of[id - 1] * (size_t)TEXTURE_KINDS + kind;
            if (seen[place])
                continue;
            seen[place] = true;
            jobs[count++] =
                (upload_job) { scene->textures[id - 1].image, &t->images[place], kind, NULL };
        }
    if (!status)
        status = upload_all(device, upload, jobs, count);
    free(jobs);
    free(seen);
    return status;
}

static ag_status upload_white(gpu_device *device, gpu_upload *upload, textures *t)
{
    static const uint8_t white[4] = { 255, 255, 255, 255 };
    const gpu_image_desc desc = {
        .format = VK_FORMAT_R8G8B8A8_UNORM,
        .width = 1,
        .height = 1,
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
    };
    ag_status status = gpu_image_create(device, &desc, &t->white);
    if (status)
        return status;
    gpu_upload_image_begin(upload, &t->white);
    status = gpu_upload_image_level(upload, &t->white, 0, 0, 4, white);
    gpu_upload_image_end(upload, &t->white);
    return status;
}

ag_status textures_create(gpu_device *device, const ag_scene *scene, gpu_upload *upload,
                          textures *t)
{
    *t = (textures) { 0 };
    ag_status status = index_images(scene, t);
    if (!status)
        status = upload_white(device, upload, t);
    if (!status)
        status = upload_used(device, scene, upload, t);
    if (status)
        textures_destroy(device, t);
    return status;
}

void textures_destroy(gpu_device *device, textures *t)
{
    for (size_t i = 0; i < t->image_count * TEXTURE_KINDS && t->images; i++)
        gpu_image_destroy(device, &t->images[i]);
    for (size_t i = 0; i < t->sampler_count; i++)
        vkDestroySampler(device->device, t->samplers[i], NULL);
    gpu_image_destroy(device, &t->white);
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
    const VkSamplerCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
        .magFilter = filter_of(desc->mag),
        .minFilter = filter_of(desc->min),
        .mipmapMode = desc->mip == AG_FILTER_NEAREST ? VK_SAMPLER_MIPMAP_MODE_NEAREST
                                                     : VK_SAMPLER_MIPMAP_MODE_LINEAR,
        .addressModeU = address_mode(desc->wrap_u),
        .addressModeV = address_mode(desc->wrap_v),
        .addressModeW = VK_SAMPLER_ADDRESS_MODE_REPEAT,
        .anisotropyEnable = smooth && device->anisotropy > 1.0f,
        .maxAnisotropy = device->anisotropy,
        // .25 keeps the minification filter apart from the magnification filter where
        // there are no mips: Vulkan 1.3, VkSamplerCreateInfo, note on OpenGL's filters.
        .maxLod = desc->no_mips ? 0.25f : VK_LOD_CLAMP_NONE,
    };
    ag_status status = gpu_check(device, vkCreateSampler(device->device, &info, NULL, sampler),
                                 "vkCreateSampler");
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
        *view = t->white.view;
        return sampler_for(device, t, &plain, sampler);
    }
    size_t texture = use->texture.id - 1;
    *view = t->images[t->image_of[texture] * (size_t)TEXTURE_KINDS + kind].view;
    return sampler_for(device, t, &scene->textures[texture].desc, sampler);
}
