// The environment on the device: what lights the surfaces, and what is seen behind them.
#include "render/surround.h"

#include "bake/dfg.h"
#include "bake/environment.h"
#include "bake/ltc.h"
#include "base/clock.h"
#include "base/log.h"
#include "image/half.h"
#include "image/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ag_status upload_levels(gpu_device *device, gpu_upload *upload, const gpu_image_desc *desc,
                               uint32_t texel, const void *data, gpu_image *image)
{
    gpu_image_desc full = *desc;
    full.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    ag_status status = gpu_image_create(device, &full, image);
    if (status)
        return status;
    const char *bytes = data;
    gpu_upload_image_begin(upload, image);
    for (uint32_t mip = 0; mip < image->desc.mips && !status; mip++) {
        size_t width = full.width >> mip ? full.width >> mip : 1;
        size_t height = full.height >> mip ? full.height >> mip : 1;
        for (uint32_t layer = 0; layer < (full.cube ? 6u : 1u) && !status; layer++) {
            status = gpu_upload_image_level(upload, image, mip, layer, texel, bytes);
            bytes += width * height * texel;
        }
    }
    gpu_upload_image_end(upload, image);
    return status;
}

static ag_status upload_cube(gpu_device *device, gpu_upload *upload, const bake_environment *baked,
                             gpu_image *cube)
{
    const gpu_image_desc desc = { .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                  .width = baked->size,
                                  .height = baked->size,
                                  .mips = baked->mip_count,
                                  .cube = true };
    return upload_levels(device, upload, &desc, 8, baked->cube, cube);
}

static ag_status upload_irradiance(gpu_device *device, gpu_upload *upload,
                                   const bake_environment *baked, gpu_image *cube)
{
    const gpu_image_desc desc = { .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                  .width = BAKE_IRRADIANCE_SIZE,
                                  .height = BAKE_IRRADIANCE_SIZE,
                                  .cube = true };
    size_t offset = bake_environment_mip_offset(baked->size, baked->mip_count);
    return upload_levels(device, upload, &desc, 8, (const char *)baked->cube + offset, cube);
}

static ag_status keep_texels(gpu_device *device, const ag_image *equirect, surround *s)
{
    uint32_t width = equirect->width, height = equirect->height;
    size_t pitch = surround_pitch(width);
    s->texels = malloc(pitch * (height + 1ul) * sizeof *s->texels);
    if (!s->texels)
        return log_fail(&device->log, AG_ERROR_MEMORY, "no memory for the environment");
    const float(*pixels)[4] = equirect->pixels;
    for (uint32_t y = 0; y <= height; y++) {
        uint16_t(*row)[4] = s->texels + y * pitch;
        size_t from = (size_t)(y < height ? y : height - 1) * width;
        half_from_floats_clamped(pixels[from], row[1], width * 4ul);
        memcpy(row[0], row[width], sizeof *row);
        memcpy(row[width + 1], row[1], sizeof *row);
    }
    s->width = width;
    s->height = height;
    return AG_OK;
}

static ag_status upload_image(gpu_device *device, gpu_upload *upload, const ag_image *equirect,
                              surround *s)
{
    const gpu_image_desc desc = { .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                  .width = equirect->width,
                                  .height = equirect->height };
    if (equirect->width > device->info.max_size || equirect->height > device->info.max_size)
        return log_fail(&device->log, AG_ERROR_UNSUPPORTED,
                        "an environment of %ux%u pixels is more than the %u of %s", equirect->width,
                        equirect->height, device->info.max_size, device->info.name);
    size_t values = (size_t)equirect->width * equirect->height * 4;
    uint16_t *halves = malloc(values * sizeof *halves);
    if (!halves)
        return log_fail(&device->log, AG_ERROR_MEMORY, "no memory for the environment");
    half_from_floats_clamped(equirect->pixels, halves, values);
    gpu_image_destroy(device, &s->image);
    ag_status status = upload_levels(device, upload, &desc, 8, halves, &s->image);
    free(halves);
    s->has_image = status == AG_OK;
    return status;
}

