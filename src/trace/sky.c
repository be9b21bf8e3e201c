// The environment as a light.
//
// Directions are drawn from cells of constant density, at most 1024 x 512 of them: by rows, then
// within the row (Pharr, Jakob & Humphreys 2023, section 12.5).  A cell has the light of all
// pixels that a bilinear lookup within it may touch, so that no light is without density.
#include "trace/sky.h"

#include "base/log.h"
#include "base/threads.h"
#include "image/image.h"
#include "physics/color.glsl"
#include "physics/environment.glsl"

#include <stdlib.h>

enum { COLUMNS_MAX = 1024, ROWS_MAX = 512 };

// ---- What is seen ------------------------------------------------------------------

static vec3 texel(const ag_image *image, uint32_t x, uint32_t y)
{
    const float *p = (const float *)image->pixels + 4 * ((size_t)y * image->width + x);
    return vec3(p[0], p[1], p[2]);
}

// As the renderer's sampler: around in u, held in v.
static vec3 lookup(const ag_image *image, vec2 uv)
{
    int width = (int)image->width, height = (int)image->height;
    float x = uv[0] * (float)width - 0.5f, y = uv[1] * (float)height - 0.5f;
    float left = floorf(x), top = floorf(y), fx = x - left, fy = y - top;
    int x0 = (int)left, x1 = x0 + 1, y0 = (int)top, y1 = y0 + 1;
    x0 = x0 < 0 ? x0 + width : x0;
    x1 = x1 >= width ? x1 - width : x1;
    y0 = y0 < 0 ? 0 : y0;
    y1 = y1 >= height ? height - 1 : y1;
    vec3 upper =
        mix(texel(image, (uint32_t)x0, (uint32_t)y0), texel(image, (uint32_t)x1, (uint32_t)y0), fx);
    vec3 lower =
        mix(texel(image, (uint32_t)x0, (uint32_t)y1), texel(image, (uint32_t)x1, (uint32_t)y1), fx);
    return mix(upper, lower, fy);
}

static vec3 sky_from_world(const trace_sky *s, vec3 d)
{
    return vec3(s->cosine * d[0] - s->sine * d[2], d[1], s->sine * d[0] + s->cosine * d[2]);
}

static vec3 world_from_sky(const trace_sky *s, vec3 d)
{
    return vec3(s->cosine * d[0] + s->sine * d[2], d[1], s->cosine * d[2] - s->sine * d[0]);
}

vec3 sky_radiance(const trace_sky *s, vec3 direction)
{
    if (!s->image)
        return vec3(0, 0, 0);
    return s->intensity * lookup(s->image, environment_uv(sky_from_world(s, direction)));
}

// ---- Where it is drawn ---------------------------------------------------------------

typedef struct filling {
    const trace_sky *sky;
    float *totals; // of rows
} filling;

static float greatest(vec3 c)
{
    return fmaxf(fmaxf(c[0], c[1]), c[2]);
}

// The mean of the pixels in [from, to) of one line, one more at either end.
static float span(const ag_image *image, uint32_t y, int from, int to)
{
    int width = (int)image->width;
    float sum = 0;
    for (int x = from - 1; x <= to; x++)
        sum += greatest(texel(image, (uint32_t)((x + width) % width), y));
    return sum / (float)(to - from + 2);
}

static void fill_row(void *context, size_t index)
{
    const filling *f = context;
    const trace_sky *s = f->sky;
    int width = (int)s->image->width, height = (int)s->image->height, row = (int)index;
    int top = (int)((size_t)row * (size_t)height / (size_t)s->rows) - 1;
    int bottom = (int)(((size_t)row + 1) * (size_t)height / (size_t)s->rows);
    float *sums = s->cell_sums + index * (size_t)(s->columns + 1);
    // The solid angle of a cell, up to a factor that all share.
    float size =
        cosf(PI * (float)row / (float)s->rows) - cosf(PI * (float)(row + 1) / (float)s->rows);
    double total = 0;
    sums[0] = 0;
    for (int c = 0; c < s->columns; c++) {
        int from = (int)((size_t)c * (size_t)width / (size_t)s->columns);
        int to = (int)(((size_t)c + 1) * (size_t)width / (size_t)s->columns);
        double light = 0;
        for (int y = top; y <= bottom; y++)
            light += (double)span(s->image,
                                  (uint32_t)(y < 0        ? 0
                                             : y < height ? y
                                                          : height - 1),
                                  from, to);
        total += light / (bottom - top + 1) * (double)size;
        sums[c + 1] = (float)total;
    }
    f->totals[row] = (float)total;
}

