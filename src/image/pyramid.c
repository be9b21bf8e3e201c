// Pyramids of light.
#include "image/pyramid.h"

#include "base/log.h"
#include "base/threads.h"

#include <math.h>
#include <stdlib.h>

enum {
    REACH_DOWN = 6, // texels of the finer line under a spline
    REACH_UP = 3,   // splines of the coarser line over a texel
    ROWS = 8,       // of one task
    BLOCK = 128,    // columns made at a time
    BLOCK_SOURCE = 2 * BLOCK + 2 * REACH_DOWN,
};

// ---- Lines ---------------------------------------------------------------------

// Where a texel comes from.
typedef struct taps {
    uint32_t at[REACH_DOWN];
    float weight[REACH_DOWN];
} taps;

typedef struct line {
    uint32_t reach; // taps of each texel
    taps *texels;
    struct span {
        uint32_t first, count;
    } * blocks; // what the taps of each BLOCK span
} line;

static uint32_t half_size(uint32_t size)
{
    return (size + 1) / 2;
}

static float spline(float x)
{
    x = fabsf(x);
    return x < 0.5f ? 0.75f - x * x : x < 1.5f ? 0.5f * (1.5f - x) * (1.5f - x) : 0;
}

static uint32_t mirror(int at, uint32_t size)
{
    int period = 2 * (int)size, i = ((at % period) + period) % period;
    return (uint32_t)(i < (int)size ? i : period - 1 - i);
}

// Texel `to` of a line of `to_size` from one of `from_size`; both span the same length.  The
// spline is as wide as three texels of the coarser line.
static taps taps_of(uint32_t from_size, uint32_t to_size, uint32_t to, uint32_t reach)
{
    float scale = (float)from_size / (float)to_size, width = scale > 1 ? scale : 1, sum = 0;
    float center = ((float)to + 0.5f) * scale - 0.5f;
    int first = (int)floorf(center - 0.5f * (float)reach) + 1;
    taps t;
    for (uint32_t i = 0; i < reach; i++) {
        t.at[i] = mirror(first + (int)i, from_size);
        t.weight[i] = spline(((float)(first + (int)i) - center) / width);
        sum += t.weight[i];
    }
    for (uint32_t i = 0; i < reach; i++)
        t.weight[i] /= sum;
    return t;
}

// Near an edge the mirrored ones are among the others.
static struct span span_of(const taps *texels, uint32_t count, uint32_t reach)
{
    uint32_t low = UINT32_MAX, high = 0;
    for (uint32_t x = 0; x < count; x++)
        for (uint32_t i = 0; i < reach; i++) {
            low = texels[x].at[i] < low ? texels[x].at[i] : low;
            high = texels[x].at[i] > high ? texels[x].at[i] : high;
        }
    return (struct span) { low, high - low + 1 };
}

static uint32_t block_size(uint32_t size, uint32_t first)
{
    return size - first < BLOCK ? size - first : BLOCK;
}

// False when there is no memory.
static bool line_init(line *l, uint32_t from_size, uint32_t to_size)
{
    l->reach = from_size > to_size ? REACH_DOWN : REACH_UP;
    l->texels = malloc(to_size * sizeof *l->texels);
    l->blocks = malloc((to_size / BLOCK + 1) * sizeof *l->blocks);
    if (!l->texels || !l->blocks)
        return false;
    for (uint32_t i = 0; i < to_size; i++)
        l->texels[i] = taps_of(from_size, to_size, i, l->reach);
    for (uint32_t i = 0; i < to_size; i += BLOCK)
        l->blocks[i / BLOCK] = span_of(l->texels + i, block_size(to_size, i), l->reach);
    return true;
}

static void line_finish(line *l)
{
    free(l->texels);
    free(l->blocks);
}

// ---- From level to level -------------------------------------------------------

typedef struct resampling {
    const pyramid_level *from, *to;
    line across, down;
    float keep; // of what `to` has been, to which the rest is added
} resampling;

// The columns that a block needs, in one row.
static inline void mix_rows(const pyramid_level *from, const taps *rows, uint32_t reach,
                            struct span span, pyramid_texel *out)
{
    const pyramid_texel *row[REACH_DOWN];
    for (uint32_t i = 0; i < reach; i++)
        row[i] = from->texels + (size_t)rows->at[i] * from->width + span.first;
    for (uint32_t x = 0; x < span.count; x++) {
        pyramid_texel sum = rows->weight[0] * row[0][x];
        for (uint32_t i = 1; i < reach; i++)
            sum += rows->weight[i] * row[i][x];
        out[x] = sum;
    }
}

