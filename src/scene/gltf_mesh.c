// Primitives of meshes (spec 3.7), made into meshes of the scene.
//
// A primitive becomes one scene mesh however many nodes show it, and primitives made of
// the same accessors share one too.  Only skins and weights of a node's own force a copy.
#include "scene/gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const ag_mesh nothing = { UINT32_MAX }; // made, but there is nothing to draw

void gltf_geometry_finish(gltf_geometry *geometry)
{
    free(geometry->positions);
    free(geometry->normals);
    free(geometry->tangents);
    free(geometry->uvs[0]);
    free(geometry->uvs[1]);
    free(geometry->colors);
    free(geometry->indices);
}

static ag_status read_attributes(const gltf_at *at, const gltf_morph *morph, gltf_geometry *g)
{
    static const gltf_attribute position = { "POSITION", 3, 3, false };
    static const gltf_attribute normal = { "NORMAL", 3, 3, false };
    static const gltf_attribute tangent = { "TANGENT", 4, 4, false };
    static const gltf_attribute uv0 = { "TEXCOORD_0", 2, 2, false };
    static const gltf_attribute uv1 = { "TEXCOORD_1", 2, 2, false };
    static const gltf_attribute color = { "COLOR_0", 4, 3, true };
    ag_status status = gltf_attribute_read(at, &position, morph, g, &g->positions);
    if (!status)
        status = gltf_attribute_read(at, &normal, morph, g, &g->normals);
    if (!status && g->normals) // without normals tangents do not count (spec 3.7.2.1)
        status = gltf_attribute_read(at, &tangent, morph, g, &g->tangents);
    if (!status)
        status = gltf_attribute_read(at, &uv0, morph, g, &g->uvs[0]);
    if (!status)
        status = gltf_attribute_read(at, &uv1, morph, g, &g->uvs[1]);
    if (!status)
        status = gltf_attribute_read(at, &color, morph, g, &g->colors);
    return status;
}

static ag_status check_positions(const gltf_at *attributes, const gltf_geometry *geometry)
{
    gltf_at at = gltf_member(attributes, "POSITION");
    for (size_t i = 0; i < geometry->vertex_count * 3; i++)
        if (!(fabsf(geometry->positions[i]) < 1e18f))
            return gltf_fail(&at, AG_ERROR_FORMAT, "vertex %zu is not finite or lies beyond 1e18 m",
                             geometry->first + i / 3);
    return AG_OK;
}

static bool needs_tangents(const ag_material_desc *drawn)
{
    return drawn->normal_texture.texture.id != 0 || drawn->anisotropy > 0.0f;
}

static ag_status add_to_scene(const gltf_at *primitive, const gltf_geometry *geometry,
                              ag_mesh *mesh)
{
    gltf_file *file = primitive->file;
    uint32_t material = GLTF_NONE;
    ag_status status =
        gltf_index(primitive, "material", file->material_count, "materials", &material);
    if (status)
        return status;
    ag_mesh_desc desc = {
        .positions = geometry->positions,
        .normals = geometry->normals,
        .tangents = geometry->tangents,
        .uvs = { geometry->uvs[0], geometry->uvs[1] },
        .colors = geometry->colors,
        .vertex_count = (uint32_t)geometry->vertex_count,
        .indices = geometry->indices,
        .index_count = (uint32_t)geometry->index_count,
        .skip_tangents = true,
    };
    if (material != GLTF_NONE) {
        const ag_material_desc *drawn = &file->materials[material].desc;
        desc.skip_tangents = !needs_tangents(drawn);
        desc.tangent_uv_set = drawn->normal_texture.uv_set;
    }
    return ag_scene_add_mesh(file->scene, &desc, mesh);
}

// What the mesh will take in the scene; flat triangles have vertices of their own.
static ag_status charge_vertices(const gltf_at *attributes, const gltf_geometry *geometry)
{
    bool flat = !gltf_member(attributes, "NORMAL").json;
    size_t vertices = flat ? geometry->index_count : geometry->vertex_count;
    return gltf_charge(attributes, &attributes->file->vertex_budget,
                       vertices + geometry->vertex_count / 4 + geometry->index_count / 16);
}

static ag_status read_geometry(const gltf_at *primitive, uint32_t node, const gltf_morph *morph,
                               gltf_geometry *geometry, bool *posed)
{
    gltf_file *file = primitive->file;
    gltf_at attributes;
    uint32_t skin = file->nodes[node].skin;
    ag_status status = gltf_object(primitive, "attributes", &attributes);
    if (!status)
        status = charge_vertices(&attributes, geometry);
    if (!status)
        status = read_attributes(&attributes, morph, geometry);
    if (!status && skin != GLTF_NONE)
        status = gltf_skin_apply(primitive, skin, geometry, posed);
    return status ? status : check_positions(&attributes, geometry);
}

