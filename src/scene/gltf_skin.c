// Skins (spec 3.7.3) in the pose of the file: vertices are moved on the CPU into world
// space, where the skinned node's own transform does not count.
//   world = sum over joints j of w_j * world(j) * inverse_bind(j)
#include "scene/gltf.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- Joints --------------------------------------------------------------------------

static ag_status find_inverse_binds(const gltf_at *at, size_t count, const gltf_accessor **found)
{
    gltf_file *file = at->file;
    gltf_at place = gltf_member(at, "inverseBindMatrices");
    uint32_t index = GLTF_NONE;
    *found = NULL;
    ag_status status =
        gltf_index(at, "inverseBindMatrices", file->accessor_count, "accessors", &index);
    if (status || index == GLTF_NONE)
        return status;
    const gltf_accessor *accessor = &file->accessors[index];
    if (accessor->columns != 4 || accessor->component != GLTF_FLOAT)
        return gltf_fail(&place, AG_ERROR_FORMAT, "accessors[%u] does not hold MAT4 floats", index);
    if (accessor->count < count)
        return gltf_fail(&place, AG_ERROR_FORMAT, "accessors[%u] has %u matrices for %zu joints",
                         index, accessor->count, count);
    *found = accessor;
    return AG_OK;
}

static ag_status pose_joint(const gltf_at *item, const gltf_accessor *inverse_binds,
                            double joint[16], bool *mirrors)
{
    gltf_file *file = item->file;
    uint32_t node = 0;
    float inverse_bind[16];
    double bind[16], world[16];
    ag_status status = gltf_item_index(item, file->node_count, "nodes", &node);
    if (status)
        return status;
    gltf_matrix_identity(bind);
    if (inverse_binds) {
        gltf_accessor_floats(inverse_binds, item->index, 1, 16, false, inverse_bind);
        for (int i = 0; i < 16; i++)
            bind[i] = (double)inverse_bind[i];
    }
    gltf_matrix_multiply(file->nodes[node].world, bind, world);
    *mirrors = gltf_matrix_determinant(world) < 0.0;
    for (int i = 0; i < 16; i++)
        if (!isfinite(world[i]))
            return gltf_fail(item, AG_ERROR_FORMAT, "its matrix is not finite");
    memcpy(joint, world, sizeof world);
    return AG_OK;
}

static ag_status pose(const gltf_at *at, gltf_skin *skin)
{
    gltf_at joints;
    const gltf_accessor *inverse_binds;
    size_t mirrored = 0;
    ag_status status = gltf_array(at, "joints", &joints);
    size_t count = gltf_length(&joints);
    if (!status && count == 0)
        return gltf_fail(&joints, AG_ERROR_FORMAT, "must have at least one joint");
    if (!status)
        status = find_inverse_binds(at, count, &inverse_binds);
    if (status)
        return status;
    skin->joints = malloc(count * sizeof *skin->joints);
    if (!skin->joints)
        return gltf_no_memory(at);
    for (size_t i = 0; i < count && !status; i++) {
        gltf_at item = gltf_item(&joints, i);
        bool mirrors = false;
        status = pose_joint(&item, inverse_binds, skin->joints[i], &mirrors);
        mirrored += mirrors;
    }
    skin->joint_count = count;
    skin->mirrored = mirrored > count / 2;
    return status;
}

// ---- Vertices ------------------------------------------------------------------------

// For each vertex the weighted sum of its joints' upper three rows, column major.
typedef struct blend {
    double (*matrices)[12];
    double *weight_sums;
    size_t count;
} blend;

static ag_status add_joint(const gltf_at *at, const gltf_skin *skin, uint32_t joint, float weight,
                           double matrix[12])
{
    if (joint >= skin->joint_count)
        return gltf_fail(at, AG_ERROR_FORMAT, "names joint %u, but its skin has only %zu", joint,
                         skin->joint_count);
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 3; row++)
            matrix[column * 3 + row] += (double)weight * skin->joints[joint][column * 4 + row];
    return AG_OK;
}

static ag_status add_influences(const gltf_at *at, const gltf_skin *skin, const uint32_t *joints,
                                const float *weights, blend *sum)
{
    ag_status status = AG_OK;
    for (size_t i = 0; i < sum->count * 4 && !status; i++) {
        if (!(weights[i] > 0.0f))
            continue;
        sum->weight_sums[i / 4] += (double)weights[i];
        status = add_joint(at, skin, joints[i], weights[i], sum->matrices[i / 4]);
    }
    return status;
}

