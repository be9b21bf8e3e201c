// Nodes: the hierarchy, world matrices, and which of them the chosen scene shows
// (spec 3.5).  Nothing here recurses: hierarchies may be as deep as the file is long.
#include "scene/gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Beyond this, squares of coordinates leave the range of floats.
#define WORLD_LIMIT 1e18

static bool is_affine(const double m[16])
{
    return fabs(m[3]) < 1e-3 && fabs(m[7]) < 1e-3 && fabs(m[11]) < 1e-3 && fabs(m[15] - 1.0) < 1e-3;
}

static ag_status read_rotation(const gltf_at *at, double q[4])
{
    gltf_at place = gltf_member(at, "rotation");
    ag_status status = gltf_doubles(at, "rotation", 4, q);
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (status)
        return status;
    if (!(length > 1e-9)) {
        gltf_warn_once(&place, GLTF_WARNED_ROTATION, "is no rotation; none is applied");
        q[3] = length = 1.0;
    }
    for (int i = 0; i < 4; i++)
        q[i] /= length;
    return AG_OK;
}

// `matrix`, or translation, rotation and scale.
static ag_status read_local(const gltf_at *at, double m[16])
{
    double t[3] = { 0 }, q[4] = { 0, 0, 0, 1 }, s[3] = { 1, 1, 1 };
    gltf_at matrix = gltf_member(at, "matrix");
    gltf_matrix_identity(m);
    ag_status status = gltf_doubles(at, "matrix", 16, m);
    if (!status && !is_affine(m))
        return gltf_fail(&matrix, AG_ERROR_FORMAT, "its last row is not 0, 0, 0, 1");
    m[3] = m[7] = m[11] = 0.0;
    m[15] = 1.0;
    if (status || matrix.json)
        return status;
    status = gltf_doubles(at, "translation", 3, t);
    if (!status)
        status = read_rotation(at, q);
    if (!status)
        status = gltf_doubles(at, "scale", 3, s);
    if (!status)
        gltf_matrix_compose(t, q, s, m);
    return status;
}

static ag_status read_node(const gltf_at *at, gltf_node *node)
{
    gltf_file *file = at->file;
    node->mesh = node->skin = node->camera = GLTF_NONE;
    ag_status status = read_local(at, node->world);
    if (!status)
        status = gltf_index(at, "mesh", file->mesh_count, "meshes", &node->mesh);
    if (!status)
        status = gltf_index(at, "skin", file->skin_count, "skins", &node->skin);
    if (!status)
        status = gltf_index(at, "camera", file->camera_count, "cameras", &node->camera);
    return status ? status : gltf_lights_of_node(at, node);
}

static ag_status link_children(const gltf_at *at)
{
    gltf_file *file = at->file;
    gltf_at children;
    ag_status status = gltf_array(at, "children", &children);
    for (size_t i = 0; !status && i < gltf_length(&children); i++) {
        gltf_at item = gltf_item(&children, i);
        uint32_t child = 0;
        status = gltf_item_index(&item, file->node_count, "nodes", &child);
        if (status)
            return status;
        if (file->nodes[child].parent != GLTF_NONE)
            return gltf_fail(&item, AG_ERROR_FORMAT, "nodes[%u] is a child of nodes[%u] already",
                             child, file->nodes[child].parent);
        file->nodes[child].parent = (uint32_t)at->index;
    }
    return status;
}

// Append the children of order[0..count) and of those appended, each once.
static size_t append_descendants(const gltf_at *nodes, bool *seen, uint32_t *order, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        gltf_at node = gltf_item(nodes, order[i]), children = gltf_member(&node, "children");
        for (size_t c = 0; c < gltf_length(&children); c++) {
            uint32_t child = (uint32_t)json_number_value(gltf_item(&children, c).json);
            if (!seen[child]) {
                seen[child] = true;
                order[count++] = child;
            }
        }
    }
    return count;
}

static ag_status resolve_world(const gltf_at *nodes, uint32_t index)
{
    gltf_file *file = nodes->file;
    gltf_node *node = &file->nodes[index];
    if (node->parent != GLTF_NONE)
        gltf_matrix_multiply(file->nodes[node->parent].world, node->world, node->world);
    for (int i = 0; i < 16; i++)
        if (!(fabs(node->world[i]) < WORLD_LIMIT)) {
            gltf_at at = gltf_item(nodes, index);
            return gltf_fail(&at, AG_ERROR_FORMAT, "its place in the world is beyond %g m",
                             WORLD_LIMIT);
        }
    return AG_OK;
}

static size_t append_roots(const gltf_file *file, bool *seen, uint32_t *order)
{
    size_t count = 0;
    for (uint32_t i = 0; i < file->node_count; i++)
        if (file->nodes[i].parent == GLTF_NONE && !seen[i]) {
            seen[i] = true;
            order[count++] = i;
        }
    return count;
}

