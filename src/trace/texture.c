// A material's textures as a ray reads them.
#include "trace/texture.h"

#include "base/log.h"
#include "base/threads.h"
#include "image/image.h"

#include <math.h>
#include <stdlib.h>

// KHR_texture_transform, as src/render/materials.c has it.
static void set_transform(const ag_texture_use *from, texture_use *use)
{
    float x = from->scale[0], y = from->scale[1];
    float c = cosf(from->rotation_rad), s = sinf(from->rotation_rad);
    const float u[3] = { c * x, s * y, from->offset[0] };
    const float v[3] = { -s * x, c * y, from->offset[1] };
    memcpy(use->u, u, sizeof u);
    memcpy(use->v, v, sizeof v);
    use->uv_set = from->uv_set != 0;
}

static bool use_init(const ag_scene *scene, const ag_texture_use *from, texture_use *use)
{
    *use = (texture_use) { 0 };
    if (!from->texture.id)
        return true;
    const scene_texture *texture = &scene->textures[from->texture.id - 1];
    const ag_image *image = texture->image;
    use->pixels = image->pixels;
    use->stride = 4;
    use->width = (int)image->width;
    use->height = (int)image->height;
    use->wrap_u = (uint8_t)texture->desc.wrap_u;
    use->wrap_v = (uint8_t)texture->desc.wrap_v;
    use->nearest = texture->desc.mag == AG_FILTER_NEAREST;
    set_transform(from, use);
    return use->pixels != NULL;
}

enum { USES = 6 };
#define USES_OF(set)                                                                               \
    {                                                                                              \
        &(set)->base_color, &(set)->metallic_roughness, &(set)->normal, &(set)->emissive,          \
            &(set)->specular, &(set)->specular_color                                               \
    }

static void set_alike(texture_set *set)
{
    const texture_use *uses[USES] = USES_OF(set), *first = NULL;
    set->alike = true;
    for (size_t i = 0; i < USES; i++) {
        if (!uses[i]->pixels)
            continue;
        set->alike &= !first || texture_alike(first, uses[i]);
        first = uses[i];
    }
}

ag_status texture_set_init(const ag_scene *scene, const ag_material_desc *m, texture_set *set)
{
    bool there = use_init(scene, &m->base_color_texture, &set->base_color) &&
                 use_init(scene, &m->metallic_roughness_texture, &set->metallic_roughness) &&
                 use_init(scene, &m->normal_texture, &set->normal) &&
                 use_init(scene, &m->emissive_texture, &set->emissive) &&
                 use_init(scene, &m->specular_texture, &set->specular) &&
                 use_init(scene, &m->specular_color_texture, &set->specular_color);
    if (!there)
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "the scene's images were given to a renderer (ag_renderer_take): load the "
                        "scene again to trace it");
    set_alike(set);
    return AG_OK;
}

// ---- Weaving ---------------------------------------------------------------------

typedef struct weaving {
    const uint8_t *from[USES];
    size_t count, stride, width;
    uint8_t *to;
} weaving;

static void weave_row(void *context, size_t row)
{
    const weaving *w = context;
    for (size_t k = 0; k < w->count; k++) {
        const uint8_t *from = w->from[k] + 4 * row * w->width;
        uint8_t *to = w->to + w->stride * row * w->width + 4 * k;
        for (size_t x = 0; x < w->width; x++)
            memcpy(to + w->stride * x, from + 4 * x, 4);
    }
}

// The images of a set, each once; `lane[i]`: of use i.
static weaving weaving_of(texture_use *const use[USES], size_t lane[USES])
{
    weaving w = { .stride = 8 };
    for (size_t i = 0; i < USES; i++) {
        if (!use[i]->pixels)
            continue;
        size_t k = 0;
        while (k < w.count && w.from[k] != use[i]->pixels)
            k++;
        w.from[k] = use[i]->pixels;
        w.count = k == w.count ? k + 1 : w.count;
        lane[i] = k;
    }
    while (w.stride < 4 * w.count) // no texel lies in two lines of the cache
        w.stride *= 2;
    return w;
}

size_t texture_set_weave(texture_set *set, size_t limit)
{
    texture_use *const use[USES] = USES_OF(set);
    size_t lane[USES] = { 0 }, height = 0;
    weaving w = weaving_of(use, lane);
    if (!set->alike || w.count < 2)
        return 0;
    for (size_t i = 0; i < USES; i++)
        if (use[i]->pixels) {
            w.width = (size_t)use[i]->width;
            height = (size_t)use[i]->height;
        }
    size_t size = w.stride * w.width * height;
    w.to = size <= limit ? aligned_alloc(64, (size + 63) / 64 * 64) : NULL;
    if (!w.to)
        return 0;
    parallel_for(height, weave_row, &w);
    for (size_t i = 0; i < USES; i++)
        if (use[i]->pixels) {
            use[i]->pixels = w.to + 4 * lane[i];
            use[i]->stride = (uint32_t)w.stride;
        }
    set->woven = w.to;
    return size;
}

