// The diffuse part of a rectangle or any convex quadrilateral of constant radiance L: exact, with
// the horizon.
//
// Irradiance = pi L F, F the form factor.  Lambert's formula: each edge, seen from the point as an
// arc of a great circle, gives its angle times the normal's component across its plane; the edges
// are cut at the horizon, along which one more arc closes what is left.
#ifndef AG_PHYSICS_LIGHT_POLYGON_GLSL
#define AG_PHYSICS_LIGHT_POLYGON_GLSL

#include "physics/lang.glsl"

// The state of a walk around the outline.
STRUCT(light_outline) {
    real sum;
    vec3 out_at; // where it dips below the horizon
    vec3 in_at;  // where it comes up again
};

// The arc's angle times the z component of its plane's normal.
static inline real light_arc(vec3 a, vec3 b)
{
    vec3 n = cross(a, b);
    real s = sqrt(dot(n, n));
    return s > 0.0f ? atan2(s, dot(a, b)) * n[2] / s : 0.0f;
}

static inline light_outline light_outline_edge(light_outline walk, vec3 a, vec3 b)
{
    bool a_up = a[2] > 0.0f;
    bool b_up = b[2] > 0.0f;
    if (!a_up && !b_up)
        return walk;
    vec3 cut = a;
    if (a_up != b_up) {
        cut = a + (a[2] / (a[2] - b[2])) * (b - a);
        cut[2] = 0.0f;
    }
    if (!b_up)
        walk.out_at = cut;
    if (!a_up)
        walk.in_at = cut;
    walk.sum += light_arc(a_up ? a : cut, b_up ? b : cut);
    return walk;
}

// Form factor of the quadrilateral p0 p1 p2 p3, planar and convex: its corners from the point, in
// the surface's frame (z = normal), in any unit of length.  The side to which
// (p1 - p0) x (p3 - p0) points emits; seen from the other, it is 0.
static inline real light_quad_form_factor(vec3 p0, vec3 p1, vec3 p2, vec3 p3)
{
    light_outline walk;
    walk.sum = 0.0f;
    walk.out_at = vec3(0.0f, 0.0f, 0.0f);
    walk.in_at = vec3(0.0f, 0.0f, 0.0f);
    walk = light_outline_edge(walk, p0, p1);
    walk = light_outline_edge(walk, p1, p2);
    walk = light_outline_edge(walk, p2, p3);
    walk = light_outline_edge(walk, p3, p0);
    real sum = walk.sum + light_arc(walk.out_at, walk.in_at);
    return clamp(-0.5f * INV_PI * sum, 0.0f, 1.0f);
}

#endif
