// Meshes: checked, mended and packed for the renderer.
#include "base/array.h"
#include "base/log.h"
#include "base/threads.h"
#include "scene/scene.h"
#include "scene/tangent.h"
#include "scene/vector.h"

#include <float.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK = 1 << 15 }; // vertices or indices a task works on

static size_t chunks_of(size_t count)
{
    return (count + CHUNK - 1) / CHUNK;
}

static size_t chunk_end(size_t chunk, size_t count)
{
    size_t end = (chunk + 1) * CHUNK;
    return end < count ? end : count;
}

// ---- Checks ----------------------------------------------------------------

static ag_status check_shape(const ag_log *log, const ag_mesh_desc *desc, uint32_t index_count)
{
    if (!desc->positions || desc->vertex_count == 0 || index_count == 0)
        return log_fail(log, AG_ERROR_ARGUMENT, "A mesh has no triangles.");
    if (index_count % 3 != 0)
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "A mesh has %u indices: triangles need a multiple of 3.", index_count);
    if (!desc->indices && index_count > desc->vertex_count)
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "A mesh without indices has %u corners but only %u vertices.", index_count,
                        desc->vertex_count);
    if (desc->tangent_uv_set > 1)
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "A mesh's tangents follow uv set %u: there are 0 and 1.",
                        desc->tangent_uv_set);
    return AG_OK;
}

static ag_status check_contents(const ag_log *log, const ag_mesh_desc *desc, uint32_t index_count)
{
    uint32_t largest = 0;
    for (uint32_t i = 0; desc->indices && i < index_count; i++)
        largest = desc->indices[i] > largest ? desc->indices[i] : largest;
    if (largest >= desc->vertex_count)
        return log_fail(log, AG_ERROR_FORMAT,
                        "A mesh's index names vertex %u, but there are only %u vertices.", largest,
                        desc->vertex_count);
    // x - x is 0 for finite x and NaN for all else, so that one sum tells about all.
    float sum = 0.0f;
    for (size_t i = 0; i < (size_t)desc->vertex_count * 3; i++)
        sum += desc->positions[i] - desc->positions[i];
    if (sum == 0.0f)
        return AG_OK;
    size_t bad = 0;
    while (isfinite(desc->positions[bad]))
        bad++;
    return log_fail(log, AG_ERROR_FORMAT,
                    "The position of a mesh's vertex %zu is infinite or not a number.", bad / 3);
}

// ---- Packing ---------------------------------------------------------------

typedef struct packing {
    const ag_mesh_desc *desc;
    scene_mesh *mesh;
    bool flat;                // one vertex for every corner
    atomic_bool colored;      // some colour is not white
    atomic_bool zero_normals; // some normal has no direction
} packing;

static uint16_t pack_color(float value)
{
    if (!isfinite(value))
        value = 1.0f;
    return (uint16_t)(fminf(fmaxf(value, 0.0f), 1.0f) * 65535.0f + 0.5f);
}

static void pack_uv(const float *uv, float out[2])
{
    out[0] = isfinite(uv[0]) ? uv[0] : 0.0f;
    out[1] = isfinite(uv[1]) ? uv[1] : 0.0f;
}

static void pack_vertex(const packing *p, size_t source, scene_vertex *out)
{
    const ag_mesh_desc *desc = p->desc;
    *out = (scene_vertex) { .color = { 0xffff, 0xffff, 0xffff, 0xffff } };
    memcpy(out->position, desc->positions + 3 * source, sizeof out->position);
    if (!p->flat)
        vec3_store(vec3_unit(vec3_from(desc->normals + 3 * source)), out->normal);
    if (desc->tangents && !p->flat)
        memcpy(out->tangent, desc->tangents + 4 * source, sizeof out->tangent);
    for (int set = 0; set < 2; set++)
        if (desc->uvs[set])
            pack_uv(desc->uvs[set] + 2 * source, out->uv[set]);
    for (int i = 0; desc->colors && i < 4; i++)
        out->color[i] = pack_color(desc->colors[4 * source + (size_t)i]);
}