void texture_set_finish(texture_set *set)
{
    free(set->woven);
    set->woven = NULL;
}

// ---- Reading ---------------------------------------------------------------------

// Texel of a coordinate in texels.
static int wrapped(int i, int size, uint8_t wrap)
{
    switch (wrap) {
    case AG_WRAP_CLAMP: return i < 0 ? 0 : i < size ? i : size - 1;
    case AG_WRAP_MIRROR:
        i %= 2 * size;
        i += i < 0 ? 2 * size : 0;
        return i < size ? i : 2 * size - 1 - i;
    default: break;
    }
    if ((unsigned)i < (unsigned)size)
        return i;
    i %= size;
    return i < 0 ? i + size : i;
}

// Beyond this many repetitions there are no digits left for the place within one.
static float tamed(float x)
{
    return x > -1e6f && x < 1e6f ? x : 0.0f;
}

// floor(x), of what an int holds; the library's is a call.
static int whole(float x)
{
    int i = (int)x;
    return i - (x < (float)i);
}

texture_place texture_find(const texture_use *use, const vec2 uv[2])
{
    texture_place place = { { 0 }, { 0 } };
    if (!use->pixels)
        return place;
    vec2 at = uv[use->uv_set];
    float x = tamed(use->u[0] * at[0] + use->u[1] * at[1] + use->u[2]) * (float)use->width - 0.5f;
    float y = tamed(use->v[0] * at[0] + use->v[1] * at[1] + use->v[2]) * (float)use->height - 0.5f;
    x = clamp(x, -1e9f, 1e9f);
    y = clamp(y, -1e9f, 1e9f);
    if (use->nearest) {
        x = (float)whole(x + 0.5f);
        y = (float)whole(y + 0.5f);
    }
    int left = whole(x), top = whole(y);
    float fx = x - (float)left, fy = y - (float)top;
    size_t x0 = (size_t)wrapped(left, use->width, use->wrap_u);
    size_t x1 = (size_t)wrapped(left + 1, use->width, use->wrap_u);
    size_t y0 = (size_t)wrapped(top, use->height, use->wrap_v) * (size_t)use->width;
    size_t y1 = (size_t)wrapped(top + 1, use->height, use->wrap_v) * (size_t)use->width;
    return (texture_place) {
        { y0 + x0, y0 + x1, y1 + x0, y1 + x1 },
        { (1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy },
    };
}

void texture_set_expect(const texture_set *set, const vec2 uv[2])
{
    const texture_use *const use[USES] = USES_OF(set);
    for (size_t i = 0; i < USES; i++) {
        if (!use[i]->pixels)
            continue;
        texture_place place = texture_find(use[i], uv);
        __builtin_prefetch(use[i]->pixels + use[i]->stride * place.texel[0]);
        __builtin_prefetch(use[i]->pixels + use[i]->stride * place.texel[2]);
        if (set->woven)
            return;
    }
}

bool texture_alike(const texture_use *a, const texture_use *b)
{
    return a->width == b->width && a->height == b->height && a->wrap_u == b->wrap_u &&
           a->wrap_v == b->wrap_v && a->nearest == b->nearest && a->uv_set == b->uv_set &&
           memcmp(a->u, b->u, sizeof a->u) == 0 && memcmp(a->v, b->v, sizeof a->v) == 0;
}

vec4 texture_read(const texture_use *use, const texture_place *place)
{
    vec4 sum = { 0, 0, 0, 0 };
    if (!use->pixels)
        return sum + 1.0f;
    for (int i = 0; i < 4; i++) {
        const uint8_t *p = use->pixels + use->stride * place->texel[i];
        sum += (place->weight[i] * (1.0f / 255)) *
               vec4((float)p[0], (float)p[1], (float)p[2], (float)p[3]);
    }
    return sum;
}

vec4 texture_read_color(const texture_use *use, const texture_place *place, const float decode[256])
{
    vec4 sum = { 0, 0, 0, 0 };
    if (!use->pixels)
        return sum + 1.0f;
    for (int i = 0; i < 4; i++) {
        const uint8_t *p = use->pixels + use->stride * place->texel[i];
        sum += place->weight[i] *
               vec4(decode[p[0]], decode[p[1]], decode[p[2]], (float)p[3] * (1.0f / 255));
    }
    return sum;
}
