// Images on their way into textures: mips and packing on all cores, then the upload.
#include "render/texture_jobs.h"

#include "base/log.h"
#include "base/pages.h"
#include "base/threads.h"
#include "image/image.h"
#include "image/mip.h"

#include <stdlib.h>

// How a kind of texture is kept on the device.
typedef struct layout {
    image_mip_kind mips;
    VkFormat format;
    uint32_t bytes;             // of a texel
    uint32_t first;             // byte k of a texel is byte first + k of RGBA8
    VkComponentMapping swizzle; // puts them back where the shader reads them
} layout;

static layout layout_of(texture_kind kind)
{
    const VkComponentSwizzle r = VK_COMPONENT_SWIZZLE_R, g = VK_COMPONENT_SWIZZLE_G,
                             one = VK_COMPONENT_SWIZZLE_ONE;
    switch (kind) {
    case TEXTURE_COLOR:
        return (layout) { IMAGE_MIP_SRGB_OPAQUE, VK_FORMAT_R8G8B8A8_SRGB, 4, 0, { 0 } };
    case TEXTURE_COLOR_ALPHA:
        return (layout) { IMAGE_MIP_SRGB, VK_FORMAT_R8G8B8A8_SRGB, 4, 0, { 0 } };
    case TEXTURE_ROUGHNESS_METALLIC:
        return (layout) { IMAGE_MIP_LINEAR, VK_FORMAT_R8G8_UNORM, 2, 1, { one, r, g, one } };
    case TEXTURE_NORMAL: return (layout) { IMAGE_MIP_NORMAL, VK_FORMAT_R8G8_UNORM, 2, 0, { 0 } };
    case TEXTURE_OCCLUSION: return (layout) { IMAGE_MIP_LINEAR, VK_FORMAT_R8_UNORM, 1, 0, { 0 } };
    case TEXTURE_SPECULAR:
        return (layout) { IMAGE_MIP_LINEAR, VK_FORMAT_R8_UNORM, 1, 3, { one, one, one, r } };
    case TEXTURE_KINDS: break;
    }
    return (layout) { 0 };
}

// The layout's bytes of `count` RGBA8 texels.  `out` may be `in`: what is written never
// overtakes what is still to be read.
static void pack(const layout *l, const uint8_t *in, size_t count, uint8_t *out)
{
    in += l->first;
    if (l->bytes == 1) {
        for (size_t i = 0; i < count; i++)
            out[i] = in[4 * i];
        return;
    }
    for (size_t i = 0; i < count; i++) {
        uint8_t a = in[4 * i], b = in[4 * i + 1];
        out[2 * i] = a;
        out[2 * i + 1] = b;
    }
}

// On a worker thread; what fails for want of memory leaves `base` or `mips` NULL.
static void prepare(void *context, size_t index)
{
    texture_job *job = (texture_job *)context + index;
    const ag_image *image = job->image;
    layout l = layout_of(job->kind);
    size_t texels = (size_t)image->width * image->height;
    uint32_t count = image_mip_count(image->width, image->height);
    job->mips = image_mips(image, l.mips);
    job->base = l.bytes == 4 ? image->pixels : malloc(texels * l.bytes);
    if (!job->mips || !job->base || l.bytes == 4)
        return;
    pages_prefer_large(job->base, texels * l.bytes);
    pack(&l, image->pixels, texels, job->base);
    pack(&l, job->mips, image_mip_offset(image->width, image->height, count) / 4, job->mips);
}

static ag_status upload_job(gpu_device *device, gpu_upload *upload, const texture_job *job)
{
    uint32_t width = job->image->width, height = job->image->height;
    layout l = layout_of(job->kind);
    const gpu_image_desc desc = {
        .format = l.format,
        .width = width,
        .height = height,
        .mips = image_mip_count(width, height),
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
        .swizzle = l.swizzle,
    };
    if (!job->base || !job->mips)
        return log_fail(&device->log, AG_ERROR_MEMORY, "no memory for the mips of a %ux%u texture",
                        width, height);
    if (width > device->info.max_size || height > device->info.max_size)
        return log_fail(&device->log, AG_ERROR_UNSUPPORTED,
                        "a texture of %ux%u pixels is more than the %u of %s", width, height,
                        device->info.max_size, device->info.name);
    ag_status status = gpu_image_create(device, &desc, job->target);
    if (status)
        return status;
    gpu_upload_image_begin(upload, job->target);
    status = gpu_upload_image_level(upload, job->target, 0, 0, l.bytes, job->base);
    for (uint32_t mip = 1; mip < desc.mips && !status; mip++) {
        size_t offset = image_mip_offset(width, height, mip) / 4 * l.bytes;
        status = gpu_upload_image_level(upload, job->target, mip, 0, l.bytes,
                                        (const char *)job->mips + offset);
    }
    gpu_upload_image_end(upload, job->target);
    return status;
}

static void finish(texture_job *job)
{
    if (job->base != job->image->pixels)
        free(job->base);
    free(job->mips);
    job->base = job->mips = NULL;
}

static int by_image(const void *a, const void *b)
{
    const texture_job *x = a, *y = b;
    return x->image != y->image ? (x->image < y->image ? -1 : 1) : (int)x->kind - (int)y->kind;
}

ag_status texture_jobs_run(gpu_device *device, gpu_upload *upload, bool release, texture_job *jobs,
                           size_t count)
{
    size_t batch = threads_available();
    ag_status status = AG_OK;
    qsort(jobs, count, sizeof *jobs, by_image); // so that an image's last job is known
    for (size_t i = 0; i < count && !status; i += batch) {
        size_t n = count - i < batch ? count - i : batch;
        parallel_for(n, prepare, jobs + i);
        for (size_t k = i; k < i + n; k++) {
            if (!status)
                status = upload_job(device, upload, &jobs[k]);
            finish(&jobs[k]);
            bool last = k + 1 == count || jobs[k + 1].image != jobs[k].image;
            if (release && last) {
                free(jobs[k].image->pixels);
                jobs[k].image->pixels = NULL;
            }
        }
    }
    return status;
}
