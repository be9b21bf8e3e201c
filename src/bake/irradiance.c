// The environment as a white matte surface reflects it.
//
// A plain sum: irradiance has no detail, so a few thousand texels of environment and a
// cube of 16 texels an edge are enough, and cheaper than any sampling.
#include "bake/irradiance.h"

#include "base/threads.h"
#include "physics/environment.glsl"

#include <stdlib.h>

enum { CHANNELS = 6 }; // direction, radiance times solid angle

typedef struct irradiance_job {
    const float *lights[CHANNELS]; // [count] each, count a multiple of 8
    size_t count;
    uint32_t size;
    float *texels;
} irradiance_job;

WIDE_INLINE f32x8 load(const float *from)
{
    f32x8 value;
    memcpy(&value, from, sizeof value);
    return value;
}

WIDE_INLINE float total(f32x8 v)
{
    float sum = 0;
    for (int i = 0; i < 8; i++)
        sum += v[i];
    return sum;
}

WIDE_INLINE void sum_row_body(const irradiance_job *job, size_t row)
{
    uint32_t face = (uint32_t)(row / job->size), y = (uint32_t)(row % job->size);
    for (uint32_t x = 0; x < job->size; x++) {
        vec3 n = normalize(environment_cube_direction(face, cube_coordinate(job->size, x),
                                                      cube_coordinate(job->size, y)));
        f32x8 red = { 0 }, green = { 0 }, blue = { 0 };
        for (size_t i = 0; i < job->count; i += 8) {
            f32x8 cosine =
                wide_max(n[0] * load(job->lights[0] + i) + n[1] * load(job->lights[1] + i) +
                             n[2] * load(job->lights[2] + i),
                         (f32x8) { 0 });
            red += cosine * load(job->lights[3] + i);
            green += cosine * load(job->lights[4] + i);
            blue += cosine * load(job->lights[5] + i);
        }
        float *out = job->texels + 4 * (row * job->size + x);
        out[0] = total(red) * INV_PI;
        out[1] = total(green) * INV_PI;
        out[2] = total(blue) * INV_PI;
        out[3] = 1;
    }
}

WIDE_DISPATCH(sum_row, (const irradiance_job *job, size_t row), (job, row))

static void sum_task(void *context, size_t row)
{
    sum_row(context, row);
}

// The level's texels as lights, one array for each of their numbers.
static void gather_lights(const cube_level *level, float *lights, size_t count)
{
    size_t i = 0;
    for (uint32_t face = 0; face < 6; face++)
        for (uint32_t y = 0; y < level->size; y++)
            for (uint32_t x = 0; x < level->size; x++, i++) {
                const float *texel = cube_texel(level, face, (int32_t)x, (int32_t)y);
                float angle = (float)cube_solid_angle(level->size, x, y);
                vec3 d = normalize(environment_cube_direction(face, cube_coordinate(level->size, x),
                                                              cube_coordinate(level->size, y)));
                for (int c = 0; c < 3; c++) {
                    lights[(size_t)c * count + i] = d[c];
                    lights[(size_t)(c + 3) * count + i] = texel[c] * angle;
                }
            }
}

bool irradiance_integrate(const cube_level *level, uint32_t size, float *texels)
{
    size_t count = 6 * (size_t)level->size * level->size;
    float *lights = malloc(CHANNELS * count * sizeof *lights);
    if (!lights)
        return false;
    gather_lights(level, lights, count);
    irradiance_job job = { .count = count, .size = size, .texels = texels };
    for (size_t c = 0; c < CHANNELS; c++)
        job.lights[c] = lights + c * count;
    parallel_for(6 * (size_t)size, sum_task, &job);
    free(lights);
    return true;
}
