// Which triangle each sample of a picture shows, found by the host.
#include "render/raster.h"

#include "base/array.h"
#include "base/threads.h"
#include "physics/lang.glsl"

#include <stdatomic.h>
#include <stdlib.h>

enum {
    CHUNK = 8192, // triangles that one thread takes at a time
    LANES = 4,    // samples that are drawn together: those of a pixel, or four pixels
};

// On the screen: px from the upper left corner, and depth.
typedef struct triangle {
    float x[3], y[3], z[3];
    uint32_t id;
} triangle;

// Part of an object.
typedef struct raster_part {
    const raster_object *object;
    uint32_t first, count; // triangles
} raster_part;

// Neighbours in drawing order, CHUNK triangles or one part.
typedef struct raster_chunk {
    const raster_part *parts; // of the raster's
    size_t part_count;
    triangle *triangles;
    size_t count, capacity;
    uint32_t *order; // of triangles, band after band
    size_t order_capacity;
    uint32_t *bands; // [bands + 1]: where a band starts in `order`
    size_t bands_capacity;
} raster_chunk;

// What a worker needs for the part that it is at.
typedef struct raster_scratch {
    struct projected *vertices;
    size_t capacity;
} raster_scratch;

typedef struct begin_job {
    raster *raster;
    atomic_bool failed;
} begin_job;

// ---- Triangles -----------------------------------------------------------------

typedef struct projected {
    vec4 clip;
    float x, y, z;
    bool inside; // of the near plane
} projected;

static projected project(const raster *r, vec4 clip)
{
    float inverse = 1 / clip[3];
    return (projected) { clip, (clip[0] * inverse * 0.5f + 0.5f) * (float)r->width,
                         (clip[1] * inverse * 0.5f + 0.5f) * (float)r->height, clip[2] * inverse,
                         clip[2] <= clip[3] };
}

// Rows [first, last] that a triangle may touch; none where last < first.
static void rows_of(const raster *r, const triangle *t, int *first, int *last)
{
    float low = min(min(t->y[0], t->y[1]), t->y[2]), high = max(max(t->y[0], t->y[1]), t->y[2]);
    float left = min(min(t->x[0], t->x[1]), t->x[2]), right = max(max(t->x[0], t->x[1]), t->x[2]);
    *first = 0;
    *last = -1;
    if (!(high > 0 && low < (float)r->height && right > 0 && left < (float)r->width))
        return;
    *first = low > 0 ? (int)low : 0;
    *last = high < (float)r->height ? (int)high : (int)r->height - 1;
}

static bool add(const raster *r, raster_chunk *c, const raster_object *o, uint32_t id,
                const projected *p0, const projected *p1, const projected *p2)
{
    float area = (p1->x - p0->x) * (p2->y - p0->y) - (p2->x - p0->x) * (p1->y - p0->y);
    if (!(area < 0 ? o->left : area > 0 && o->right)) // y points down
        return true;
    triangle t = { { p0->x, p1->x, p2->x }, { p0->y, p1->y, p2->y }, { p0->z, p1->z, p2->z }, id };
    int first, last;
    rows_of(r, &t, &first, &last);
    if (last < first)
        return true;
    if (!array_reserve(&c->triangles, &c->capacity, c->count + 1, sizeof t))
        return false;
    c->triangles[c->count++] = t;
    for (int band = first / RASTER_BAND; band <= last / RASTER_BAND; band++)
        c->bands[band]++;
    return true;
}

// Where the edge from a to b meets the near plane.
static projected cut(const raster *r, const projected *a, const projected *b)
{
    float out = a->clip[2] - a->clip[3], in = b->clip[3] - b->clip[2];
    return project(r, a->clip + (b->clip - a->clip) * (out / (out + in)));
}

// What of a triangle is before the near plane: three or four corners.
static bool add_cut(const raster *r, raster_chunk *c, const raster_object *o, uint32_t id,
                    const projected *const p[3])
{
    projected kept[4];
    int count = 0;
    for (int i = 0; i < 3; i++) {
        const projected *a = p[i], *b = p[(i + 1) % 3];
        if (a->inside)
            kept[count++] = *a;
        if (a->inside && !b->inside)
            kept[count++] = cut(r, b, a);
        else if (!a->inside && b->inside)
            kept[count++] = cut(r, a, b);
    }
    return (count < 3 || add(r, c, o, id, &kept[0], &kept[1], &kept[2])) &&
           (count < 4 || add(r, c, o, id, &kept[0], &kept[2], &kept[3]));
}

