// Vertices and triangles on their way into a .glb (spec 3.7.2): each attribute is an array of
// its own, and those that say nothing are left out.
#include "scene/gltf_write.h"
#include "scene/tangent.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ARRAY_BUFFER = 34962, ELEMENT_ARRAY_BUFFER = 34963 };

typedef struct attribute {
    const char *name, *type;
    size_t offset, size; // in scene_vertex
    gltf_component component;
} attribute;

static const attribute position = { "POSITION", "VEC3", offsetof(scene_vertex, position), 12,
                                    GLTF_FLOAT };
static const attribute normal = { "NORMAL", "VEC3", offsetof(scene_vertex, normal), 12,
                                  GLTF_FLOAT };
static const attribute tangent = { "TANGENT", "VEC4", offsetof(scene_vertex, tangent), 16,
                                   GLTF_FLOAT };
static const attribute uv0 = { "TEXCOORD_0", "VEC2", offsetof(scene_vertex, uv), 8, GLTF_FLOAT };
static const attribute uv1 = { "TEXCOORD_1", "VEC2", offsetof(scene_vertex, uv[1]), 8, GLTF_FLOAT };
static const attribute color = { "COLOR_0", "VEC4", offsetof(scene_vertex, color), 8, GLTF_USHORT };

static uint32_t add_accessor(gltf_writer *w, uint32_t view, gltf_component component,
                             const char *type, size_t count, json_t **accessor)
{
    *accessor = json_object();
    gltf_put_index(w, *accessor, "bufferView", view);
    gltf_put_index(w, *accessor, "componentType", (size_t)component);
    gltf_put_index(w, *accessor, "count", count);
    gltf_put_word(w, *accessor, "type", type);
    return gltf_append(w, w->root, "accessors", *accessor);
}

static uint32_t add_attribute(gltf_writer *w, const scene_mesh *mesh, const attribute *a,
                              json_t *attributes)
{
    uint8_t *rows = malloc(mesh->vertex_count * a->size);
    for (size_t i = 0; rows && i < mesh->vertex_count; i++)
        memcpy(rows + i * a->size, (const uint8_t *)&mesh->vertices[i] + a->offset, a->size);
    json_t *accessor;
    uint32_t view = gltf_add_view(w, rows, mesh->vertex_count * a->size, ARRAY_BUFFER);
    uint32_t index = add_accessor(w, view, a->component, a->type, mesh->vertex_count, &accessor);
    if (a->component != GLTF_FLOAT)
        gltf_put_true(w, accessor, "normalized");
    gltf_put_index(w, attributes, a->name, index);
    return index;
}

// The bounds of all vertices, also of those that no triangle uses: what the accessor holds.
static void put_bounds(gltf_writer *w, const scene_mesh *mesh, uint32_t index)
{
    float low[3] = { FLT_MAX, FLT_MAX, FLT_MAX }, high[3] = { -FLT_MAX, -FLT_MAX, -FLT_MAX };
    for (size_t i = 0; i < mesh->vertex_count; i++)
        for (int c = 0; c < 3; c++) {
            low[c] = fminf(low[c], mesh->vertices[i].position[c]);
            high[c] = fmaxf(high[c], mesh->vertices[i].position[c]);
        }
    json_t *accessor = json_array_get(json_object_get(w->root, "accessors"), index);
    gltf_put_floats(w, accessor, "min", low, 3);
    gltf_put_floats(w, accessor, "max", high, 3);
}

static bool any_bits(const scene_mesh *mesh, size_t offset, size_t size)
{
    static const uint8_t zeros[16] = { 0 };
    for (size_t i = 0; i < mesh->vertex_count; i++)
        if (memcmp((const uint8_t *)&mesh->vertices[i] + offset, zeros, size) != 0)
            return true;
    return false;
}

// Whether readers would not find the same tangents without being told.
static bool tangents_matter(const scene_mesh *mesh)
{
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        scene_vertex any = mesh->vertices[i];
        scene_mesh one = { .vertices = &any, .vertex_count = 1 };
        tangents_any(&one);
        if (memcmp(any.tangent, mesh->vertices[i].tangent, sizeof any.tangent) != 0)
            return true;
    }
    return false;
}

static uint32_t add_indices(gltf_writer *w, const scene_mesh *mesh)
{
    // 65535 would restart a strip.
    bool narrow = mesh->vertex_count <= UINT16_MAX;
    size_t size = mesh->index_count * (narrow ? sizeof(uint16_t) : sizeof(uint32_t));
    void *data = malloc(size);
    uint16_t *halves = data;
    for (size_t i = 0; data && narrow && i < mesh->index_count; i++)
        halves[i] = (uint16_t)mesh->indices[i];
    if (data && !narrow)
        memcpy(data, mesh->indices, size);
    json_t *accessor;
    uint32_t view = gltf_add_view(w, data, size, ELEMENT_ARRAY_BUFFER);
    return add_accessor(w, view, narrow ? GLTF_USHORT : GLTF_UINT, "SCALAR", mesh->index_count,
                        &accessor);
}

json_t *gltf_write_primitive(gltf_writer *w, uint32_t index)
{
    const scene_mesh *mesh = &w->scene->meshes[index];
    if (w->primitives[index])
        return w->primitives[index];
    json_t *primitive = json_object(), *attributes = gltf_put_object(w, primitive, "attributes");
    put_bounds(w, mesh, add_attribute(w, mesh, &position, attributes));
    add_attribute(w, mesh, &normal, attributes);
    if (w->tangents[index] || tangents_matter(mesh))
        add_attribute(w, mesh, &tangent, attributes);
    if (any_bits(mesh, uv0.offset, uv0.size + uv1.size)) // there is no second set without a first
        add_attribute(w, mesh, &uv0, attributes);
    if (any_bits(mesh, uv1.offset, uv1.size))
        add_attribute(w, mesh, &uv1, attributes);
    if (mesh->has_colors)
        add_attribute(w, mesh, &color, attributes);
    gltf_put_index(w, primitive, "indices", add_indices(w, mesh));
    return w->primitives[index] = primitive;
}
