// What of a picture is to be shaded: each surface once in each pixel that shows it.
#include "render/shade_list.h"

#include "base/array.h"
#include "base/threads.h"
#include "image/half.h"
#include "image/srgb.h"
#include "physics/display.glsl"

#include <stdlib.h>

enum { CODES = 0x3c01 }; // half floats from 0 to 1

// Places are listed tile by tile, so that neighbours find each other's texels in the cache.
enum { TILE = 32 }; // px across; as high as a band

static const uint32_t NOTHING = (uint32_t)RASTER_NONE; // as an id

// ---- Pixels --------------------------------------------------------------------

// The surfaces of one pixel.
typedef struct parts {
    uint32_t id[4];
    uint32_t weight[4]; // samples
    int count;
} parts;

static const shade_source *source_of(const shade_list *l, uint32_t id)
{
    uint32_t i = (uint32_t)((uint64_t)id >> l->triangle_bits);
    return &l->sources[i < l->source_count ? i : l->source_count - 1];
}

static uint32_t *ids_of(const shade_list *l, uint32_t x, uint32_t y)
{
    return l->ids + y * l->pitch + (size_t)x * l->samples;
}

static bool is_whole(const shade_list *l, const uint32_t *ids)
{
    return l->samples == 1 || ((ids[0] ^ ids[1]) | (ids[0] ^ ids[2]) | (ids[0] ^ ids[3])) == 0;
}

static bool is_empty(const shade_list *l, const uint32_t *ids)
{
    return l->samples == 1 ? ids[0] == NOTHING : (ids[0] & ids[1] & ids[2] & ids[3]) == NOTHING;
}

static parts parts_of(const shade_list *l, const uint32_t *ids)
{
    parts p = { .id = { ids[0] }, .weight = { 1 }, .count = 1 };
    for (uint32_t s = 1; s < l->samples; s++) {
        uint32_t id = ids[s];
        int i = 0;
        while (i < p.count && p.id[i] != id)
            i++;
        if (i == p.count)
            p.id[p.count++] = id;
        p.weight[i]++;
    }
    return p;
}

// ---- Surfaces --------------------------------------------------------------------

static bool share_vertex(const uint32_t a[3], const uint32_t b[3])
{
    for (int i = 0; i < 3; i++)
        if (a[i] == b[0] || a[i] == b[1] || a[i] == b[2])
            return true;
    return false;
}

static bool are_one_surface(const shade_list *l, uint32_t a, uint32_t b)
{
    if ((uint64_t)(a ^ b) >> l->triangle_bits != 0)
        return false;
    const shade_source *source = source_of(l, a);
    uint32_t mask = (uint32_t)((1ull << l->triangle_bits) - 1);
    return !source->indices ||
           share_vertex(source->indices + 3ul * (a & mask), source->indices + 3ul * (b & mask));
}

// Which parts hang together, by way of a third if need be: equal numbers.
static void group_parts(const shade_list *l, const parts *p, int group[4])
{
    for (int i = 0; i < p->count; i++) {
        group[i] = i;
        for (int k = 0; k < i; k++)
            if (group[k] != group[i] && are_one_surface(l, p->id[i], p->id[k]))
                for (int was = group[i], m = 0; m <= i; m++)
                    group[m] = group[m] == was ? group[k] : group[m];
    }
}

// Samples of one surface all become those of its triangle that has most.
static parts unite(const shade_list *l, uint32_t *ids)
{
    parts p = parts_of(l, ids);
    int group[4], heaviest[4] = { -1, -1, -1, -1 };
    group_parts(l, &p, group);
    for (int i = 0; i < p.count; i++) {
        int *best = &heaviest[group[i]];
        *best = *best < 0 || p.weight[i] > p.weight[*best] ? i : *best;
    }
    for (int s = 0; s < 4; s++) {
        int i = 0;
        while (p.id[i] != ids[s])
            i++;
        ids[s] = p.id[heaviest[group[i]]];
    }
    return parts_of(l, ids);
}

