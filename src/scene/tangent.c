// Tangent frames for normal maps.
#include "scene/tangent.h"

#include "scene/vector.h"

void tangents_any(scene_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        scene_vertex *vertex = &mesh->vertices[i];
        vec3_store(vec3_perpendicular(vec3_from(vertex->normal)), vertex->tangent);
        vertex->tangent[3] = 1.0f;
    }
}

bool tangents_compute(scene_mesh *mesh, unsigned uv_set)
{
    (void)uv_set;
    tangents_any(mesh);
    return true;
}
