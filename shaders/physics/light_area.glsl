// The GGX lobe under a light of constant radiance that is given by its outline: without table or
// fit.
//
// The outline is a chain of arcs of circles on the sphere of directions, clockwise as seen from
// the point, and wholly above the horizon.  docs/area-lights.md derives what stands here; its
// section numbers are below.  In brief: the half vectors of an arc lie on a quadratic cone, and
// stay on one where a stretch turns visible normals into a clamped cosine (1); that cosine is
// integrated over the sectors between a point within and the arcs (2-4), and shadowing and
// Fresnel are averaged over a node for each sector and one in the middle (5).
//
// A light walks along its outline twice: light_fan_survey() for each arc, light_fan_settle(),
// light_fan_add() for each arc again, light_fan_ggx().  Nothing is stored between.
//
// Symbols: all directions in the surface's frame, x = tangent, z = normal, pointing away from the
// surface; v = towards the eye, unit, v.z > 0; ax, ay = GGX alpha along x and y, in (0, 1].
#ifndef AG_PHYSICS_LIGHT_AREA_GLSL
#define AG_PHYSICS_LIGHT_AREA_GLSL

#include "physics/fresnel.glsl"
#include "physics/lang.glsl"

static const real AREA_TINY = 1e-30f;

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

// An arc cut where it is as far from one end as from the other, its halves paced each for itself;
// one that is short and straight has no second, and long ones have two pieces a half.
STRUCT(light_halves) {
    light_arc next;
    light_arc then;
    int count;
    int pieces;
};

