// The lights of a scene on the device.
#include "render/lights.h"

#include "base/log.h"
#include "physics/light_punctual.glsl"
#include "scene/picture.h"

#include <string.h>

// Up to this many lights, every pixel is lit by all.
enum { FEW = 16 };

// ---- One light -----------------------------------------------------------------

static uint32_t kind_of(ag_light_kind kind)
{
    switch (kind) {
    case AG_LIGHT_SPOT: return GPU_LIGHT_SPOT;
    case AG_LIGHT_DIRECTIONAL: return GPU_LIGHT_DIRECTIONAL;
    case AG_LIGHT_SUN: return GPU_LIGHT_SUN;
    case AG_LIGHT_SPHERE: return GPU_LIGHT_SPHERE;
    case AG_LIGHT_RECT: return GPU_LIGHT_RECT;
    case AG_LIGHT_DISK: return GPU_LIGHT_DISK;
    case AG_LIGHT_TUBE: return GPU_LIGHT_TUBE;
    default: return GPU_LIGHT_POINT;
    }
}

static int group_of(uint32_t kind)
{
    switch (kind) {
    case GPU_LIGHT_SUN:
    case GPU_LIGHT_SPHERE: return GPU_LIGHTS_CAP;
    case GPU_LIGHT_RECT: return GPU_LIGHTS_RECT;
    case GPU_LIGHT_DISK: return GPU_LIGHTS_DISK;
    case GPU_LIGHT_TUBE: return GPU_LIGHTS_TUBE;
    default: return GPU_LIGHTS_PUNCTUAL;
    }
}

// Finite whatever the scene says: infinite times nothing is not a number.
static float bounded(float x)
{
    return fminf(x, 1e30f);
}

static float3 scaled(const float v[3], float s)
{
    return (float3) { bounded(v[0] * s), bounded(v[1] * s), bounded(v[2] * s) };
}

// What of two half axes the device takes.
static void set_axes(const ag_light_desc *d, gpu_light *light)
{
    float x[3], y[3];
    light_axes(d, x, y);
    light->x = scaled(x, 1);
    light->y = scaled(y, 1);
}

static gpu_light pack(const ag_light_desc *d)
{
    const float *p = d->position, *to = d->direction;
    float spread = light_spread(d);
    gpu_light light = {
        .position = { p[0], p[1], p[2] },
        .inverse_range2 = d->range_m > 0 ? bounded(1 / (d->range_m * d->range_m)) : 0,
        .intensity = scaled(d->color, d->intensity),
        .kind = kind_of(d->kind),
        .direction = { to[0], to[1], to[2] },
        .radius = d->radius_m,
    };
    if (spread > 0 && !d->hidden)
        light.radiance = scaled(d->color, d->intensity / spread);
    vec2 cone = light_spot_cone(cosf(d->cone_inner_rad), cosf(d->cone_outer_rad));
    light.cone_scale = cone[0];
    light.cone_offset = cone[1];
    if (d->kind == AG_LIGHT_SUN) {
        light.radius = sinf(d->angular_radius_rad);
        light.cone_scale = cosf(d->angular_radius_rad);
    }
    set_axes(d, &light);
    return light;
}

// ---- All of them -----------------------------------------------------------------

static float greatest(float3 c)
{
    return fmaxf(c.x, fmaxf(c.y, c.z));
}

static float length_of(float3 v)
{
    return sqrtf(v.x * v.x + v.y * v.y + v.z * v.z);
}

// cd, in the direction where a light sends most.
static float candela(const gpu_light *light)
{
    float x = length_of(light->x), y = length_of(light->y), r = light->radius;
    float most = greatest(light->intensity);
    switch (light->kind) {
    case GPU_LIGHT_RECT: return most * 4 * x * y;
    case GPU_LIGHT_DISK: return most * PI * x * y;
    case GPU_LIGHT_TUBE: return most * (4 * x * r + PI * r * r);
    default: return most;
    }
}

// Gives a light without a range one beyond which `count` such together add less to a white matte
// surface than half a step of an 8-bit picture, in its darkest part, where steps are finest.
static void bound_range(gpu_light *light, size_t count, float exposure)
{
    const float darkest = 0.5f / 255 / 12.92f; // sRGB's slope at black
    bool placed = light->kind != GPU_LIGHT_DIRECTIONAL && light->kind != GPU_LIGHT_SUN;
    if (placed && light->inverse_range2 == 0)
        light->inverse_range2 =
            bounded(darkest / (float)count / fmaxf(candela(light) * exposure / PI, 1e-30f));
}

