// The environment as a light.
//
// Directions are drawn from cells of constant density, at most 1024 x 512 of them: by rows, then
// within the row (Pharr, Jakob & Humphreys 2023, section 12.5).  A cell has the light that bilinear
// lookups within it find, so that no light is without density.
#include "trace/sky.h"

#include "bake/wide.h"
#include "base/log.h"
#include "base/threads.h"
#include "image/image.h"
#include "physics/color.glsl"
#include "trace/elementary.h"

#include <stdlib.h>

enum { COLUMNS_MAX = 1024, ROWS_MAX = 512 };

// ---- What is seen ------------------------------------------------------------------

// As environment_uv().
static vec2 uv_of(vec3 d)
{
    return vec2(0.5f + elementary_angle(d[2], d[0]) * (0.5f * INV_PI),
                elementary_angle(sqrtf(d[0] * d[0] + d[2] * d[2]), d[1]) * INV_PI);
}

static vec3 texel(const ag_image *image, uint32_t x, uint32_t y)
{
    const float *p = (const float *)image->pixels + 4 * ((size_t)y * image->width + x);
    return vec3(p[0], p[1], p[2]);
}

// Where an image is read: the texels that lie around, and how far it is between them.
typedef struct between {
    const float *texel[4]; // upper left and right, lower left and right
    float x, y;
} between;

// As the renderer's sampler: around in u, held in v.
static between between_texels(const ag_image *image, vec2 uv)
{
    int width = (int)image->width, height = (int)image->height;
    float x = uv[0] * (float)width - 0.5f, y = uv[1] * (float)height - 0.5f;
    int x0 = (int)(x + 1) - 1, y0 = (int)(y + 1) - 1, x1 = x0 + 1, y1 = y0 + 1; // from -1 on
    between b = { .x = x - (float)x0, .y = y - (float)y0 };
    x0 = x0 < 0 ? x0 + width : x0;
    x1 = x1 >= width ? x1 - width : x1;
    y0 = y0 < 0 ? 0 : y0;
    y1 = y1 >= height ? height - 1 : y1;
    const float *upper = (const float *)image->pixels + 4 * (size_t)y0 * (size_t)width;
    const float *lower = (const float *)image->pixels + 4 * (size_t)y1 * (size_t)width;
    b.texel[0] = upper + 4 * x0;
    b.texel[1] = upper + 4 * x1;
    b.texel[2] = lower + 4 * x0;
    b.texel[3] = lower + 4 * x1;
    return b;
}

static vec3 color_of(const float *texel)
{
    return vec3(texel[0], texel[1], texel[2]);
}

static vec3 read(const between *b)
{
    return mix(mix(color_of(b->texel[0]), color_of(b->texel[1]), b->x),
               mix(color_of(b->texel[2]), color_of(b->texel[3]), b->x), b->y);
}

// Each of many readings waits for memory: they are told of first, and wait together.
static void tell(const between *b)
{
    __builtin_prefetch(b->texel[0]);
    __builtin_prefetch(b->texel[2]);
}

static vec3 sky_from_world(const trace_sky *s, vec3 d)
{
    return vec3(s->cosine * d[0] - s->sine * d[2], d[1], s->sine * d[0] + s->cosine * d[2]);
}

static vec3 world_from_sky(const trace_sky *s, vec3 d)
{
    return vec3(s->cosine * d[0] + s->sine * d[2], d[1], s->cosine * d[2] - s->sine * d[0]);
}

// ---- Where it is drawn ---------------------------------------------------------------

typedef struct filling {
    const trace_sky *sky;
    float *totals; // of rows
} filling;

static float greatest(vec3 c)
{
    return max(max(c[0], c[1]), c[2]);
}

// The share of pixel `x` that a bilinear lookup within the pixels [from, to) sees, which reaches
// half a pixel beyond them: of a pixel's tent, 1/8 is on either side of its neighbours' edges.
static float share(int x, int from, int to)
{
    if (x < from || x >= to)
        return 0.125f;
    return 1 - 0.125f * (float)((x == from) + (x == to - 1));
}

// The first pixel of a cell, of so many of both in a line; and the cell that holds a pixel.
static int pixel_of(int cell, int pixels, int cells)
{
    return cells == pixels ? cell : (int)((int64_t)cell * pixels / cells);
}

static int cell_of(int pixel, int pixels, int cells)
{
    return cells == pixels ? pixel : (int)((((int64_t)pixel + 1) * cells - 1) / pixels);
}

// The light of one line of pixels in a cell.
static float span(const ag_image *image, uint32_t y, int from, int to)
{
    int width = (int)image->width;
    float sum = 0;
    for (int x = from - 1; x <= to; x++)
        sum += share(x, from, to) * greatest(texel(image, (uint32_t)((x + width) % width), y));
    return sum;
}

// guides[k] = the last cell that begins at or before the share k of the sum.
static void set_guides(const float *sums, int count, uint16_t *guides)
{
    int cell = 0;
    for (int k = 0; k <= SKY_GUIDES; k++) {
        float from = sums[count] * (float)k / SKY_GUIDES;
        while (cell < count - 1 && sums[cell + 1] <= from)
            cell++;
        guides[k] = (uint16_t)cell;
    }
}