// `row` begins with column `first`.
static inline void mix_columns(const taps *columns, uint32_t count, uint32_t reach,
                               const pyramid_texel *row, uint32_t first, float keep,
                               pyramid_texel *out)
{
    for (uint32_t x = 0; x < count; x++) {
        pyramid_texel sum = columns[x].weight[0] * row[columns[x].at[0] - first];
        for (uint32_t i = 1; i < reach; i++)
            sum += columns[x].weight[i] * row[columns[x].at[i] - first];
        out[x] = keep > 0 ? keep * out[x] + sum : sum;
    }
}

static void resample_block(const resampling *r, uint32_t y, uint32_t x)
{
    pyramid_texel mixed[BLOCK_SOURCE];
    struct span span = r->across.blocks[x / BLOCK];
    const taps *columns = r->across.texels + x, *rows = &r->down.texels[y];
    uint32_t count = block_size(r->to->width, x);
    pyramid_texel *out = r->to->texels + (size_t)y * r->to->width + x;
    // Constants, so that loops unroll.
    if (r->down.reach == REACH_DOWN)
        mix_rows(r->from, rows, REACH_DOWN, span, mixed);
    else
        mix_rows(r->from, rows, REACH_UP, span, mixed);
    if (r->across.reach == REACH_DOWN)
        mix_columns(columns, count, REACH_DOWN, mixed, span.first, r->keep, out);
    else
        mix_columns(columns, count, REACH_UP, mixed, span.first, r->keep, out);
}

static void resample_rows(void *context, size_t index)
{
    const resampling *r = context;
    uint32_t first = (uint32_t)index * ROWS;
    for (uint32_t y = first; y < first + ROWS && y < r->to->height; y++)
        for (uint32_t x = 0; x < r->to->width; x += BLOCK)
            resample_block(r, y, x);
}

static ag_status resample(const ag_log *log, const pyramid_level *from, pyramid_level *to,
                          float keep)
{
    resampling r = { .from = from, .to = to, .keep = keep };
    bool enough = line_init(&r.across, from->width, to->width);
    enough = line_init(&r.down, from->height, to->height) && enough;
    if (enough)
        parallel_for((to->height + ROWS - 1) / ROWS, resample_rows, &r);
    line_finish(&r.across);
    line_finish(&r.down);
    return enough ? AG_OK : log_fail(log, AG_ERROR_MEMORY, "no memory to blur a picture");
}

// ---- Pyramids ------------------------------------------------------------------

float pyramid_sigma(uint32_t size, uint32_t level)
{
    uint32_t coarse = size;
    for (uint32_t i = 0; i < level; i++)
        coarse = half_size(coarse);
    // A spline's variance is a quarter of its texel's square: of all levels' texels, twice.
    float texel = (float)size / (float)coarse;
    return sqrtf((texel * texel - 1) * 2 / 3);
}

ag_status pyramid_create(const ag_log *log, ag_image *image, uint32_t count, pyramid *p)
{
    *p = (pyramid) { .count = 1 };
    p->levels[0] = (pyramid_level) { image->width, image->height, image->pixels };
    ag_status status = AG_OK;
    for (; p->count < count && !status; p->count++) {
        const pyramid_level *fine = &p->levels[p->count - 1];
        pyramid_level *coarse = &p->levels[p->count];
        coarse->width = half_size(fine->width);
        coarse->height = half_size(fine->height);
        coarse->texels = malloc((size_t)coarse->width * coarse->height * sizeof *coarse->texels);
        status = coarse->texels ? resample(log, fine, coarse, 0)
                                : log_fail(log, AG_ERROR_MEMORY, "no memory to blur a picture");
    }
    if (status)
        pyramid_destroy(p);
    return status;
}

void pyramid_destroy(pyramid *p)
{
    for (uint32_t i = 1; i < p->count; i++)
        free(p->levels[i].texels);
    *p = (pyramid) { 0 };
}

ag_status pyramid_sum(const ag_log *log, pyramid *p, const float *weights)
{
    ag_status status = AG_OK;
    pyramid_level *last = &p->levels[p->count - 1];
    for (size_t i = 0; i < (size_t)last->width * last->height; i++)
        last->texels[i] *= weights[p->count - 1];
    for (uint32_t i = p->count - 1; i > 0 && !status; i--)
        status = resample(log, &p->levels[i], &p->levels[i - 1], weights[i - 1]);
    return status;
}