// From the roots downwards; whatever is not reached is its own ancestor.
static ag_status resolve_worlds(const gltf_at *nodes, bool *seen, uint32_t *order)
{
    gltf_file *file = nodes->file;
    size_t count = append_descendants(nodes, seen, order, append_roots(file, seen, order));
    for (uint32_t i = 0; count < file->node_count && i < file->node_count; i++)
        if (!seen[i]) {
            gltf_at at = gltf_item(nodes, i);
            return gltf_fail(&at, AG_ERROR_FORMAT, "is its own ancestor: the nodes form a cycle");
        }
    ag_status status = AG_OK;
    for (size_t i = 0; i < count && !status; i++)
        status = resolve_world(nodes, order[i]);
    return status;
}

static ag_status count_items(const gltf_at *object, const char *key, size_t *count)
{
    gltf_at array;
    ag_status status = gltf_objects(object, key, &array);
    *count = gltf_length(&array);
    return status;
}

static ag_status count_what_nodes_hold(gltf_file *file)
{
    gltf_at root = gltf_root(file);
    ag_status status = count_items(&root, "meshes", &file->mesh_count);
    if (!status)
        status = count_items(&root, "cameras", &file->camera_count);
    if (!status)
        status = count_items(&root, "skins", &file->skin_count);
    if (!status)
        status = gltf_lights_count(file);
    if (status)
        return status;
    file->skins = calloc(file->skin_count + 1, sizeof *file->skins);
    return file->skins ? AG_OK : gltf_no_memory(&root);
}

ag_status gltf_nodes_read(gltf_file *file)
{
    gltf_at root = gltf_root(file), nodes;
    ag_status status = count_what_nodes_hold(file);
    if (!status)
        status = count_items(&root, "nodes", &file->node_count);
    if (!status)
        status = gltf_objects(&root, "nodes", &nodes);
    if (status)
        return status;
    size_t count = file->node_count;
    file->nodes = calloc(count + 1, sizeof *file->nodes);
    file->reached = calloc(count + 1, sizeof *file->reached);
    bool *seen = calloc(count + 1, sizeof *seen);
    if (!file->nodes || !file->reached || !seen)
        status = gltf_no_memory(&nodes);
    for (size_t i = 0; i < count && !status; i++) {
        gltf_at at = gltf_item(&nodes, i);
        file->nodes[i].parent = GLTF_NONE;
        status = read_node(&at, &file->nodes[i]);
    }
    for (size_t i = 0; i < count && !status; i++) {
        gltf_at at = gltf_item(&nodes, i);
        status = link_children(&at);
    }
    if (!status)
        status = resolve_worlds(&nodes, seen, file->reached);
    free(seen);
    return status;
}

static ag_status append_scene(const gltf_at *scene, bool *seen, uint32_t *order, size_t *count)
{
    gltf_at list;
    ag_status status = gltf_array(scene, "nodes", &list);
    for (size_t i = 0; !status && i < gltf_length(&list); i++) {
        gltf_at item = gltf_item(&list, i);
        uint32_t node = 0;
        status = gltf_item_index(&item, scene->file->node_count, "nodes", &node);
        if (!status && !seen[node]) {
            seen[node] = true;
            order[(*count)++] = node;
        }
    }
    return status;
}

static ag_status choose(const gltf_at *scenes, uint32_t *index)
{
    gltf_file *file = scenes->file;
    gltf_at root = gltf_root(file);
    uint32_t wanted = file->options.scene;
    if (wanted > gltf_length(scenes))
        return gltf_fail(scenes, AG_ERROR_ARGUMENT, "there is no scene %u among %zu", wanted,
                         gltf_length(scenes));
    *index = 0;
    ag_status status = gltf_index(&root, "scene", gltf_length(scenes), "scenes", index);
    if (wanted)
        *index = wanted - 1;
    return status;
}

ag_status gltf_scene_choose(gltf_file *file)
{
    gltf_at root = gltf_root(file), scenes, nodes = gltf_member(&root, "nodes");
    uint32_t index = 0;
    size_t count = 0;
    ag_status status = gltf_objects(&root, "scenes", &scenes);
    if (!status)
        status = choose(&scenes, &index);
    if (status)
        return status;
    bool *seen = calloc(file->node_count + 1, sizeof *seen);
    if (!seen)
        return gltf_no_memory(&root);
    if (scenes.json && gltf_length(&scenes)) {
        gltf_at scene = gltf_item(&scenes, index);
        status = append_scene(&scene, seen, file->reached, &count);
    } else {
        gltf_warn(&scenes, "the file has no scene; all of its nodes are shown");
        count = append_roots(file, seen, file->reached);
    }
    if (!status)
        file->reached_count = append_descendants(&nodes, seen, file->reached, count);
    free(seen);
    return status;
}