// JOINTS_n and WEIGHTS_n; false in *found where there is no such set.
static ag_status add_set(const gltf_at *attributes, const gltf_skin *skin, unsigned set,
                         const gltf_geometry *geometry, blend *sum, bool *found)
{
    char joints_name[24], weights_name[24];
    snprintf(joints_name, sizeof joints_name, "JOINTS_%u", set);
    snprintf(weights_name, sizeof weights_name, "WEIGHTS_%u", set);
    gltf_at at = gltf_member(attributes, joints_name);
    gltf_attribute attribute = { weights_name, 4, 4, true };
    const gltf_accessor *accessor = NULL;
    ag_status status = gltf_attribute_find(attributes, joints_name, &accessor);
    *found = accessor != NULL;
    if (status || !accessor)
        return status;
    if (accessor->count != geometry->element_count)
        return gltf_fail(&at, AG_ERROR_FORMAT, "has %u elements, POSITION has %zu", accessor->count,
                         geometry->element_count);
    status = gltf_require(attributes, weights_name);
    if (!status)
        status = gltf_charge(&at, &at.file->work_budget, 4 * sum->count);
    uint32_t *joints = status ? NULL : malloc(sum->count * 4 * sizeof *joints);
    float *weights = NULL;
    if (!status && !joints)
        status = gltf_no_memory(&at);
    if (!status)
        status = gltf_accessor_uints(&at, accessor, geometry->first, sum->count, 4, joints);
    if (!status)
        status = gltf_attribute_read(attributes, &attribute, NULL, geometry, &weights);
    if (!status)
        status = add_influences(&at, skin, joints, weights, sum);
    free(joints);
    free(weights);
    return status;
}

// Weights that do not sum to one are scaled to; a vertex without any follows joint 0.
static void normalize(const gltf_skin *skin, blend *sum)
{
    for (size_t v = 0; v < sum->count; v++) {
        double *m = sum->matrices[v], weight = sum->weight_sums[v];
        for (int i = 0; i < 12; i++)
            m[i] = weight > 0.0 ? m[i] / weight : skin->joints[0][i / 3 * 4 + i % 3];
    }
}

static void transform(const double m[9], const double offset[3], float v[3])
{
    double x = (double)v[0], y = (double)v[1], z = (double)v[2];
    for (int i = 0; i < 3; i++)
        v[i] = (float)(m[i] * x + m[3 + i] * y + m[6 + i] * z + offset[i]);
}

// Normals turn with the cofactors, which are the inverse transpose up to scale.
static void move_vertex(const double m[12], size_t v, gltf_geometry *geometry)
{
    static const double none[3] = { 0.0, 0.0, 0.0 };
    double full[16] = { 0 }, cofactor[9], largest = 0.0;
    transform(m, m + 9, geometry->positions + 3 * v);
    if (!geometry->normals)
        return;
    for (int i = 0; i < 9; i++)
        full[i / 3 * 4 + i % 3] = m[i];
    gltf_matrix_cofactor(full, cofactor);
    bool mirrors = gltf_matrix_determinant(full) < 0.0;
    for (int i = 0; i < 9; i++)
        largest = fmax(largest, fabs(cofactor[i]));
    for (int i = 0; i < 9; i++)
        cofactor[i] /= mirrors ? -largest : largest;
    if (largest > 0.0)
        transform(cofactor, none, geometry->normals + 3 * v);
    if (!geometry->tangents)
        return;
    transform(m, none, geometry->tangents + 4 * v);
    if (mirrors)
        geometry->tangents[4 * v + 3] *= -1.0f;
}

// Mirrored triangles would show their backs.
static ag_status turn_triangles(const gltf_at *at, gltf_geometry *geometry)
{
    if (!geometry->indices) {
        geometry->indices = malloc(geometry->index_count * sizeof *geometry->indices);
        if (!geometry->indices)
            return gltf_no_memory(at);
        for (size_t i = 0; i < geometry->index_count; i++)
            geometry->indices[i] = (uint32_t)i;
    }
    for (size_t i = 0; i + 2 < geometry->index_count; i += 3) {
        uint32_t second = geometry->indices[i + 1];
        geometry->indices[i + 1] = geometry->indices[i + 2];
        geometry->indices[i + 2] = second;
    }
    return AG_OK;
}

static ag_status move(const gltf_at *attributes, const gltf_skin *skin, gltf_geometry *geometry)
{
    blend sum = { .count = geometry->vertex_count };
    sum.matrices = calloc(sum.count, sizeof *sum.matrices);
    sum.weight_sums = calloc(sum.count, sizeof *sum.weight_sums);
    ag_status status = AG_OK;
    if (!sum.matrices || !sum.weight_sums)
        status = gltf_no_memory(attributes);
    bool found = true;
    for (unsigned set = 0; found && !status; set++)
        status = add_set(attributes, skin, set, geometry, &sum, &found);
    if (!status) {
        normalize(skin, &sum);
        for (size_t v = 0; v < sum.count; v++)
            move_vertex(sum.matrices[v], v, geometry);
        if (skin->mirrored)
            status = turn_triangles(attributes, geometry);
    }
    free(sum.matrices);
    free(sum.weight_sums);
    return status;
}

ag_status gltf_skin_apply(const gltf_at *primitive, uint32_t index, gltf_geometry *geometry,
                          bool *posed)
{
    gltf_file *file = primitive->file;
    gltf_at root = gltf_root(file), skins = gltf_member(&root, "skins");
    gltf_at at = gltf_item(&skins, index), attributes;
    gltf_skin *skin = &file->skins[index];
    *posed = false;
    ag_status status = gltf_object(primitive, "attributes", &attributes);
    if (status)
        return status;
    if (!gltf_member(&attributes, "JOINTS_0").json) {
        gltf_warn_once(&attributes, GLTF_WARNED_SKIN, "has no JOINTS_0: its skin does not move it");
        return AG_OK;
    }
    if (!skin->joints)
        status = pose(&at, skin);
    if (!status)
        status = move(&attributes, skin, geometry);
    *posed = !status;
    return status;
}
