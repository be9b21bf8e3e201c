// What deferred frames keep.
#include "render/visibility.h"

#include "base/log.h"

#include <stdlib.h>

static void destroy_views(gpu_device *device, visibility *v)
{
    for (int i = 0; i < 4; i++) {
        vkDestroyBufferView(device->device, v->views[i], NULL);
        v->views[i] = VK_NULL_HANDLE;
    }
}

static void free_memory(visibility *v)
{
    free(v->sources);
    free(v->objects);
    free(v->bodies);
    free(v->sum);
    v->sources = NULL;
    v->objects = NULL;
    v->bodies = NULL;
    v->sum = NULL;
}

void visibility_destroy(gpu_device *device, visibility *v)
{
    destroy_views(device, v);
    gpu_buffer_destroy(device, &v->places);
    gpu_buffer_destroy(device, &v->colors);
    free_memory(v);
    raster_finish(&v->raster);
    shade_list_finish(&v->list);
    *v = (visibility) { 0 };
}

ag_status visibility_allocate(gpu_device *device, size_t sources, size_t bodies, size_t summed,
                              visibility *v)
{
    free_memory(v);
    v->sources = calloc(sources, sizeof *v->sources);
    v->objects = calloc(sources, sizeof *v->objects);
    v->bodies = malloc((bodies ? bodies : 1) * sizeof *v->bodies);
    v->sum = summed ? malloc(summed * sizeof *v->sum) : NULL;
    if (v->sources && v->objects && v->bodies && (v->sum || !summed))
        return AG_OK;
    free_memory(v);
    return log_fail(&device->log, AG_ERROR_MEMORY, "no memory to see %zu instances", sources);
}

ag_status visibility_bind(gpu_device *device, const bindings *b, const gpu_buffer *vertices,
                          const gpu_buffer *indices, const gpu_buffer *instances, uint32_t count,
                          visibility *v)
{
    ag_status status =
        gpu_buffer_ensure(device, count * sizeof(gpu_listed),
                          VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT, GPU_MEMORY_UPLOAD, &v->places);
    if (!status)
        status = gpu_buffer_ensure(device, count * 8ull, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                                   GPU_MEMORY_READBACK, &v->colors);
    const gpu_buffer *buffers[4] = { &v->places, vertices, instances, indices };
    const VkFormat formats[4] = { VK_FORMAT_R32G32B32A32_UINT, VK_FORMAT_R32G32B32A32_SFLOAT,
                                  VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R32_UINT };
    destroy_views(device, v);
    for (uint32_t i = 0; i < 4 && !status; i++) {
        status = gpu_buffer_view(device, buffers[i], formats[i], &v->views[i]);
        if (!status)
            bindings_write_texels(device, b->listed, i, v->views[i]);
    }
    if (!status)
        bindings_write_buffer(device, b->listed, 4, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                              v->colors.buffer, 0, VK_WHOLE_SIZE);
    return status;
}
