// The environment where nothing stands before it, eight pixels at a time.
#include "render/panorama.h"

#include "bake/wide.h"
#include "physics/display.glsl"
#include "physics/environment.glsl"
#include "physics/white_balance.glsl"

static vec3 vec3_of(float3 v)
{
    return vec3(v.x, v.y, v.z);
}

// ---- Directions ----------------------------------------------------------------

static vec3 ray_at(const gpu_frame *f, float x, float y)
{
    vec3 d = vec3_of(f->ray_center);
    return f->orthographic != 0 ? d : d + x * vec3_of(f->ray_x) + y * vec3_of(f->ray_y);
}

// The environment's own frame: frame.glsl.
static vec3 environment_from_world(const gpu_frame *f, vec3 d)
{
    return vec3(f->environment_cos * d[0] - f->environment_sin * d[2], d[1],
                f->environment_sin * d[0] + f->environment_cos * d[2]);
}

// ---- Texels --------------------------------------------------------------------

// Where eight taps lie: the texel on the upper left, and the weights of its neighbours.
typedef struct taps {
    i32x8 x, y;
    f32x8 right, lower;
} taps;

// Eight colours.
typedef struct colors {
    f32x8 r, g, b;
} colors;

WIDE_INLINE f32x8 wide_fraction(f32x8 v, i32x8 *whole)
{
    *whole = __builtin_convertvector(v, i32x8);
    return v - __builtin_convertvector(*whole, f32x8);
}

// environment_uv() of the physics, eight at a time, and what a sampler makes of it that
// repeats u and clamps v.
WIDE_INLINE taps taps_at(const surround *s, f32x8 dx, f32x8 dy, f32x8 dz)
{
    const f32x8 zero = { 0 };
    float width = (float)s->width, height = (float)s->height;
    f32x8 u = wide_atan2(dz, dx) * (0.5f * INV_PI) + 0.5f;
    f32x8 v = wide_atan2(wide_sqrt(dx * dx + dz * dz), dy) * INV_PI;
    taps t;
    t.right =
        wide_fraction(wide_min(wide_max(u * width + 0.5f, zero), zero + (width + 0.75f)), &t.x);
    t.lower = wide_fraction(wide_min(wide_max(v * height - 0.5f, zero), zero + (height - 1)), &t.y);
    return t;
}

// Two neighbours of eight pixels, four half floats each: what stands where in 32 bits.
typedef struct pairs {
    i32x8 left_rg, left_b, right_rg, right_b;
} pairs;

#define SHUFFLE(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#define TWO(p, i)                                                                                  \
    SHUFFLE(*(const i32x4u *)(p)[i], *(const i32x4u *)(p)[(i) + 4], 0, 1, 2, 3, 4, 5, 6, 7)

typedef int32_t i32x4u __attribute__((vector_size(16), aligned(2), may_alias));

