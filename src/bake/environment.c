// An environment prepared for shading: a prefiltered cube and irradiance in two forms.
#include "bake/environment.h"

#include "bake/cache.h"
#include "bake/cube.h"
#include "bake/equirect.h"
#include "bake/harmonics.h"
#include "bake/irradiance.h"
#include "bake/prefilter.h"
#include "base/log.h"
#include "base/threads.h"
#include "image/half.h"
#include "image/image.h"
#include "physics/environment.glsl"
#include "scene/scene.h"

#include <stdlib.h>

enum {
    FORMAT_VERSION = 3, // of what is baked: raise it when the same pixels give another result
    EDGE_MIN = 128,
    EDGE_MAX = 512,
    EDGE_LAST = 8,     // px, of the last mip, roughness 1
    DIFFUSE_EDGE = 32, // px, of the level that irradiance is made from
};

size_t bake_environment_mip_offset(uint32_t size, uint32_t mip)
{
    size_t bytes = 0;
    for (uint32_t i = 0; i < mip; i++)
        bytes += 6 * sizeof(uint16_t[4]) * (size_t)(size >> i) * (size >> i);
    return bytes;
}

size_t bake_environment_bytes(uint32_t size, uint32_t mip_count)
{
    return bake_environment_mip_offset(size, mip_count) +
           6 * sizeof(uint16_t[4]) * BAKE_IRRADIANCE_SIZE * BAKE_IRRADIANCE_SIZE;
}

// The power of two nearest, as a ratio, to the texels that cover a quarter of the horizon.
static uint32_t cube_size(uint32_t width)
{
    uint32_t size = EDGE_MIN;
    while (size < EDGE_MAX && (double)size * 4.0 * 1.41421356 < width)
        size *= 2;
    return size;
}

static uint32_t mip_count_of(uint32_t size)
{
    uint32_t count = 1;
    while (size >> (count - 1) > EDGE_LAST)
        count++;
    return count;
}

typedef struct conversion {
    const float *from;
    uint16_t *to;
    size_t row; // floats
} conversion;

static void convert_row(void *context, size_t index)
{
    const conversion *c = context;
    half_from_floats_clamped(c->from + index * c->row, c->to + index * c->row, c->row);
}

static void store_base(const cube *c, bake_environment *e)
{
    for (uint32_t face = 0; face < 6; face++) {
        for (uint32_t y = 0; y < e->size; y++) {
            uint16_t *to = e->cube + 4 * (size_t)(face * e->size + y) * e->size;
            half_from_floats_clamped(cube_texel(&c->levels[0], face, 0, (int32_t)y), to,
                                     4 * e->size);
        }
    }
}

// The levels below the first, through `texels`, room for the largest of them.
static void store_mips(const cube *c, bake_environment *e, float *texels)
{
    for (uint32_t mip = 1; mip < e->mip_count; mip++) {
        uint32_t size = e->size >> mip;
        float roughness = environment_roughness((float)mip, (float)e->mip_count);
        prefilter(c, roughness, size, texels);
        size_t offset = bake_environment_mip_offset(e->size, mip) / sizeof *e->cube;
        conversion conv = { texels, e->cube + offset, 4 * (size_t)size };
        parallel_for(6 * (size_t)size, convert_row, &conv);
    }
}

// Irradiance in both forms, through `texels`; false when there is no memory.
static bool store_irradiance(const cube *c, bake_environment *e, float *texels)
{
    uint32_t level = 0;
    while (c->levels[level].size > DIFFUSE_EDGE)
        level++;
    harmonics_project(&c->levels[level], e->sh);
    if (!irradiance_integrate(&c->levels[level], BAKE_IRRADIANCE_SIZE, texels))
        return false;
    size_t offset = bake_environment_mip_offset(e->size, e->mip_count) / sizeof *e->cube;
    half_from_floats_clamped(texels, e->cube + offset,
                             6 * 4 * (size_t)BAKE_IRRADIANCE_SIZE * BAKE_IRRADIANCE_SIZE);
    return true;
}

// Fill an environment whose sizes are set; false when there is no memory.
static bool bake(const ag_image *image, bake_environment *e)
{
    cube c = { 0 };
    uint32_t half = e->size / 2;
    float *texels = malloc(6 * sizeof(float[4]) * half * half);
    e->cube = malloc(e->cube_bytes);
    bool done = texels && e->cube && cube_init(&c, e->size) &&
                equirect_to_cube(image->pixels, image->width, image->height, &c.levels[0]);
    if (done) {
        cube_complete(&c);
        store_base(&c, e);
        store_mips(&c, e, texels);
        done = store_irradiance(&c, e, texels);
    }
    free(texels);
    cube_finish(&c);
    return done;
}

static uint64_t key_of(const ag_image *image)
{
    const uint32_t parameters[] = { FORMAT_VERSION, image->width, image->height };
    uint64_t seed = bake_cache_hash(parameters, sizeof parameters, 0);
    return bake_cache_hash(image->pixels, sizeof(float[4]) * image->width * image->height, seed);
}

ag_status bake_environment_make(const ag_log *log, const ag_image *equirect, bake_environment *out,
                                bool *cached)
{
    *out = (bake_environment) { 0 };
    if (cached)
        *cached = false;
    if (equirect->format != AG_FORMAT_RGBA32F)
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "the environment image has 8-bit channels; it needs RGBA32F");
    uint64_t key = key_of(equirect);
    bake_environment e = { .size = cube_size(equirect->width) };
    e.mip_count = mip_count_of(e.size);
    e.cube_bytes = bake_environment_bytes(e.size, e.mip_count);
    bake_environment found;
    if (bake_cache_find(key, &found)) {
        if (found.size == e.size && found.mip_count == e.mip_count) {
            *out = found;
            if (cached)
                *cached = true;
            return AG_OK;
        }
        bake_environment_finish(&found);
    }
    if (!bake(equirect, &e)) {
        bake_environment_finish(&e);
        return log_fail(log, AG_ERROR_MEMORY,
                        "no memory to prepare an environment of %u x %u pixels", equirect->width,
                        equirect->height);
    }
    bake_cache_store(log, key, &e);
    *out = e;
    return AG_OK;
}

void bake_environment_finish(bake_environment *environment)
{
    free(environment->cube);
    *environment = (bake_environment) { 0 };
}

static ag_status stopped(const ag_scene *scene, const ag_progress *progress, double fraction)
{
    if (!progress || !progress->update || progress->update(progress->user, "bake", fraction))
        return AG_OK;
    return log_fail(&scene->log, AG_ERROR_CANCELLED, "preparing the environment was cancelled");
}

ag_status ag_scene_bake(const ag_scene *scene, const ag_progress *progress)
{
    const ag_image *image = NULL;
    bake_environment baked = { 0 };
    ag_status status = stopped(scene, progress, 0);
    if (!status)
        status = scene_environment_open(scene, &image);
    if (status)
        return status;
    if (image)
        status = bake_environment_make(&scene->log, image, &baked, NULL);
    bake_environment_finish(&baked);
    scene_environment_close(scene, image);
    return status ? status : stopped(scene, progress, 1);
}
