// Which lights reach which part of the picture.
#include "render/clusters.h"

#include "base/log.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    SIDE = GPU_CLUSTERS,
    COUNT = SIDE * SIDE * SIDE,
    ROUND = 4, // px: a CPU device shades blocks of this size together
};

// The grid over one tile of the picture.
typedef struct grid {
    const view *view;
    view_rect tile;
    uint32_t tile_x, tile_y; // px, of a cluster
    float slice_scale, slice_offset;
} grid;

// The clusters from `first` to `last` in each direction; none where last < first.
typedef struct span {
    int first[3], last[3];
} span;

static const span everywhere = { { 0, 0, 0 }, { SIDE - 1, SIDE - 1, SIDE - 1 } };

static uint32_t cluster_size(uint32_t px)
{
    uint32_t size = (px + SIDE - 1) / SIDE;
    return (size + ROUND - 1) / ROUND * ROUND;
}

// An orthographic view, whose depth may have any sign, is not sliced.
static grid make_grid(const view *v, view_rect tile)
{
    grid g = { .view = v,
               .tile = tile,
               .tile_x = cluster_size(tile.width),
               .tile_y = cluster_size(tile.height) };
    if (!v->orthographic) {
        g.slice_scale = SIDE / log2f(v->far_m / v->near_m);
        g.slice_offset = -log2f(v->near_m) * g.slice_scale;
    }
    return g;
}

static int clamp_index(float x)
{
    return x < 0 ? 0 : x > SIDE - 1 ? SIDE - 1 : (int)x;
}

// Of depth, with a margin for the device's logarithm.
static void span_depth(const grid *g, float near, float far, span *s)
{
    if (g->view->orthographic)
        return;
    if (far < g->view->near_m || near > g->view->far_m) {
        s->last[2] = -1;
        return;
    }
    if (near > g->view->near_m)
        s->first[2] = clamp_index(log2f(near) * g->slice_scale + g->slice_offset - 0.01f);
    if (far > 0)
        s->last[2] = clamp_index(log2f(far) * g->slice_scale + g->slice_offset + 0.01f);
}

// Of one direction across the picture: `x` to `half` of the tangent (or m) at the picture's
// edge; one pixel of margin for jitter.
static void span_side(float low, float high, float half, uint32_t size, uint32_t start,
                      uint32_t extent, uint32_t cluster, int *first, int *last)
{
    float px = 0.5f * (float)size / half, middle = 0.5f * (float)size - (float)start;
    float from = low * px + middle - 1, to = high * px + middle + 1;
    if (to < 0 || from > (float)extent) {
        *last = -1;
        return;
    }
    *first = clamp_index(from / (float)cluster);
    *last = clamp_index(to / (float)cluster);
}

// Tangents of a ball's edges at depths `near` to `far`, never too narrow.
static void tangents(float x, float reach, float near, float far, float *low, float *high)
{
    *low = (x - reach) / (x < reach ? near : far);
    *high = (x + reach) / (x > -reach ? near : far);
}

// The clusters that the ball around a light reaches.
static span span_of(const grid *g, const gpu_light *light)
{
    span s = everywhere;
    if (g->view->orthographic)
        s.last[2] = 0;
    if (light->inverse_range2 <= 0)
        return s;
    const view *v = g->view;
    const float p[3] = { light->position.x, light->position.y, light->position.z };
    float x = 0, y = 0, z = 0, reach = 1 / sqrtf(light->inverse_range2);
    for (int i = 0; i < 3; i++) {
        float d = p[i] - v->eye[i];
        x += d * v->right[i];
        y -= d * v->up[i];
        z += d * v->forward[i];
    }
    span_depth(g, z - reach, z + reach, &s);
    float left = x - reach, right = x + reach, top = y - reach, bottom = y + reach;
    if (!v->orthographic) {
        if (z - reach < v->near_m)
            return s;
        tangents(x, reach, z - reach, z + reach, &left, &right);
        tangents(y, reach, z - reach, z + reach, &top, &bottom);
    }
    span_side(left, right, v->half_x, v->width, g->tile.x, g->tile.width, g->tile_x, &s.first[0],
              &s.last[0]);
    span_side(top, bottom, v->half_y, v->height, g->tile.y, g->tile.height, g->tile_y, &s.first[1],
              &s.last[1]);
    return s;
}