WIDE_INLINE pairs fetch(const uint16_t *const at[8])
{
    i32x8 a = TWO(at, 0), b = TWO(at, 1), c = TWO(at, 2), d = TWO(at, 3);
    i32x8 ab = SHUFFLE(a, b, 0, 8, 1, 9, 4, 12, 5, 13),
          cd = SHUFFLE(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
    i32x8 ef = SHUFFLE(a, b, 2, 10, 3, 11, 6, 14, 7, 15),
          gh = SHUFFLE(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
    return (pairs) { SHUFFLE(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13),
                     SHUFFLE(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15),
                     SHUFFLE(ef, gh, 0, 1, 8, 9, 4, 5, 12, 13),
                     SHUFFLE(ef, gh, 2, 3, 10, 11, 6, 7, 14, 15) };
}

// Finite half floats in the upper 16 bits, as floats.
WIDE_INLINE f32x8 widen(i32x8 upper)
{
    return 0x1p112f * (f32x8)(upper >> 3 & (int32_t)0x8fffe000);
}

WIDE_INLINE f32x8 between(f32x8 a, f32x8 b, f32x8 t)
{
    return a + (b - a) * t;
}

WIDE_INLINE colors across(pairs p, f32x8 right)
{
    return (colors) { between(widen(p.left_rg << 16), widen(p.right_rg << 16), right),
                      between(widen(p.left_rg), widen(p.right_rg), right),
                      between(widen(p.left_b << 16), widen(p.right_b << 16), right) };
}

WIDE_INLINE colors look_up(const surround *s, const taps *t)
{
    const uint16_t *upper[8], *lower[8];
    size_t pitch = surround_pitch(s->width);
    i32x8 index = t->y * (int32_t)pitch + t->x;
    for (int i = 0; i < 8; i++) {
        upper[i] = s->texels[(uint32_t)index[i]];
        lower[i] = upper[i] + 4 * pitch;
    }
    colors a = across(fetch(upper), t->right), b = across(fetch(lower), t->right);
    return (colors) { between(a.r, b.r, t->lower), between(a.g, b.g, t->lower),
                      between(a.b, b.b, t->lower) };
}

// ---- Light ---------------------------------------------------------------------

// Suns hide what is behind them; their edges are a pixel wide.
static vec3 behind_suns(const panorama *p, float x, float y, vec3 color)
{
    const gpu_frame *f = p->frame;
    vec3 d = normalize(ray_at(f, x, y)), dx = normalize(ray_at(f, x + f->pixel.x, y)),
         dy = normalize(ray_at(f, x, y + f->pixel.y));
    for (uint32_t i = f->light_ends[GPU_LIGHTS_PUNCTUAL]; i < f->first_body; i++) {
        const gpu_light *sun = &p->suns[i];
        vec3 shown = vec3_of(sun->radiance);
        if (shown[0] != 0 || shown[1] != 0 || shown[2] != 0)
            color = mix(color, shown,
                        environment_sun_share(d, dx, dy, vec3_of(sun->direction), sun->radius));
    }
    return color;
}

// From a pixel to the light that is seen there, in a row.
typedef struct row {
    float x, y, step_x;      // clip space: the middle of the first pixel, and on to the next one
    float first[3], step[3]; // the same as directions in the environment's frame
} row;

static row row_at(const gpu_frame *f, uint32_t x, uint32_t y)
{
    row r = { .x = ((float)x + 0.5f) * f->pixel.x - 1,
              .y = ((float)y + 0.5f) * f->pixel.y - 1,
              .step_x = f->pixel.x };
    vec3 first = environment_from_world(f, ray_at(f, r.x, r.y));
    vec3 step = environment_from_world(f, f->pixel.x * vec3_of(f->ray_x));
    if (f->orthographic != 0)
        step = vec3(0, 0, 0);
    memcpy(r.first, &first, sizeof r.first);
    memcpy(r.step, &step, sizeof r.step);
    return r;
}

// Of eight pixels from the one on that is `i` pixels right of the row's first.
WIDE_INLINE colors light_at(const panorama *p, const row *r, uint32_t i)
{
    const gpu_frame *f = p->frame;
    const f32x8 ramp = (f32x8) { 0, 1, 2, 3, 4, 5, 6, 7 } + (float)i;
    colors c = { ramp * 0, ramp * 0, ramp * 0 };
    if (p->surround->present) {
        taps t = taps_at(p->surround, ramp * r->step[0] + r->first[0],
                         ramp * r->step[1] + r->first[1], ramp * r->step[2] + r->first[2]);
        c = look_up(p->surround, &t);
        c.r *= f->environment_intensity;
        c.g *= f->environment_intensity;
        c.b *= f->environment_intensity;
    }
    if (f->light_ends[GPU_LIGHTS_PUNCTUAL] < f->first_body)
        for (int k = 0; k < 8; k++) {
            float x = r->x + ramp[k] * r->step_x;
            vec3 seen = behind_suns(p, x, r->y, vec3(c.r[k], c.g[k], c.b[k]));
            c.r[k] = seen[0];
            c.g[k] = seen[1];
            c.b[k] = seen[2];
        }
    return c;
}

// ---- The picture's colours -------------------------------------------------------

// exposed() of frame.glsl.
WIDE_INLINE colors exposed(const gpu_frame *f, colors c)
{
    f32x8 r = f->seen * c.r, g = f->seen * c.g, b = f->seen * c.b;
    return (colors) { r * f->red.x + g * f->green.x + b * f->blue.x,
                      r * f->red.y + g * f->green.y + b * f->blue.y,
                      r * f->red.z + g * f->green.z + b * f->blue.z };
}

WIDE_INLINE f32x8 wide_clamp(f32x8 v, float low, float high)
{
    const f32x8 zero = { 0 };
    return wide_min(wide_max(v, zero + low), zero + high);
}

// tonemap() of the physics with TONEMAP_NEUTRAL, eight at a time.
WIDE_INLINE colors neutral(colors c)
{
    const f32x8 zero = { 0 };
    const float start = 0.8f - 0.04f, d = 1 - start;
    c.r = wide_clamp(c.r, 0, 1e6f);
    c.g = wide_clamp(c.g, 0, 1e6f);
    c.b = wide_clamp(c.b, 0, 1e6f);
    f32x8 x = wide_min(wide_min(c.r, c.g), c.b);
    f32x8 offset = wide_select(x < 0.08f, x - 6.25f * x * x, zero + 0.04f);
    f32x8 peak = wide_max(wide_max(c.r, c.g), c.b) - offset;
    f32x8 bright = wide_max(peak, zero + start);
    f32x8 new_peak = 1 - d * d / (bright + d - start);
    f32x8 white = 1 - 1 / (0.15f * (bright - new_peak) + 1);
    f32x8 factor = (1 - white) * (new_peak / bright), lift = new_peak * white - factor * offset;
    i32x8 low = peak < start;
    factor = wide_select(low, zero + 1, factor);
    lift = wide_select(low, -offset, lift);
    return (colors) { c.r * factor + lift, c.g * factor + lift, c.b * factor + lift };
}

WIDE_INLINE colors shown(uint32_t tone, colors c)
{
    if (tone == GPU_TONE_LINEAR)
        return c;
    if (tone == TONEMAP_NEUTRAL)
        return neutral(c);
    for (int i = 0; i < 8; i++) {
        vec3 one = display(tone, vec3(c.r[i], c.g[i], c.b[i]));
        c.r[i] = one[0];
        c.g[i] = one[1];
        c.b[i] = one[2];
    }
    return c;
}

WIDE_INLINE void run_colors_body(const panorama *p, uint32_t x, uint32_t y, uint32_t count,
                                 float out[][4])
{
    const f32x8 limit = { 60000, 60000, 60000, 60000, 60000, 60000, 60000, 60000 };
    const row r = row_at(p->frame, x, y);
    for (uint32_t i = 0; i < count; i += 8) {
        colors c = shown(p->tone, exposed(p->frame, light_at(p, &r, i)));
        c = (colors) { wide_min(c.r, limit), wide_min(c.g, limit), wide_min(c.b, limit) };
        for (uint32_t k = 0; k < 8; k++) {
            const float color[4] = { c.r[k], c.g[k], c.b[k], 1 };
            memcpy(out[i + k], color, sizeof color);
        }
    }
}

WIDE_DISPATCH(run_colors,
              (const panorama *p, uint32_t x, uint32_t y, uint32_t count, float out[][4]),
              (p, x, y, count, out))

void panorama_colors(const panorama *p, uint32_t x, uint32_t y, uint32_t count, float out[][4])
{
    run_colors(p, x, y, count, out);
}

// The half floats that are nearest to values from 2^-14 to 1: at least and at most.
WIDE_INLINE i32x8 wide_halves(f32x8 v)
{
    return ((i32x8)wide_clamp(v, 0x1p-14f, 1) + (0x1000 - 0x38000000)) >> 13;
}

WIDE_INLINE void run_codes_body(const panorama *p, uint32_t x, uint32_t y, uint32_t count,
                                const uint8_t *code, uint8_t out[][4])
{
    const row r = row_at(p->frame, x, y);
    for (uint32_t i = 0; i < count; i += 8) {
        colors c = shown(p->tone, exposed(p->frame, light_at(p, &r, i)));
        i32x8 red = wide_halves(c.r), green = wide_halves(c.g), blue = wide_halves(c.b);
        for (uint32_t k = 0; k < 8; k++) {
            const uint8_t pixel[4] = { code[red[k]], code[green[k]], code[blue[k]], 255 };
            memcpy(out[i + k], pixel, sizeof pixel);
        }
    }
}

WIDE_DISPATCH(run_codes,
              (const panorama *p, uint32_t x, uint32_t y, uint32_t count, const uint8_t *code,
               uint8_t out[][4]),
              (p, x, y, count, code, out))

void panorama_codes(const panorama *p, uint32_t x, uint32_t y, uint32_t count, const uint8_t *code,
                    uint8_t out[][4])
{
    run_codes(p, x, y, count, code, out);
}