// ---- Lists ---------------------------------------------------------------------------

// The cursors of a band; that of what is not listed comes last.
static uint32_t *cursors_of(const shade_list *l, size_t band)
{
    return l->cursors + band * (l->list_count + 1);
}

static uint32_t band_end(const shade_list *l, size_t band)
{
    uint32_t end = ((uint32_t)band + 1) * RASTER_BAND;
    return end < l->height ? end : l->height;
}

static uint32_t tile_end(const shade_list *l, uint32_t x)
{
    return x + TILE < l->width ? x + TILE : l->width;
}

typedef struct count_job {
    shade_list *list;
    const raster *raster;
} count_job;

static void count_pixel(const shade_list *l, uint32_t *ids, uint32_t *counts)
{
    if (is_empty(l, ids))
        return;
    if (is_whole(l, ids)) {
        counts[source_of(l, ids[0])->list]++;
        return;
    }
    parts p = unite(l, ids);
    for (int i = 0; i < p.count; i++)
        counts[source_of(l, p.id[i])->list]++;
}

static void count_band(void *context, size_t band, unsigned worker)
{
    count_job *job = context;
    const shade_list *l = job->list;
    uint32_t first = (uint32_t)band * RASTER_BAND;
    raster_band(job->raster, (uint32_t)band, worker, ids_of(l, 0, first));
    for (uint32_t y = first; y < band_end(l, band); y++)
        for (uint32_t x = 0; x < l->width; x++)
            count_pixel(l, ids_of(l, x, y), cursors_of(l, band));
}

// From counts to where each band's part of each list is.
static void place_lists(shade_list *l)
{
    uint32_t at = 0;
    for (uint32_t i = 0; i < l->list_count; i++) {
        l->firsts[i] = at;
        for (uint32_t band = 0; band < l->bands; band++) {
            uint32_t *cursor = cursors_of(l, band) + i, count = *cursor;
            *cursor = at;
            at += count;
        }
    }
    l->firsts[l->list_count] = at;
}

static bool allocate(shade_list *l)
{
    size_t columns = l->list_count + 1, cursors = l->bands * columns;
    if (!array_reserve(&l->ids, &l->ids_capacity, l->height * l->pitch, sizeof *l->ids) ||
        !array_reserve(&l->cursors, &l->cursors_capacity, cursors, sizeof *l->cursors) ||
        !array_reserve(&l->firsts, &l->firsts_capacity, columns, sizeof *l->firsts))
        return false;
    memset(l->cursors, 0, cursors * sizeof *l->cursors);
    return true;
}

bool shade_list_count(shade_list *l, const raster *r)
{
    l->width = r->width;
    l->height = r->height;
    l->samples = r->samples;
    l->pitch = r->pitch;
    l->bands = r->bands;
    if (!allocate(l))
        return false;
    count_job job = { .list = l, .raster = r };
    parallel_for_workers(r->workers, l->bands, count_band, &job);
    place_lists(l);
    return true;
}

void shade_list_finish(shade_list *l)
{
    free(l->ids);
    free(l->cursors);
    free(l->firsts);
    *l = (shade_list) { 0 };
}

typedef struct write_job {
    const shade_list *list;
    gpu_listed *places;
} write_job;

static gpu_listed place_of(const shade_list *l, uint32_t id, uint32_t pixel)
{
    const shade_source *source = source_of(l, id);
    uint32_t triangle = id & (uint32_t)((1ull << l->triangle_bits) - 1);
    return (gpu_listed) { pixel, (uint32_t)((uint64_t)id >> l->triangle_bits),
                          source->first_index + 3 * triangle, source->first_vertex };
}