static void pack_chunk(void *context, size_t chunk)
{
    packing *p = context;
    const uint32_t *indices = p->flat ? p->desc->indices : NULL;
    bool colored = false, zero = false;
    size_t end = chunk_end(chunk, p->mesh->vertex_count);
    for (size_t i = chunk * CHUNK; i < end; i++) {
        scene_vertex *vertex = &p->mesh->vertices[i];
        pack_vertex(p, indices ? indices[i] : i, vertex);
        colored |=
            (vertex->color[0] & vertex->color[1] & vertex->color[2] & vertex->color[3]) != 0xffff;
        zero |= vec3_is_zero(vec3_from(vertex->normal));
    }
    if (colored)
        atomic_store(&p->colored, true);
    if (zero)
        atomic_store(&p->zero_normals, true);
}

static bool allocate(scene_mesh *mesh, size_t vertex_count, size_t index_count)
{
    mesh->vertices = malloc(vertex_count * sizeof *mesh->vertices);
    mesh->indices = malloc(index_count * sizeof *mesh->indices);
    mesh->vertex_count = (uint32_t)vertex_count;
    mesh->index_count = (uint32_t)index_count;
    return mesh->vertices && mesh->indices;
}

static void fill_indices(scene_mesh *mesh, const uint32_t *indices)
{
    if (indices)
        memcpy(mesh->indices, indices, mesh->index_count * sizeof *indices);
    for (uint32_t i = 0; !indices && i < mesh->index_count; i++)
        mesh->indices[i] = i;
}

// ---- Normals ---------------------------------------------------------------

// The normal of a triangle, as long as twice its area, in double so that neither tiny nor
// huge triangles lose it; scaled down to fit a float.
static vec3 face_normal(const scene_mesh *mesh, const uint32_t corners[3])
{
    double e[2][3], largest = 0.0;
    for (int i = 0; i < 3; i++) {
        double origin = (double)mesh->vertices[corners[0]].position[i];
        e[0][i] = (double)mesh->vertices[corners[1]].position[i] - origin;
        e[1][i] = (double)mesh->vertices[corners[2]].position[i] - origin;
    }
    double n[3] = { e[0][1] * e[1][2] - e[0][2] * e[1][1], e[0][2] * e[1][0] - e[0][0] * e[1][2],
                    e[0][0] * e[1][1] - e[0][1] * e[1][0] };
    for (int i = 0; i < 3; i++)
        largest = fmax(largest, fabs(n[i]));
    if (!(largest > 0.0))
        return (vec3) { 0.0f, 0.0f, 0.0f };
    return vec3_unit(
        (vec3) { (float)(n[0] / largest), (float)(n[1] / largest), (float)(n[2] / largest) });
}

static void flatten_chunk(void *context, size_t chunk)
{
    scene_mesh *mesh = context;
    size_t end = chunk_end(chunk, mesh->index_count / 3);
    for (size_t face = chunk * CHUNK; face < end; face++) {
        const uint32_t *corners = mesh->indices + 3 * face;
        vec3 normal = face_normal(mesh, corners);
        if (vec3_is_zero(normal)) // never seen, but must not be NaN in the shader
            normal.y = 1.0f;
        for (int i = 0; i < 3; i++)
            vec3_store(normal, mesh->vertices[corners[i]].normal);
    }
}

// Normals without a direction become the mean of their triangles', or +Y where even that
// has none.  `pending` marks those vertices.
static void sum_normals(scene_mesh *mesh, const bool *pending)
{
    for (size_t i = 0; i < mesh->index_count; i += 3) {
        const uint32_t *corners = mesh->indices + i;
        if (!pending[corners[0]] && !pending[corners[1]] && !pending[corners[2]])
            continue;
        vec3 normal = face_normal(mesh, corners);
        for (int c = 0; c < 3; c++) {
            float *out = mesh->vertices[corners[c]].normal;
            if (pending[corners[c]])
                vec3_store(vec3_add(vec3_from(out), normal), out);
        }
    }
}

