// Tangent frames for normal maps: each triangle's own, gathered around each vertex (fan.c), and
// the vertices split where their triangles disagree.
#include "scene/tangent.h"

#include "base/array.h"
#include "base/threads.h"
#include "scene/fan.h"
#include "scene/vector.h"
#include "scene/weld.h"

#include <float.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK = 4096 }; // triangles or vertices a task works on

static size_t chunks_of(size_t count)
{
    return (count + CHUNK - 1) / CHUNK;
}

static size_t chunk_end(size_t chunk, size_t count)
{
    size_t end = (chunk + 1) * CHUNK;
    return end < count ? end : count;
}

static void set_any(scene_vertex *vertex)
{
    vec3_store(vec3_perpendicular(vec3_from(vertex->normal)), vertex->tangent);
    vertex->tangent[3] = 1.0f;
}

void tangents_any(scene_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        set_any(&mesh->vertices[i]);
}

typedef struct face {
    vec3 tangent; // unit; zero where it has none
    facing facing;
} face;

typedef struct solver {
    scene_mesh *mesh;
    unsigned uv_set;
    uint32_t *welded;  // [vertex_count]
    face *faces;       // [index_count / 3]
    uint32_t *starts;  // [vertex_count + 1], of each welded vertex's corners in `corners`
    uint32_t *corners; // [index_count], places in mesh->indices
    fan_frame *frames; // [index_count], of each corner
    uint32_t *copies;  // the next copy of a vertex, 0 = none
    size_t copies_capacity;
    atomic_bool failed;
} solver;

// ---- Triangles -------------------------------------------------------------

static vec3 edge(const scene_vertex *from, const scene_vertex *to)
{
    return vec3_sub(vec3_from(to->position), vec3_from(from->position));
}

static bool same_position(const scene_vertex *a, const scene_vertex *b)
{
    return a->position[0] == b->position[0] && a->position[1] == b->position[1] &&
           a->position[2] == b->position[2];
}

// a e1 + b e2, in double against overflow and underflow.
static vec3 combine_unit(double a, vec3 e1, double b, vec3 e2)
{
    double v[3] = { a * (double)e1.x + b * (double)e2.x, a * (double)e1.y + b * (double)e2.y,
                    a * (double)e1.z + b * (double)e2.z };
    double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    if (!(length > 0.0) || !isfinite(length))
        return (vec3) { 0.0f, 0.0f, 0.0f };
    return (vec3) { (float)(v[0] / length), (float)(v[1] / length), (float)(v[2] / length) };
}

// From P = P1 + (u - u1) S + (v - v1) T at the corners: S is the tangent, T the bitangent.
// glTF's v runs down the image, its tangent frames up, hence the sign of v.
static face face_of(const scene_vertex *const v[3], unsigned uv_set)
{
    const face none = { { 0.0f, 0.0f, 0.0f }, FACING_ANY };
    if (same_position(v[0], v[1]) || same_position(v[1], v[2]) || same_position(v[2], v[0]))
        return (face) { none.tangent, FACING_POINT };
    float u1 = v[1]->uv[uv_set][0] - v[0]->uv[uv_set][0];
    float v1 = v[0]->uv[uv_set][1] - v[1]->uv[uv_set][1];
    float u2 = v[2]->uv[uv_set][0] - v[0]->uv[uv_set][0];
    float v2 = v[0]->uv[uv_set][1] - v[2]->uv[uv_set][1];
    float area = u1 * v2 - u2 * v1;
    if (!(fabsf(area) > FLT_MIN) || !isfinite(area))
        return none;
    vec3 e1 = edge(v[0], v[1]), e2 = edge(v[0], v[2]);
    double sign = area > 0.0f ? 1.0 : -1.0;
    vec3 s = combine_unit(sign * (double)v2, e1, -sign * (double)v1, e2);
    vec3 t = combine_unit(-(double)u2, e1, (double)u1, e2);
    if (vec3_is_zero(s) || vec3_is_zero(t))
        return none;
    return (face) { s, area > 0.0f ? FACING_SAME : FACING_MIRRORED };
}