static void fill_row(void *context, size_t index)
{
    const filling *f = context;
    const trace_sky *s = f->sky;
    int width = (int)s->image->width, height = (int)s->image->height, row = (int)index;
    int top = pixel_of(row, height, s->rows), bottom = pixel_of(row + 1, height, s->rows);
    float *sums = s->sums + index * (size_t)(s->columns + 1);
    // The solid angle of a cell, up to a factor that all share.
    float size = s->heights[row] - s->heights[row + 1];
    double total = 0;
    sums[0] = 0;
    for (int c = 0; c < s->columns; c++) {
        int from = pixel_of(c, width, s->columns), to = pixel_of(c + 1, width, s->columns);
        double light = 0;
        for (int y = top - 1; y <= bottom; y++) {
            int held = y < 0 ? 0 : y < height ? y : height - 1;
            light += (double)(share(y, top, bottom) * span(s->image, (uint32_t)held, from, to));
        }
        total += light / (bottom - top) * (double)size;
        sums[c + 1] = (float)total;
    }
    f->totals[row] = (float)total;
    set_guides(sums, s->columns, s->guides + index * (SKY_GUIDES + 1));
}

static ag_status no_memory(const ag_scene *scene)
{
    return log_fail(&scene->log, AG_ERROR_MEMORY, "no memory for the environment's distribution");
}

static sky_line line_of(const trace_sky *s, int row)
{
    bool of_rows = row == s->rows;
    return (sky_line) { of_rows ? s->rows : s->columns,
                        s->sums + (size_t)row * (size_t)(s->columns + 1),
                        s->guides + (size_t)row * (SKY_GUIDES + 1) };
}

static ag_status fill(trace_sky *s)
{
    size_t rows = (size_t)s->rows, columns = (size_t)s->columns;
    s->sums = malloc((rows * (columns + 1) + rows + 1) * sizeof *s->sums);
    s->guides = malloc((rows + 1) * (SKY_GUIDES + 1) * sizeof *s->guides);
    s->heights = malloc((rows + 1) * sizeof *s->heights);
    float *totals = malloc(rows * sizeof *totals);
    if (!s->sums || !s->guides || !s->heights || !totals) {
        free(totals);
        return no_memory(s->scene);
    }
    int height = (int)s->image->height;
    for (int i = 0; i <= s->rows; i++)
        s->heights[i] = cosf(PI * (float)pixel_of(i, height, s->rows) / (float)height);
    filling f = { s, totals };
    parallel_for(rows, fill_row, &f);
    float *sums = s->sums + rows * (columns + 1);
    double sum = 0;
    sums[0] = 0;
    for (size_t i = 0; i < rows; i++) {
        sum += (double)totals[i];
        sums[i + 1] = (float)sum;
    }
    set_guides(sums, s->rows, s->guides + rows * (SKY_GUIDES + 1));
    free(totals);
    return AG_OK;
}

void sky_turn(const ag_scene *scene, trace_sky *s)
{
    s->intensity = scene->environment_intensity;
    s->cosine = cosf(scene->environment_rotation_rad);
    s->sine = sinf(scene->environment_rotation_rad);
}

ag_status sky_init(const ag_scene *scene, trace_sky *s)
{
    *s = (trace_sky) { .scene = scene };
    sky_turn(scene, s);
    ag_status status = scene_environment_open(scene, &s->image);
    if (status || !s->image)
        return status;
    if (s->image != scene->environment)
        s->owned = (ag_image *)(uintptr_t)s->image;
    s->columns = s->image->width < COLUMNS_MAX ? (int)s->image->width : COLUMNS_MAX;
    s->rows = s->image->height < ROWS_MAX ? (int)s->image->height : ROWS_MAX;
    status = fill(s);
    if (status)
        sky_finish(s);
    return status;
}

void sky_finish(trace_sky *s)
{
    ag_image_destroy(s->owned);
    free(s->sums);
    free(s->guides);
    free(s->heights);
    *s = (trace_sky) { 0 };
}

// ---- Looking -----------------------------------------------------------------------

static int guide_of(float u)
{
    return (int)(u * SKY_GUIDES);
}

