// Instances: a mesh shown with a material at a place.
#include "base/array.h"
#include "base/log.h"
#include "scene/scene.h"
#include "scene/vector.h"

#include <string.h>

static const float identity[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

ag_status ag_scene_add_instance(ag_scene *scene, ag_mesh mesh, ag_material material,
                                const float world[16], ag_instance *instance)
{
    *instance = (ag_instance) { 0 };
    if (mesh.id == 0 || mesh.id > scene->meshes_count || material.id >= scene->materials_count)
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "An instance names mesh %u and material %u: the scene has %zu and %zu.",
                        mesh.id, material.id, scene->meshes_count, scene->materials_count - 1);
    if (world && !all_finite(world, 16))
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "An instance's matrix has an entry that is not finite.");
    if (!array_reserve(&scene->instances, &scene->instances_capacity, scene->instances_count + 1,
                       sizeof *scene->instances))
        return log_fail(&scene->log, AG_ERROR_MEMORY, "There is no memory for an instance.");
    scene_instance *made = &scene->instances[scene->instances_count++];
    *made = (scene_instance) { .mesh = mesh.id - 1, .material = material.id };
    memcpy(made->world, world ? world : identity, sizeof made->world);
    for (int row = 3; row < 16; row += 4) // affine
        made->world[row] = identity[row];
    instance->id = (uint32_t)scene->instances_count;
    scene->revision++;
    return AG_OK;
}