static void index_range(const raster_part *p, uint32_t *first, uint32_t *last)
{
    const uint32_t *indices = p->object->indices + 3ul * p->first;
    *first = UINT32_MAX;
    *last = 0;
    for (uint32_t i = 0; i < 3 * p->count; i++) {
        *first = indices[i] < *first ? indices[i] : *first;
        *last = indices[i] > *last ? indices[i] : *last;
    }
}

// The vertices of a part; indices count from *first.
static bool project_part(const raster *r, raster_scratch *s, const raster_part *p, uint32_t *first)
{
    uint32_t last;
    index_range(p, first, &last);
    const raster_object *o = p->object;
    if (!array_reserve(&s->vertices, &s->capacity, last - *first + 1ul, sizeof *s->vertices))
        return false;
    vec4 column[4];
    for (int i = 0; i < 4; i++)
        column[i] = vec4(o->clip[i][0], o->clip[i][1], o->clip[i][2], o->clip[i][3]);
    for (uint32_t i = *first; i <= last; i++) {
        const float *v = (const float *)(const void *)((const char *)o->positions + i * o->stride);
        s->vertices[i - *first] =
            project(r, column[0] * v[0] + column[1] * v[1] + column[2] * v[2] + column[3]);
    }
    return true;
}

static bool add_part(const raster *r, raster_chunk *c, raster_scratch *s, const raster_part *p)
{
    uint32_t base;
    bool ok = project_part(r, s, p, &base);
    const projected *vertices = s->vertices;
    for (uint32_t i = p->first; i < p->first + p->count && ok; i++) {
        const uint32_t *corner = p->object->indices + 3ul * i;
        const projected *const v[3] = { vertices + (corner[0] - base),
                                        vertices + (corner[1] - base),
                                        vertices + (corner[2] - base) };
        uint32_t id = p->object->id + i;
        if (v[0]->inside && v[1]->inside && v[2]->inside)
            ok = add(r, c, p->object, id, v[0], v[1], v[2]);
        else
            ok = add_cut(r, c, p->object, id, v);
    }
    return ok;
}

// ---- Bands -----------------------------------------------------------------------

// From counts to an order.
static bool sort_bands(const raster *r, raster_chunk *c)
{
    uint32_t at = 0;
    for (uint32_t band = 0; band <= r->bands; band++) {
        uint32_t count = c->bands[band];
        c->bands[band] = at;
        at += count;
    }
    if (!array_reserve(&c->order, &c->order_capacity, at, sizeof *c->order))
        return false;
    for (size_t i = 0; i < c->count; i++) {
        int first, last;
        rows_of(r, &c->triangles[i], &first, &last);
        for (int band = first / RASTER_BAND; band <= last / RASTER_BAND; band++)
            c->order[c->bands[band]++] = (uint32_t)i;
    }
    for (uint32_t band = r->bands; band > 0; band--) // they have moved to their ends
        c->bands[band] = c->bands[band - 1];
    c->bands[0] = 0;
    return true;
}

static void begin_chunk(void *context, size_t index, unsigned worker)
{
    begin_job *job = context;
    const raster *r = job->raster;
    raster_chunk *c = &r->chunks[index];
    bool ok = array_reserve(&c->bands, &c->bands_capacity, r->bands + 1ul, sizeof *c->bands);
    if (ok)
        memset(c->bands, 0, (r->bands + 1ul) * sizeof *c->bands);
    for (size_t i = 0; i < c->part_count && ok; i++)
        ok = add_part(r, c, &r->scratch[worker], &c->parts[i]);
    if (!ok || !sort_bands(r, c))
        atomic_store(&job->failed, true);
}

// Room for `most` chunks of as many parts, and none in use.
static bool reserve_chunks(raster *r, size_t most)
{
    size_t before = r->chunk_capacity;
    if (!array_reserve(&r->parts, &r->part_capacity, most, sizeof *r->parts) ||
        !array_reserve(&r->chunks, &r->chunk_capacity, most, sizeof *r->chunks))
        return false;
    if (r->chunk_capacity > before)
        memset(r->chunks + before, 0, (r->chunk_capacity - before) * sizeof *r->chunks);
    for (size_t i = 0; i < r->chunk_capacity; i++)
        r->chunks[i].part_count = r->chunks[i].count = 0;
    r->chunk_count = 0;
    return true;
}

static bool reserve_scratch(raster *r)
{
    size_t before = r->scratch_capacity;
    if (!array_reserve(&r->depth, &r->depth_capacity, (size_t)r->workers * RASTER_BAND * r->pitch,
                       sizeof *r->depth) ||
        !array_reserve(&r->scratch, &r->scratch_capacity, r->workers, sizeof *r->scratch))
        return false;
    if (r->scratch_capacity > before)
        memset(r->scratch + before, 0, (r->scratch_capacity - before) * sizeof *r->scratch);
    return true;
}

