// What the nodes of the chosen scene show, light and look from.
#include "scene/gltf.h"

#include <stdlib.h>

enum { INSTANCE_WORK = 64 }; // what one counts, in rows read

static ag_status name_instance(const gltf_at *primitive, uint32_t index, ag_instance instance)
{
    gltf_at root = gltf_root(primitive->file), nodes = gltf_member(&root, "nodes");
    gltf_at node = gltf_item(&nodes, index);
    const char *name = NULL;
    ag_status status = gltf_string(primitive->up->up, "name", &name);
    if (!status)
        status = gltf_string(&node, "name", &name);
    return status ? status : ag_scene_name_instance(primitive->file->scene, instance, name);
}

static ag_status add_instance(const gltf_at *primitive, uint32_t index)
{
    gltf_file *file = primitive->file;
    const gltf_node *node = &file->nodes[index];
    ag_mesh mesh = { 0 };
    bool posed = false;
    uint32_t material = GLTF_NONE;
    ag_status status = gltf_charge(primitive, &file->work_budget, INSTANCE_WORK);
    if (!status)
        status = gltf_index(primitive, "material", file->material_count, "materials", &material);
    if (!status)
        status = gltf_primitive_add(primitive, index, &mesh, &posed);
    if (status || !mesh.id || (!posed && gltf_matrix_is_collapsed(node->world)))
        return status;
    float world[16];
    for (int i = 0; i < 16; i++)
        world[i] = (float)node->world[i];
    ag_material id = { 0 };
    if (material != GLTF_NONE)
        id = file->materials[material].material;
    ag_instance instance;
    status = ag_scene_add_instance(file->scene, mesh, id, posed ? NULL : world, &instance);
    return status ? status : name_instance(primitive, index, instance);
}

static ag_status add_mesh(gltf_file *file, const gltf_at *meshes, uint32_t node)
{
    gltf_at mesh = gltf_item(meshes, file->nodes[node].mesh), primitives;
    ag_status status = gltf_require(&mesh, "primitives");
    if (!status)
        status = gltf_array(&mesh, "primitives", &primitives);
    if (!status && gltf_length(&primitives) == 0)
        return gltf_fail(&primitives, AG_ERROR_FORMAT, "must have at least one primitive");
    for (size_t i = 0; !status && i < gltf_length(&primitives); i++) {
        gltf_at primitive = gltf_item(&primitives, i);
        status = add_instance(&primitive, node);
    }
    return status;
}

static ag_status add_node(gltf_file *file, const gltf_at *meshes, uint32_t index)
{
    const gltf_node *node = &file->nodes[index];
    ag_status status = AG_OK;
    if (node->mesh != GLTF_NONE)
        status = add_mesh(file, meshes, index);
    if (!status)
        status = gltf_lights_add(file, index);
    if (!status && node->camera != GLTF_NONE)
        status = gltf_camera_add(file, index);
    return status;
}

ag_status gltf_instances_add(gltf_file *file)
{
    gltf_at root = gltf_root(file), meshes = gltf_member(&root, "meshes");
    size_t before = file->scene->instances_count, count = file->reached_count;
    file->meshes = calloc(file->mesh_count + 1, sizeof *file->meshes);
    file->meshes_made = json_object();
    if (!file->meshes || !file->meshes_made)
        return gltf_no_memory(&meshes);
    ag_status status = AG_OK;
    for (size_t i = 0; i < count && !status; i++) {
        status = add_node(file, &meshes, file->reached[i]);
        if (!status && (i + 1) * 10 / count != i * 10 / count)
            status = gltf_progress(file, "load", 0.5 + 0.5 * (double)(i + 1) / (double)count);
    }
    if (!status && file->scene->instances_count == before)
        gltf_warn(&root, "there is no surface in it to show");
    return status;
}