static ag_status upload_black(gpu_device *device, gpu_upload *upload, bool cube, gpu_image *image)
{
    static const uint16_t black[6][4];
    const gpu_image_desc desc = {
        .format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = 1, .height = 1, .cube = cube
    };
    return upload_levels(device, upload, &desc, 8, black, image);
}

static ag_status upload_dfg(gpu_device *device, gpu_upload *upload, gpu_image *dfg)
{
    uint16_t table[BAKE_DFG_SIZE * BAKE_DFG_SIZE * 2];
    const gpu_image_desc desc = { .format = VK_FORMAT_R16G16_SFLOAT,
                                  .width = BAKE_DFG_SIZE,
                                  .height = BAKE_DFG_SIZE };
    bake_dfg(table);
    return upload_levels(device, upload, &desc, 4, table, dfg);
}

static ag_status upload_ltc(gpu_device *device, gpu_upload *upload, gpu_image *ltc)
{
    const gpu_image_desc desc = { .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                  .width = BAKE_LTC_SIZE,
                                  .height = BAKE_LTC_SIZE };
    return upload_levels(device, upload, &desc, 8, bake_ltc_table, ltc);
}

bool surround_shows(const surround *s, surround_shown shown)
{
    return !s->present || (shown == SURROUND_BY_DEVICE ? s->has_image
                           : shown == SURROUND_BY_HOST ? s->texels != NULL
                                                       : true);
}

ag_status surround_show(gpu_device *device, const ag_image *equirect, surround_shown shown,
                        gpu_upload *upload, surround *s)
{
    if (surround_shows(s, shown))
        return AG_OK;
    return shown == SURROUND_BY_DEVICE ? upload_image(device, upload, equirect, s)
                                       : keep_texels(device, equirect, s);
}

ag_status surround_create(gpu_device *device, const ag_image *equirect, surround_shown shown,
                          gpu_upload *upload, bool *cached, double *bake_ms, surround *s)
{
    *s = (surround) { .present = equirect };
    *cached = false;
    double start = clock_ms();
    bake_environment baked = { 0 };
    ag_status status = AG_OK;
    if (equirect)
        status = bake_environment_make(&device->log, equirect, &baked, cached);
    if (!status)
        status = upload_dfg(device, upload, &s->dfg);
    if (!status)
        status = upload_ltc(device, upload, &s->ltc);
    *bake_ms = clock_ms() - start;

    memcpy(s->sh, baked.sh, sizeof s->sh);
    if (!status)
        status = equirect ? upload_cube(device, upload, &baked, &s->cube)
                          : upload_black(device, upload, true, &s->cube);
    if (!status)
        status = equirect ? upload_irradiance(device, upload, &baked, &s->irradiance)
                          : upload_black(device, upload, true, &s->irradiance);
    if (!status && (!equirect || shown != SURROUND_BY_DEVICE)) // a stand-in
        status = upload_black(device, upload, false, &s->image);
    if (!status)
        status = surround_show(device, equirect, shown, upload, s);
    bake_environment_finish(&baked);
    return status;
}

void surround_destroy(gpu_device *device, surround *s)
{
    gpu_image_destroy(device, &s->cube);
    gpu_image_destroy(device, &s->irradiance);
    gpu_image_destroy(device, &s->image);
    gpu_image_destroy(device, &s->dfg);
    gpu_image_destroy(device, &s->ltc);
    free(s->texels);
    *s = (surround) { 0 };
}

void surround_frame(const surround *s, const ag_scene *scene, gpu_frame *frame)
{
    frame->environment_intensity = scene->environment_intensity;
    frame->environment_cos = cosf(scene->environment_rotation_rad);
    frame->environment_sin = sinf(scene->environment_rotation_rad);
    frame->environment_mips = (float)s->cube.desc.mips;
    memcpy(frame->sh, s->sh, sizeof frame->sh);
}
