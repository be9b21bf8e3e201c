// The meshes of a scene on the device: one buffer of vertices, one of indices.
#include "render/geometry.h"

#include "base/log.h"
#include "interop/scene.glsl"

#include <stddef.h>
#include <stdlib.h>

_Static_assert(sizeof(scene_vertex) == 64, "uploaded as it is");

const VkPipelineVertexInputStateCreateInfo *geometry_vertex_input(void)
{
    static const VkVertexInputBindingDescription bindings[] = {
        { 0, sizeof(scene_vertex), VK_VERTEX_INPUT_RATE_VERTEX },
        { 1, sizeof(gpu_instance), VK_VERTEX_INPUT_RATE_INSTANCE },
    };
    static const VkVertexInputAttributeDescription attributes[] = {
        { 0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(scene_vertex, position) },
        { 1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(scene_vertex, normal) },
        { 2, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(scene_vertex, tangent) },
        { 3, 0, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(scene_vertex, uv) },
        { 4, 0, VK_FORMAT_R16G16B16A16_UNORM, offsetof(scene_vertex, color) },
        { 5, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 0 },
        { 6, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 16 },
        { 7, 1, VK_FORMAT_R32G32B32A32_SFLOAT, 32 },
    };
    static const VkPipelineVertexInputStateCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = sizeof bindings / sizeof *bindings,
        .pVertexBindingDescriptions = bindings,
        .vertexAttributeDescriptionCount = sizeof attributes / sizeof *attributes,
        .pVertexAttributeDescriptions = attributes,
    };
    return &info;
}

static ag_status lay_out(const ag_scene *scene, geometry *g, uint64_t *vertices, uint64_t *indices)
{
    g->ranges = calloc(scene->meshes_count ? scene->meshes_count : 1, sizeof *g->ranges);
    if (!g->ranges)
        return log_fail(&scene->log, AG_ERROR_MEMORY, "no memory for %zu meshes",
                        scene->meshes_count);
    for (size_t i = 0; i < scene->meshes_count; i++) {
        const scene_mesh *mesh = &scene->meshes[i];
        g->ranges[i] =
            (geometry_range) { (uint32_t)*indices, mesh->index_count, (int32_t)*vertices };
        *vertices += mesh->vertex_count;
        *indices += mesh->index_count;
    }
    if (*vertices > INT32_MAX || *indices > UINT32_MAX)
        return log_fail(&scene->log, AG_ERROR_MEMORY,
                        "the scene has more than 2^31 vertices or 2^32 indices");
    return AG_OK;
}

static ag_status fill(const ag_scene *scene, gpu_upload *upload, const geometry *g)
{
    ag_status status = AG_OK;
    for (size_t i = 0; i < scene->meshes_count && !status; i++) {
        const scene_mesh *mesh = &scene->meshes[i];
        const geometry_range *range = &g->ranges[i];
        status = gpu_upload_buffer(upload, &g->vertices,
                                   (VkDeviceSize)range->first_vertex * sizeof(scene_vertex),
                                   mesh->vertices, mesh->vertex_count * sizeof(scene_vertex));
        if (!status)
            status = gpu_upload_buffer(upload, &g->indices, range->first_index * 4ull,
                                       mesh->indices, mesh->index_count * 4ull);
    }
    return status;
}

ag_status geometry_create(gpu_device *device, const ag_scene *scene, gpu_upload *upload,
                          geometry *g)
{
    *g = (geometry) { 0 };
    const VkBufferUsageFlags read =
        VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;
    uint64_t vertices = 0, indices = 0;
    ag_status status = lay_out(scene, g, &vertices, &indices);
    if (!status)
        status = gpu_buffer_create(device, vertices * sizeof(scene_vertex),
                                   VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | read, GPU_MEMORY_DEVICE,
                                   &g->vertices);
    if (!status)
        status = gpu_buffer_create(device, indices * 4, VK_BUFFER_USAGE_INDEX_BUFFER_BIT | read,
                                   GPU_MEMORY_DEVICE, &g->indices);
    return status ? status : fill(scene, upload, g);
}

void geometry_destroy(gpu_device *device, geometry *g)
{
    gpu_buffer_destroy(device, &g->vertices);
    gpu_buffer_destroy(device, &g->indices);
    free(g->ranges);
    *g = (geometry) { 0 };
}