// The cell at share `u` of a line's sum; `*within` where in it.
static int find(const sky_line *l, float u, float *within)
{
    float x = u * l->sums[l->count];
    int guide = guide_of(u), low = l->guides[guide], high = l->guides[guide + 1] + 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (l->sums[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    float width = l->sums[low + 1] - l->sums[low];
    *within = width > 0 ? min(max(x - l->sums[low], 0.0f) / width, 0x1.fffffep-1f) : 0.5f;
    return low;
}

// The share of a line's sum that one of its items has, by which find() finds it.
static float chance(const sky_line *l, int item)
{
    float all = l->sums[l->count];
    return all > 0 ? (l->sums[item + 1] - l->sums[item]) / all : 0;
}

// Of a cell, 1/sr.
static float density_of(const trace_sky *s, int row, int column)
{
    sky_line rows = line_of(s, s->rows), cells = line_of(s, row);
    int width = (int)s->image->width;
    int wide = pixel_of(column + 1, width, s->columns) - pixel_of(column, width, s->columns);
    float size = (s->heights[row] - s->heights[row + 1]) * (2 * PI) * (float)wide / (float)width;
    return chance(&rows, row) * chance(&cells, column) / size;
}

// Where a direction lies, and its cell.
typedef struct spot {
    between texels;
    int row, column;
} spot;

static void look(const trace_sky *s, const spot *at, sky_look *look)
{
    look->radiance = s->intensity * read(&at->texels);
    look->density = density_of(s, at->row, at->column);
}

// Within a row heights are drawn evenly in the cosine, so that density over the sphere is
// constant in a cell.
static vec3 draw(const trace_sky *s, vec2 u, float down, spot *at)
{
    float across;
    sky_line cells = line_of(s, at->row);
    int width = (int)s->image->width;
    at->column = find(&cells, u[0], &across);
    int left = pixel_of(at->column, width, s->columns);
    int right = pixel_of(at->column + 1, width, s->columns);
    float turn = ((float)left + across * (float)(right - left)) / (float)width;
    float y = mix(s->heights[at->row], s->heights[at->row + 1], down);
    float r = sqrtf(max(1 - y * y, 0.0f)); // half a turn from the seam is +X
    at->texels = between_texels(s->image, vec2(turn, elementary_angle(r, y) * INV_PI));
    return world_from_sky(s, vec3(-r * elementary_cos(turn), y, -r * elementary_sin(turn)));
}

void sky_sample(const trace_sky *s, size_t count, const vec2 *u, sky_look *looks)
{
    spot at[SKY_MANY];
    float down[SKY_MANY];
    sky_line rows = line_of(s, s->rows);
    for (size_t i = 0; i < count; i++) {
        at[i].row = find(&rows, u[i][1], &down[i]);
        __builtin_prefetch(&line_of(s, at[i].row).guides[guide_of(u[i][0])]);
    }
    for (size_t i = 0; i < count; i++) {
        sky_line cells = line_of(s, at[i].row);
        __builtin_prefetch(&cells.sums[cells.guides[guide_of(u[i][0])]]);
    }
    for (size_t i = 0; i < count; i++) {
        looks[i].direction = draw(s, u[i], down[i], &at[i]);
        tell(&at[i].texels);
    }
    for (size_t i = 0; i < count; i++)
        look(s, &at[i], &looks[i]);
}

// The cells' light is radiance times difference of the cosine, over pixels around.
float sky_irradiance(const trace_sky *s)
{
    if (!s->image)
        return 0;
    sky_line rows = line_of(s, s->rows);
    return s->intensity * rows.sums[rows.count] * (0.5f * PI) / (float)s->image->width;
}

// As uv_of(), of the directions as they are seen in the world.
WIDE_INLINE void place_body(const trace_sky *s, const ray_packet *r, float *u, float *v)
{
    for (int i = 0; i < WORLD_PACKET; i++) {
        float x = s->cosine * r->direction[0][i] - s->sine * r->direction[2][i];
        float z = s->sine * r->direction[0][i] + s->cosine * r->direction[2][i];
        u[i] = 0.5f + elementary_angle(z, x) * (0.5f * INV_PI);
        v[i] = elementary_angle(sqrtf(x * x + z * z), r->direction[1][i]) * INV_PI;
    }
}

WIDE_DISPATCH(place, (const trace_sky *s, const ray_packet *r, float *u, float *v), (s, r, u, v))

void sky_behind(const trace_sky *s, const ray_packet *rays, vec3 radiance[WORLD_PACKET])
{
    float u[WORLD_PACKET], v[WORLD_PACKET];
    if (s->image)
        place(s, rays, u, v);
    for (int i = 0; i < WORLD_PACKET; i++) {
        radiance[i] = vec3(0, 0, 0);
        if (s->image) {
            between texels = between_texels(s->image, vec2(u[i], v[i]));
            radiance[i] = s->intensity * read(&texels);
        }
    }
}

static int pixel_at(float share, int pixels)
{
    int pixel = (int)(share * (float)pixels);
    return pixel < 0 ? 0 : pixel < pixels ? pixel : pixels - 1;
}

static spot spot_of(const trace_sky *s, vec3 direction)
{
    int width = (int)s->image->width, height = (int)s->image->height;
    vec2 uv = uv_of(sky_from_world(s, direction));
    return (spot) { .texels = between_texels(s->image, uv),
                    .row = cell_of(pixel_at(uv[1], height), height, s->rows),
                    .column = cell_of(pixel_at(uv[0], width), width, s->columns) };
}

void sky_at(const trace_sky *s, size_t count, sky_look *looks)
{
    spot at[SKY_MANY];
    for (size_t i = 0; i < count; i++) {
        at[i] = spot_of(s, looks[i].direction);
        tell(&at[i].texels);
        __builtin_prefetch(&line_of(s, at[i].row).sums[at[i].column]);
    }
    for (size_t i = 0; i < count; i++)
        look(s, &at[i], &looks[i]);
}