// Lists the places of a row's pixels [from, to); cursors move on.
static void write_row(const write_job *job, uint32_t y, uint32_t from, uint32_t to,
                      uint32_t *cursors)
{
    const shade_list *l = job->list;
    for (uint32_t x = from; x < to; x++) {
        const uint32_t *ids = ids_of(l, x, y);
        if (is_empty(l, ids))
            continue;
        parts p = { .id = { ids[0] }, .count = 1 };
        if (!is_whole(l, ids))
            p = parts_of(l, ids);
        for (int i = 0; i < p.count; i++) {
            uint32_t list = source_of(l, p.id[i])->list;
            if (list < l->list_count)
                job->places[cursors[list]++] = place_of(l, p.id[i], x | y << 16);
        }
    }
}

static void write_band(void *context, size_t band)
{
    const write_job *job = context;
    const shade_list *l = job->list;
    uint32_t cursors[SHADE_LISTS_MAX + 1];
    memcpy(cursors, cursors_of(l, band), (l->list_count + 1) * sizeof *cursors);
    for (uint32_t x = 0; x < l->width; x += TILE)
        for (uint32_t y = (uint32_t)band * RASTER_BAND; y < band_end(l, band); y++)
            write_row(job, y, x, tile_end(l, x), cursors);
}

void shade_list_write(const shade_list *l, gpu_listed *places)
{
    write_job job = { l, places };
    parallel_for(l->bands, write_band, &job);
}

// ---- Pictures ------------------------------------------------------------------------

typedef struct mix_job {
    const shade_list *list;
    const shade_mix *mix;
    bool direct;          // what is shaded is stored as it is
    uint8_t codes[CODES]; // sRGB, of half floats
} mix_job;

static uint8_t code_of(const mix_job *job, uint16_t half)
{
    return half & 0x8000 ? 0 : job->codes[half < CODES ? half : CODES - 1];
}

static void store(const mix_job *job, const float c[4], size_t at)
{
    if (job->mix->format == AG_FORMAT_RGBA32F) {
        memcpy((float *)job->mix->pixels + at * 4, c, 4 * sizeof *c);
        return;
    }
    uint8_t *out = (uint8_t *)job->mix->pixels + at * 4;
    for (int i = 0; i < 3; i++)
        out[i] = code_of(job, half_from_float_clamped(c[i]));
    out[3] = (uint8_t)(c[3] * 255 + 0.5f);
}

// From the mean of a pixel's surfaces to what is stored.
static void finish_pixel(const mix_job *job, float c[4], size_t at)
{
    const shade_mix *mix = job->mix;
    if (mix->sum) {
        for (int i = 0; i < 4; i++)
            c[i] = mix->sum[at][i] = (mix->first ? 0 : mix->sum[at][i]) + mix->weight * c[i];
        if (!mix->last)
            return;
    }
    if (mix->tone != GPU_TONE_LINEAR && c[3] > 0) {
        vec3 shown = display(mix->tone, vec3(c[0] / c[3], c[1] / c[3], c[2] / c[3]));
        for (int i = 0; i < 3; i++)
            c[i] = c[3] * shown[i];
    }
    float open = 1 - c[3];
    for (int i = 0; i < 4; i++)
        c[i] += open * mix->backdrop[i];
    store(job, c, at);
}

static void add(float to[4], const float c[4], float weight)
{
    for (int i = 0; i < 4; i++)
        to[i] += weight * c[i];
}

// The mean of a pixel's surfaces; `cursors` move past what is read.
static void mix_pixel(const mix_job *job, uint32_t x, uint32_t y, uint32_t *cursors, float sum[4])
{
    const shade_list *l = job->list;
    parts p = parts_of(l, ids_of(l, x, y));
    for (int i = 0; i < p.count; i++) {
        const shade_source *source = source_of(l, p.id[i]);
        float weight = (float)p.weight[i] / (float)l->samples, color[4];
        if (job->mix->background && p.id[i] == NOTHING) {
            float run[8][4];
            panorama_colors(job->mix->background, x, y, 1, run);
            add(sum, run[0], weight);
            continue;
        }
        if (source->list == l->list_count) {
            add(sum, source->color, weight);
            continue;
        }
        const uint16_t *half = job->mix->colors[cursors[source->list]++];
        for (int k = 0; k < 4; k++)
            color[k] = half_to_float(half[k]);
        add(sum, color, weight);
    }
}