static ag_status build(const gltf_at *primitive, uint32_t node, ag_mesh *mesh, bool *posed)
{
    gltf_at attributes, *mesh_at = (gltf_at *)primitive->up->up;
    const gltf_accessor *positions = NULL;
    gltf_morph morph = { 0 };
    gltf_geometry geometry = { 0 };
    *mesh = nothing;
    ag_status status = gltf_object(primitive, "attributes", &attributes);
    if (!status)
        status = gltf_attribute_find(&attributes, "POSITION", &positions);
    if (status)
        return status;
    if (!positions) {
        gltf_warn_once(primitive, GLTF_WARNED_POSITION, "has no POSITION: it is not drawn");
        return AG_OK;
    }
    geometry.element_count = positions->count;
    status = gltf_triangles_read(primitive, &geometry);
    if (!status && geometry.index_count)
        status = gltf_morph_read(primitive, mesh_at, node, &morph);
    if (!status && geometry.index_count)
        status = read_geometry(primitive, node, &morph, &geometry, posed);
    if (!status && geometry.index_count)
        status = add_to_scene(primitive, &geometry, mesh);
    free(morph.weights);
    gltf_geometry_finish(&geometry);
    return status;
}

// Whether it has morph targets, and as many as the weights of its mesh.
static bool has_targets(const gltf_at *primitive)
{
    size_t weights = json_array_size(json_object_get(primitive->up->up->json, "weights"));
    size_t targets = json_array_size(json_object_get(primitive->json, "targets"));
    return targets > 0 && weights == targets;
}

// Whether they come from the material's uv set, and not from the file.
static bool computes_tangents(const gltf_at *primitive, const ag_material_desc *drawn)
{
    const json_t *attributes = json_object_get(primitive->json, "attributes");
    bool given = json_object_get(attributes, "TANGENT") && json_object_get(attributes, "NORMAL");
    return !given && needs_tangents(drawn);
}

// What makes up the mesh, as text: equal texts, equal meshes.  NULL without memory.
static char *describe(const gltf_at *primitive)
{
    static const char *const parts[] = { "attributes", "indices", "mode", "targets" };
    gltf_file *file = primitive->file;
    json_t *parts_json = json_object();
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++)
        if (json_object_get(primitive->json, parts[i]))
            (void)json_object_set_nocheck(parts_json, parts[i],
                                          json_object_get(primitive->json, parts[i]));
    json_t *weights = json_object_get(primitive->up->up->json, "weights");
    if (has_targets(primitive))
        (void)json_object_set_nocheck(parts_json, "weights", weights);
    uint32_t material = (uint32_t)json_integer_value(json_object_get(primitive->json, "material"));
    const ag_material_desc *drawn = NULL;
    if (json_object_get(primitive->json, "material") && material < file->material_count)
        drawn = &file->materials[material].desc;
    if (drawn && computes_tangents(primitive, drawn))
        (void)json_object_set_new_nocheck(parts_json, "tangents",
                                          json_integer(drawn->normal_texture.uv_set));
    char *text = json_dumps(parts_json, JSON_COMPACT | JSON_SORT_KEYS);
    json_decref(parts_json);
    return text;
}

static ag_status build_shared(const gltf_at *primitive, uint32_t node, ag_mesh *mesh)
{
    json_t *made = primitive->file->meshes_made;
    char *text = describe(primitive);
    const json_t *before = text ? json_object_get(made, text) : NULL;
    bool posed = false;
    ag_status status = AG_OK;
    if (before)
        mesh->id = (uint32_t)json_integer_value(before);
    else
        status = build(primitive, node, mesh, &posed);
    if (!status && !before && text)
        (void)json_object_set_new_nocheck(made, text, json_integer(mesh->id));
    free(text);
    return status;
}

static ag_status reserve_slots(const gltf_at *primitives, ag_mesh **slots)
{
    if (!*slots)
        *slots = calloc(gltf_length(primitives) + 1, sizeof **slots);
    return *slots ? AG_OK : gltf_no_memory(primitives);
}

ag_status gltf_primitive_add(const gltf_at *primitive, uint32_t node, ag_mesh *mesh, bool *posed)
{
    gltf_file *file = primitive->file;
    gltf_at root = gltf_root(file), nodes = gltf_member(&root, "nodes");
    gltf_at node_at = gltf_item(&nodes, node);
    ag_status status = AG_OK;
    *posed = false;
    bool own_weights =
        gltf_member(&node_at, "weights").json && gltf_member(primitive, "targets").json;
    if (file->nodes[node].skin != GLTF_NONE || own_weights) {
        status = build(primitive, node, mesh, posed);
    } else {
        ag_mesh **slots = &file->meshes[file->nodes[node].mesh];
        status = reserve_slots(primitive->up, slots);
        if (status)
            return status;
        ag_mesh *slot = *slots + primitive->index;
        if (slot->id == 0)
            status = build_shared(primitive, node, slot);
        *mesh = *slot;
    }
    if (mesh->id == nothing.id || status)
        mesh->id = 0;
    return status;
}
