// What is drawn, and in which order.
#include "render/draws.h"

#include "base/log.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// An instance on its way into the list.
typedef struct candidate {
    uint32_t group; // alpha mode; opaque, cut-out, blended
    int32_t slice;  // of depth: nearer ones are smaller; 0 where the order is exact
    uint32_t mesh, material;
    float depth; // m, along the line of sight
    uint32_t instance;
    uint8_t mirrored, side; // side: 1 = back faces, 2 = front faces, 0 = as the material says
} candidate;

typedef struct box {
    float center[3], half[3];
} box;

// The world-space box of a mesh's box under an affine matrix (Arvo 1990).
static box transform_box(const scene_mesh *mesh, const float world[16])
{
    box out;
    for (int i = 0; i < 3; i++) {
        out.center[i] = world[12 + i];
        out.half[i] = 0;
        for (int k = 0; k < 3; k++) {
            float m = world[k * 4 + i];
            out.center[i] += m * 0.5f * (mesh->min[k] + mesh->max[k]);
            out.half[i] += fabsf(m) * 0.5f * (mesh->max[k] - mesh->min[k]);
        }
    }
    return out;
}

static float support(const box *b, const float n[3])
{
    return fabsf(n[0]) * b->half[0] + fabsf(n[1]) * b->half[1] + fabsf(n[2]) * b->half[2];
}

static float along(const view *v, const box *b, const float axis[3])
{
    float sum = 0;
    for (int i = 0; i < 3; i++)
        sum += (b->center[i] - v->eye[i]) * axis[i];
    return sum;
}

// False when the box is wholly outside one of the view's planes.
static bool may_be_seen(const view *v, const box *b)
{
    float depth = along(v, b, v->forward);
    if (depth + support(b, v->forward) < v->near_m || depth - support(b, v->forward) > v->far_m)
        return false;
    const float *axes[2] = { v->right, v->up }, half[2] = { v->half_x, v->half_y };
    for (int a = 0; a < 2; a++) {
        float x = along(v, b, axes[a]);
        if (v->orthographic) {
            if (fabsf(x) - support(b, axes[a]) > half[a])
                return false;
            continue;
        }
        for (float sign = -1; sign <= 1; sign += 2) {
            float n[3]; // normal of the side plane, pointing out
            for (int i = 0; i < 3; i++)
                n[i] = sign * axes[a][i] - half[a] * v->forward[i];
            if (sign * x - half[a] * depth > support(b, n))
                return false;
        }
    }
    return true;
}

static bool is_mirrored(const float w[16])
{
    return w[0] * (w[5] * w[10] - w[6] * w[9]) - w[4] * (w[1] * w[10] - w[2] * w[9]) +
               w[8] * (w[1] * w[6] - w[2] * w[5]) <
           0;
}

static int compare(const void *a, const void *b)
{
    const candidate *x = a, *y = b;
#define BY(field)                                                                                  \
    if (x->field != y->field)                                                                      \
    return x->field < y->field ? -1 : 1
    BY(group);
    if (x->group == AG_ALPHA_BLEND) {
        if (x->depth != y->depth)
            return x->depth > y->depth ? -1 : 1;
        BY(instance);
        BY(side);
        return 0;
    }
    BY(slice);
    BY(material);
    BY(mesh);
    BY(mirrored);
    BY(depth);
    BY(instance);
#undef BY
    return 0;
}

// Slices of depth, each 1.3 times as far as the one before: near enough to front to back
// for the depth test, coarse enough to gather instances.
static int32_t slice_of(const view *v, float nearest)
{
    float slice = log2f(fmaxf(nearest, v->near_m) / v->near_m) * 2.6f;
    return slice < 1000 ? (int32_t)slice : 1000; // a depth that overflows is the last one
}

// Candidates of everything that may be seen; how many comes back.
static uint32_t gather(const ag_scene *scene, const view *v, candidate *list)
{
    uint32_t count = 0;
    for (size_t i = 0; i < scene->instances_count; i++) {
        const scene_instance *instance = &scene->instances[i];
        const scene_mesh *mesh = &scene->meshes[instance->mesh];
        const ag_material_desc *material = &scene->materials[instance->material];
        box b = transform_box(mesh, instance->world);
        if (!mesh->index_count || !may_be_seen(v, &b))
            continue;
        candidate c = {
            .group = material->alpha_mode,
            .mesh = instance->mesh,
            .material = instance->material,
            .depth = along(v, &b, v->forward),
            .instance = (uint32_t)i,
            .mirrored = is_mirrored(instance->world),
        };
        if (!v->orthographic)
            c.slice = slice_of(v, c.depth - support(&b, v->forward));
        if (c.group == AG_ALPHA_BLEND && material->double_sided) {
            c.side = 1;
            list[count++] = c;
            c.side = 2;
        }
        list[count++] = c;
    }
    return count;
}

static VkCullModeFlags cull_mode(const candidate *c, const ag_material_desc *material)
{
    switch (c->side) {
    case 1: return VK_CULL_MODE_FRONT_BIT;
    case 2: return VK_CULL_MODE_BACK_BIT;
    default: return material->double_sided ? VK_CULL_MODE_NONE : VK_CULL_MODE_BACK_BIT;
    }
}

static void append(const ag_scene *scene, const candidate *c, draws *d)
{
    const float *w = scene->instances[c->instance].world;
    gpu_instance *instance = &d->instances[d->instance_count];
    for (int r = 0; r < 3; r++)
        instance->rows[r] = (float4) { w[r], w[4 + r], w[8 + r], w[12 + r] };
    d->triangles += scene->meshes[c->mesh].index_count / 3;

    VkCullModeFlags cull = cull_mode(c, &scene->materials[c->material]);
    draw *last = d->count ? &d->items[d->count - 1] : NULL;
    if (last && last->mesh == c->mesh && last->material == c->material &&
        last->mirrored == (c->mirrored != 0) && last->cull == cull)
        last->instance_count++;
    else
        d->items[d->count++] = (draw) { .mesh = c->mesh,
                                        .material = c->material,
                                        .first_instance = d->instance_count,
                                        .instance_count = 1,
                                        .mirrored = c->mirrored,
                                        .cull = cull };
    d->instance_count++;
    if (c->group != AG_ALPHA_BLEND)
        d->opaque_count = d->count;
}

ag_status draws_make(const ag_scene *scene, const view *v, draws *d)
{
    *d = (draws) { 0 };
    size_t most = scene->instances_count * 2 + 1; // double-sided blending draws twice
    candidate *list = calloc(most, sizeof *list);
    d->items = calloc(most, sizeof *d->items);
    d->instances = calloc(most, sizeof *d->instances);
    if (!list || !d->items || !d->instances || most > UINT32_MAX) {
        free(list);
        draws_finish(d);
        return log_fail(&scene->log, AG_ERROR_MEMORY, "no memory to draw %zu instances",
                        scene->instances_count);
    }
    uint32_t count = gather(scene, v, list);
    qsort(list, count, sizeof *list, compare);
    for (uint32_t i = 0; i < count; i++)
        append(scene, &list[i], d);
    free(list);
    return AG_OK;
}

void draws_finish(draws *d)
{
    free(d->items);
    free(d->instances);
    *d = (draws) { 0 };
}
