// A rectangle or any convex quadrilateral of constant radiance L: its form factor, exact and with
// the horizon, and its reflection in a GGX lobe.
//
// Irradiance = pi L F, F the form factor.  Lambert's formula: each edge, seen from the point as an
// arc of a great circle, gives its angle times the normal's component across its plane; the edges
// are cut at the horizon, along which one more arc closes what is left.
//
// Corners: from the point, in the surface's frame (z = normal), in any unit of length, planar and
// convex.  The side to which (p1 - p0) x (p3 - p0) points emits; seen from the other, it is dark.
#ifndef AG_PHYSICS_LIGHT_POLYGON_GLSL
#define AG_PHYSICS_LIGHT_POLYGON_GLSL

#include "physics/lang.glsl"
#include "physics/light_area.glsl"

// What is above the horizon of an edge from a to b.
STRUCT(light_edge) {
    vec3 a;
    vec3 b;
    bool up;    // at all
    bool sinks; // through it, or
    bool rises;
};

static inline light_edge light_edge_clip(vec3 a, vec3 b)
{
    light_edge e;
    bool a_up = a[2] > 0.0f;
    bool b_up = b[2] > 0.0f;
    e.up = a_up || b_up;
    e.sinks = a_up && !b_up;
    e.rises = !a_up && b_up;
    vec3 cut = a;
    if (e.sinks || e.rises)
        cut = a + (a[2] / (a[2] - b[2])) * (b - a);
    cut[2] = 0.0f;
    e.a = e.rises ? cut : a;
    e.b = e.sinks ? cut : b;
    return e;
}

// An edge's angle times the z component of its plane's normal.
static inline real light_edge_angle(vec3 a, vec3 b)
{
    vec3 n = cross(a, b);
    real s = sqrt(dot(n, n));
    return s > 0.0f ? atan2(s, dot(a, b)) * n[2] / s : 0.0f;
}

// The state of a walk around the outline.
STRUCT(light_walk) {
    real sum;
    vec3 out_at; // where it dips below the horizon
    vec3 in_at;  // where it comes up again
};

static inline light_walk light_walk_edge(light_walk walk, vec3 a, vec3 b)
{
    light_edge e = light_edge_clip(a, b);
    walk.sum += e.up ? light_edge_angle(e.a, e.b) : 0.0f;
    walk.out_at = e.sinks ? e.b : walk.out_at;
    walk.in_at = e.rises ? e.a : walk.in_at;
    return walk;
}

static inline real light_quad_form_factor(vec3 p0, vec3 p1, vec3 p2, vec3 p3)
{
    light_walk walk;
    walk.sum = 0.0f;
    walk.out_at = vec3(0.0f, 0.0f, 0.0f);
    walk.in_at = vec3(0.0f, 0.0f, 0.0f);
    walk = light_walk_edge(walk, p0, p1);
    walk = light_walk_edge(walk, p1, p2);
    walk = light_walk_edge(walk, p2, p3);
    walk = light_walk_edge(walk, p3, p0);
    real sum = walk.sum + light_edge_angle(walk.out_at, walk.in_at);
    return clamp(-0.5f * INV_PI * sum, 0.0f, 1.0f);
}

static inline light_outline light_outline_edge(light_outline o, int i, vec3 a, vec3 b)
{
    light_edge e = light_edge_clip(a, b);
    if (!e.up)
        return o;
    vec3 d = light_unit(e.a);
    vec3 f = light_unit(e.b);
    o.out_at = e.sinks ? f : o.out_at;
    o.in_at = e.rises ? d : o.in_at;
    o.closed = o.closed || e.sinks;
    return light_outline_add(o, i, light_arc_great(o.lobe, d, f));
}

// The quadrilateral as nodes for any Fresnel (light_area.glsl).
static inline light_nodes light_quad_nodes(vec3 p0, vec3 p1, vec3 p2, vec3 p3, vec3 v, real ax,
                                           real ay)
{
    light_outline o = light_outline_start(light_lobe_from_view(v, ax, ay));
    vec3 d0 = light_unit(p0);
    vec3 d1 = light_unit(p1);
    vec3 d2 = light_unit(p2);
    vec3 d3 = light_unit(p3);
    o = light_outline_edge(o, 0, d0, d3);
    o = light_outline_edge(o, 1, d3, d2);
    o = light_outline_edge(o, 2, d2, d1);
    o = light_outline_edge(o, 3, d1, d0);
    if (o.closed)
        o = light_outline_add(o, 4, light_arc_great(o.lobe, o.out_at, o.in_at));
    return light_nodes_from_outline(o);
}

// As light_nodes_ggx: L (f0 (x - y) + f90 y) is the radiance towards v.
static inline vec2 light_quad_ggx(vec3 p0, vec3 p1, vec3 p2, vec3 p3, vec3 v, real ax, real ay)
{
    return light_nodes_ggx(light_quad_nodes(p0, p1, p2, p3, v, ax, ay));
}

#endif