static void solve_faces(void *context, size_t chunk)
{
    solver *s = context;
    const scene_mesh *mesh = s->mesh;
    size_t end = chunk_end(chunk, mesh->index_count / 3);
    for (size_t i = chunk * CHUNK; i < end; i++) {
        const uint32_t *index = mesh->indices + 3 * i;
        const scene_vertex *v[3] = { &mesh->vertices[index[0]], &mesh->vertices[index[1]],
                                     &mesh->vertices[index[2]] };
        s->faces[i] = face_of(v, s->uv_set);
    }
}

// ---- Corners by vertex -----------------------------------------------------

// A counting sort of the corners by their welded vertex.
static void sort_corners(solver *s)
{
    uint32_t count = s->mesh->vertex_count;
    for (uint32_t i = 0; i < s->mesh->index_count; i++)
        s->starts[s->welded[s->mesh->indices[i]]]++;
    uint32_t sum = 0;
    for (uint32_t i = 0; i <= count; i++) {
        sum += s->starts[i];
        s->starts[i] = sum;
    }
    for (uint32_t i = s->mesh->index_count; i-- > 0;)
        s->corners[--s->starts[s->welded[s->mesh->indices[i]]]] = i;
}

static vec3 flatten(vec3 v, vec3 normal)
{
    v = vec3_unit(v);
    return vec3_unit(vec3_sub(v, vec3_scale(normal, vec3_dot(normal, v))));
}

static fan_corner corner_of(const solver *s, uint32_t corner, vec3 normal)
{
    const scene_mesh *mesh = s->mesh;
    uint32_t first = corner - corner % 3;
    uint32_t next = mesh->indices[first + (corner + 1) % 3];
    uint32_t previous = mesh->indices[first + (corner + 2) % 3];
    const face *f = &s->faces[corner / 3];
    fan_corner out = { s->welded[next], s->welded[previous], f->facing, f->tangent, 0.0f };
    if (f->facing == FACING_SAME || f->facing == FACING_MIRRORED) {
        const scene_vertex *here = &mesh->vertices[mesh->indices[corner]];
        vec3 a = flatten(edge(here, &mesh->vertices[previous]), normal);
        vec3 b = flatten(edge(here, &mesh->vertices[next]), normal);
        out.angle = acosf(fminf(fmaxf(vec3_dot(a, b), -1.0f), 1.0f));
    }
    return out;
}

static bool solve_vertex(solver *s, uint32_t vertex)
{
    enum { FEW = 32 };
    fan_corner few_corners[FEW];
    fan_frame few_frames[FEW];
    uint32_t start = s->starts[vertex], count = s->starts[vertex + 1] - start;
    if (count == 0)
        return true;
    fan_corner *corners = count <= FEW ? few_corners : malloc(count * sizeof *corners);
    fan_frame *frames = count <= FEW ? few_frames : malloc(count * sizeof *frames);
    vec3 normal = vec3_from(s->mesh->vertices[vertex].normal);
    bool done = corners && frames;
    for (uint32_t i = 0; done && i < count; i++)
        corners[i] = corner_of(s, s->corners[start + i], normal);
    done = done && fan_solve(normal, corners, count, frames);
    for (uint32_t i = 0; done && i < count; i++)
        s->frames[s->corners[start + i]] = frames[i];
    if (count > FEW) {
        free(corners);
        free(frames);
    }
    return done;
}

static void solve_vertices(void *context, size_t chunk)
{
    solver *s = context;
    size_t end = chunk_end(chunk, s->mesh->vertex_count);
    for (size_t i = chunk * CHUNK; i < end; i++)
        if (!solve_vertex(s, (uint32_t)i))
            atomic_store(&s->failed, true);
}

// ---- Splitting -------------------------------------------------------------

static bool has_frame(const scene_vertex *vertex, const fan_frame *frame)
{
    return vertex->tangent[0] == frame->tangent.x && vertex->tangent[1] == frame->tangent.y &&
           vertex->tangent[2] == frame->tangent.z && vertex->tangent[3] == frame->handedness;
}

