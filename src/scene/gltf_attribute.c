// Vertex attributes (spec 3.7.2.1) with morph targets applied (spec 3.7.2.2).
#include "scene/gltf.h"

#include <stdlib.h>
#include <string.h>

ag_status gltf_attribute_find(const gltf_at *attributes, const char *name,
                              const gltf_accessor **accessor)
{
    gltf_file *file = attributes->file;
    uint32_t index = GLTF_NONE;
    ag_status status = gltf_index(attributes, name, file->accessor_count, "accessors", &index);
    *accessor = index == GLTF_NONE ? NULL : &file->accessors[index];
    return status;
}

// Read into `out`, rows of attribute->width; false in *found when the file has none.
static ag_status read_rows(const gltf_at *attributes, const gltf_attribute *attribute,
                           const gltf_geometry *geometry, float *out, bool *found)
{
    gltf_at at = gltf_member(attributes, attribute->name);
    const gltf_accessor *accessor = NULL;
    ag_status status = gltf_attribute_find(attributes, attribute->name, &accessor);
    *found = accessor != NULL;
    if (status || !accessor)
        return status;
    size_t index = (size_t)(accessor - at.file->accessors);
    if (accessor->columns != 1 || accessor->rows < attribute->least ||
        accessor->rows > attribute->width)
        return gltf_fail(&at, AG_ERROR_FORMAT, "accessors[%zu] is not of the type VEC%zu", index,
                         attribute->width);
    if (accessor->count != geometry->element_count)
        return gltf_fail(&at, AG_ERROR_FORMAT, "accessors[%zu] has %u elements, POSITION has %zu",
                         index, accessor->count, geometry->element_count);
    status = gltf_charge(&at, &at.file->work_budget, geometry->vertex_count);
    if (status)
        return status;
    gltf_accessor_floats(accessor, geometry->first, geometry->vertex_count, attribute->width,
                         attribute->normalize, out);
    if (!gltf_all_finite(out, geometry->vertex_count * attribute->width))
        gltf_warn_once(&at, GLTF_WARNED_FINITE, "accessors[%zu] holds a value that is not finite",
                       index);
    return AG_OK;
}

// Add weight * difference of one target.
static ag_status add_target(const gltf_at *target, const gltf_attribute *attribute,
                            const gltf_geometry *geometry, float weight, float *out)
{
    size_t count = geometry->vertex_count * attribute->width;
    float *difference = calloc(count, sizeof *difference);
    if (!difference)
        return gltf_no_memory(target);
    bool found = false;
    ag_status status = read_rows(target, attribute, geometry, difference, &found);
    for (size_t i = 0; !status && found && i < count; i++)
        out[i] += weight * difference[i];
    free(difference);
    return status;
}

static ag_status add_targets(const gltf_attribute *attribute, const gltf_morph *morph,
                             const gltf_geometry *geometry, float *out)
{
    gltf_attribute differences = *attribute;
    if (differences.width == 4) // handedness and alpha need not be there
        differences.least = 3;
    ag_status status = AG_OK;
    for (size_t i = 0; morph && i < morph->count && !status; i++) {
        gltf_at target = gltf_item(&morph->targets, i);
        if (morph->weights[i] != 0.0f && gltf_member(&target, attribute->name).json)
            status = add_target(&target, &differences, geometry, morph->weights[i], out);
    }
    return status;
}

ag_status gltf_attribute_read(const gltf_at *attributes, const gltf_attribute *attribute,
                              const gltf_morph *morph, const gltf_geometry *geometry, float **out)
{
    if (!gltf_member(attributes, attribute->name).json)
        return AG_OK;
    size_t count = geometry->vertex_count * attribute->width;
    float *rows = malloc(count * sizeof *rows);
    if (!rows)
        return gltf_no_memory(attributes);
    for (size_t i = 0; attribute->least < attribute->width && i < count; i++)
        rows[i] = 1.0f;
    bool found = false;
    ag_status status = read_rows(attributes, attribute, geometry, rows, &found);
    if (!status)
        status = add_targets(attribute, morph, geometry, rows);
    if (status)
        free(rows);
    else
        *out = rows;
    return status;
}

// The node's weights, else the mesh's; all zero where neither has them.
static ag_status read_weights(const gltf_at *holder, gltf_morph *morph)
{
    gltf_at weights;
    ag_status status = gltf_array(holder, "weights", &weights);
    if (!status && weights.json && gltf_length(&weights) != morph->count)
        return gltf_fail(&weights, AG_ERROR_FORMAT, "has %zu numbers for %zu morph targets",
                         gltf_length(&weights), morph->count);
    for (size_t i = 0; !status && i < gltf_length(&weights); i++) {
        gltf_at item = gltf_item(&weights, i);
        status = gltf_item_float(&item, &morph->weights[i]);
    }
    return status;
}

ag_status gltf_morph_read(const gltf_at *primitive, const gltf_at *mesh, uint32_t node,
                          gltf_morph *morph)
{
    gltf_at root = gltf_root(primitive->file), nodes = gltf_member(&root, "nodes");
    gltf_at node_at = gltf_item(&nodes, node);
    ag_status status = gltf_objects(primitive, "targets", &morph->targets);
    morph->count = gltf_length(&morph->targets);
    if (status || morph->count == 0)
        return status;
    status = gltf_charge(&morph->targets, &primitive->file->work_budget, morph->count);
    if (status)
        return status;
    morph->weights = calloc(morph->count, sizeof *morph->weights);
    if (!morph->weights)
        return gltf_no_memory(&morph->targets);
    return read_weights(gltf_member(&node_at, "weights").json ? &node_at : mesh, morph);
}
