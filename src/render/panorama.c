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

typedef uint16_t u16x4 __attribute__((vector_size(8), aligned(2), may_alias));

// Where eight taps lie: the texel on the upper left, and the weights of its neighbours.
typedef struct taps {
    i32x8 x, y;
    f32x8 right, lower;
} taps;

// environment_uv() of the physics, eight at a time, and what a sampler makes of it that
// repeats u and clamps v.
WIDE_INLINE taps taps_at(const surround *s, f32x8 dx, f32x8 dy, f32x8 dz)
{
    const f32x8 zero = { 0 };
    float width = (float)s->width, height = (float)s->height;
    f32x8 u = wide_atan2(dz, dx) * (0.5f * INV_PI) + 0.5f;
    f32x8 v = wide_atan2(wide_sqrt(dx * dx + dz * dz), dy) * INV_PI;
    f32x8 x = wide_max(u * width + 0.5f, zero); // one texel to the right
    f32x8 y = wide_min(wide_max(v * height - 0.5f, zero), zero + (height - 1));
    taps t = { __builtin_convertvector(x, i32x8), __builtin_convertvector(y, i32x8), x, y };
    t.right -= __builtin_convertvector(t.x, f32x8);
    t.lower -= __builtin_convertvector(t.y, f32x8);
    t.x -= 1;
    return t;
}

// 2^-112 of a texel: the bits of a finite half float where those of a float are.
WIDE_INLINE f32x4 texel(const uint16_t *half)
{
    i32x4 bits = __builtin_convertvector(*(const u16x4 *)(const void *)half, i32x4) << 16;
    return (f32x4)(bits >> 3 & (int32_t)0x8fffe000);
}

WIDE_INLINE f32x4 tap(const surround *s, const taps *t, int i)
{
    size_t width = s->width, x = t->x[i] < 0 ? width - 1 : (size_t)t->x[i];
    size_t next = x + 1 < width ? x + 1 : 0, y = (size_t)t->y[i];
    const uint16_t(*upper)[4] = s->texels + y * width;
    const uint16_t(*lower)[4] = y + 1 < s->height ? upper + width : upper;
    f32x4 a = texel(upper[x]), b = texel(lower[x]);
    a += (texel(upper[next]) - a) * t->right[i];
    b += (texel(lower[next]) - b) * t->right[i];
    return a + (b - a) * t->lower[i];
}

// ---- Colours ---------------------------------------------------------------------

// Suns hide what is behind them; their edges are a pixel wide.
static vec3 behind_suns(const panorama *b, float x, float y, vec3 color)
{
    const gpu_frame *f = b->frame;
    vec3 d = normalize(ray_at(f, x, y)), dx = normalize(ray_at(f, x + f->pixel.x, y)),
         dy = normalize(ray_at(f, x, y + f->pixel.y));
    for (uint32_t i = f->light_ends[GPU_LIGHTS_PUNCTUAL]; i < f->first_body; i++) {
        const gpu_light *sun = &b->suns[i];
        vec3 shown = vec3_of(sun->radiance);
        if (shown[0] != 0 || shown[1] != 0 || shown[2] != 0)
            color = mix(color, shown,
                        environment_sun_share(d, dx, dy, vec3_of(sun->direction), sun->radius));
    }
    return color;
}

WIDE_INLINE void panorama_run_wide_body(const panorama *b, uint32_t x, uint32_t y,
                                        float colors[][4])
{
    const gpu_frame *f = b->frame;
    const surround *s = b->surround;
    const f32x8 ramp = { 0, 1, 2, 3, 4, 5, 6, 7 };
    float left = ((float)x + 0.5f) * f->pixel.x - 1, up = ((float)y + 0.5f) * f->pixel.y - 1;
    vec3 first = environment_from_world(f, ray_at(f, left, up));
    vec3 step = environment_from_world(f, ray_at(f, left + f->pixel.x, up)) - first;
    taps t;
    if (s->present)
        t = taps_at(s, ramp * step[0] + first[0], ramp * step[1] + first[1],
                    ramp * step[2] + first[2]);
    bool suns = f->light_ends[GPU_LIGHTS_PUNCTUAL] < f->first_body;
    float intensity = f->environment_intensity;
    vec3 red = f->seen * vec3_of(f->red), green = f->seen * vec3_of(f->green),
         blue = f->seen * vec3_of(f->blue);
    for (int i = 0; i < PANORAMA_RUN; i++) {
        vec3 c = vec3(0, 0, 0);
        if (s->present)
            c = intensity * (0x1p112f * tap(s, &t, i));
        if (suns)
            c = behind_suns(b, left + (float)i * f->pixel.x, up, c);
        c = white_balanced(c, red, green, blue);
        if (b->tone != GPU_TONE_LINEAR)
            c = display(b->tone, c);
        c = min(c, 60000.0f);
        const float color[4] = { c[0], c[1], c[2], 1 };
        memcpy(colors[i], color, sizeof color);
    }
}

WIDE_DISPATCH(panorama_run_wide, (const panorama *b, uint32_t x, uint32_t y, float colors[][4]),
              (b, x, y, colors))

void panorama_run(const panorama *b, uint32_t x, uint32_t y, float colors[][4])
{
    panorama_run_wide(b, x, y, colors);
}
