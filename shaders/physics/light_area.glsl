// The GGX lobe under a light of constant radiance that is given by its outline: without table or
// fit.
//
// The outline is a chain of arcs of circles on the sphere of directions, clockwise as seen from
// the point, and wholly above the horizon.  docs/area-lights.md derives what stands here; its
// section numbers are below.  In brief: the half vectors of an arc lie on a quadratic cone, and
// stay on one where a stretch turns visible normals into a clamped cosine (1); that cosine is
// integrated over the sectors between a point within and short pieces of the arcs (2-4), and
// shadowing and Fresnel are averaged over a node for each piece and one in the middle (5).
//
// Symbols: all directions in the surface's frame, x = tangent, z = normal, pointing away from the
// surface; v = towards the eye, unit, v.z > 0; ax, ay = GGX alpha along x and y, in (0, 1].
#ifndef AG_PHYSICS_LIGHT_AREA_GLSL
#define AG_PHYSICS_LIGHT_AREA_GLSL

#include "physics/fresnel.glsl"
#include "physics/lang.glsl"

#define AREA_PIECES 20
#define AREA_NODES  21

static const real AREA_TINY = 1e-30f;
static const real AREA_RING = 0.81649658f; // sqrt(2 / 3)
static const real AREA_GAUSS = 0.38729833f; // sqrt(3 / 5) / 2

// The lobe seen from v; `axis` = the stretched v, unit: half vectors are stretch * s, and the
// visible ones have the density of s.axis.
STRUCT(light_lobe) {
    vec3 v;
    vec3 stretch;
    vec3 unstretch;
    vec3 axis;
    real length_v;
};

// Stretched half vectors (1-x)^2 p0 + 2x(1-x) p1 + x^2 p2 along an arc, of any length.
STRUCT(light_arc) {
    vec3 p0;
    vec3 p1;
    vec3 p2;
};

// Five arcs, each in four pieces.
STRUCT(light_outline) {
    light_lobe lobe;
    light_arc piece[AREA_PIECES];
    light_arc arc[5]; // whole: enough where all are short
    bool small;
    bool closed; // by a fifth along the horizon,
    vec3 out_at; // from here
    vec3 in_at;  // to here
};

// The light ready for any Fresnel: weight and v.h of each node.
STRUCT(light_nodes) {
    vec2 node[AREA_NODES];
    int used;
    vec3 centre;
    real area;
    real scale;
};

// A unit vector on an arc and its derivative (but for a multiple of itself).
STRUCT(light_rim) {
    vec3 s;
    vec3 ds;
};

static inline light_lobe light_lobe_from_view(vec3 v, real ax, real ay)
{
    light_lobe lobe;
    real m = max(ax, ay);
    vec3 sv = vec3(ax * v[0], ay * v[1], v[2]);
    lobe.v = v;
    lobe.stretch = vec3(ax, ay, 1.0f);
    lobe.unstretch = vec3(m / ax, m / ay, m);
    lobe.length_v = sqrt(dot(sv, sv));
    lobe.axis = sv / lobe.length_v;
    return lobe;
}

static inline vec3 light_unit(vec3 p)
{
    return p / sqrt(max(dot(p, p), AREA_TINY));
}

// ---- arcs ---------------------------------------------------------------------------------------

static inline light_rim light_arc_at(light_arc arc, real x)
{
    real y = 1.0f - x;
    vec3 r = y * y * arc.p0 + 2.0f * x * y * arc.p1 + x * x * arc.p2;
    vec3 dr = 2.0f * (y * (arc.p1 - arc.p0) + x * (arc.p2 - arc.p1));
    real inverse = 1.0f / sqrt(max(dot(r, r), AREA_TINY));
    light_rim rim;
    rim.s = inverse * r;
    rim.ds = inverse * dr;
    return rim;
}

// The same arc with another pace: x : 1-x becomes mu x : 1-x.
static inline light_arc light_arc_paced(light_arc arc, real mu)
{
    light_arc a;
    a.p0 = arc.p0 / mu;
    a.p1 = arc.p1;
    a.p2 = mu * arc.p2;
    return a;
}

static inline light_arc light_arc_first(light_arc a)
{
    light_arc first;
    first.p0 = a.p0;
    first.p1 = 0.5f * (a.p0 + a.p1);
    first.p2 = 0.25f * (a.p0 + 2.0f * a.p1 + a.p2);
    return first;
}

static inline light_arc light_arc_second(light_arc a)
{
    light_arc second;
    second.p0 = 0.25f * (a.p0 + 2.0f * a.p1 + a.p2);
    second.p1 = 0.5f * (a.p1 + a.p2);
    second.p2 = a.p2;
    return second;
}

// Paced so that x = 1/2 is as far from one end as from the other (section 3).
static inline light_arc light_arc_bisected(light_arc arc, real n0, real n2, vec3 apart)
{
    real f = 0.5f * dot(apart, apart) + 1e-12f;
    real f1 = dot(apart, arc.p1);
    real w = sqrt(f1 * f1 + n0 * n2 * f * f);
    real mu = f1 > 0.0f ? (f1 + w) / (n2 * f) : n0 * f / max(w - f1, AREA_TINY);
    return light_arc_paced(arc, clamp(mu, 1e-5f, 1e5f));
}

