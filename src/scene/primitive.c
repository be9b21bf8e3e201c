// Simple solids.  Each is a sum of patches: grids of points given by a function of (s, t) in
// the unit square, seen from outside with s to the right and t downwards, as uvs run.
#include "scene/primitive.h"

#include "base/log.h"
#include "scene/vector.h"

#include <stdlib.h>
#include <string.h>

static const float pi = 3.14159265359f;

typedef struct point {
    vec3 position, normal;
    float uv[2];
} point;

typedef point point_at(const void *shape, float s, float t);

typedef struct patches {
    float *positions, *normals, *uvs;
    uint32_t *indices;
    uint32_t vertex_count, index_count;
} patches;

static void patches_finish(patches *p)
{
    free(p->positions);
    free(p->normals);
    free(p->uvs);
    free(p->indices);
}

static bool patches_init(patches *p, size_t count, unsigned columns, unsigned rows)
{
    size_t vertices = count * (columns + 1) * (rows + 1), cells = count * columns * rows;
    *p = (patches) { .positions = malloc(vertices * 3 * sizeof(float)),
                     .normals = malloc(vertices * 3 * sizeof(float)),
                     .uvs = malloc(vertices * 2 * sizeof(float)),
                     .indices = malloc(cells * 6 * sizeof(uint32_t)) };
    if (p->positions && p->normals && p->uvs && p->indices)
        return true;
    patches_finish(p);
    return false;
}

static bool coincide(const patches *p, uint32_t a, uint32_t b)
{
    const float *pa = p->positions + 3 * a, *pb = p->positions + 3 * b;
    return pa[0] == pb[0] && pa[1] == pb[1] && pa[2] == pb[2];
}

// Leaves out triangles of no area, as at a sphere's poles.
static void add_triangle(patches *p, uint32_t a, uint32_t b, uint32_t c)
{
    if (coincide(p, a, b) || coincide(p, b, c) || coincide(p, c, a))
        return;
    uint32_t *out = p->indices + p->index_count;
    out[0] = a;
    out[1] = b;
    out[2] = c;
    p->index_count += 3;
}

static void add_patch(patches *p, unsigned columns, unsigned rows, point_at *at, const void *shape)
{
    uint32_t first = p->vertex_count;
    for (unsigned row = 0; row <= rows; row++) {
        for (unsigned column = 0; column <= columns; column++) {
            point v = at(shape, (float)column / (float)columns, (float)row / (float)rows);
            vec3_store(v.position, p->positions + 3 * p->vertex_count);
            vec3_store(v.normal, p->normals + 3 * p->vertex_count);
            memcpy(p->uvs + 2 * p->vertex_count, v.uv, sizeof v.uv);
            p->vertex_count++;
        }
    }
    for (unsigned row = 0; row < rows; row++) {
        for (unsigned column = 0; column < columns; column++) {
            uint32_t a = first + row * (columns + 1) + column, b = a + columns + 1;
            add_triangle(p, a, b, b + 1);
            add_triangle(p, a, b + 1, a + 1);
        }
    }
}

static ag_status hand_over(ag_scene *scene, patches *p, ag_mesh *mesh)
{
    ag_mesh_desc desc = { .positions = p->positions,
                          .normals = p->normals,
                          .uvs = { p->uvs },
                          .vertex_count = p->vertex_count,
                          .indices = p->indices,
                          .index_count = p->index_count };
    ag_status status = ag_scene_add_mesh(scene, &desc, mesh);
    patches_finish(p);
    return status;
}

static ag_status add_single(ag_scene *scene, unsigned columns, unsigned rows, point_at *at,
                            const void *shape, ag_mesh *mesh)
{
    patches p;
    if (!patches_init(&p, 1, columns, rows))
        return log_fail(&scene->log, AG_ERROR_MEMORY, "There is no memory for a mesh.");
    add_patch(&p, columns, rows, at, shape);
    return hand_over(scene, &p, mesh);
}

// ---- Sphere ----------------------------------------------------------------

// Exactly 0 at whole multiples of pi, and the same at both ends of a turn.
static void circle(float turns, float *cosine, float *sine)
{
    turns -= floorf(turns);
    *cosine = cosf(2.0f * pi * turns);
    *sine = turns == 0.0f || turns == 0.5f ? 0.0f : sinf(2.0f * pi * turns);
}

static point sphere_at(const void *shape, float s, float t)
{
    const float *radius = shape;
    float ct, st, cp, sp;
    circle(0.5f * t, &ct, &st);
    circle(s, &cp, &sp);
    if (t == 1.0f)
        ct = -1.0f;
    vec3 normal = { st * sp, ct, st * cp };
    return (point) { vec3_scale(normal, *radius), normal, { s, t } };
}

ag_status primitive_sphere(ag_scene *scene, float radius, unsigned segments, unsigned rings,
                           ag_mesh *mesh)
{
    return add_single(scene, segments, rings, sphere_at, &radius, mesh);
}

// ---- Torus -----------------------------------------------------------------

typedef struct torus {
    float radius, tube;
} torus;

