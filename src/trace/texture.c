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

ag_status texture_set_init(const ag_scene *scene, const ag_material_desc *m, texture_set *set)
{
    bool there = use_init(scene, &m->base_color_texture, &set->base_color) &
                 use_init(scene, &m->metallic_roughness_texture, &set->metallic_roughness) &
                 use_init(scene, &m->normal_texture, &set->normal) &
                 use_init(scene, &m->emissive_texture, &set->emissive) &
                 use_init(scene, &m->specular_texture, &set->specular) &
                 use_init(scene, &m->specular_color_texture, &set->specular_color);
    if (!there)
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "the scene's images were given to a renderer (ag_renderer_take): load the "
                        "scene again to trace it");
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

// Four texels and their weights.
typedef struct taps {
    const uint8_t *texel[4];
    float weight[4];
} taps;

// Beyond this many repetitions there are no digits left for the place within one.
static float tamed(float x)
{
    return fabsf(x) < 1e6f ? x : 0.0f;
}

static taps taps_of(const texture_use *use, const vec2 uv[2])
{
    vec2 at = uv[use->uv_set];
    float x = tamed(use->u[0] * at[0] + use->u[1] * at[1] + use->u[2]) * (float)use->width - 0.5f;
    float y = tamed(use->v[0] * at[0] + use->v[1] * at[1] + use->v[2]) * (float)use->height - 0.5f;
    x = min(max(x, -1e9f), 1e9f);
    y = min(max(y, -1e9f), 1e9f);
    if (use->nearest) {
        x = floorf(x + 0.5f);
        y = floorf(y + 0.5f);
    }
    float left = floorf(x), top = floorf(y), fx = x - left, fy = y - top;
    int x0 = wrapped((int)left, use->width, use->wrap_u);
    int x1 = wrapped((int)left + 1, use->width, use->wrap_u);
    size_t y0 = (size_t)wrapped((int)top, use->height, use->wrap_v) * (size_t)use->width;
    size_t y1 = (size_t)wrapped((int)top + 1, use->height, use->wrap_v) * (size_t)use->width;
    const uint8_t *p = use->pixels;
    return (taps) {
        { p + 4 * (y0 + (size_t)x0), p + 4 * (y0 + (size_t)x1), p + 4 * (y1 + (size_t)x0),
          p + 4 * (y1 + (size_t)x1) },
        { (1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy },
    };
}

vec4 texture_read(const texture_use *use, const vec2 uv[2])
{
    vec4 sum = { 0, 0, 0, 0 };
    if (!use->pixels)
        return sum + 1.0f;
    taps t = taps_of(use, uv);
    for (int i = 0; i < 4; i++) {
        const uint8_t *p = t.texel[i];
        sum += (t.weight[i] / 255) * vec4((float)p[0], (float)p[1], (float)p[2], (float)p[3]);
    }
    return sum;
}

vec4 texture_read_color(const texture_use *use, const vec2 uv[2], const float decode[256])
{
    vec4 sum = { 0, 0, 0, 0 };
    if (!use->pixels)
        return sum + 1.0f;
    taps t = taps_of(use, uv);
    for (int i = 0; i < 4; i++) {
        const uint8_t *p = t.texel[i];
        sum += t.weight[i] *
               vec4(decode[p[0]], decode[p[1]], decode[p[2]], (float)p[3] * (1.0f / 255));
    }
    return sum;
}
