// A tube of constant radiance L, a cylinder with round ends: its form factor, exact and with the
// horizon, and its reflection in a GGX lobe.
//
// `centre` of the axis from the point, in the surface's frame (z = normal); `half_axis` from there
// to the centre of the round end; in one unit of length, whatever it is.  At the surface of the
// tube and inside, the tube is thinner: it reaches to the point.  Derivation: docs/area-lights.md.
#ifndef AG_PHYSICS_LIGHT_TUBE_GLSL
#define AG_PHYSICS_LIGHT_TUBE_GLSL

#include "physics/lang.glsl"
#include "physics/light_polygon.glsl"

// The part of the outline along a round end: the circle foot + sin_s (cos t out + sin t side),
// |t| < turn; foot = cos_s times its axis, out away from the other end.
STRUCT(light_tube_end) {
    vec3 foot;
    vec3 out_way;
    vec3 side;
    real sin_s;
    real cos_s;
    real turn;
    vec3 first; // its ends
    vec3 last;
};

STRUCT(light_tube) {
    light_tube_end a;
    light_tube_end b;
};

// `point` = its centre, at distance d; the part's angle from its cosine and sine.
static inline light_tube_end light_tube_end_make(vec3 point, vec3 away, real radius, real cos_t,
                                                 real sin_t)
{
    light_tube_end e;
    real d = sqrt(dot(point, point));
    vec3 axis = point / max(d, AREA_TINY);
    vec3 flat_way = away - dot(away, axis) * axis;
    vec3 other = max(axis[2], -axis[2]) < 0.7f ? vec3(0.0f, 0.0f, 1.0f) : vec3(1.0f, 0.0f, 0.0f);
    bool end_on = dot(flat_way, flat_way) <= 1e-12f * dot(away, away);
    e.sin_s = min(radius / max(d, AREA_TINY), 1.0f);
    e.cos_s = sqrt(max(1.0f - e.sin_s * e.sin_s, 0.0f));
    e.out_way = light_unit(end_on ? other - dot(other, axis) * axis : flat_way);
    e.side = cross(axis, e.out_way);
    e.foot = e.cos_s * axis;
    e.turn = atan2(sin_t, cos_t);
    vec3 c = e.foot + e.sin_s * cos(e.turn) * e.out_way;
    vec3 s = e.sin_s * sin(e.turn) * e.side;
    e.first = c - s;
    e.last = c + s;
    return e;
}

static inline light_tube light_tube_from_axis(vec3 centre, vec3 half_axis, real radius)
{
    real h2 = max(dot(half_axis, half_axis), AREA_TINY);
    vec3 nearest = centre - clamp(dot(centre, half_axis) / h2, -1.0f, 1.0f) * half_axis;
    real r = min(radius, 0.9999f * sqrt(dot(nearest, nearest)));
    vec3 a = centre - half_axis;
    vec3 b = centre + half_axis;
    real aa = dot(a, a);
    real bb = dot(b, b);
    vec3 m = 2.0f * cross(centre, half_axis); // a x b
    real n = sqrt(dot(m, m));
    // The planes through the point that touch both ends, of normals across m or along it.
    real ratio = 2.0f * r * sqrt(h2) / max(n, AREA_TINY);
    real gamma = sqrt(max(1.0f - min(ratio, 1.0f) * ratio, 0.0f));
    real side = 2.0f * dot(centre, half_axis); // (bb - aa) / 2
    real toward_a = -side + 2.0f * dot(half_axis, half_axis); // aa - ab
    real toward_b = side + 2.0f * dot(half_axis, half_axis);  // bb - ab
    bool nested = ratio >= 1.0f;
    real cos_a = nested ? (side > 0.0f ? -1.0f : 1.0f) : r * toward_a / (sqrt(aa) * n);
    real cos_b = nested ? (side > 0.0f ? 1.0f : -1.0f) : r * toward_b / (sqrt(bb) * n);
    light_tube t;
    t.a = light_tube_end_make(a, -1.0f * half_axis, r, cos_a, nested ? 0.0f : gamma);
    t.b = light_tube_end_make(b, half_axis, r, cos_b, nested ? 0.0f : gamma);
    return t;
}

// What is above the horizon of a part of a circle: up to two intervals of t.
STRUCT(light_tube_span) {
    vec2 one;
    vec2 two;
    bool sinks; // at the first's end
    bool rises; // at the last's start
};

