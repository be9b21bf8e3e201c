// The bodies of lights, as they are seen.
#include "render/body.h"

#include "interop/body.glsl"

#include <math.h>

static uint32_t index_count(uint32_t level)
{
    return body_columns(level) * body_rows(level) * 6;
}

static uint32_t first_index(uint32_t level)
{
    uint32_t first = 0;
    for (uint32_t i = 0; i < level; i++)
        first += index_count(i);
    return first;
}

static uint32_t *fill_grid(uint32_t columns, uint32_t rows, uint32_t *out)
{
    for (uint32_t row = 0; row < rows; row++)
        for (uint32_t column = 0; column < columns; column++) {
            uint32_t a = row * (columns + 1) + column, b = a + columns + 1;
            const uint32_t corners[6] = { a, b, a + 1, a + 1, b, b + 1 };
            for (int i = 0; i < 6; i++)
                *out++ = corners[i];
        }
    return out;
}

ag_status body_create(gpu_device *device, gpu_buffer *indices)
{
    ag_status status =
        gpu_buffer_create(device, first_index(GPU_BODY_LEVELS) * sizeof(uint32_t),
                          VK_BUFFER_USAGE_INDEX_BUFFER_BIT, GPU_MEMORY_UPLOAD, indices);
    uint32_t *out = indices->memory.mapped;
    for (uint32_t level = 0; level < GPU_BODY_LEVELS && !status; level++)
        out = fill_grid(body_columns(level), body_rows(level), out);
    return status;
}

static float length_of(float3 v)
{
    return sqrtf(v.x * v.x + v.y * v.y + v.z * v.z);
}

// px, half the body's extent on the picture at most; 0 when it cannot be seen.
static float size_of(const view *v, const gpu_light *light)
{
    float reach = light->radius + length_of(light->x) + length_of(light->y);
    const float at[3] = { light->position.x, light->position.y, light->position.z };
    float depth = view_depth(v, at);
    if (length_of(light->radiance) == 0 || depth + reach < v->near_m)
        return 0;
    float px = 0.5f * (float)v->height / v->half_y;
    return v->orthographic ? reach * px : reach * px / fmaxf(depth - reach, v->near_m);
}

uint32_t body_level(const view *v, const gpu_light *light)
{
    float size = size_of(v, light);
    return size > 24 ? 0 : size > 6 ? 1 : size > 0 ? 2 : GPU_BODY_LEVELS;
}

void body_draw(VkCommandBuffer cmd, const gpu_buffer *indices, const lights *l, const view *v)
{
    const gpu_light *all = l->all.memory.mapped;
    vkCmdBindIndexBuffer(cmd, indices->buffer, 0, VK_INDEX_TYPE_UINT32);
    vkCmdSetCullMode(cmd, VK_CULL_MODE_NONE);
    for (uint32_t i = l->bodies; i < l->count; i++) {
        uint32_t level = body_level(v, &all[i]);
        if (level < GPU_BODY_LEVELS)
            vkCmdDrawIndexed(cmd, index_count(level), 1, first_index(level),
                             (int32_t)(level << GPU_BODY_LEVEL_SHIFT), i);
    }
}

static vec3 vector(float3 v)
{
    return vec3(v.x, v.y, v.z);
}

static light_body body_of(const gpu_light *l)
{
    return (light_body) { l->kind,      vector(l->position), vector(l->direction),
                          vector(l->x), vector(l->y),        l->radius };
}

void body_place(const gpu_light *light, uint32_t level, float points[BODY_POINTS][3])
{
    light_body body = body_of(light);
    uint32_t count = (body_columns(level) + 1) * (body_rows(level) + 1);
    for (uint32_t i = 0; i < count; i++) {
        vec3 p = body_vertex(body, level << GPU_BODY_LEVEL_SHIFT | i);
        for (int k = 0; k < 3; k++)
            points[i][k] = p[k];
    }
}

const uint32_t *body_triangles(const gpu_buffer *indices, uint32_t level, uint32_t *count)
{
    *count = index_count(level) / 3;
    return (const uint32_t *)indices->memory.mapped + first_index(level);
}

bool body_shows_front(const gpu_light *light, const gpu_frame *frame)
{
    vec3 along = vector(light->position) - vector(frame->eye);
    if (frame->orthographic != 0)
        along = vector(frame->ray_center);
    return body_faces(body_of(light), along);
}
