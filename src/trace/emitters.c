// Triangles that shine.
//
// They are drawn by their power, area times mean emission, and then evenly over their area.
#include "trace/emitters.h"

#include "base/log.h"
#include "base/threads.h"

#include <stdlib.h>

static bool shines(const world_instance *i)
{
    const float *e = i->material->emissive;
    return !i->material->unlit && (e[0] > 0 || e[1] > 0 || e[2] > 0);
}

static emitter emitter_of(const world *w, uint32_t instance, uint32_t index)
{
    const world_instance *i = &w->instances[instance];
    const uint32_t *at = i->mesh->indices + 3 * (size_t)index;
    const scene_vertex *v = i->mesh->vertices;
    emitter e = { .a = world_point(i, v[at[0]].position),
                  .b = world_point(i, v[at[1]].position),
                  .c = world_point(i, v[at[2]].position),
                  .instance = instance,
                  .triangle = index };
    e.area = i->flip * cross(e.b - e.a, e.c - e.a);
    return e;
}

// ---- How bright ------------------------------------------------------------------

// An emissive texture in blocks: the mean of each, 0 only where all of it is dark.
enum { BLOCK = 16 }; // texels
typedef struct blocks {
    const texture_use *map;
    const float *decode;
    int columns, rows;
    float *mean; // [rows][columns]; NULL: no texture
} blocks;

static void fill_blocks(void *context, size_t row)
{
    const blocks *b = context;
    int top = (int)row * BLOCK, bottom = top + BLOCK;
    bottom = bottom < b->map->height ? bottom : b->map->height;
    for (int column = 0; column < b->columns; column++) {
        int left = column * BLOCK, right = left + BLOCK;
        right = right < b->map->width ? right : b->map->width;
        float sum = 0;
        for (int y = top; y < bottom; y++)
            for (int x = left; x < right; x++) {
                const uint8_t *p = b->map->pixels +
                                   b->map->stride * ((size_t)y * (size_t)b->map->width + (size_t)x);
                uint8_t most = p[0] > p[1] ? p[0] : p[1];
                sum += b->decode[most > p[2] ? most : p[2]];
            }
        b->mean[row * (size_t)b->columns + (size_t)column] =
            sum / (float)((bottom - top) * (right - left));
    }
}

static bool blocks_init(const world *w, const texture_use *map, blocks *b)
{
    *b = (blocks) { .map = map, .decode = w->decode };
    if (!map->pixels)
        return true;
    b->columns = (map->width + BLOCK - 1) / BLOCK;
    b->rows = (map->height + BLOCK - 1) / BLOCK;
    b->mean = malloc((size_t)b->columns * (size_t)b->rows * sizeof *b->mean);
    if (b->mean)
        parallel_for((size_t)b->rows, fill_blocks, b);
    return b->mean != NULL;
}

// Blocks that coordinates between two may touch, a texel to either side; all where they repeat.
static void range_of(float low, float high, int size, int count, uint8_t wrap, int range[2])
{
    float from = floorf((low * (float)size - 1.5f) / BLOCK);
    float to = floorf((high * (float)size + 1.5f) / BLOCK);
    range[0] = 0;
    range[1] = count - 1;
    if (from >= 0 && to < (float)count) {
        range[0] = (int)from;
        range[1] = (int)to;
    } else if (wrap == AG_WRAP_CLAMP) {
        range[0] = (int)clamp(from, 0.0f, (float)(count - 1));
        range[1] = (int)clamp(to, 0.0f, (float)(count - 1));
    }
}