static inline light_tube_span light_tube_span_make(light_tube_end e)
{
    real x = e.sin_s * e.out_way[2];
    real y = e.sin_s * e.side[2];
    real h = sqrt(x * x + y * y);
    real top = h > 0.0f ? atan2(y, x) : 0.0f;
    real cos_h = -e.foot[2] / max(h, AREA_TINY);
    real half_h = cos_h <= -1.0f ? 7.0f : cos_h >= 1.0f ? -7.0f
                                                         : atan2(sqrt(1.0f - cos_h * cos_h), cos_h);
    real again = top > 0.0f ? -2.0f * PI : 2.0f * PI;
    vec2 a = vec2(max(-e.turn, top - half_h), min(e.turn, top + half_h));
    vec2 b = vec2(max(-e.turn, top + again - half_h), min(e.turn, top + again + half_h));
    bool a_is = a[1] > a[0];
    bool b_is = b[1] > b[0] && half_h < 4.0f;
    vec2 none = vec2(0.0f, 0.0f);
    vec2 first = b_is && again < 0.0f ? b : a_is ? a : none;
    vec2 last = b_is && again > 0.0f ? b : a_is ? a : none;
    light_tube_span s;
    bool single = !(a_is && b_is);
    vec2 only = b_is ? b : a_is ? a : none;
    real middle = 0.5f * (only[0] + only[1]);
    s.one = single ? vec2(only[0], middle) : first;
    s.two = single ? vec2(middle, only[1]) : last;
    bool any = a_is || b_is;
    s.sinks = any && (single ? s.two[1] < e.turn : true);
    s.rises = any && (single ? s.one[0] > -e.turn : true);
    return s;
}

static inline vec3 light_tube_end_at(light_tube_end e, real t)
{
    return e.foot + e.sin_s * (cos(t) * e.out_way + sin(t) * e.side);
}

// ---- the form factor ----------------------------------------------------------------------------

// Lambert's integral along a part of the circle.
static inline real light_tube_contour(light_tube_end e, vec2 span)
{
    vec3 axis = cross(e.out_way, e.side);
    vec3 d = light_tube_end_at(e, span[1]) - light_tube_end_at(e, span[0]);
    return e.sin_s * e.sin_s * axis[2] * (span[1] - span[0]) + cross(e.foot, d)[2];
}

static inline light_walk light_tube_walk_end(light_walk walk, light_tube_end e)
{
    light_tube_span s = light_tube_span_make(e);
    bool single = s.one[1] == s.two[0];
    real sink = single ? s.two[1] : s.one[1];
    real rise = single ? s.one[0] : s.two[0];
    walk.sum += light_tube_contour(e, s.one) + light_tube_contour(e, s.two);
    walk.out_at = s.sinks ? light_tube_end_at(e, sink) : walk.out_at;
    walk.in_at = s.rises ? light_tube_end_at(e, rise) : walk.in_at;
    return walk;
}

static inline real light_tube_form_factor(vec3 centre, vec3 half_axis, real radius)
{
    light_tube t = light_tube_from_axis(centre, half_axis, radius);
    light_walk walk;
    walk.sum = 0.0f;
    walk.out_at = vec3(0.0f, 0.0f, 0.0f);
    walk.in_at = vec3(0.0f, 0.0f, 0.0f);
    walk = light_walk_edge(walk, t.a.last, t.b.first);
    walk = light_tube_walk_end(walk, t.b);
    walk = light_walk_edge(walk, t.b.last, t.a.first);
    walk = light_tube_walk_end(walk, t.a);
    real sum = walk.sum + light_edge_angle(walk.out_at, walk.in_at);
    return clamp(0.5f * INV_PI * sum, 0.0f, 1.0f);
}

// ---- the highlight ------------------------------------------------------------------------------

static inline light_arc light_tube_arc(light_lobe lobe, light_tube_end e, vec2 span)
{
    real t = 0.5f * (span[0] + span[1]);
    real turn = 0.5f * (span[1] - span[0]);
    real cos_turn = cos(turn);
    vec3 out_way = e.sin_s * (cos(t) * e.out_way + sin(t) * e.side);
    vec3 side = e.sin_s * sin(turn) * (cos(t) * e.side - sin(t) * e.out_way);
    vec3 middle = lobe.v + e.foot + cos_turn * out_way;
    light_arc arc;
    arc.p0 = lobe.unstretch * (middle - side);
    arc.p1 = lobe.unstretch * (cos_turn * (lobe.v + e.foot) + out_way);
    arc.p2 = lobe.unstretch * (middle + side);
    return arc;
}

