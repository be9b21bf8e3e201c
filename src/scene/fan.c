// The triangles around one vertex, and the tangent frames they agree on.
//
// After Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", section 3.3 and the
// algorithm published with it (MikkTSpace, at its default angular threshold of 180 degrees,
// which keeps all in): triangles form a group where they are joined by edges at the vertex and
// turn the same way in texture space; a group's tangent is the mean of its triangles' tangents,
// each projected onto the plane of the vertex normal and weighted by the triangle's angle.
//
// Triangles without an area in texture space have no tangent of their own.  They join the
// groups beside them, and may link two.  MikkTSpace gives such a triangle to the group that
// reaches it first; here an unmirrored group is preferred, so that the order of triangles does
// not matter.  For the same reason all triangles at an edge of more than two are joined.
#include "scene/fan.h"

#include <stdlib.h>

enum { SMALL = 32 }; // corners that need no allocation

// An edge from the vertex to `other`, seen from one corner.
typedef struct spoke {
    uint32_t other;
    uint32_t corner;
    bool leaving; // the triangle runs along it from the vertex to `other`
} spoke;

typedef struct group {
    uint32_t parent; // union-find
    facing facing;   // resolved
    bool beside_same, beside_mirrored;
    vec3 sum;
} group;

typedef struct fan {
    const fan_corner *corners;
    uint32_t count;
    spoke *spokes;
    uint32_t spoke_count;
    group *groups; // [count]
} fan;

// ---- Union-find ------------------------------------------------------------

static uint32_t root_of(group *groups, uint32_t i)
{
    while (groups[i].parent != i) {
        groups[i].parent = groups[groups[i].parent].parent;
        i = groups[i].parent;
    }
    return i;
}

static void join(group *groups, uint32_t a, uint32_t b)
{
    a = root_of(groups, a);
    b = root_of(groups, b);
    if (a < b)
        groups[b].parent = a;
    else
        groups[a].parent = b;
}

// ---- Spokes ----------------------------------------------------------------

static int compare_spokes(const void *a, const void *b)
{
    uint32_t x = ((const spoke *)a)->other, y = ((const spoke *)b)->other;
    return (x > y) - (x < y);
}

static void sort_spokes(spoke *spokes, uint32_t count)
{
    if (count > 2 * SMALL) {
        qsort(spokes, count, sizeof *spokes, compare_spokes);
        return;
    }
    for (uint32_t i = 1; i < count; i++) {
        spoke moved = spokes[i];
        uint32_t j = i;
        for (; j > 0 && spokes[j - 1].other > moved.other; j--)
            spokes[j] = spokes[j - 1];
        spokes[j] = moved;
    }
}

static void list_spokes(fan *f)
{
    f->spoke_count = 0;
    for (uint32_t i = 0; i < f->count; i++) {
        if (f->corners[i].facing == FACING_POINT)
            continue;
        f->spokes[f->spoke_count++] = (spoke) { f->corners[i].next, i, true };
        f->spokes[f->spoke_count++] = (spoke) { f->corners[i].previous, i, false };
    }
    sort_spokes(f->spokes, f->spoke_count);
}

static uint32_t run_end(const fan *f, uint32_t start)
{
    uint32_t end = start + 1;
    while (end < f->spoke_count && f->spokes[end].other == f->spokes[start].other)
        end++;
    return end;
}

// ---- Groups ----------------------------------------------------------------

// Which ways the triangles of one facing run along an edge.
typedef struct ways {
    bool leaving, arriving;
} ways;

static ways ways_along(const fan *f, uint32_t start, uint32_t end, facing which)
{
    ways w = { false, false };
    for (uint32_t i = start; i < end; i++) {
        if (f->groups[f->spokes[i].corner].facing != which)
            continue;
        w.leaving |= f->spokes[i].leaving;
        w.arriving |= !f->spokes[i].leaving;
    }
    return w;
}

// Join the corners of one facing along one edge, if it separates any two of them.
static void join_run(fan *f, uint32_t start, uint32_t end, facing which)
{
    ways w = ways_along(f, start, end, which);
    if (!w.leaving || !w.arriving)
        return;
    uint32_t first = UINT32_MAX;
    for (uint32_t i = start; i < end; i++) {
        uint32_t corner = f->spokes[i].corner;
        if (f->groups[corner].facing != which)
            continue;
        if (first == UINT32_MAX)
            first = corner;
        join(f->groups, first, corner);
    }
}

static void join_all(fan *f, facing which)
{
    for (uint32_t start = 0, end; start < f->spoke_count; start = end) {
        end = run_end(f, start);
        join_run(f, start, end, which);
    }
}