static void set_frame(scene_vertex *vertex, const fan_frame *frame)
{
    vec3_store(frame->tangent, vertex->tangent);
    vertex->tangent[3] = frame->handedness;
}

static bool add_copy(solver *s, uint32_t *capacity, uint32_t of)
{
    scene_mesh *mesh = s->mesh;
    if (mesh->vertex_count == UINT32_MAX)
        return false;
    size_t wanted = mesh->vertex_count + (size_t)1, room = *capacity;
    if (!array_reserve(&s->copies, &s->copies_capacity, wanted, sizeof *s->copies) ||
        !array_reserve(&mesh->vertices, &room, wanted, sizeof *mesh->vertices))
        return false;
    *capacity = room < UINT32_MAX ? (uint32_t)room : UINT32_MAX;
    mesh->vertices[mesh->vertex_count] = mesh->vertices[of];
    s->copies[mesh->vertex_count++] = 0;
    return true;
}

// Point a corner at a copy of its vertex that has the corner's frame.  Where one vertex has
// many frames the search gives up, and the copy may be one of several alike.
static bool place_corner(solver *s, uint32_t corner, uint32_t *capacity)
{
    enum { PATIENCE = 16 };
    scene_mesh *mesh = s->mesh;
    const fan_frame *frame = &s->frames[corner];
    uint32_t first = mesh->indices[corner], at = first;
    if (mesh->vertices[first].tangent[3] == 0.0f) { // not used by a corner before
        set_frame(&mesh->vertices[first], frame);
        return true;
    }
    for (int i = 0; i < PATIENCE; i++) {
        if (has_frame(&mesh->vertices[at], frame)) {
            mesh->indices[corner] = at;
            return true;
        }
        if (s->copies[at] == 0)
            break;
        at = s->copies[at];
    }
    if (!add_copy(s, capacity, first))
        return false;
    uint32_t made = mesh->vertex_count - 1;
    set_frame(&mesh->vertices[made], frame);
    s->copies[made] = s->copies[first];
    s->copies[first] = made;
    mesh->indices[corner] = made;
    return true;
}

static bool place_corners(solver *s)
{
    scene_mesh *mesh = s->mesh;
    uint32_t capacity = mesh->vertex_count;
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        mesh->vertices[i].tangent[3] = 0.0f;
    for (uint32_t i = 0; i < mesh->index_count; i++)
        if (!place_corner(s, i, &capacity))
            return false;
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        if (mesh->vertices[i].tangent[3] == 0.0f)
            set_any(&mesh->vertices[i]);
    return true;
}

// ---- The whole -------------------------------------------------------------

static bool allocate(solver *s)
{
    size_t vertices = s->mesh->vertex_count, corners = s->mesh->index_count;
    s->welded = malloc(vertices * sizeof *s->welded);
    s->faces = malloc(corners / 3 * sizeof *s->faces);
    s->starts = calloc(vertices + 1, sizeof *s->starts);
    s->corners = malloc(corners * sizeof *s->corners);
    s->frames = malloc(corners * sizeof *s->frames);
    s->copies = calloc(vertices, sizeof *s->copies);
    s->copies_capacity = vertices;
    return s->welded && s->faces && s->starts && s->corners && s->frames && s->copies;
}

static void finish(solver *s)
{
    free(s->welded);
    free(s->faces);
    free(s->starts);
    free(s->corners);
    free(s->frames);
    free(s->copies);
}

bool tangents_compute(scene_mesh *mesh, unsigned uv_set)
{
    solver s = { .mesh = mesh, .uv_set = uv_set };
    bool done = allocate(&s) && weld_vertices(mesh, uv_set, s.welded);
    if (done) {
        parallel_for(chunks_of(mesh->index_count / 3), solve_faces, &s);
        sort_corners(&s);
        parallel_for(chunks_of(mesh->vertex_count), solve_vertices, &s);
        done = !atomic_load(&s.failed) && place_corners(&s);
    }
    finish(&s);
    return done;
}