// A walk around the outline, arc by arc: twice an edge and one or two parts of the end it leads
// to; the third edge is along the horizon.
STRUCT(light_tube_walk) {
    light_tube_end end;  // the next
    light_tube_end past; // the one behind
    light_tube_span span;
    light_arc edge;
    int next; // 0 for the edge, 1 and 2 for the parts
    int last; // that there is, less than next if none
    vec3 out_at;
    vec3 in_at;
    bool closed;
};

static inline light_tube_walk light_tube_walk_start(light_tube t)
{
    light_tube_walk w;
    w.end = t.a;
    w.past = t.b;
    w.span.one = w.span.two = vec2(0.0f, 0.0f);
    w.span.sinks = w.span.rises = false;
    w.edge.p0 = w.edge.p1 = w.edge.p2 = t.a.foot;
    w.next = 0;
    w.last = 0;
    w.out_at = w.in_at = vec3(1.0f, 0.0f, 0.0f);
    w.closed = false;
    return w;
}

// To the next edge and end.
static inline light_tube_walk light_tube_walk_turn(light_tube_walk w, light_lobe lobe, bool last)
{
    light_tube_end past = w.past;
    w.past = w.end;
    w.end = past;
    light_edge e = light_edge_clip(w.past.last, w.end.first);
    light_tube_span s = light_tube_span_make(w.end);
    bool single = s.one[1] == s.two[0];
    bool whole = single && s.two[1] - s.one[0] < 4.0f;
    vec3 a = last ? w.out_at : light_unit(e.a);
    vec3 b = last ? w.in_at : light_unit(e.b);
    w.edge = light_arc_great(lobe, a, b);
    w.span.one = whole ? vec2(s.one[0], s.two[1]) : s.one;
    w.span.two = s.two;
    w.next = last || e.up ? 0 : 1;
    w.last = last || s.one[1] <= s.one[0] ? 0 : whole ? 1 : 2;
    w.out_at = e.sinks ? b : w.out_at;
    w.in_at = e.rises ? a : w.in_at;
    w.out_at = s.sinks ? light_tube_end_at(w.end, single ? s.two[1] : s.one[1]) : w.out_at;
    w.in_at = s.rises ? light_tube_end_at(w.end, single ? s.one[0] : s.two[0]) : w.in_at;
    w.closed = w.closed || e.sinks || s.sinks;
    return w;
}

static inline light_arc light_tube_walk_arc(light_tube_walk w, light_lobe lobe)
{
    light_arc arc = w.edge;
    if (w.next > 0)
        arc = light_tube_arc(lobe, w.end, w.next == 1 ? w.span.one : w.span.two);
    return arc;
}

static inline light_fan light_tube_fan(light_lobe lobe, vec3 centre, vec3 half_axis, real radius)
{
    light_tube t = light_tube_from_axis(centre, half_axis, radius);
    light_fan fan = light_fan_start();
    light_tube_walk w = light_tube_walk_start(t);
    for (int i = 0; i < (w.closed ? 3 : 2); i++) {
        w = light_tube_walk_turn(w, lobe, i == 2);
        for (; w.next <= w.last; w.next++)
            fan = light_fan_survey(fan, light_tube_walk_arc(w, lobe));
    }
    fan = light_fan_settle(fan, lobe);
    w = light_tube_walk_start(t);
    for (int i = 0; i < (w.closed ? 3 : 2); i++) {
        w = light_tube_walk_turn(w, lobe, i == 2);
        for (; w.next <= w.last; w.next++)
            fan = light_fan_add(fan, lobe, light_tube_walk_arc(w, lobe));
    }
    return fan;
}

// As light_fan_ggx: L (f0 (x - y) + f90 y) is the radiance towards v.
static inline vec2 light_tube_ggx(vec3 centre, vec3 half_axis, real radius, vec3 v, real ax,
                                  real ay)
{
    light_lobe lobe = light_lobe_from_view(v, ax, ay);
    return light_fan_ggx(light_tube_fan(lobe, centre, half_axis, radius), lobe);
}

#endif
