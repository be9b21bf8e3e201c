// What the samples of a picture add up to.
#include "trace/film.h"

#include "base/log.h"
#include "base/threads.h"
#include "image/image.h"
#include "physics/color.glsl"
#include "scene/bloom.h"

#include <stdlib.h>

ag_status film_init(const ag_log *log, uint32_t width, uint32_t height, bool aovs, film *f)
{
    *f = (film) {
        .width = width,
        .height = height,
        .columns = (width + FILM_TILE_WIDTH - 1) / FILM_TILE_WIDTH,
        .rows = (height + FILM_TILE_HEIGHT - 1) / FILM_TILE_HEIGHT,
    };
    size_t count = (size_t)width * height;
    f->pixels = calloc(count, sizeof *f->pixels);
    f->aovs = aovs ? calloc(count, sizeof *f->aovs) : NULL;
    f->samples = calloc((size_t)f->columns * f->rows, sizeof *f->samples);
    if (f->pixels && f->samples && (f->aovs || !aovs))
        return AG_OK;
    film_finish(f);
    return log_fail(log, AG_ERROR_MEMORY, "no memory to trace a picture of %ux%u pixels", width,
                    height);
}

void film_finish(film *f)
{
    free(f->pixels);
    free(f->aovs);
    free(f->samples);
    *f = (film) { 0 };
}

static void add3(float sum[3], vec3 v)
{
    for (int i = 0; i < 3; i++)
        sum[i] += v[i];
}

void film_add(film *f, uint32_t x, uint32_t y, const path_result *sample)
{
    film_pixel *p = &f->pixels[(size_t)y * f->width + x];
    float luminance = min(color_luminance(sample->direct + sample->indirect), 1e15f);
    add3(p->direct, sample->direct);
    add3(p->indirect, sample->indirect);
    p->alpha += sample->alpha;
    p->square += luminance * luminance;
    if (!f->aovs)
        return;
    film_aov *a = &f->aovs[(size_t)y * f->width + x];
    add3(a->albedo, sample->albedo);
    add3(a->normal, sample->normal);
    a->depth += sample->depth;
}

static uint32_t samples_at(const film *f, uint32_t x, uint32_t y)
{
    return f->samples[(size_t)(y / FILM_TILE_HEIGHT) * f->columns + x / FILM_TILE_WIDTH];
}

static float inverse(uint32_t count)
{
    return count ? 1 / (float)count : 0;
}

static vec3 mean_of(const film_pixel *p, float scale)
{
    return vec3(p->direct[0] + p->indirect[0], p->direct[1] + p->indirect[1],
                p->direct[2] + p->indirect[2]) *
           scale;
}

// ---- Noise ---------------------------------------------------------------------------

// The sum over rows of a picture, in their order: the same on any number of threads.
typedef struct row_sum {
    const film *film;
    float floor;
    double *sums;
} row_sum;

static void add_luminance(void *context, size_t y)
{
    const row_sum *r = context;
    double sum = 0;
    for (uint32_t x = 0; x < r->film->width; x++)
        sum += (double)color_luminance(mean_of(&r->film->pixels[y * r->film->width + x],
                                               inverse(samples_at(r->film, x, (uint32_t)y))));
    r->sums[y] = sum;
}

static void add_error(void *context, size_t y)
{
    const row_sum *r = context;
    double sum = 0;
    for (uint32_t x = 0; x < r->film->width; x++) {
        const film_pixel *p = &r->film->pixels[y * r->film->width + x];
        uint32_t n = samples_at(r->film, x, (uint32_t)y);
        if (n < 2)
            continue;
        float mean = color_luminance(mean_of(p, inverse(n)));
        float variance = max(p->square / (float)n - mean * mean, 0) / (float)(n - 1);
        sum += (double)(sqrtf(variance) / max(mean, r->floor));
    }
    r->sums[y] = sum;
}

static double total_of(const film *f, row_sum *r, void (*task)(void *, size_t))
{
    double total = 0;
    parallel_for(f->height, task, r);
    for (uint32_t y = 0; y < f->height; y++)
        total += r->sums[y];
    return total / ((double)f->width * f->height);
}