// How many pixels from x on and before `to` show nothing.
static uint32_t count_empty(const shade_list *l, uint32_t x, uint32_t to, uint32_t y)
{
    uint32_t end = x;
    while (end < to && is_empty(l, ids_of(l, end, y)))
        end++;
    return end - x;
}

static void mix_background(const mix_job *job, uint32_t x, uint32_t y, uint32_t count)
{
    const shade_mix *mix = job->mix;
    size_t at = (size_t)y * job->list->width + x;
    if (job->direct) {
        uint8_t run[PANORAMA_RUN][4];
        panorama_codes(mix->background, x, y, count, job->codes, run);
        memcpy((uint8_t *)mix->pixels + at * 4, run, count * sizeof *run);
        return;
    }
    float run[PANORAMA_RUN][4];
    panorama_colors(mix->background, x, y, count, run);
    for (uint32_t i = 0; i < count; i++)
        finish_pixel(job, run[i], at + i);
}

// The pixels [from, to) of a row.
static void mix_row(const mix_job *job, uint32_t y, uint32_t from, uint32_t to, uint32_t *cursors)
{
    const shade_list *l = job->list;
    const shade_mix *mix = job->mix;
    size_t texel = mix->format == AG_FORMAT_RGBA8 ? 4 : 16;
    const shade_source *before = NULL; // that alone gave the pixel before, known beforehand
    for (uint32_t x = from; x < to; x++) {
        const uint32_t *ids = ids_of(l, x, y);
        size_t at = (size_t)y * l->width + x;
        const shade_source *source = is_whole(l, ids) ? source_of(l, ids[0]) : NULL;
        uint32_t empty = mix->background ? count_empty(l, x, to, y) : 0;
        if (empty) {
            mix_background(job, x, y, empty);
            before = NULL;
            x += empty - 1;
            continue;
        }
        if (source && source == before) {
            memcpy((char *)mix->pixels + at * texel, (char *)mix->pixels + (at - 1) * texel, texel);
            continue;
        }
        bool listed = source && source->list < l->list_count;
        before = listed || mix->sum ? NULL : source;
        if (job->direct && listed) {
            const uint16_t *half = mix->colors[cursors[source->list]++];
            const uint8_t code[4] = { code_of(job, half[0]), code_of(job, half[1]),
                                      code_of(job, half[2]), 255 };
            memcpy((uint8_t *)mix->pixels + at * 4, code, 4);
            continue;
        }
        float sum[4] = { 0 };
        mix_pixel(job, x, y, cursors, sum);
        finish_pixel(job, sum, at);
    }
}

static void mix_band(void *context, size_t band)
{
    const mix_job *job = context;
    const shade_list *l = job->list;
    uint32_t cursors[SHADE_LISTS_MAX + 1];
    memcpy(cursors, cursors_of(l, band), (l->list_count + 1) * sizeof *cursors);
    for (uint32_t x = 0; x < l->width; x += TILE)
        for (uint32_t y = (uint32_t)band * RASTER_BAND; y < band_end(l, band); y++)
            mix_row(job, y, x, tile_end(l, x), cursors);
}

void shade_list_mix(const shade_list *l, const shade_mix *mix)
{
    mix_job job = { .list = l, .mix = mix };
    job.direct = mix->format == AG_FORMAT_RGBA8 && mix->tone == GPU_TONE_LINEAR && !mix->sum;
    srgb_encoder encoder;
    srgb_encoder_init(&encoder);
    for (uint32_t i = 0; i < CODES; i++)
        job.codes[i] = srgb_encode(&encoder, half_to_float((uint16_t)i));
    parallel_for(l->bands, mix_band, &job);
}