// The mean under a triangle, by the blocks that its box touches.
static float brightness(const blocks *b, const scene_mesh *mesh, uint32_t index)
{
    if (!b->mean)
        return 1;
    const uint32_t *at = mesh->indices + 3 * (size_t)index;
    vec2 low = { INFINITY, INFINITY }, high = -low;
    for (int c = 0; c < 3; c++) {
        const float *from = mesh->vertices[at[c]].uv[b->map->uv_set];
        const float *u = b->map->u, *v = b->map->v;
        const float place[2] = { u[0] * from[0] + u[1] * from[1] + u[2],
                                 v[0] * from[0] + v[1] * from[1] + v[2] };
        for (int i = 0; i < 2; i++) {
            low[i] = min(low[i], place[i]);
            high[i] = max(high[i], place[i]);
        }
    }
    int x[2], y[2];
    range_of(low[0], high[0], b->map->width, b->columns, b->map->wrap_u, x);
    range_of(low[1], high[1], b->map->height, b->rows, b->map->wrap_v, y);
    float sum = 0;
    for (int row = y[0]; row <= y[1]; row++)
        for (int column = x[0]; column <= x[1]; column++)
            sum += b->mean[(size_t)row * (size_t)b->columns + (size_t)column];
    return sum / (float)((x[1] - x[0] + 1) * (y[1] - y[0] + 1));
}

// ---- The list --------------------------------------------------------------------

static ag_status no_memory(const world *w)
{
    return log_fail(&w->log, AG_ERROR_MEMORY, "no memory for the triangles that shine");
}

typedef struct listing {
    size_t capacity;
    double total;
    blocks blocks; // of the instance that is listed
} listing;

static ag_status add_triangle(emitters *e, listing *l, uint32_t instance, uint32_t index)
{
    const world_instance *i = &e->world->instances[instance];
    emitter made = emitter_of(e->world, instance, index);
    float size = sqrtf(dot(made.area, made.area));
    const float *factor = i->material->emissive;
    // Bounded: the sum of all stays finite.
    float power = isfinite(size) ? min(size * max(factor[0], max(factor[1], factor[2])), 1e29f) : 0;
    if (power > 0)
        power *= brightness(&l->blocks, i->mesh, index);
    if (!(power > 0))
        return AG_OK;
    if (e->count == l->capacity) {
        size_t capacity = l->capacity ? 2 * l->capacity : 64;
        emitter *grown = aligned_alloc(_Alignof(emitter), capacity * sizeof *grown);
        float *sums = realloc(e->sums, (capacity + 1) * sizeof *sums);
        e->sums = sums ? sums : e->sums;
        if (!grown || !sums) {
            free(grown);
            return no_memory(e->world);
        }
        if (e->count)
            memcpy(grown, e->all, e->count * sizeof *grown);
        free(e->all);
        e->all = grown;
        l->capacity = capacity;
    }
    e->sums[0] = 0;
    e->where[instance][index] = (uint32_t)e->count;
    e->all[e->count++] = made;
    l->total += (double)power;
    e->sums[e->count] = (float)l->total;
    return AG_OK;
}

static ag_status add_instance(emitters *e, listing *l, uint32_t instance)
{
    uint32_t triangles = e->world->instances[instance].mesh->index_count / 3;
    e->where[instance] = malloc(triangles * sizeof(uint32_t));
    if (!e->where[instance])
        return no_memory(e->world);
    memset(e->where[instance], 0xff, triangles * sizeof(uint32_t));
    if (!blocks_init(e->world, &e->world->instances[instance].textures->emissive, &l->blocks))
        return no_memory(e->world);
    ag_status status = AG_OK;
    for (uint32_t t = 0; t < triangles && !status; t++)
        status = add_triangle(e, l, instance, t);
    free(l->blocks.mean);
    return status;
}

static float power_of(const emitters *e, size_t index)
{
    return e->sums[index + 1] - e->sums[index];
}

static vec3 middle(const emitter *t)
{
    return (t->a + t->b + t->c) / 3;
}

static void set_center(emitters *e)
{
    if (!e->count)
        return;
    vec3 sum = { 0, 0, 0, 0 };
    for (size_t i = 0; i < e->count; i++)
        sum += power_of(e, i) / e->sums[e->count] * middle(&e->all[i]);
    e->center = sum;
    for (size_t i = 0; i < e->count; i++) {
        vec3 off = middle(&e->all[i]) - e->center;
        e->spread2 += power_of(e, i) / e->sums[e->count] * dot(off, off);
    }
}