static size_t count_placed(const ag_scene *scene)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->lights_count; i++)
        count += !light_is_ambient(scene->lights[i].kind);
    return count;
}

// Whether light `i` lights surfaces in this picture.
static bool is_part(const ag_render_options *o, size_t i)
{
    return o->parts & AG_PART_LIGHTS && (!o->light.id || o->light.id == i + 1);
}

// The greatest factor from light to what the picture has of it.
static float most_exposed(const ag_render_options *o)
{
    const rgb_matrix m = picture_exposure(o);
    float most = 0;
    for (int i = 0; i < 3; i++)
        most = fmaxf(most, fmaxf(m.red[i], fmaxf(m.green[i], m.blue[i])));
    return most;
}

// In the order of their kinds.
static void place(const ag_scene *scene, size_t count, const ag_render_options *o, lights *l)
{
    float exposure = o->format == AG_FORMAT_RGBA32F ? INFINITY : most_exposed(o);
    gpu_light *out = l->all.memory.mapped;
    l->bodies = (uint32_t)count;
    l->count = 0;
    for (uint32_t kind = 0; kind <= GPU_LIGHT_TUBE; kind++) {
        if (kind == GPU_LIGHT_SPHERE)
            l->bodies = l->count;
        for (size_t i = 0; i < scene->lights_count; i++) {
            const ag_light_desc *d = &scene->lights[i];
            if (light_is_ambient(d->kind) || kind_of(d->kind) != kind)
                continue;
            gpu_light *light = &out[l->count++];
            *light = pack(d);
            if (!is_part(o, i))
                light->intensity = (float3) { 0, 0, 0 };
            if (count > FEW)
                bound_range(light, count, exposure);
        }
        for (int group = group_of(kind); group < GPU_LIGHT_GROUPS; group++)
            l->ends[group] = l->count;
    }
}

static void sum_ambient(const ag_scene *scene, const ag_render_options *o, lights *l)
{
    float sum[9][3];
    l->ambient_present = scene_ambient(scene, o->light, sum);
    float share = o->parts & AG_PART_LIGHTS ? 1.0f : 0.0f; // dark, not left out: variants are dear
    for (int i = 0; i < 9; i++)
        l->ambient[i] = scaled(sum[i], share);
}

ag_status lights_write(gpu_device *device, const ag_scene *scene, const ag_render_options *o,
                       lights *l)
{
    size_t count = count_placed(scene);
    ag_status status =
        gpu_buffer_ensure(device, GPU_LIGHTS_NEAR * sizeof(gpu_light),
                          VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, GPU_MEMORY_UPLOAD, &l->near);
    if (!status)
        status = gpu_buffer_ensure(device, count * sizeof(gpu_light),
                                   VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, GPU_MEMORY_UPLOAD, &l->all);
    if (!status)
        status = gpu_buffer_ensure(device, 0, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, GPU_MEMORY_UPLOAD,
                                   &l->clusters);
    if (status)
        return status;
    place(scene, count, o, l);
    uint32_t punctual = l->ends[GPU_LIGHTS_PUNCTUAL];
    memcpy(l->near.memory.mapped, l->all.memory.mapped,
           (punctual < GPU_LIGHTS_NEAR ? punctual : GPU_LIGHTS_NEAR) * sizeof(gpu_light));
    sum_ambient(scene, o, l);
    return AG_OK;
}

void lights_destroy(gpu_device *device, lights *l)
{
    gpu_buffer_destroy(device, &l->near);
    gpu_buffer_destroy(device, &l->all);
    gpu_buffer_destroy(device, &l->clusters);
    *l = (lights) { 0 };
}

// ---- For a frame -----------------------------------------------------------------

void lights_constants(const lights *l, gpu_surface_constants *constants)
{
    uint32_t punctual = l->ends[GPU_LIGHTS_PUNCTUAL], first = 0;
    bool near = l->count <= FEW && punctual <= GPU_LIGHTS_NEAR;
    constants->lights = near ? punctual : 0;
    constants->clustered = l->count > FEW;
    constants->ambient = l->ambient_present;
    constants->groups = 0;
    for (int group = 0; group < GPU_LIGHT_GROUPS; group++) {
        if (l->ends[group] > first && !(near && group == GPU_LIGHTS_PUNCTUAL))
            constants->groups |= 1u << group;
        first = l->ends[group];
    }
}

void lights_frame(const lights *l, gpu_frame *frame)
{
    frame->first_body = l->bodies;
    memcpy(frame->light_ends, l->ends, sizeof l->ends);
    memcpy(frame->ambient, l->ambient, sizeof l->ambient);
}
