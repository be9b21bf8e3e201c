// A material's textures as a ray reads them.
#include "trace/texture.h"

#include "base/log.h"
#include "image/image.h"

#include <math.h>

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
    use->width = (int)image->width;
    use->height = (int)image->height;
    use->wrap_u = (uint8_t)texture->desc.wrap_u;
    use->wrap_v = (uint8_t)texture->desc.wrap_v;
    use->nearest = texture->desc.mag == AG_FILTER_NEAREST;
    set_transform(from, use);
    return use->pixels != NULL;
}

static void set_alike(texture_set *set)
{
    const texture_use *uses[] = {
        &set->base_color, &set->metallic_roughness, &set->normal,
        &set->emissive,   &set->specular,           &set->specular_color
    };
    const texture_use *first = NULL;
    set->alike = true;
    for (size_t i = 0; i < sizeof uses / sizeof *uses; i++) {
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
        const uint8_t *p = use->pixels + 4 * place->texel[i];
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
        const uint8_t *p = use->pixels + 4 * place->texel[i];
        sum += place->weight[i] *
               vec4(decode[p[0]], decode[p[1]], decode[p[2]], (float)p[3] * (1.0f / 255));
    }
    return sum;
}