// Objects in pieces of CHUNK triangles, gathered until they are as many.
static bool make_chunks(raster *r, const raster_object *objects, size_t count)
{
    size_t most = 0;
    for (size_t i = 0; i < count; i++)
        most += objects[i].triangle_count / CHUNK + 1;
    if (!reserve_chunks(r, most))
        return false;
    raster_part *parts = r->parts;
    uint32_t filled = CHUNK;
    for (size_t i = 0; i < count; i++)
        for (uint32_t first = 0; first < objects[i].triangle_count; first += CHUNK) {
            uint32_t left = objects[i].triangle_count - first, n = left < CHUNK ? left : CHUNK;
            if (filled + n > CHUNK) {
                r->chunks[r->chunk_count++].parts = parts;
                filled = 0;
            }
            *parts++ = (raster_part) { &objects[i], first, n };
            r->chunks[r->chunk_count - 1].part_count++;
            filled += n;
        }
    return true;
}

bool raster_begin(raster *r, uint32_t width, uint32_t height, uint32_t samples,
                  const raster_object *objects, size_t count)
{
    r->width = width;
    r->height = height;
    r->samples = samples;
    r->pitch = (width * samples + LANES - 1) / LANES * LANES;
    r->bands = (height + RASTER_BAND - 1) / RASTER_BAND;
    r->workers = threads_available();
    if (!reserve_scratch(r) || !make_chunks(r, objects, count))
        return false;
    begin_job job = { .raster = r };
    parallel_for_workers(r->workers, r->chunk_count, begin_chunk, &job);
    return !atomic_load(&job.failed);
}

void raster_finish(raster *r)
{
    for (size_t i = 0; i < r->chunk_capacity; i++) {
        free(r->chunks[i].triangles);
        free(r->chunks[i].order);
        free(r->chunks[i].bands);
    }
    for (size_t i = 0; i < r->scratch_capacity; i++)
        free(r->scratch[i].vertices);
    free(r->scratch);
    free(r->chunks);
    free(r->parts);
    free(r->depth);
    *r = (raster) { 0 };
}

// ---- Samples -----------------------------------------------------------------------

typedef float lanes __attribute__((vector_size(16)));
typedef int32_t lanes_int __attribute__((vector_size(16)));
typedef double lanes_double __attribute__((vector_size(32)));

// The rows of one band, in cells of LANES samples.
typedef struct canvas {
    lanes_int *ids;
    lanes *depth;
    int first_row, end_row;
    int cells;         // across
    int step;          // px from a cell to the next one
    lanes_double x, y; // of the samples in the first cell
} canvas;

// An edge from its upper end: two triangles that share it find the same x, and so neither
// cover a sample twice nor leave one out.
typedef struct edge {
    double x, y, slope;
} edge;

static edge edge_from(const triangle *t, int upper, int lower)
{
    double x = (double)t->x[upper], y = (double)t->y[upper];
    return (edge) { x, y, ((double)t->x[lower] - x) / ((double)t->y[lower] - y) };
}

static lanes_double edge_at(edge e, lanes_double y)
{
    return e.x + (y - e.y) * e.slope;
}

// Depth over the screen.
typedef struct plane {
    double x, y, z, dx, dy;
} plane;

static plane plane_of(const triangle *t)
{
    double x1 = (double)t->x[1] - (double)t->x[0], x2 = (double)t->x[2] - (double)t->x[0];
    double y1 = (double)t->y[1] - (double)t->y[0], y2 = (double)t->y[2] - (double)t->y[0];
    double z1 = (double)t->z[1] - (double)t->z[0], z2 = (double)t->z[2] - (double)t->z[0];
    double inverse = 1 / (x1 * y2 - x2 * y1);
    return (plane) { (double)t->x[0], (double)t->y[0], (double)t->z[0],
                     (z1 * y2 - z2 * y1) * inverse, (x1 * z2 - x2 * z1) * inverse };
}

// A triangle cut at the height of its middle corner, where the edge that goes all the way and
// the two others change.
typedef struct shape {
    edge whole, upper, lower;
    double top, middle, bottom;
    bool whole_is_left;
    plane depth;
} shape;

