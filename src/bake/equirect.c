// From an equirectangular image to the faces of a cube.
//
// A light of one pixel must not fall between the taps.  So the pixels are first made about
// as wide as those on the equator, by averaging: rows near the poles get fewer of them, and
// an image much finer than the cube is reduced.  Then every texel of the cube takes the
// mean of 2 x 2 bilinear taps, which are nearer to each other than the pixels.
#include "bake/equirect.h"

#include "base/threads.h"
#include "physics/environment.glsl"

#include <stdlib.h>

// Brighter than any lamp, and its square is still a float.
static const float RADIANCE_MAX = 1e12f;

typedef struct source {
    const float *pixels;
    uint32_t width, height;
    // Reduced: `rows` rows, row y has `widths[y]` pixels from `first[y]` on, and one more on
    // either side, where the circle closes.
    uint32_t rows;
    int32_t *widths;
    size_t *first; // in pixels
    float *reduced;
    cube_level *level;
} source;

static f32x4 clean(const float *p)
{
    f32x4 v;
    for (int i = 0; i < 3; i++)
        v[i] = p[i] > 0.0f ? (p[i] < RADIANCE_MAX ? p[i] : RADIANCE_MAX) : 0.0f; // NaN -> 0
    v[3] = 1.0f;
    return v;
}

// Add a source row, averaged to `width` pixels and weighted, to `to`.
static void add_row(const float *from, uint32_t from_width, float *to, int32_t width, float weight)
{
    if ((uint32_t)width == from_width) {
        for (int32_t x = 0; x < width; x++)
            *(f32x4 *)(to + 4 * x) += clean(from + 4 * x) * weight;
        return;
    }
    double step = (double)from_width / width;
    for (int32_t x = 0; x < width; x++) {
        double a = x * step, b = x + 1 == width ? from_width : (x + 1) * step;
        f32x4 sum = { 0 };
        for (uint32_t i = (uint32_t)a; i < b; i++)
            sum += clean(from + 4 * (size_t)i) * (float)(fmin(b, i + 1.0) - fmax(a, i));
        *(f32x4 *)(to + 4 * x) += sum * (weight / (float)step);
    }
}

static void reduce_row(void *context, size_t y)
{
    const source *s = context;
    float *to = s->reduced + 4 * s->first[y];
    int32_t width = s->widths[y];
    memset(to, 0, sizeof(float[4]) * (size_t)width);
    double step = (double)s->height / s->rows;
    double a = (double)y * step, b = y + 1 == s->rows ? s->height : (double)(y + 1) * step;
    for (uint32_t i = (uint32_t)a; i < b; i++)
        add_row(s->pixels + 4 * (size_t)i * s->width, s->width, to, width,
                (float)((fmin(b, i + 1.0) - fmax(a, i)) / step));
    memcpy(to - 4, to + 4 * (width - 1), sizeof(float[4]));
    memcpy(to + 4 * width, to, sizeof(float[4]));
}

// How many pixels each row keeps; false when there is no memory.
static bool plan(source *s, uint32_t cube_size)
{
    bool finer = s->width > 6 * cube_size;
    double width = finer ? 4 * cube_size : s->width;
    s->rows = finer && s->height > 2 * cube_size ? 2 * cube_size : s->height;
    s->widths = malloc(s->rows * sizeof *s->widths);
    s->first = malloc(s->rows * sizeof *s->first);
    if (!s->widths || !s->first)
        return false;
    size_t total = 0;
    for (uint32_t y = 0; y < s->rows; y++) {
        double across = sin((y + 0.5) / s->rows * (double)PI); // of a pixel, against the equator
        int halvings = (int)floor(log2(sqrt(2.0) / across));
        double w = ldexp(width, -halvings);
        s->widths[y] = (int32_t)(w < 1.0 ? 1.0 : w);
        s->first[y] = total + 1;
        total += (size_t)s->widths[y] + 2;
    }
    s->reduced = malloc(total * sizeof(float[4]));
    return s->reduced != NULL;
}

WIDE_INLINE f32x4 row_tap(const source *s, int32_t y, float u)
{
    float x = u * (float)s->widths[y] + 0.5f; // counted from the extra pixel on the left
    int32_t i = (int32_t)x;
    const float *p = s->reduced + 4 * (s->first[y] + (size_t)i - 1);
    f32x4 a = *(const f32x4 *)p, b = *(const f32x4 *)(p + 4);
    return a + (b - a) * (x - (float)i);
}

// Eight taps.
WIDE_INLINE void add_taps(const source *s, f32x8 dx, f32x8 dy, f32x8 dz, f32x4 sum[8])
{
    // environment_uv() of the physics, eight at a time.
    f32x8 u = wide_atan2(dz, dx) * (0.5f * INV_PI) + 0.5f;
    f32x8 v = wide_atan2(wide_sqrt(dx * dx + dz * dz), dy) * INV_PI;
    float rows = (float)s->rows;
    f32x8 py = wide_max(v * rows - 0.5f, (f32x8) { 0 });
    u = wide_max(wide_min(u, (f32x8) { 0 } + 1.0f), (f32x8) { 0 });
    int32_t last = (int32_t)s->rows - 1;
    for (int i = 0; i < 8; i++) {
        int32_t y = (int32_t)py[i];
        y = y < last ? y : last;
        float low = py[i] - (float)y;
        f32x4 a = row_tap(s, y, u[i]), b = row_tap(s, y < last ? y + 1 : last, u[i]);
        sum[i] += a + (b - a) * low;
    }
}

WIDE_INLINE void fill_row_body(const source *s, uint32_t face, uint32_t y)
{
    uint32_t size = s->level->size;
    f32x8 ramp = { 0, 1, 2, 3, 4, 5, 6, 7 };
    for (uint32_t x = 0; x < size; x += 8) {
        f32x4 sum[8] = { { 0 } };
        for (uint32_t tap = 0; tap < 4; tap++) {
            float t = (2.0f * (float)y + 0.5f + (float)(tap / 2)) / (float)size - 1.0f;
            f32x8 a = (2.0f * (ramp + (float)x) + (0.5f + (float)(tap % 2))) / (float)size - 1.0f;
            vec3 origin = environment_cube_direction(face, 0.0f, t);
            vec3 along = environment_cube_direction(face, 1.0f, t) - origin;
            add_taps(s, origin[0] + along[0] * a, origin[1] + along[1] * a,
                     origin[2] + along[2] * a, sum);
        }
        float *to = cube_texel(s->level, face, (int32_t)x, (int32_t)y);
        for (int i = 0; i < 8; i++)
            *(f32x4 *)(to + 4 * i) = sum[i] * 0.25f;
    }
}
WIDE_DISPATCH(fill_row, (const source *s, uint32_t face, uint32_t y), (s, face, y))

static void fill_row_task(void *context, size_t index)
{
    const source *s = context;
    fill_row(s, (uint32_t)index / s->level->size, (uint32_t)index % s->level->size);
}

bool equirect_to_cube(const float *pixels, uint32_t width, uint32_t height, cube_level *level)
{
    source s = { .pixels = pixels, .width = width, .height = height, .level = level };
    bool done = plan(&s, level->size);
    if (done) {
        parallel_for(s.rows, reduce_row, &s);
        parallel_for(6 * (size_t)level->size, fill_row_task, &s);
    }
    free(s.widths);
    free(s.first);
    free(s.reduced);
    return done;
}