static inline light_halves light_arc_halves(light_arc arc)
{
    real n0 = sqrt(max(dot(arc.p0, arc.p0), AREA_TINY));
    real n2 = sqrt(max(dot(arc.p2, arc.p2), AREA_TINY));
    real m = dot(arc.p1, arc.p1);
    vec3 apart = arc.p0 / n0 - arc.p2 / n2;
    vec3 bend = arc.p1 - 0.5f * sqrt(m) * (arc.p0 / n0 + arc.p2 / n2);
    light_arc a = light_arc_bisected(arc, n0, n2, apart);
    bool is_long = dot(apart, apart) > 1.0f;
    light_halves h;
    h.next = light_arc_shouldered(light_arc_first(a));
    h.then = light_arc_shouldered(light_arc_second(a));
    h.count = 2;
    h.pieces = is_long ? 2 : 1;
    if (!is_long && dot(bend, bend) < 0.1f * m && m < 4.0f * n0 * n2 && n0 * n2 < 4.0f * m) {
        h.next = light_arc_shouldered(arc);
        h.count = 1;
    }
    return h;
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

// ---- the walk -----------------------------------------------------------------------------------

STRUCT(light_fan) {
    vec3 mean; // of the rim
    vec3 turn; // twice its vector area
    real way;
    vec3 centre;
    vec2 node; // there
    real weight;
    real ring; // the other nodes are so far from the centre to the rim,
    real bend;    // so that a node on the way to a rim at 90 degrees has length 1
    real sectors; // the cosine's integral over them,
    real whole;   // and by the vector area
    vec2 sum;     // over the sectors' nodes
};

static inline light_fan light_fan_start()
{
    light_fan fan;
    fan.mean = fan.turn = fan.centre = vec3(0.0f, 0.0f, 0.0f);
    fan.node = fan.sum = vec2(0.0f, 0.0f);
    fan.way = fan.weight = fan.ring = fan.bend = fan.sectors = fan.whole = 0.0f;
    return fan;
}

static inline light_fan light_fan_survey_at(light_fan fan, light_arc arc, real x)
{
    light_rim rim = light_arc_at(arc, x);
    vec3 across = 0.5f * cross(rim.s, rim.ds);
    real step = sqrt(dot(across, across));
    fan.turn = fan.turn + across;
    fan.mean = fan.mean + step * rim.s;
    fan.way += step;
    return fan;
}

// Two Gauss points for each half.
static inline light_fan light_fan_survey(light_fan fan, light_arc arc)
{
    light_halves h = light_arc_halves(arc);
    for (int i = 0; i < h.count; i++) {
        fan = light_fan_survey_at(fan, h.next, 0.21132487f);
        fan = light_fan_survey_at(fan, h.next, 0.78867513f);
        h.next = h.then;
    }
    return fan;
}

// x without Fresnel, y with the factor (1 - v.h)^5 of Schlick's.
static inline vec2 light_fan_node(light_lobe lobe, vec3 s)
{
    vec2 node = light_lobe_node(lobe, s);
    return vec2(node[0], node[0] * pow5(1.0f - node[1]));
}

// A point within, and its node, which counts for less where its light would come from below the
// horizon.
static inline light_fan light_fan_settle(light_fan fan, light_lobe lobe)
{
    vec3 mean = fan.mean / max(fan.way, AREA_TINY);
    fan.centre = light_unit(mean + 0.5f * sqrt(dot(fan.turn, fan.turn)) * fan.turn);
    fan.node = light_fan_node(lobe, fan.centre);
    fan.weight = 0.25f * min(4.0f * fan.node[0], 1.0f);
    fan.ring = sqrt(0.5f / (1.0f - fan.weight));
    real ring2 = fan.ring * fan.ring;
    fan.bend = sqrt(1.0f - ring2) - 1.0f + ring2;
    return fan;
}

// The sector from the centre to the rim, `width` of x wide.
static inline light_fan light_fan_sector(light_fan fan, light_lobe lobe, light_rim rim, real width)
{
    vec3 d = rim.s - fan.centre;
    vec3 turn = 0.5f * width * cross(d, rim.ds);
    real down = 0.5f * dot(d, d);
    real c = 1.0f - down;
    real u = max(1.0f + c, 0.1f);
    real k = (1.5745f + c * (1.1197f + c * (0.0997f * c - 0.1151f))) / (u * u);
    real top = dot(lobe.axis, fan.centre);
    real area = dot(fan.centre, turn) * (top + k * (dot(lobe.axis, rim.s) - c * top));
    real up = (1.0f - fan.ring) * (1.0f + down * fan.ring) + down * down * fan.bend;
    fan.sectors += area;
    fan.whole += dot(lobe.axis, turn) +
                 0.5f * width * dot(rim.ds, cross(lobe.axis, fan.centre));
    fan.sum = fan.sum + area * light_fan_node(lobe, fan.ring * rim.s + up * fan.centre);
    return fan;
}

// Four Gauss points for each piece.
static inline light_fan light_fan_add(light_fan fan, light_lobe lobe, light_arc arc)
{
    light_halves h = light_arc_halves(arc);
    int points = 4 * h.pieces;
    real span = 1.0f / to_real(h.pieces);
    for (int i = 0; i < h.count; i++) {
        for (int j = 0; j < points; j++) {
            int k = j < 4 ? j : j - 4;
            bool outer = k == 0 || k == 3;
            real x = outer ? 0.43056816f : 0.16999052f;
            real width = outer ? 0.17392742f : 0.32607258f;
            x = (k < 2 ? 0.5f - x : 0.5f + x) + (j < 4 ? 0.0f : 1.0f);
            fan = light_fan_sector(fan, lobe, light_arc_at(h.next, span * x), span * width);
        }
        h.next = h.then;
    }
    return fan;
}

// x without Fresnel, y with Schlick's factor: L (f0 (x - y) + f90 y) is the radiance towards v.
static inline vec2 light_fan_ggx(light_fan fan, light_lobe lobe)
{
    real whole = max(fan.whole, 0.0f);
    real t = clamp((whole - 0.1f) / 0.3f, 0.0f, 1.0f);
    real area = mix(max(fan.sectors, 0.0f), whole, t * t * (3.0f - 2.0f * t));
    vec2 sum = fan.sum / max(fan.sectors, AREA_TINY);
    real mean = clamp(sum[0], 0.0f, 1.0f);
    real grazing = clamp(sum[1], 0.0f, 1.0f);
    area = area * 2.0f * INV_PI / (1.0f + lobe.axis[2]);
    sum = area * (fan.weight * fan.node + (1.0f - fan.weight) * vec2(mean, grazing));
    real x = clamp(sum[0], 0.0f, 1.0f); // no light is reflected brighter than it is
    return vec2(x, clamp(sum[1], 0.0f, x));
}

#endif