// Tell groups without a tangent which others lie beside them across this edge.
static void look_beside(fan *f, uint32_t start, uint32_t end)
{
    ways same = ways_along(f, start, end, FACING_SAME);
    ways mirrored = ways_along(f, start, end, FACING_MIRRORED);
    for (uint32_t i = start; i < end; i++) {
        if (f->groups[f->spokes[i].corner].facing != FACING_ANY)
            continue;
        group *g = &f->groups[root_of(f->groups, f->spokes[i].corner)];
        bool leaving = f->spokes[i].leaving;
        g->beside_same |= leaving ? same.arriving : same.leaving;
        g->beside_mirrored |= leaving ? mirrored.arriving : mirrored.leaving;
    }
}

// Triangles that say nothing take the side of their neighbours.
static void resolve_any(fan *f)
{
    join_all(f, FACING_ANY);
    for (uint32_t start = 0, end; start < f->spoke_count; start = end) {
        end = run_end(f, start);
        look_beside(f, start, end);
    }
    for (uint32_t i = 0; i < f->count; i++) {
        const group *g = &f->groups[root_of(f->groups, i)];
        if (f->groups[i].facing == FACING_ANY)
            f->groups[i].facing = g->beside_same       ? FACING_SAME
                                  : g->beside_mirrored ? FACING_MIRRORED
                                                       : FACING_ANY;
    }
}

static void find_groups(fan *f)
{
    bool any = false;
    for (uint32_t i = 0; i < f->count; i++) {
        f->groups[i] = (group) { .parent = i, .facing = f->corners[i].facing };
        any |= f->corners[i].facing == FACING_ANY;
    }
    list_spokes(f);
    if (any)
        resolve_any(f);
    join_all(f, FACING_SAME);
    join_all(f, FACING_MIRRORED);
}

// ---- Frames ----------------------------------------------------------------

static vec3 without(vec3 v, vec3 normal)
{
    return vec3_sub(v, vec3_scale(normal, vec3_dot(normal, v)));
}

static vec3 project(vec3 v, vec3 normal)
{
    return vec3_unit(without(v, normal));
}

static bool has_facing(facing f)
{
    return f == FACING_SAME || f == FACING_MIRRORED;
}

// Projected twice: the first time leaves mostly noise of a vector along the normal.
static fan_frame frame_of(const group *g, vec3 normal)
{
    vec3 twice = without(project(g->sum, normal), normal);
    bool sound = vec3_dot(twice, twice) > 0.9f;
    return (fan_frame) { sound ? vec3_unit(twice) : vec3_perpendicular(normal),
                         g->facing == FACING_MIRRORED ? -1.0f : 1.0f };
}

// Sum each group's tangents into its root; returns the root with the longest sum, whose frame
// corners without a group of their own take.
static const group *sum_tangents(fan *f, vec3 normal)
{
    for (uint32_t i = 0; i < f->count; i++) {
        const fan_corner *corner = &f->corners[i];
        if (!has_facing(corner->facing))
            continue;
        group *root = &f->groups[root_of(f->groups, i)];
        root->sum =
            vec3_add(root->sum, vec3_scale(project(corner->tangent, normal), corner->angle));
    }
    const group *best = &f->groups[0];
    for (uint32_t i = 1; i < f->count; i++) {
        const group *g = &f->groups[i];
        if (vec3_dot(g->sum, g->sum) > vec3_dot(best->sum, best->sum))
            best = g;
    }
    return best;
}

static void solve(fan *f, vec3 normal, fan_frame *frames)
{
    find_groups(f);
    fan_frame spare = frame_of(sum_tangents(f, normal), normal);
    for (uint32_t i = 0; i < f->count; i++) {
        uint32_t root = root_of(f->groups, i);
        if (!has_facing(f->groups[i].facing))
            frames[i] = spare;
        else
            frames[i] = root < i ? frames[root] : frame_of(&f->groups[root], normal);
    }
}

bool fan_solve(vec3 normal, const fan_corner *corners, size_t count, fan_frame *frames)
{
    if (count == 0)
        return true;
    spoke few_spokes[2 * SMALL];
    group few_groups[SMALL];
    fan f = { corners, (uint32_t)count, few_spokes, 0, few_groups };
    if (count <= SMALL) {
        solve(&f, normal, frames);
        return true;
    }
    f.spokes = malloc(2 * count * sizeof *f.spokes);
    f.groups = malloc(count * sizeof *f.groups);
    bool ready = f.spokes && f.groups;
    if (ready)
        solve(&f, normal, frames);
    free(f.spokes);
    free(f.groups);
    return ready;
}
