// Bloom: a share of the light is scattered as in the eye.
#include "scene/bloom.h"

#include "base/log.h"
#include "base/threads.h"
#include "image/image.h"
#include "image/pyramid.h"
#include "physics/color.glsl"
#include "physics/glare.glsl"

enum { ROWS = 64 }; // of one task

// The picture's height is seen under 45 degrees, Argand's own angle of view.  Gaussians begin where
// the equation does, and end where they are as wide as two sevenths of the height.
static const float HEIGHT = 45, NARROWEST = 0.1f, WIDEST = 12.8f; // degrees

// ---- Weights -------------------------------------------------------------------

static float level_degrees(uint32_t height, uint32_t level)
{
    return pyramid_sigma(height, level) * HEIGHT / (float)height;
}

static uint32_t level_count(uint32_t height)
{
    uint32_t count = 1;
    while (count < PYRAMID_LEVELS_MAX && height >> (count - 1) > 1 &&
           level_degrees(height, count - 1) * 1.4142136f < WIDEST)
        count++;
    return count;
}

// Each level takes the Gaussians from halfway to the narrower one to halfway to the wider one; the
// image itself those that are narrower than about a pixel.
static void weigh(uint32_t height, uint32_t count, float share, float *weights)
{
    float from = NARROWEST, all = glare_share(NARROWEST, WIDEST);
    for (uint32_t i = 0; i < count; i++) {
        float here = level_degrees(height, i), next = level_degrees(height, i + 1);
        float to = i + 1 == count ? WIDEST : i ? sqrt(here * next) : next * 0.7071068f;
        to = clamp(to, from, WIDEST);
        weights[i] = share * glare_share(from, to) / all;
        from = to;
    }
    weights[0] += 1 - share;
}

// ---- Pixels --------------------------------------------------------------------

typedef struct bloom_job {
    const ag_image *from;
    ag_image *to;
    vec3 under; // display-linear
} bloom_job;

typedef int32_t mask __attribute__((vector_size(16)));

typedef struct band {
    const pyramid_texel *in;
    pyramid_texel *out;
    size_t end;
} band;

static band band_of(const bloom_job *job, size_t index)
{
    size_t first = index * ROWS * job->to->width, all = (size_t)job->to->width * job->to->height;
    size_t end = first + (size_t)ROWS * job->to->width;
    const pyramid_texel *in = job->from->pixels;
    pyramid_texel *out = job->to->pixels;
    return (band) { in + first, out + first, (end < all ? end : all) - first };
}

static pyramid_texel choose(mask which, pyramid_texel a, pyramid_texel b)
{
    return (pyramid_texel)(((mask)a & which) | ((mask)b & ~which));
}

// Multiplied by alpha; NaN becomes black, and sums of all are finite.
static void multiply_rows(void *context, size_t index)
{
    const pyramid_texel none = { 0 }, most = none + 1e30f;
    band b = band_of(context, index);
    for (size_t i = 0; i < b.end; i++) {
        pyramid_texel c = b.in[i];
        c = choose(c == c, c, none);
        c = choose(c < most, c, most);
        c = choose(c > -most, c, -most);
        float alpha = clamp(c[3], 0.0f, 1.0f);
        c *= alpha;
        c[3] = alpha;
        b.out[i] = c;
    }
}

static void straighten_rows(void *context, size_t index)
{
    band b = band_of(context, index);
    for (size_t i = 0; i < b.end; i++) {
        float alpha = b.in[i][3];
        if (alpha < 0.99999f)
            b.out[i] = b.in[i] * (alpha > 0 ? 1 / alpha : 0);
        b.out[i][3] = alpha < 0.99999f ? alpha : 1; // but for rounding
    }
}

static void cover_rows(void *context, size_t index)
{
    const bloom_job *job = context;
    band b = band_of(context, index);
    for (size_t i = 0; i < b.end; i++) {
        float alpha = b.in[i][3];
        for (int c = 0; c < 3; c++)
            b.out[i][c] = job->under[c] + (b.in[i][c] - job->under[c]) * alpha;
        b.out[i][3] = 1;
    }
}

static void each_band(bloom_job *job, void (*task)(void *, size_t))
{
    parallel_for((job->to->height + ROWS - 1) / ROWS, task, job);
}

// ---- Pictures ------------------------------------------------------------------

static ag_status scatter(const ag_log *log, ag_image *image, float share)
{
    float weights[PYRAMID_LEVELS_MAX];
    pyramid p;
    uint32_t count = level_count(image->height);
    weigh(image->height, count, share, weights);
    ag_status status = pyramid_create(log, image, count, &p);
    if (status)
        return status;
    status = pyramid_sum(log, &p, weights);
    pyramid_destroy(&p);
    return status;
}

ag_status ag_image_bloom(const ag_log *log, const ag_image *light, float share, ag_image **image)
{
    *image = NULL;
    if (light->format != AG_FORMAT_RGBA32F || !(share >= 0 && share <= 1))
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "only a picture of floats has bloom, of a share of 0 to 1 of its light");
    bloom_job job = { .from = light };
    ag_status status =
        image_allocate(log, "image", light->width, light->height, light->format, &job.to);
    if (status)
        return status;
    each_band(&job, multiply_rows);
    status = scatter(log, job.to, share);
    if (status) {
        ag_image_destroy(job.to);
        return status;
    }
    job.from = job.to;
    each_band(&job, straighten_rows);
    *image = job.to;
    return AG_OK;
}

ag_render_options bloom_light(const ag_render_options *options)
{
    ag_render_options light = *options;
    light.format = AG_FORMAT_RGBA32F;
    light.bloom = 0;
    if (light.background == AG_BACKGROUND_COLOR) // no light
        light.background = AG_BACKGROUND_TRANSPARENT;
    return light;
}

static void cover(ag_image *image, const float color[3])
{
    bloom_job job = { .from = image, .to = image };
    for (int i = 0; i < 3; i++)
        job.under[i] = color_srgb_decode_channel(color[i]);
    each_band(&job, cover_rows);
}

ag_status bloom_finish(const ag_log *log, const ag_image *light, const ag_render_options *options,
                       ag_image **picture)
{
    ag_image *bloomed;
    *picture = NULL;
    ag_status status = ag_image_bloom(log, light, options->bloom, &bloomed);
    if (status)
        return status;
    if (options->format == AG_FORMAT_RGBA8) {
        status = ag_image_display(log, bloomed, options, picture);
        ag_image_destroy(bloomed);
        return status;
    }
    if (options->background == AG_BACKGROUND_COLOR)
        cover(bloomed, options->background_color);
    *picture = bloomed;
    return AG_OK;
}
