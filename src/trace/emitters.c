// Triangles that shine.
//
// They are drawn by their power, area times mean emission, and then evenly over their area.
#include "trace/emitters.h"

#include "base/log.h"

#include <stdlib.h>

typedef struct triangle {
    vec3 a, b, c;
} triangle;

static triangle triangle_of(const world_instance *i, uint32_t index)
{
    const uint32_t *at = i->mesh->indices + 3 * (size_t)index;
    const scene_vertex *v = i->mesh->vertices;
    return (triangle) { world_point(i, v[at[0]].position), world_point(i, v[at[1]].position),
                        world_point(i, v[at[2]].position) };
}

// Twice the area, along the front.
static vec3 area_of(const world_instance *i, const triangle *t)
{
    return i->flip * cross(t->b - t->a, t->c - t->a);
}

static bool shines(const world_instance *i)
{
    const float *e = i->material->emissive;
    return !i->material->unlit && (e[0] > 0 || e[1] > 0 || e[2] > 0);
}

// The texture's mean over a triangle by a few places, and a little for what they miss.
static float brightness(const world *w, const world_instance *i, uint32_t index)
{
    static const float places[7][2] = { { 1 / 3.f, 1 / 3.f }, { .6f, .2f },  { .2f, .6f },
                                        { .2f, .2f },         { .1f, .45f }, { .45f, .1f },
                                        { .45f, .45f } };
    const float *e = i->material->emissive;
    const texture_use *map = &i->textures->emissive;
    float factor = max(e[0], max(e[1], e[2])), sum = 0;
    if (!map->pixels)
        return factor;
    const uint32_t *at = i->mesh->indices + 3 * (size_t)index;
    for (int k = 0; k < 7; k++) {
        const float weight[3] = { 1 - places[k][0] - places[k][1], places[k][0], places[k][1] };
        vec2 uv[2] = { { 0, 0 }, { 0, 0 } };
        for (int set = 0; set < 2; set++)
            for (int c = 0; c < 3; c++) {
                const float *of = i->mesh->vertices[at[c]].uv[set];
                uv[set] += weight[c] * vec2(of[0], of[1]);
            }
        vec4 texel = texture_read_color(map, uv, w->decode);
        sum += max(texel[0], max(texel[1], texel[2])) / 7;
    }
    return factor * (sum + 0.01f);
}

static size_t count_all(const world *w)
{
    size_t count = 0;
    for (size_t i = 0; i < w->instance_count; i++)
        if (shines(&w->instances[i]))
            count += w->instances[i].mesh->index_count / 3;
    return count;
}

static void add_instance(emitters *e, size_t index, double *total)
{
    const world_instance *i = &e->world->instances[index];
    e->first[index] = (uint32_t)e->count;
    for (uint32_t t = 0; t < i->mesh->index_count / 3; t++) {
        triangle corners = triangle_of(i, t);
        vec3 area = area_of(i, &corners);
        float size = sqrtf(dot(area, area));
        if (isfinite(size))
            *total += (double)(size * brightness(e->world, i, t));
        e->instance[e->count] = (uint32_t)index;
        e->triangle[e->count] = t;
        e->sums[++e->count] = (float)*total;
    }
}

ag_status emitters_init(const world *w, emitters *e)
{
    *e = (emitters) { .world = w };
    size_t count = count_all(w);
    if (!count)
        return AG_OK;
    e->instance = malloc(count * sizeof *e->instance);
    e->triangle = malloc(count * sizeof *e->triangle);
    e->sums = malloc((count + 1) * sizeof *e->sums);
    e->first = malloc(w->instance_count * sizeof *e->first);
    if (!e->instance || !e->triangle || !e->sums || !e->first || count > UINT32_MAX) {
        emitters_finish(e);
        return log_fail(&w->log, AG_ERROR_MEMORY, "no memory for %zu triangles that shine", count);
    }
    double total = 0;
    e->sums[0] = 0;
    for (size_t i = 0; i < w->instance_count; i++) {
        e->first[i] = UINT32_MAX;
        if (shines(&w->instances[i]))
            add_instance(e, i, &total);
    }
    return AG_OK;
}

void emitters_finish(emitters *e)
{
    free(e->instance);
    free(e->triangle);
    free(e->sums);
    free(e->first);
    *e = (emitters) { 0 };
}

static size_t find(const float *sums, size_t count, float x)
{
    size_t low = 0, high = count;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (sums[middle] <= x)
            low = middle;
        else
            high = middle;
    }
    return low;
}

// Per solid angle, of a place that was drawn by area: `area` twice the triangle's, along its front.
static float density_of(const emitters *e, size_t index, vec3 area, vec3 direction, float distance)
{
    float chance = (e->sums[index + 1] - e->sums[index]) / e->sums[e->count];
    float seen = 0.5f * fabsf(dot(area, direction)); // area times cosine
    return seen > 0 ? chance * distance * distance / seen : 0;
}

bool emitters_sample(const emitters *e, vec3 from, float pick, vec2 u, emitter_found *found)
{
    if (!e->count || !(e->sums[e->count] > 0))
        return false;
    size_t index = find(e->sums, e->count, pick * e->sums[e->count]);
    const world_instance *i = &e->world->instances[e->instance[index]];
    triangle t = triangle_of(i, e->triangle[index]);
    // Heitz 2019, "A Low-Distortion Map Between Triangle and Square".
    float s = u[0], v = u[1];
    if (v > s) {
        s *= 0.5f;
        v -= s;
    } else {
        v *= 0.5f;
        s -= v;
    }
    vec3 area = area_of(i, &t), to = (1 - s - v) * t.a + s * t.b + v * t.c - from;
    float distance = sqrtf(dot(to, to));
    if (!(distance > 0))
        return false;
    vec3 direction = to / distance;
    *found = (emitter_found) {
        .direction = direction,
        .distance = distance,
        .density = density_of(e, index, area, direction, distance),
        .at = { .instance = i,
                .triangle = e->triangle[index],
                .distance = distance,
                .u = s,
                .v = v,
                .normal = area },
    };
    return found->density > 0;
}

float emitters_density(const emitters *e, const hit *h, vec3 direction)
{
    if (!e->count)
        return 0;
    uint32_t first = e->first[h->instance - e->world->instances];
    if (first == UINT32_MAX)
        return 0;
    triangle t = triangle_of(h->instance, h->triangle);
    return density_of(e, first + h->triangle, area_of(h->instance, &t), direction, h->distance);
}