static ag_status no_memory(const ag_scene *scene)
{
    return log_fail(&scene->log, AG_ERROR_MEMORY, "no memory for the environment's distribution");
}

ag_status sky_init(const ag_scene *scene, trace_sky *s)
{
    *s = (trace_sky) {
        .scene = scene,
        .intensity = scene->environment_intensity,
        .cosine = cosf(scene->environment_rotation_rad),
        .sine = sinf(scene->environment_rotation_rad),
    };
    ag_status status = scene_environment_open(scene, &s->image);
    if (status || !s->image)
        return status;
    s->columns = s->image->width < COLUMNS_MAX ? (int)s->image->width : COLUMNS_MAX;
    s->rows = s->image->height < ROWS_MAX ? (int)s->image->height : ROWS_MAX;
    size_t rows = (size_t)s->rows, columns = (size_t)s->columns;
    s->row_sums = calloc(rows + 1, sizeof *s->row_sums);
    s->cell_sums = malloc(rows * (columns + 1) * sizeof *s->cell_sums);
    float *totals = malloc(rows * sizeof *totals);
    if (!s->row_sums || !s->cell_sums || !totals) {
        free(totals);
        sky_finish(s);
        return no_memory(scene);
    }
    filling f = { s, totals };
    parallel_for(rows, fill_row, &f);
    double sum = 0;
    for (size_t i = 0; i < rows; i++) {
        sum += (double)totals[i];
        s->row_sums[i + 1] = (float)sum;
    }
    free(totals);
    return AG_OK;
}

void sky_finish(trace_sky *s)
{
    if (s->scene)
        scene_environment_close(s->scene, s->image);
    free(s->row_sums);
    free(s->cell_sums);
    *s = (trace_sky) { 0 };
}

// The interval of rising sums that holds `x`; `*within` where in it.
static int find(const float *sums, int count, float x, float *within)
{
    int low = 0, high = count;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (sums[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    float width = sums[low + 1] - sums[low];
    *within = width > 0 ? fminf((x - sums[low]) / width, 0x1.fffffep-1f) : 0.5f;
    return low;
}

// Within a row heights are drawn evenly in the cosine, so that density over the sphere is
// constant in a cell.
vec3 sky_sample(const trace_sky *s, vec2 u, float *density)
{
    float total = s->image ? s->row_sums[s->rows] : 0, across, down;
    *density = 0;
    if (!(total > 0))
        return vec3(0, 1, 0);
    int row = find(s->row_sums, s->rows, u[1] * total, &down);
    const float *cells = s->cell_sums + (size_t)row * (size_t)(s->columns + 1);
    int column = find(cells, s->columns, u[0] * cells[s->columns], &across);
    float top = cosf(PI * (float)row / (float)s->rows);
    float bottom = cosf(PI * (float)(row + 1) / (float)s->rows);
    float y = top + down * (bottom - top), r = sqrtf(fmaxf(1 - y * y, 0));
    float phi = (((float)column + across) / (float)s->columns - 0.5f) * 2 * PI;
    float size = (top - bottom) * 2 * PI / (float)s->columns;
    *density = (cells[column + 1] - cells[column]) / (total * size);
    return world_from_sky(s, vec3(r * cosf(phi), y, r * sinf(phi)));
}

float sky_density(const trace_sky *s, vec3 direction)
{
    float total = s->image ? s->row_sums[s->rows] : 0;
    if (!(total > 0))
        return 0;
    vec2 uv = environment_uv(sky_from_world(s, direction));
    int row = (int)(uv[1] * (float)s->rows), column = (int)(uv[0] * (float)s->columns);
    row = row < s->rows ? row : s->rows - 1;
    column = column < 0 ? 0 : column < s->columns ? column : s->columns - 1;
    const float *cells = s->cell_sums + (size_t)row * (size_t)(s->columns + 1);
    float top = cosf(PI * (float)row / (float)s->rows);
    float bottom = cosf(PI * (float)(row + 1) / (float)s->rows);
    return (cells[column + 1] - cells[column]) /
           (total * (top - bottom) * 2 * PI / (float)s->columns);
}