static bool mend_normals(scene_mesh *mesh)
{
    bool *pending = calloc(mesh->vertex_count, sizeof *pending);
    if (!pending)
        return false;
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        pending[i] = vec3_is_zero(vec3_from(mesh->vertices[i].normal));
    sum_normals(mesh, pending);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        if (!pending[i])
            continue;
        vec3 normal = vec3_unit(vec3_from(mesh->vertices[i].normal));
        if (vec3_is_zero(normal))
            normal.y = 1.0f;
        vec3_store(normal, mesh->vertices[i].normal);
    }
    free(pending);
    return true;
}

// ---- Given tangents, bounds ------------------------------------------------

// Unit length and w = +1 or -1; a tangent without a direction becomes any one.
static void mend_tangents(scene_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        scene_vertex *vertex = &mesh->vertices[i];
        vec3 tangent = vec3_unit(vec3_from(vertex->tangent));
        if (vec3_is_zero(tangent))
            tangent = vec3_perpendicular(vec3_from(vertex->normal));
        vec3_store(tangent, vertex->tangent);
        vertex->tangent[3] = vertex->tangent[3] < 0.0f ? -1.0f : 1.0f;
    }
}

// Of the vertices that triangles use.
static void measure(scene_mesh *mesh)
{
    vec3 low = { FLT_MAX, FLT_MAX, FLT_MAX }, high = { -FLT_MAX, -FLT_MAX, -FLT_MAX };
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        const float *p = mesh->vertices[mesh->indices[i]].position;
        low = (vec3) { fminf(low.x, p[0]), fminf(low.y, p[1]), fminf(low.z, p[2]) };
        high = (vec3) { fmaxf(high.x, p[0]), fmaxf(high.y, p[1]), fmaxf(high.z, p[2]) };
    }
    vec3_store(low, mesh->min);
    vec3_store(high, mesh->max);
}

// ---- The whole -------------------------------------------------------------

static bool add_tangents(scene_mesh *mesh, const ag_mesh_desc *desc)
{
    if (desc->tangents && desc->normals)
        mend_tangents(mesh);
    else if (desc->skip_tangents || !desc->uvs[desc->tangent_uv_set])
        tangents_any(mesh);
    else
        return tangents_compute(mesh, desc->tangent_uv_set);
    return true;
}

static bool build(scene_mesh *mesh, const ag_mesh_desc *desc, uint32_t index_count)
{
    packing p = { .desc = desc, .mesh = mesh, .flat = !desc->normals };
    if (!allocate(mesh, p.flat ? index_count : desc->vertex_count, index_count))
        return false;
    fill_indices(mesh, p.flat ? NULL : desc->indices);
    parallel_for(chunks_of(mesh->vertex_count), pack_chunk, &p);
    mesh->has_colors = atomic_load(&p.colored);
    if (p.flat)
        parallel_for(chunks_of(index_count / 3), flatten_chunk, mesh);
    else if (atomic_load(&p.zero_normals) && !mend_normals(mesh))
        return false;
    measure(mesh);
    return add_tangents(mesh, desc);
}

ag_status ag_scene_add_mesh(ag_scene *scene, const ag_mesh_desc *desc, ag_mesh *mesh)
{
    *mesh = (ag_mesh) { 0 };
    uint32_t index_count = desc->index_count;
    if (!desc->indices && index_count == 0)
        index_count = desc->vertex_count;
    ag_status status = check_shape(&scene->log, desc, index_count);
    if (status == AG_OK)
        status = check_contents(&scene->log, desc, index_count);
    if (status != AG_OK)
        return status;
    scene_mesh made = { 0 };
    if (!build(&made, desc, index_count) ||
        !array_reserve(&scene->meshes, &scene->meshes_capacity, scene->meshes_count + 1,
                       sizeof *scene->meshes)) {
        free(made.vertices);
        free(made.indices);
        return log_fail(&scene->log, AG_ERROR_MEMORY,
                        "There is no memory for a mesh of %u vertices and %u indices.",
                        desc->vertex_count, index_count);
    }
    scene->meshes[scene->meshes_count++] = made;
    mesh->id = (uint32_t)scene->meshes_count;
    scene->revision++;
    return AG_OK;
}
