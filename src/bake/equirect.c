// From an equirectangular image to the faces of a cube.
//
// A light of one pixel must not fall between the taps.  So the pixels are first made about
// as wide as those on the equator, by averaging: rows near the poles get fewer of them, and
// an image much finer than the cube is reduced.  Then every texel of the cube takes the
// mean of 2 x 2 bilinear taps, which are nearer to each other than the pixels.  Even so a
// single pixel's energy would be off by up to 15 %: pixels far brighter than all about
// them are taken out first and put into the cube by their energy.
#include "bake/equirect.h"

#include "base/threads.h"
#include "physics/environment.glsl"

#include <stdatomic.h>
#include <stdlib.h>

// Brighter than any lamp, and its square is still a float.
static const float RADIANCE_MAX = 1e12f;

// A reduced row, with one more pixel on either side where the circle closes; `pixels` is
// the one on the left.
typedef struct row {
    float *pixels;
    float width;
} row;

// What a pixel has above its neighbours, times its solid angle.
typedef struct spike {
    vec3 direction;
    f32x4 energy;
} spike;

enum { SPIKES_MAX = 4096 }; // beyond that it is texture

typedef struct source {
    const float *pixels;
    uint32_t width, height;
    row *rows;
    uint32_t row_count;
    float *reduced; // what the rows point into
    cube_level *level;
    spike spikes[SPIKES_MAX];
    atomic_uint spike_count;
    bool keep_spikes; // there are too many
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

static float brightest(const float *p)
{
    f32x4 v = clean(p);
    return fmaxf(fmaxf(v[0], v[1]), v[2]);
}

enum { SPIKE_RATIO = 16 };

static const float *pixel_at(const source *s, uint32_t x, uint32_t y)
{
    return s->pixels + 4 * ((size_t)y * s->width + x);
}

static bool is_spike(const source *s, uint32_t x, uint32_t y)
{
    float limit = brightest(pixel_at(s, x, y)) / SPIKE_RATIO;
    uint32_t left = x ? x - 1 : s->width - 1, right = x + 1 < s->width ? x + 1 : 0;
    return brightest(pixel_at(s, left, y)) < limit && brightest(pixel_at(s, right, y)) < limit &&
           (y == 0 || brightest(pixel_at(s, x, y - 1)) < limit) &&
           (y + 1 == s->height || brightest(pixel_at(s, x, y + 1)) < limit);
}

// The pixel, or what is left of it when it is a spike: its neighbours' mean.
WIDE_INLINE f32x4 smooth_pixel(const source *s, uint32_t x, uint32_t y)
{
    const float *p = pixel_at(s, x, y);
    const float *before = x ? p - 4 : pixel_at(s, s->width - 1, y);
    f32x4 v = clean(p);
    f32x4 rise = v - SPIKE_RATIO * clean(before);
    if (s->keep_spikes || !(rise[0] > 0.0f || rise[1] > 0.0f || rise[2] > 0.0f) ||
        !is_spike(s, x, y))
        return v;
    const float *after = x + 1 < s->width ? p + 4 : pixel_at(s, 0, y);
    return 0.5f * (clean(before) + clean(after));
}

static void find_spikes(void *context, size_t row_index)
{
    source *s = context;
    uint32_t y = (uint32_t)row_index;
    double top = (double)PI * y / s->height, bottom = (double)PI * (y + 1) / s->height;
    float angle = (float)((cos(top) - cos(bottom)) * 2.0 * (double)PI / s->width);
    for (uint32_t x = 0; x < s->width; x++) {
        f32x4 excess = clean(pixel_at(s, x, y)) - smooth_pixel(s, x, y);
        if (!(excess[0] > 0.0f || excess[1] > 0.0f || excess[2] > 0.0f))
            continue;
        unsigned i = atomic_fetch_add(&s->spike_count, 1);
        if (i >= SPIKES_MAX)
            return;
        vec2 uv = vec2(((float)x + 0.5f) / (float)s->width, ((float)y + 0.5f) / (float)s->height);
        s->spikes[i] = (spike) { environment_direction(uv), excess * angle };
    }
}

// Share a spike's energy among the four texels around it, or those of them on its face.
static void add_spike(cube_level *level, const spike *k)
{
    f32x8 zero = { 0 };
    cube_hit hit = cube_find(level->size, zero + k->direction[0], zero + k->direction[1],
                             zero + k->direction[2]);
    int32_t stride = (int32_t)level->size + 2, last = (int32_t)level->size - 1;
    int32_t x = hit.index[0] % stride - 1, y = hit.index[0] / stride % stride - 1;
    uint32_t face = (uint32_t)(hit.index[0] / (stride * stride));
    for (int i = 0; i < 4; i++) {
        int32_t tx = x + i % 2, ty = y + i / 2;
        tx = tx < 0 ? 0 : tx > last ? last : tx;
        ty = ty < 0 ? 0 : ty > last ? last : ty;
        float weight =
            (i % 2 ? hit.right[0] : 1.0f - hit.right[0]) * (i / 2 ? hit.low[0] : 1.0f - hit.low[0]);
        float angle = (float)cube_solid_angle(level->size, (uint32_t)tx, (uint32_t)ty);
        *(f32x4 *)cube_texel(level, face, tx, ty) += k->energy * (weight / angle);
    }
}

// Add a source row, averaged to `width` pixels and weighted, to `to`.
static void add_row(const source *s, uint32_t y, float *to, int32_t width, float weight)
{
    if ((uint32_t)width == s->width) {
        for (uint32_t x = 0; x < s->width; x++)
            *(f32x4 *)(to + 4 * x) += smooth_pixel(s, x, y) * weight;
        return;
    }
    double step = (double)s->width / width;
    for (int32_t x = 0; x < width; x++) {
        double a = x * step, b = x + 1 == width ? s->width : (x + 1) * step;
        f32x4 sum = { 0 };
        for (uint32_t i = (uint32_t)a; i < b; i++)
            sum += smooth_pixel(s, i, y) * (float)(fmin(b, i + 1.0) - fmax(a, i));
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
        add_row(s, i, to, width, (float)((fmin(b, i + 1.0) - fmax(a, i)) / step));
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
    source *s = calloc(1, sizeof *s);
    if (!s)
        return false;
    s->pixels = pixels;
    s->width = width;
    s->height = height;
    s->level = level;
    bool done = plan(s, level->size);
    if (done) {
        parallel_for(height, find_spikes, s);
        unsigned found = atomic_load(&s->spike_count);
        s->keep_spikes = found > SPIKES_MAX;
        parallel_for(s->row_count, reduce_row, s);
        parallel_for(6 * (size_t)level->size, fill_row_task, s);
        for (unsigned i = 0; i < found && !s->keep_spikes; i++)
            add_spike(level, &s->spikes[i]);
    }
    free(s->rows);
    free(s->reduced);
    free(s);
    return done;
}