// Paced so that x = 1/2 is farthest from the chord between its ends.
static inline light_arc light_arc_shouldered(light_arc arc)
{
    real n0 = max(dot(arc.p0, arc.p0), AREA_TINY);
    real n2 = max(dot(arc.p2, arc.p2), AREA_TINY);
    return light_arc_paced(arc, sqrt(sqrt(n0 / n2)));
}

// Paced so that it starts as fast as it ends.
static inline light_arc light_arc_even(light_arc arc)
{
    real n0 = max(dot(arc.p0, arc.p0), AREA_TINY);
    real n2 = max(dot(arc.p2, arc.p2), AREA_TINY);
    vec3 c0 = cross(arc.p0, arc.p1);
    vec3 c2 = cross(arc.p1, arc.p2);
    real v0 = sqrt(dot(c0, c0)) / n0;
    real v2 = sqrt(dot(c2, c2)) / n2;
    real least = 1e-6f * (v0 + v2) + 1e-20f;
    return light_arc_paced(arc, sqrt((v2 + least) / (v0 + least)));
}

// ---- the outline --------------------------------------------------------------------------------

static inline light_outline light_outline_start(light_lobe lobe)
{
    light_arc none;
    none.p0 = none.p1 = none.p2 = lobe.axis;
    light_outline o;
    o.lobe = lobe;
    for (int i = 0; i < AREA_PIECES; i++)
        o.piece[i] = none;
    for (int i = 0; i < 5; i++)
        o.arc[i] = none;
    o.small = true;
    o.closed = false;
    o.out_at = vec3(1.0f, 0.0f, 0.0f);
    o.in_at = vec3(1.0f, 0.0f, 0.0f);
    return o;
}

// Adds a half arc as two pieces.
static inline light_outline light_outline_half(light_outline o, int i, light_arc half_arc)
{
    light_arc a = light_arc_shouldered(half_arc);
    o.piece[i] = light_arc_first(a);
    o.piece[i + 1] = light_arc_second(a);
    return o;
}

// Adds half an arc that is not halved by its distances.
static inline light_outline light_outline_part(light_outline o, int i, light_arc arc)
{
    real n0 = sqrt(max(dot(arc.p0, arc.p0), AREA_TINY));
    real n2 = sqrt(max(dot(arc.p2, arc.p2), AREA_TINY));
    light_arc a = light_arc_bisected(arc, n0, n2, arc.p0 / n0 - arc.p2 / n2);
    o.piece[i] = light_arc_first(a);
    o.piece[i + 1] = light_arc_second(a);
    return o;
}

// Is it so short and straight that one piece will do?
static inline bool light_arc_is_short(light_arc arc, real n0, real n2, vec3 apart)
{
    real m = dot(arc.p1, arc.p1);
    vec3 middle = arc.p1 - 0.5f * sqrt(m) * (arc.p0 / n0 + arc.p2 / n2);
    return dot(apart, apart) < 0.04f && m > 0.5f * n0 * n2 && m < 2.0f * n0 * n2 &&
           dot(middle, middle) < 0.01f * m;
}

// Adds the `i`th arc.
static inline light_outline light_outline_add(light_outline o, int i, light_arc arc)
{
    real n0 = sqrt(max(dot(arc.p0, arc.p0), AREA_TINY));
    real n2 = sqrt(max(dot(arc.p2, arc.p2), AREA_TINY));
    vec3 apart = arc.p0 / n0 - arc.p2 / n2;
    light_arc a = light_arc_bisected(arc, n0, n2, apart);
    o.small = o.small && light_arc_is_short(arc, n0, n2, apart);
    o.arc[i] = arc;
    o = light_outline_half(o, 4 * i, light_arc_first(a));
    return light_outline_half(o, 4 * i + 2, light_arc_second(a));
}

// A great circle's arc between two directions.
static inline light_arc light_arc_great(light_lobe lobe, vec3 a, vec3 b)
{
    vec3 m = a + b;
    real n = sqrt(dot(m, m));
    light_arc arc;
    arc.p0 = lobe.unstretch * (lobe.v + a);
    arc.p1 = lobe.unstretch * (0.5f * n * lobe.v + m / max(n, 1e-6f));
    arc.p2 = lobe.unstretch * (lobe.v + b);
    return arc;
}

// ---- nodes --------------------------------------------------------------------------------------

