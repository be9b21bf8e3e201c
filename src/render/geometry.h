// The meshes of a scene on the device: one buffer of vertices, one of indices.
#ifndef AG_RENDER_GEOMETRY_H
#define AG_RENDER_GEOMETRY_H

#include "gpu/upload.h"
#include "scene/scene.h"

// Where a mesh lies in the buffers.
typedef struct geometry_range {
    uint32_t first_index, index_count;
    int32_t first_vertex;
} geometry_range;

typedef struct geometry {
    gpu_buffer vertices, indices;
    geometry_range *ranges; // one a mesh of the scene
} geometry;

// On failure what is half made stays for geometry_destroy, after the upload is finished: the
// device may still be copying into it.
AG_CHECK ag_status geometry_create(gpu_device *device, const ag_scene *scene, gpu_upload *upload,
                                   geometry *g);
void geometry_destroy(gpu_device *device, geometry *g); // zero is allowed

// How a vertex shader reads scene_vertex (binding 0) and gpu_instance (binding 1).  Static storage.
const VkPipelineVertexInputStateCreateInfo *geometry_vertex_input(void);

#endif
