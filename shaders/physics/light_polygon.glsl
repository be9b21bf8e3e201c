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


// A walk around the quadrilateral's directions; the fifth edge is along the horizon.
STRUCT(light_quad_walk) {
    vec3 a;
    vec3 b;
    vec3 c;
    vec3 d;
    light_edge edge; // between unit vectors
    vec3 out_at;
    vec3 in_at;
    bool closed;
};

static inline light_quad_walk light_quad_walk_start(vec3 p0, vec3 p1, vec3 p2, vec3 p3)
{
    light_quad_walk w;
    w.a = light_unit(p0);
    w.b = light_unit(p3);
    w.c = light_unit(p2);
    w.d = light_unit(p1);
    w.edge.a = w.edge.b = w.out_at = w.in_at = vec3(0.0f, 0.0f, 0.0f);
    w.edge.up = w.edge.sinks = w.edge.rises = false;
    w.closed = false;
    return w;
}

static inline light_quad_walk light_quad_walk_next(light_quad_walk w, bool last)
{
    light_edge e = light_edge_clip(w.a, w.b);
    e.a = last ? w.out_at : light_unit(e.a);
    e.b = last ? w.in_at : light_unit(e.b);
    e.up = last ? w.closed : e.up;
    w.edge = e;
    w.out_at = e.sinks ? e.b : w.out_at;
    w.in_at = e.rises ? e.a : w.in_at;
    w.closed = w.closed || e.sinks;
    vec3 t = w.a;
    w.a = w.b;
    w.b = w.c;
    w.c = w.d;
    w.d = t;
    return w;
}

static inline light_fan light_quad_fan(light_lobe lobe, vec3 p0, vec3 p1, vec3 p2, vec3 p3)
{
    light_fan fan = light_fan_start();
    light_quad_walk w = light_quad_walk_start(p0, p1, p2, p3);
    for (int i = 0; i < (w.closed ? 5 : 4); i++) {
        w = light_quad_walk_next(w, i == 4);
        if (w.edge.up)
            fan = light_fan_survey(fan, light_arc_great(lobe, w.edge.a, w.edge.b));
    }
    fan = light_fan_settle(fan, lobe);
    w = light_quad_walk_start(p0, p1, p2, p3);
    for (int i = 0; i < (w.closed ? 5 : 4); i++) {
        w = light_quad_walk_next(w, i == 4);
        if (w.edge.up)
            fan = light_fan_add(fan, lobe, light_arc_great(lobe, w.edge.a, w.edge.b));
    }
    return fan;
}

// As light_fan_ggx: L (f0 (x - y) + f90 y) is the radiance towards v.
static inline vec2 light_quad_ggx(vec3 p0, vec3 p1, vec3 p2, vec3 p3, vec3 v, real ax, real ay)
{
    light_lobe lobe = light_lobe_from_view(v, ax, ay);
    return light_fan_ggx(light_quad_fan(lobe, p0, p1, p2, p3), lobe);
}

#endif
