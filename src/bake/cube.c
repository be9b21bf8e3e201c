// A cube map in floats with its mip chain: what the bake filters from.
#include "bake/cube.h"

#include "base/threads.h"
#include "physics/environment.glsl"

#include <stdlib.h>

bool cube_init(cube *c, uint32_t size)
{
    *c = (cube) { 0 };
    for (; size >= 4 && c->level_count < CUBE_LEVELS_MAX; size /= 2) {
        cube_level *level = &c->levels[c->level_count++];
        level->size = size;
        level->texels = malloc(6 * sizeof(float[4]) * (size + 2) * (size + 2));
        if (!level->texels) {
            cube_finish(c);
            return false;
        }
    }
    return true;
}

void cube_finish(cube *c)
{
    for (uint32_t i = 0; i < c->level_count; i++)
        free(c->levels[i].texels);
    *c = (cube) { 0 };
}

// The integral of (1 + x^2 + y^2)^-3/2 over [0, x] x [0, y] of the plane z = 1.
static double corner_angle(double x, double y)
{
    return atan2(x * y, sqrt(x * x + y * y + 1.0));
}

double cube_solid_angle(uint32_t size, uint32_t x, uint32_t y)
{
    double step = 2.0 / size;
    double x0 = x * step - 1.0, x1 = x0 + step, y0 = y * step - 1.0, y1 = y0 + step;
    return corner_angle(x1, y1) - corner_angle(x0, y1) - corner_angle(x1, y0) +
           corner_angle(x0, y0);
}

// What lies on the sphere where the face's plane goes on: the nearest neighbour inside.
static void fill_border_texel(cube_level *level, uint32_t face, int32_t x, int32_t y)
{
    float size = (float)level->size;
    float s = (2.0f * (float)x + 1.0f) / size - 1.0f, t = (2.0f * (float)y + 1.0f) / size - 1.0f;
    vec3 d = environment_cube_direction(face, s, t);
    f32x8 zero = { 0 };
    cube_hit hit = cube_find(level->size, zero + d[0], zero + d[1], zero + d[2]);
    // Nearest instead of bilinear: the neighbour's own border may not be there yet.
    uint32_t row = level->size + 2, index = (uint32_t)hit.index[0];
    int32_t nx = (int32_t)(index % row) - 1 + (hit.right[0] >= 0.5f);
    int32_t ny = (int32_t)(index / row % row) - 1 + (hit.low[0] >= 0.5f);
    int32_t last = (int32_t)level->size - 1;
    nx = nx < 0 ? 0 : nx > last ? last : nx;
    ny = ny < 0 ? 0 : ny > last ? last : ny;
    memcpy(cube_texel(level, face, x, y), cube_texel(level, index / (row * row), nx, ny),
           sizeof(float[4]));
}

static void fill_borders(cube_level *level)
{
    int32_t size = (int32_t)level->size;
    for (uint32_t face = 0; face < 6; face++) {
        for (int32_t i = -1; i <= size; i++) {
            fill_border_texel(level, face, i, -1);
            fill_border_texel(level, face, i, size);
            fill_border_texel(level, face, -1, i);
            fill_border_texel(level, face, size, i);
        }
    }
}

// Solid angle of a small texel but for a constant: the inverse cube of its distance.
static float texel_weight(float s, float t)
{
    float r2 = 1.0f + s * s + t * t;
    return 1.0f / (r2 * sqrtf(r2));
}

typedef struct reduction {
    const cube_level *from;
    cube_level *to;
} reduction;

// Four texels become one, each by its solid angle, so that no light is lost; row y of
// every face.
static void reduce_row(void *context, size_t y)
{
    const reduction *r = context;
    uint32_t size = r->to->size;
    float t0 = cube_coordinate(2 * size, 2 * (uint32_t)y);
    float t1 = cube_coordinate(2 * size, 2 * (uint32_t)y + 1);
    for (uint32_t x = 0; x < size; x++) {
        float s0 = cube_coordinate(2 * size, 2 * x), s1 = cube_coordinate(2 * size, 2 * x + 1);
        float a = texel_weight(s0, t0), b = texel_weight(s1, t0);
        float c = texel_weight(s0, t1), d = texel_weight(s1, t1);
        float scale = 1.0f / (a + b + c + d);
        for (uint32_t face = 0; face < 6; face++) {
            const float *p = cube_texel(r->from, face, 2 * (int32_t)x, 2 * (int32_t)y);
            const float *q = p + 4 * (size_t)(r->from->size + 2);
            f32x4 sum = *(const f32x4 *)p * a + *(const f32x4 *)(p + 4) * b +
                        *(const f32x4 *)q * c + *(const f32x4 *)(q + 4) * d;
            *(f32x4 *)cube_texel(r->to, face, (int32_t)x, (int32_t)y) = sum * scale;
        }
    }
}

void cube_complete(cube *c)
{
    fill_borders(&c->levels[0]);
    for (uint32_t i = 1; i < c->level_count; i++) {
        reduction r = { &c->levels[i - 1], &c->levels[i] };
        parallel_for(r.to->size, reduce_row, &r);
        fill_borders(&c->levels[i]);
    }
}
