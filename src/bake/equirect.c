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

// A reduced row, with one more pixel on either side where the circle closes; `pixels` is
// the one on the left.
typedef struct row {
    float *pixels;
    float width;
} row;

typedef struct source {
    const float *pixels;
    uint32_t width, height;
    row *rows;
    uint32_t row_count;
    float *reduced; // what the rows point into
    cube_level *level;
} source;

// What is no radiance becomes 0, what is none on Earth is clipped.
WIDE_INLINE f32x4 clean(const float *p)
{
    f32x4 v = *(const f32x4 *)p, limit = { RADIANCE_MAX, RADIANCE_MAX, RADIANCE_MAX, 1.0f };
    v = (f32x4)((v > 0.0f) & (i32x4)v); // false for NaN
    i32x4 over = v > limit;
    v = (f32x4)((over & (i32x4)limit) | (~over & (i32x4)v));
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
    int32_t width = (int32_t)s->rows[y].width;
    float *to = s->rows[y].pixels + 4;
    memset(to, 0, sizeof(float[4]) * (size_t)width);
    double step = (double)s->height / s->row_count;
    double a = (double)y * step, b = y + 1 == s->row_count ? s->height : (double)(y + 1) * step;
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
    s->row_count = finer && s->height > 2 * cube_size ? 2 * cube_size : s->height;
    s->rows = malloc((s->row_count + 1) * sizeof *s->rows);
    if (!s->rows)
        return false;
    size_t total = 0;
    for (uint32_t y = 0; y < s->row_count; y++) {
        double across = sin((y + 0.5) / s->row_count * (double)PI); // against the equator
        int halvings = (int)floor(log2(sqrt(2.0) / across));
        double w = ldexp(width, -halvings);
        s->rows[y].width = (float)(uint32_t)(w < 1.0 ? 1.0 : w);
        total += (size_t)s->rows[y].width + 2;
    }
    s->reduced = malloc(total * sizeof(float[4]));
    if (!s->reduced)
        return false;
    float *next = s->reduced;
    for (uint32_t y = 0; y < s->row_count; y++) {
        s->rows[y].pixels = next;
        next += 4 * ((size_t)s->rows[y].width + 2);
    }
    s->rows[s->row_count] = s->rows[s->row_count - 1];
    return true;
}

// Where eight taps lie: u, and v in rows.
typedef struct taps {
    f32x8 u, low; // low: weight of the lower row
    i32x8 y;
} taps;

// environment_uv() of the physics, eight at a time.
WIDE_INLINE taps find_taps(const source *s, f32x8 dx, f32x8 dy, f32x8 dz)
{
    f32x8 zero = { 0 };
    f32x8 u = wide_atan2(dz, dx) * (0.5f * INV_PI) + 0.5f;
    f32x8 v = wide_atan2(wide_sqrt(dx * dx + dz * dz), dy) * INV_PI;
    float rows = (float)s->row_count;
    v = wide_min(wide_max(v * rows - 0.5f, zero), zero + (rows - 1.0f));
    taps t = { .u = wide_max(wide_min(u, zero + 1.0f), zero) };
    t.y = __builtin_convertvector(v, i32x8);
    t.low = v - __builtin_convertvector(t.y, f32x8);
    return t;
}

WIDE_INLINE f32x4 row_tap(const row *r, float x)
{
    int32_t i = (int32_t)x;
    const float *p = r->pixels + 4 * (size_t)(uint32_t)i;
    f32x4 a = *(const f32x4 *)p, b = *(const f32x4 *)(p + 4);
    return a + (b - a) * (x - (float)i);
}

WIDE_INLINE f32x4 fetch(const source *s, const taps *t, int i)
{
    const row *upper = &s->rows[t->y[i]], *lower = upper + 1; // there is one beyond the last
    // Counted from the extra pixel on the left.
    f32x4 a = row_tap(upper, t->u[i] * upper->width + 0.5f);
    f32x4 b = row_tap(lower, t->u[i] * lower->width + 0.5f);
    return a + (b - a) * t->low[i];
}

WIDE_INLINE void fill_row_body(const source *s, uint32_t face, uint32_t y)
{
    uint32_t size = s->level->size;
    float *to = cube_texel(s->level, face, 0, (int32_t)y);
    f32x8 ramp = { 0, 1, 2, 3, 4, 5, 6, 7 };
    for (uint32_t x = 0; x < size; x += 8, to += 32) {
        taps t[4];
        for (uint32_t i = 0; i < 4; i++) {
            float down = (2.0f * (float)y + 0.5f + (float)(i / 2)) / (float)size - 1.0f;
            f32x8 right = (2.0f * (ramp + (float)x) + (0.5f + (float)(i % 2))) / (float)size - 1.0f;
            vec3 origin = environment_cube_direction(face, 0.0f, down);
            vec3 along = environment_cube_direction(face, 1.0f, down) - origin;
            t[i] = find_taps(s, origin[0] + along[0] * right, origin[1] + along[1] * right,
                             origin[2] + along[2] * right);
        }
        for (int k = 0; k < 8; k++)
            *(f32x4 *)(to + 4 * k) = 0.25f * (fetch(s, &t[0], k) + fetch(s, &t[1], k) +
                                              fetch(s, &t[2], k) + fetch(s, &t[3], k));
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
        parallel_for(s.row_count, reduce_row, &s);
        parallel_for(6 * (size_t)level->size, fill_row_task, &s);
    }
    free(s.rows);
    free(s.reduced);
    return done;
}