static point torus_at(const void *shape, float s, float t)
{
    const torus *ring = shape;
    float cp, sp, ct, st;
    circle(s, &cp, &sp);
    circle(0.25f - t, &ct, &st); // t = 0 on top, then outwards
    vec3 normal = { ct * sp, st, ct * cp };
    float out = ring->radius + ring->tube * ct;
    return (point) { { out * sp, ring->tube * st, out * cp }, normal, { s, t } };
}

ag_status primitive_torus(ag_scene *scene, float radius, float tube, unsigned segments,
                          unsigned sides, ag_mesh *mesh)
{
    torus shape = { radius, tube };
    return add_single(scene, segments, sides, torus_at, &shape, mesh);
}

// ---- Panel -----------------------------------------------------------------

typedef struct panel {
    float width, height, repeats;
} panel;

static point panel_at(const void *shape, float s, float t)
{
    const panel *p = shape;
    return (point) { { (s - 0.5f) * p->width, (0.5f - t) * p->height, 0.0f },
                     { 0.0f, 0.0f, 1.0f },
                     { s * p->repeats, t * p->repeats } };
}

ag_status primitive_panel(ag_scene *scene, float width, float height, float repeats, ag_mesh *mesh)
{
    panel shape = { width, height, repeats };
    return add_single(scene, 1, 1, panel_at, &shape, mesh);
}

// ---- Box -------------------------------------------------------------------

// One side of a rounded box: `right`, `up` and `out` are signed axes.  The grid has `steps`
// cells in each bevel and one between them.
typedef struct side {
    vec3 right, up, out;
    float inner[3]; // half extents without the bevel, along right, up, out
    float bevel;
    unsigned steps;
} side;

// Grid line `index` (0 .. 2 steps + 1) of a side: the tangent of its angle inside the bevel,
// from -1 to 0, then 0 to 1; and which end of the flat part it belongs to.
static float bevel_slope(const side *face, unsigned index, float *end)
{
    *end = index <= face->steps ? -1.0f : 1.0f;
    if (face->steps == 0)
        return 0.0f;
    unsigned from = index <= face->steps ? face->steps - index : index - face->steps - 1;
    return *end *
           (from == face->steps ? 1.0f : tanf(0.25f * pi * (float)from / (float)face->steps));
}

static point side_at(const void *shape, float s, float t)
{
    const side *face = shape;
    float lines = (float)(2 * face->steps + 1), end_s, end_t;
    float a = bevel_slope(face, (unsigned)lrintf(s * lines), &end_s);
    float b = -bevel_slope(face, (unsigned)lrintf(t * lines), &end_t);
    vec3 direction =
        vec3_add(face->out, vec3_add(vec3_scale(face->right, a), vec3_scale(face->up, b)));
    vec3 normal = vec3_unit(direction);
    vec3 centre = vec3_add(vec3_scale(face->right, end_s * face->inner[0]),
                           vec3_add(vec3_scale(face->up, -end_t * face->inner[1]),
                                    vec3_scale(face->out, face->inner[2])));
    vec3 position = vec3_add(centre, vec3_scale(normal, face->bevel));
    float width = face->inner[0] + face->bevel, height = face->inner[1] + face->bevel;
    return (point) { position,
                     normal,
                     { 0.5f + 0.5f * vec3_dot(position, face->right) / width,
                       0.5f - 0.5f * vec3_dot(position, face->up) / height } };
}

static float along(vec3 axis, const float half[3])
{
    return fabsf(axis.x) * half[0] + fabsf(axis.y) * half[1] + fabsf(axis.z) * half[2];
}

ag_status primitive_box(ag_scene *scene, const float half[3], float bevel, unsigned steps,
                        ag_mesh *mesh)
{
    static const vec3 axes[6][2] = {
        // right, up
        { { 1, 0, 0 }, { 0, 1, 0 } }, { { 0, 0, -1 }, { 0, 1, 0 } }, { { -1, 0, 0 }, { 0, 1, 0 } },
        { { 0, 0, 1 }, { 0, 1, 0 } }, { { 1, 0, 0 }, { 0, 0, -1 } }, { { 1, 0, 0 }, { 0, 0, 1 } },
    };
    patches p;
    unsigned cells = bevel > 0.0f ? 2 * steps + 1 : 1;
    if (!patches_init(&p, 6, cells, cells))
        return log_fail(&scene->log, AG_ERROR_MEMORY, "There is no memory for a mesh.");
    for (int i = 0; i < 6; i++) {
        side face = { .right = axes[i][0],
                      .up = axes[i][1],
                      .out = vec3_cross(axes[i][0], axes[i][1]),
                      .bevel = bevel,
                      .steps = bevel > 0.0f ? steps : 0 };
        face.inner[0] = along(face.right, half) - bevel;
        face.inner[1] = along(face.up, half) - bevel;
        face.inner[2] = along(face.out, half) - bevel;
        add_patch(&p, cells, cells, side_at, &face);
    }
    return hand_over(scene, &p, mesh);
}