// G2 / G1 and v.h; Heitz 2014, eqs. 43, 99, 72 and 86.
static inline vec2 light_lobe_node(light_lobe b, vec3 s)
{
    vec3 h = b.stretch * s;
    real vh = max(dot(b.v, h), 0.0f);
    real h1 = 1.0f / sqrt(max(dot(h, h), AREA_TINY));
    vec3 l = (2.0f * vh * h1 * h1) * h - b.v;
    vec3 sl = b.stretch * l;
    real NoL = max(l[2], 0.0f);
    real g2 = b.length_v * NoL + sqrt(dot(sl, sl)) * b.v[2];
    return vec2((b.length_v + b.v[2]) * NoL / max(g2, AREA_TINY), min(vh * h1, 1.0f));
}

// The cosine's integral over the sector from the centre to the rim, a unit of x wide (section 4).
static inline real light_sector(light_lobe lobe, vec3 centre, light_rim rim)
{
    vec3 d = rim.s - centre;
    real c = max(1.0f - 0.5f * dot(d, d), 0.0f);
    real k = 1.5688f + c * (-1.9418f + c * (1.9223f + c * (-1.2445f + c * 0.3626f)));
    real density = dot(lobe.axis, centre) + dot(lobe.axis, rim.s - c * centre) * k;
    return 0.5f * dot(centre, cross(d, rim.ds)) * max(density, 0.0f);
}

// Three Gauss points of a piece, and its node: its area, G2 / G1, v.h.
static inline vec3 light_piece(light_lobe lobe, vec3 centre, light_arc arc)
{
    light_rim middle = light_arc_at(arc, 0.5f);
    real ends = light_sector(lobe, centre, light_arc_at(arc, 0.5f - AREA_GAUSS)) +
                light_sector(lobe, centre, light_arc_at(arc, 0.5f + AREA_GAUSS));
    real area = (5.0f * ends + 8.0f * light_sector(lobe, centre, middle)) / 18.0f;
    vec3 q = AREA_RING * (middle.s - dot(middle.s, centre) * centre);
    vec2 node = light_lobe_node(lobe, q + sqrt(max(1.0f - dot(q, q), 0.0f)) * centre);
    return vec3(area, node[0], node[1]);
}

// A point within, from the vector area of the outline and its own mean (section 4).
static inline vec3 light_outline_centre(light_outline o)
{
    int n = o.closed ? AREA_PIECES : o.small ? 4 : AREA_PIECES - 4;
    vec3 turn = vec3(0.0f, 0.0f, 0.0f);
    vec3 mean = vec3(0.0f, 0.0f, 0.0f);
    real way = 0.0f;
    for (int i = 0; i < n; i++) {
        light_arc a = o.piece[i];
        if (n == 4)
            a = o.arc[i];
        a = light_arc_even(a);
        for (int k = -1; k <= 1; k++) {
            light_rim rim = light_arc_at(a, 0.5f + to_real(k) * AREA_GAUSS);
            vec3 across = (k == 0 ? 8.0f : 5.0f) / 18.0f * cross(rim.s, rim.ds);
            real step = sqrt(dot(across, across));
            turn = turn + across;
            mean = mean + step * rim.s;
            way += step;
        }
    }
    return light_unit(mean / max(way, AREA_TINY) + 0.5f * sqrt(dot(turn, turn)) * turn);
}

static inline light_nodes light_nodes_from_outline(light_outline o)
{
    light_nodes nodes;
    nodes.centre = light_outline_centre(o);
    nodes.area = 0.0f;
    int n = o.closed ? AREA_PIECES : o.small ? 4 : AREA_PIECES - 4;
    nodes.used = n + 1;
    for (int i = 0; i < n; i++) {
        light_arc a = o.piece[i];
        if (n == 4)
            a = o.arc[i];
        vec3 piece = light_piece(o.lobe, nodes.centre, light_arc_even(a));
        nodes.node[i] = vec2(piece[0] * piece[1], piece[2]);
        nodes.area += piece[0];
    }
    vec2 middle = light_lobe_node(o.lobe, nodes.centre);
    nodes.node[n] = vec2(0.25f / 0.75f * nodes.area * middle[0], middle[1]);
    nodes.scale = nodes.area > 0.0f ? 0.75f * 2.0f * INV_PI / (1.0f + o.lobe.axis[2]) : 0.0f;
    return nodes;
}

// Weight and v.h: the light's reflection towards v is L times the sum of weight F(v.h) over the
// nodes i < nodes.used.
static inline vec2 light_nodes_at(light_nodes nodes, int i)
{
    return vec2(nodes.scale * nodes.node[i][0], nodes.node[i][1]);
}

// x without Fresnel, y with the factor (1 - v.h)^5 of Schlick's: L (f0 (x - y) + f90 y) is the
// radiance towards v.
static inline vec2 light_nodes_ggx(light_nodes nodes)
{
    vec2 sum = vec2(0.0f, 0.0f);
    for (int i = 0; i < nodes.used; i++) {
        vec2 node = light_nodes_at(nodes, i);
        sum = sum + vec2(node[0], node[0] * pow5(1.0f - node[1]));
    }
    real x = clamp(sum[0], 0.0f, 1.0f); // no light is reflected brighter than it is
    return vec2(x, clamp(sum[1], 0.0f, x));
}

#endif
