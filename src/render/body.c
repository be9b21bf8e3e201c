// The bodies of lights, as they are seen.
#include "render/body.h"

#include <math.h>

static uint32_t columns_of(uint32_t level)
{
    return GPU_BODY_COLUMNS >> level;
}

static uint32_t rows_of(uint32_t level)
{
    return (GPU_BODY_ROWS >> level) | 1;
}

static uint32_t index_count(uint32_t level)
{
    return columns_of(level) * rows_of(level) * 6;
}

static uint32_t first_index(uint32_t level)
{
    uint32_t first = 0;
    for (uint32_t i = 0; i < level; i++)
        first += index_count(i);
    return first;
}

static uint16_t *fill_grid(uint32_t columns, uint32_t rows, uint16_t *out)
{
    for (uint32_t row = 0; row < rows; row++)
        for (uint32_t column = 0; column < columns; column++) {
            uint32_t a = row * (columns + 1) + column, b = a + columns + 1;
            const uint32_t corners[6] = { a, b, a + 1, a + 1, b, b + 1 };
            for (int i = 0; i < 6; i++)
                *out++ = (uint16_t)corners[i];
        }
    return out;
}

ag_status body_create(gpu_device *device, gpu_buffer *indices)
{
    ag_status status =
        gpu_buffer_create(device, first_index(GPU_BODY_LEVELS) * sizeof(uint16_t),
                          VK_BUFFER_USAGE_INDEX_BUFFER_BIT, GPU_MEMORY_UPLOAD, indices);
    uint16_t *out = indices->memory.mapped;
    for (uint32_t level = 0; level < GPU_BODY_LEVELS && !status; level++)
        out = fill_grid(columns_of(level), rows_of(level), out);
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

void body_draw(VkCommandBuffer cmd, const gpu_buffer *indices, const lights *l, const view *v)
{
    const gpu_light *all = l->all.memory.mapped;
    vkCmdBindIndexBuffer(cmd, indices->buffer, 0, VK_INDEX_TYPE_UINT16);
    vkCmdSetCullMode(cmd, VK_CULL_MODE_NONE);
    for (uint32_t i = l->bodies; i < l->count; i++) {
        float size = size_of(v, &all[i]);
        uint32_t level = size > 24 ? 0 : size > 6 ? 1 : 2;
        if (size > 0)
            vkCmdDrawIndexed(cmd, index_count(level), 1, first_index(level),
                             (int32_t)(level << GPU_BODY_LEVEL_SHIFT), i);
    }
}
