// The bodies of lights, as they are seen.
#include "render/body.h"

enum { CELLS = GPU_BODY_COLUMNS * GPU_BODY_ROWS };

ag_status body_create(gpu_device *device, gpu_buffer *indices)
{
    ag_status status =
        gpu_buffer_create(device, CELLS * 6 * sizeof(uint16_t), VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                          GPU_MEMORY_UPLOAD, indices);
    if (status)
        return status;
    uint16_t *out = indices->memory.mapped;
    for (int row = 0; row < GPU_BODY_ROWS; row++)
        for (int column = 0; column < GPU_BODY_COLUMNS; column++) {
            int a = row * (GPU_BODY_COLUMNS + 1) + column, b = a + GPU_BODY_COLUMNS + 1;
            const int corners[6] = { a, b, a + 1, a + 1, b, b + 1 };
            for (int i = 0; i < 6; i++)
                *out++ = (uint16_t)corners[i];
        }
    return AG_OK;
}

void body_draw(VkCommandBuffer cmd, const gpu_buffer *indices, uint32_t first, uint32_t count)
{
    vkCmdBindIndexBuffer(cmd, indices->buffer, 0, VK_INDEX_TYPE_UINT16);
    vkCmdSetCullMode(cmd, VK_CULL_MODE_NONE);
    vkCmdDrawIndexed(cmd, CELLS * 6, count, 0, 0, first);
}