float film_noise(const film *f)
{
    row_sum r = { .film = f, .sums = calloc(f->height, sizeof(double)) };
    if (!r.sums)
        return INFINITY;
    r.floor = max((float)total_of(f, &r, add_luminance) / 20, 1e-20f);
    double noise = total_of(f, &r, add_error);
    free(r.sums);
    return (float)noise;
}

// ---- Pictures ------------------------------------------------------------------------

typedef struct developing {
    const film *film;
    const ag_render_options *options;
    ag_aov aov;
    ag_image *image;
} developing;

// Straight alpha; over the backdrop where floats leave as they are.
static void develop(const developing *d, vec3 mean, float alpha, float out[4])
{
    const float *backdrop = d->options->background_color;
    if (d->options->background == AG_BACKGROUND_COLOR && d->options->format == AG_FORMAT_RGBA32F) {
        for (int i = 0; i < 3; i++)
            mean[i] += (1 - alpha) * color_srgb_decode_channel(backdrop[i]);
        alpha = 1;
    }
    float scale = alpha > 0 && alpha < 1 ? 1 / alpha : 1;
    for (int i = 0; i < 3; i++)
        out[i] = mean[i] * scale;
    out[3] = alpha;
}

static void develop_row(void *context, size_t y)
{
    const developing *d = context;
    for (uint32_t x = 0; x < d->film->width; x++) {
        size_t at = y * d->film->width + x;
        const film_pixel *p = &d->film->pixels[at];
        float scale = inverse(samples_at(d->film, x, (uint32_t)y));
        develop(d, mean_of(p, scale), p->alpha * scale, (float *)d->image->pixels + 4 * at);
    }
}

ag_status film_picture(const ag_log *log, const film *f, const ag_render_options *options,
                       ag_image **image)
{
    const ag_image_desc desc = { f->width, f->height, AG_FORMAT_RGBA32F, NULL };
    ag_render_options light = options->bloom > 0 ? bloom_light(options) : *options;
    developing d = { .film = f, .options = &light };
    ag_status status = ag_image_create(log, &desc, &d.image);
    if (status)
        return status;
    parallel_for(f->height, develop_row, &d);
    if (options->bloom == 0 && options->format == AG_FORMAT_RGBA32F) {
        *image = d.image;
        return AG_OK;
    }
    status = options->bloom > 0 ? bloom_finish(log, d.image, options, image)
                                : ag_image_display(log, d.image, options, image);
    ag_image_destroy(d.image);
    return status;
}

static void aov_row(void *context, size_t y)
{
    const developing *d = context;
    for (uint32_t x = 0; x < d->film->width; x++) {
        size_t at = y * d->film->width + x;
        const film_pixel *p = &d->film->pixels[at];
        const film_aov *a = &d->film->aovs[at];
        const float depth[3] = { a->depth, a->depth, a->depth };
        const float *sums[] = { [AG_AOV_ALBEDO] = a->albedo,
                                [AG_AOV_NORMAL] = a->normal,
                                [AG_AOV_DEPTH] = depth,
                                [AG_AOV_DIRECT] = p->direct,
                                [AG_AOV_INDIRECT] = p->indirect };
        float *out = (float *)d->image->pixels + 4 * at;
        float scale = inverse(samples_at(d->film, x, (uint32_t)y));
        for (int i = 0; i < 3; i++)
            out[i] = sums[d->aov][i] * scale;
        out[3] = 1;
    }
}

ag_status film_aov_image(const ag_log *log, const film *f, ag_aov aov, ag_image **image)
{
    const ag_image_desc desc = { f->width, f->height, AG_FORMAT_RGBA32F, NULL };
    developing d = { .film = f, .aov = aov };
    if ((unsigned)aov > AG_AOV_INDIRECT || !f->aovs)
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "this is not known of the picture: ask for it by keep_aovs");
    ag_status status = ag_image_create(log, &desc, &d.image);
    if (status)
        return status;
    parallel_for(f->height, aov_row, &d);
    *image = d.image;
    return AG_OK;
}
