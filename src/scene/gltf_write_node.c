// Instances as nodes (spec 3.5), and the meshes with their materials that they show.
#include "scene/gltf_write.h"

#include <stdio.h>

static const float none[3] = { 0 }, ones[3] = { 1, 1, 1 };

// Moved and stretched along the axes only?
static bool is_straight(const float m[16])
{
    static const int others[] = { 1, 2, 4, 6, 8, 9 };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (m[others[i]] != 0.0f)
            return false;
    return true;
}

// A rotation would not come out of a matrix exactly: then the matrix itself is written.
static void put_place(gltf_writer *w, json_t *node, const float m[16])
{
    const float scale[3] = { m[0], m[5], m[10] };
    if (!is_straight(m)) {
        gltf_put_floats(w, node, "matrix", m, 16);
        return;
    }
    gltf_put_floats_unless(w, node, "translation", m + 12, 3, none);
    gltf_put_floats_unless(w, node, "scale", scale, 3, ones);
}

bool gltf_write_shows(const scene_instance *instance)
{
    double world[16];
    for (int i = 0; i < 16; i++)
        world[i] = (double)instance->world[i];
    return !gltf_matrix_is_collapsed(world);
}

json_t *gltf_write_node(gltf_writer *w, const float world[16], const char *name)
{
    json_t *node = json_object();
    gltf_put_name(w, node, name);
    put_place(w, node, world);
    uint32_t index = gltf_append(w, w->root, "nodes", node);
    json_t *scene = json_array_get(json_object_get(w->root, "scenes"), 0);
    gltf_append(w, scene, "nodes", json_integer(index));
    return node;
}

// The mesh in the file for one of the scene's with a material; `known` remembers.
static uint32_t mesh_of(gltf_writer *w, const scene_instance *instance, json_t *known)
{
    char key[32];
    snprintf(key, sizeof key, "%u %u", instance->mesh, instance->material);
    const json_t *before = json_object_get(known, key);
    if (before)
        return (uint32_t)json_integer_value(before);
    json_t *mesh = json_object(), *primitive = json_copy(gltf_write_primitive(w, instance->mesh));
    uint32_t material = w->materials[instance->material];
    if (material != GLTF_NONE)
        gltf_put_index(w, primitive, "material", material);
    gltf_append(w, mesh, "primitives", primitive);
    uint32_t index = gltf_append(w, w->root, "meshes", mesh);
    gltf_put_index(w, known, key, index);
    return index;
}

void gltf_write_instances(gltf_writer *w)
{
    json_t *known = json_object();
    for (size_t i = 0; i < w->scene->instances_count; i++) {
        const scene_instance *instance = &w->scene->instances[i];
        if (!gltf_write_shows(instance))
            continue;
        uint32_t mesh = mesh_of(w, instance, known);
        gltf_put_index(w, gltf_write_node(w, instance->world, instance->name), "mesh", mesh);
    }
    json_decref(known);
}
