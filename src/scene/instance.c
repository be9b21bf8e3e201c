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

ag_status ag_scene_name_instance(ag_scene *scene, ag_instance instance, const char *name)
{
    if (instance.id == 0 || instance.id > scene->instances_count)
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "Instance %u is to be named: the scene has 1 to %zu.", instance.id,
                        scene->instances_count);
    if (!name_set(&scene->instances[instance.id - 1].name, name))
        return log_fail(&scene->log, AG_ERROR_MEMORY, "There is no memory for an instance's name.");
    return AG_OK;
}

bool ag_scene_instance(const ag_scene *scene, size_t index, ag_instance_info *info)
{
    if (index >= scene->instances_count)
        return false;
    const scene_instance *instance = &scene->instances[index];
    *info = (ag_instance_info) { .mesh = { instance->mesh + 1 },
                                 .material = { instance->material },
                                 .name = instance->name };
    memcpy(info->world, instance->world, sizeof info->world);
    instance_bounds(scene, instance, info->bounds_min, info->bounds_max);
    return true;
}