// For each cluster of the span.
#define FOR_SPAN(s, cluster)                                                                       \
    for (int z_ = (s).first[2]; z_ <= (s).last[2]; z_++)                                           \
        for (int y_ = (s).first[1]; y_ <= (s).last[1]; y_++)                                       \
            for (int x_ = (s).first[0], cluster = (z_ * SIDE + y_) * SIDE + x_; x_ <= (s).last[0]; \
                 x_++, cluster++)

// How many lights of each group reach each cluster, in the places of the records' ends.
static void count_lights(const span *spans, const lights *l, uint32_t *records)
{
    uint32_t i = 0;
    memset(records, 0, COUNT * GPU_CLUSTER_WORDS * sizeof *records);
    for (int group = 0; group < GPU_LIGHT_GROUPS; group++)
        for (; i < l->ends[group]; i++)
            FOR_SPAN(spans[i], c)
            {
                records[c * GPU_CLUSTER_WORDS + 1 + group]++;
            }
}

// Counts become ends; the number of words comes back.
static size_t place_lists(uint32_t *records)
{
    size_t at = COUNT * GPU_CLUSTER_WORDS;
    for (int c = 0; c < COUNT; c++) {
        uint32_t *record = records + c * GPU_CLUSTER_WORDS;
        record[0] = (uint32_t)at;
        for (int group = 0; group < GPU_LIGHT_GROUPS; group++) {
            at += record[1 + group];
            record[1 + group] = (uint32_t)at;
        }
    }
    return at;
}

static bool fill_lists(const span *spans, const lights *l, uint32_t *words)
{
    uint32_t *next = malloc(COUNT * sizeof *next);
    if (!next)
        return false;
    for (int c = 0; c < COUNT; c++)
        next[c] = words[c * GPU_CLUSTER_WORDS];
    for (uint32_t i = 0; i < l->count; i++)
        FOR_SPAN(spans[i], c)
        {
            words[next[c]++] = i;
        }
    free(next);
    return true;
}

static ag_status write_clusters(gpu_device *device, const span *spans, uint32_t *records, lights *l)
{
    count_lights(spans, l, records);
    size_t words = place_lists(records);
    if (words * sizeof *records > device->limits.maxStorageBufferRange)
        return log_fail(&device->log, AG_ERROR_UNSUPPORTED,
                        "%u lights reach too many parts of the picture for this device; give them "
                        "ranges",
                        l->count);
    ag_status status =
        gpu_buffer_ensure(device, words * sizeof *records, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                          GPU_MEMORY_UPLOAD, &l->clusters);
    if (status)
        return status;
    uint32_t *out = l->clusters.memory.mapped;
    memcpy(out, records, COUNT * GPU_CLUSTER_WORDS * sizeof *records);
    if (!fill_lists(spans, l, out))
        return log_fail(&device->log, AG_ERROR_MEMORY, "no memory to sort %u lights", l->count);
    return AG_OK;
}

ag_status clusters_write(gpu_device *device, const view *v, view_rect tile, lights *l,
                         gpu_frame *frame)
{
    grid g = make_grid(v, tile);
    frame->cluster_tile_x = g.tile_x;
    frame->cluster_tile_y = g.tile_y;
    frame->slice_scale = g.slice_scale;
    frame->slice_offset = g.slice_offset;

    span *spans = malloc(l->count * sizeof *spans);
    uint32_t *records = malloc(COUNT * GPU_CLUSTER_WORDS * sizeof *records);
    ag_status status = AG_OK;
    if (spans && records) {
        const gpu_light *all = l->all.memory.mapped;
        for (uint32_t i = 0; i < l->count; i++)
            spans[i] = span_of(&g, &all[i]);
        status = write_clusters(device, spans, records, l);
    } else {
        status = log_fail(&device->log, AG_ERROR_MEMORY, "no memory to sort %u lights", l->count);
    }
    free(spans);
    free(records);
    return status;
}