// guides[k] = the last item that begins at or before the share k / count of the sum.
static ag_status set_guides(emitters *e)
{
    size_t item = 0;
    e->guides = malloc((e->count + 1) * sizeof *e->guides);
    if (!e->guides)
        return no_memory(e->world);
    for (size_t k = 0; e->count && k <= e->count; k++) {
        float from = e->sums[e->count] * ((float)k / (float)e->count);
        while (item < e->count - 1 && e->sums[item + 1] <= from)
            item++;
        e->guides[k] = (uint32_t)item;
    }
    return AG_OK;
}

ag_status emitters_init(const world *w, emitters *e)
{
    *e = (emitters) { .world = w };
    e->where = calloc(w->instance_count + 1, sizeof *e->where);
    if (!e->where)
        return no_memory(w);
    listing l = { 0 };
    ag_status status = AG_OK;
    for (size_t i = 0; i < w->instance_count && !status; i++)
        if (shines(&w->instances[i]))
            status = add_instance(e, &l, (uint32_t)i);
    if (!status)
        status = set_guides(e);
    set_center(e);
    if (status)
        emitters_finish(e);
    return status;
}

void emitters_finish(emitters *e)
{
    for (size_t i = 0; e->where && i < e->world->instance_count; i++)
        free(e->where[i]);
    free(e->where);
    free(e->all);
    free(e->sums);
    free(e->guides);
    *e = (emitters) { 0 };
}

// Power is twice area times radiance; the mean of a cosine that counts on one side is 1/4.
float emitters_irradiance(const emitters *e, vec3 at)
{
    vec3 to = e->center - at;
    return e->count ? e->sums[e->count] / (32 * (dot(to, to) + e->spread2)) : 0;
}

// ---- Drawing ---------------------------------------------------------------------

// The item at a share of the sum.  Guides are rounded as the share is not: searched from one
// step before.
static size_t find(const emitters *e, float share)
{
    float x = share * e->sums[e->count];
    size_t step = (size_t)(share * (float)e->count);
    size_t low = e->guides[step ? step - 1 : 0];
    size_t high = step + 2 <= e->count ? e->guides[step + 2] + 1 : e->count;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (e->sums[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

// Per solid angle, of a place that was drawn by area.
static float density_of(const emitters *e, size_t index, vec3 direction, float distance)
{
    float chance = power_of(e, index) / e->sums[e->count];
    float seen = 0.5f * fabsf(dot(e->all[index].area, direction)); // area times cosine
    return seen > 0 ? chance * distance * distance / seen : 0;
}

// Heitz 2019, "A Low-Distortion Map Between Triangle and Square".
static vec2 triangle_point(vec2 u)
{
    float s = u[0], v = u[1];
    return v > s ? vec2(0.5f * s, v - 0.5f * s) : vec2(s - 0.5f * v, 0.5f * v);
}

bool emitters_sample(const emitters *e, vec3 from, float pick, vec2 u, emitter_found *found)
{
    if (!e->count)
        return false;
    size_t index = find(e, pick);
    const emitter *t = &e->all[index];
    vec2 at = triangle_point(u);
    vec3 to = (1 - at[0] - at[1]) * t->a + at[0] * t->b + at[1] * t->c - from;
    float distance = sqrtf(dot(to, to));
    if (!(distance > 0))
        return false;
    *found = (emitter_found) {
        .direction = to / distance,
        .distance = distance,
        .density = density_of(e, index, to / distance, distance),
        .at = { .instance = &e->world->instances[t->instance],
                .triangle = t->triangle,
                .distance = distance,
                .u = at[0],
                .v = at[1],
                .normal = t->area },
    };
    return found->density > 0;
}

float emitters_density(const emitters *e, const hit *h, vec3 direction)
{
    const uint32_t *where = e->where[h->instance - e->world->instances];
    if (!where || where[h->triangle] == UINT32_MAX)
        return 0;
    return density_of(e, where[h->triangle], direction, h->distance);
}