static shape shape_of(const triangle *t)
{
    const float *y = t->y;
    int top = y[0] <= y[1] ? (y[0] <= y[2] ? 0 : 2) : (y[1] <= y[2] ? 1 : 2);
    int bottom = y[2] >= y[1] ? (y[2] >= y[0] ? 2 : 0) : (y[1] >= y[0] ? 1 : 0);
    int middle = top == bottom ? top : 3 - top - bottom; // all on one line: nothing is drawn
    shape s = { .whole = edge_from(t, top, bottom),
                .upper = edge_from(t, top, middle),
                .lower = edge_from(t, middle, bottom),
                .top = (double)y[top],
                .middle = (double)y[middle],
                .bottom = (double)y[bottom],
                .depth = plane_of(t) };
    double across = s.whole.x + (s.middle - s.whole.y) * s.whole.slope;
    s.whole_is_left = across < (double)t->x[middle];
    return s;
}

static lanes_double choose(lanes_double x, lanes_double y, bool first)
{
    return first ? x : y;
}

// From one row of the screen to samples: from `left` on, before `right`.
static void fill(const canvas *c, const shape *s, int row, lanes_double left, lanes_double right,
                 uint32_t id)
{
    lanes from = __builtin_convertvector(left - c->x, lanes);
    lanes to = __builtin_convertvector(right - c->x, lanes);
    float low = min(min(from[0], from[1]), min(from[2], from[3]));
    float high = max(max(to[0], to[1]), max(to[2], to[3]));
    float end = (float)(c->cells * c->step);
    if (!(low < high && high > 0 && low < end))
        return;
    int first = low > 0 ? (int)low / c->step : 0;
    int last = high < end ? (int)high / c->step : c->cells - 1;
    double x = first * c->step;
    lanes_double at = s->depth.z + (c->x + x - s->depth.x) * s->depth.dx +
                      (c->y + row - s->depth.y) * s->depth.dy;
    lanes z = __builtin_convertvector(at, lanes), here = (lanes) { 0 } + (float)x;
    float dz = (float)(s->depth.dx * c->step), dx = (float)c->step;
    size_t cell = (size_t)(row - c->first_row) * (size_t)c->cells + (size_t)first;
    lanes *depth = c->depth + cell;
    lanes_int *ids = c->ids + cell, own = (lanes_int) { 0 } + (int32_t)id;
    for (int i = first; i <= last; i++, here += dx, z += dz, depth++, ids++) {
        lanes_int in = (here >= from) & (here < to) & (z >= *depth);
        *depth = (lanes)((in & (lanes_int)z) | (~in & (lanes_int)*depth));
        *ids = (in & own) | (~in & *ids);
    }
}

static void draw(const canvas *c, const triangle *t)
{
    shape s = shape_of(t);
    int row = s.top > c->first_row ? (int)s.top : c->first_row;
    int end = s.bottom < c->end_row ? (int)s.bottom + 1 : c->end_row;
    for (; row < end; row++) {
        lanes_double y = c->y + row;
        lanes_double a = edge_at(s.whole, y);
        // Above the middle, below it; nowhere above the top and below the bottom.
        lanes_double b = (lanes_double) { 0 }, u = edge_at(s.upper, y), l = edge_at(s.lower, y);
        for (int i = 0; i < LANES; i++) {
            b[i] = y[i] < s.middle ? u[i] : l[i];
            if (!(y[i] >= s.top && y[i] < s.bottom))
                b[i] = a[i];
        }
        fill(c, &s, row, choose(a, b, s.whole_is_left), choose(b, a, s.whole_is_left), t->id);
    }
}

void raster_band(const raster *r, uint32_t band, unsigned worker, uint32_t *ids)
{
    uint32_t first = band * RASTER_BAND, end = first + RASTER_BAND;
    end = end < r->height ? end : r->height;
    size_t count = (size_t)(end - first) * r->pitch;
    float *depth = r->depth + (size_t)worker * RASTER_BAND * r->pitch;
    canvas c = {
        .ids = (lanes_int *)(void *)ids,
        .depth = (lanes *)(void *)depth,
        .first_row = (int)first,
        .end_row = (int)end,
        .cells = (int)(r->pitch / LANES),
        .step = (int)(LANES / r->samples),
        .x = { 0.375, 0.875, 0.125, 0.625 },
        .y = { 0.125, 0.375, 0.625, 0.875 },
    };
    if (r->samples == 1) {
        c.x = (lanes_double) { 0.5, 1.5, 2.5, 3.5 };
        c.y = (lanes_double) { 0.5, 0.5, 0.5, 0.5 };
    }
    memset(depth, 0, count * sizeof *depth);
    memset(ids, 0xff, count * sizeof *ids); // RASTER_NONE
    for (size_t i = 0; i < r->chunk_count; i++) {
        const raster_chunk *chunk = &r->chunks[i];
        for (uint32_t k = chunk->bands[band]; k < chunk->bands[band + 1]; k++)
            draw(&c, &chunk->triangles[chunk->order[k]]);
    }
}
