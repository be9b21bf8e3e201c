// A disk or an ellipse of constant radiance L: its form factor, exact and with the horizon, and its
// reflection in a GGX lobe.
//
// `centre` from the point, in the surface's frame (z = normal); the half axes, or any two
// conjugate half diameters, in the same unit of length, whatever it is.  The side to which half_x
// x half_y points emits; seen from the other, it is dark.  Derivation: docs/area-lights.md.
#ifndef AG_PHYSICS_LIGHT_DISK_GLSL
#define AG_PHYSICS_LIGHT_DISK_GLSL

#include "physics/lang.glsl"
#include "physics/light_area.glsl"
#include "physics/light_sphere.glsl"

// The outline is centre + up cos t + across sin t; across is level, and what is above the horizon
// has |t| < th.
STRUCT(light_ellipse) {
    vec3 centre;
    vec3 up;
    vec3 across;
    real cos_t; // of th
    bool dark;
};

static inline light_ellipse light_ellipse_from_axes(vec3 centre, vec3 half_x, vec3 half_y)
{
    real h = sqrt(half_x[2] * half_x[2] + half_y[2] * half_y[2]);
    real x = h > 0.0f ? half_x[2] / h : 1.0f;
    real y = h > 0.0f ? half_y[2] / h : 0.0f;
    real d = sqrt(max(dot(centre, centre), AREA_TINY));
    light_ellipse e;
    e.centre = centre / d;
    e.up = (x * half_x + y * half_y) / d;
    e.across = (y * half_x - x * half_y) / d;
    real z = e.centre[2];
    h = e.up[2];
    e.cos_t = z >= h ? -1.0f : clamp(-z / max(h, AREA_TINY), -1.0f, 1.0f);
    bool faces = dot(e.centre, cross(e.up, e.across)) > 1e-20f;
    e.dark = z <= -h || !faces;
    if (e.dark) { // any that is not degenerate
        e.centre = vec3(0.0f, 0.0f, 1.0f);
        e.up = vec3(1.0f, 0.0f, 0.0f);
        e.across = vec3(0.0f, 1.0f, 0.0f);
        e.cos_t = -1.0f;
    }
    return e;
}

static inline vec3 light_ellipse_at(light_ellipse e, real cos_t, real sin_t)
{
    return e.centre + cos_t * e.up + sin_t * e.across;
}

// ---- the form factor ----------------------------------------------------------------------------

// The ellipse's cone: its points are along axis + cos p x + sin p y; axis is unit, x and y are
// across it and each other, x the longer.
STRUCT(light_ellipse_cone) {
    vec3 axis;
    vec3 x;
    vec3 y;
};

// As light_cone_from_cap (docs/sphere-light.md, section 3), whose rim is one such ellipse.
static inline light_ellipse_cone light_ellipse_cone_from(light_ellipse e)
{
    vec3 c0 = e.centre;
    vec3 c1 = e.up;
    vec3 c2 = e.across;
    real g00 = dot(c1, c1);
    real g11 = dot(c2, c2);
    real g01 = dot(c1, c2);
    real g02 = dot(c1, c0);
    real g12 = dot(c2, c0);
    vec3 x01 = cross(c1, c2);
    vec3 x02 = cross(c1, c0);
    vec3 x12 = cross(c2, c0);
    real minor = dot(x01, x01);
    real det = dot(c0, x01);
    real k = light_root(dot(c0, c0) - g00 - g11, minor - dot(x02, x02) - dot(x12, x12), det * det);
    vec3 x = vec3(g01 * g12 - (g11 + k) * g02, g01 * g02 - (g00 + k) * g12,
                  k * (g00 + g11 + k) + minor);
    x = x / sqrt(max(x[2] * x[2] - x[0] * x[0] - x[1] * x[1],
                     1e-7f * x[2] * x[2] + AREA_TINY));
    vec3 shift = c0 + (x[0] * c1 + x[1] * c2) / (1.0f + x[2]);
    real scale = 1.0f / sqrt(k);
    vec3 b1 = scale * (c1 + x[0] * shift);
    vec3 b2 = scale * (c2 + x[1] * shift);
    real d = dot(b1, b1) - dot(b2, b2);
    real m = 2.0f * dot(b1, b2);
    real cos_2 = d / max(sqrt(d * d + m * m), AREA_TINY);
    real cos_1 = sqrt(max(0.5f + 0.5f * cos_2, 0.0f));
    real sin_1 = sqrt(max(0.5f - 0.5f * cos_2, 0.0f)) * (m < 0.0f ? -1.0f : 1.0f);
    light_ellipse_cone cone;
    cone.axis = light_unit(x[0] * c1 + x[1] * c2 + x[2] * c0);
    cone.x = cos_1 * b1 + sin_1 * b2;
    cone.y = cos_1 * b2 - sin_1 * b1;
    cone.y = dot(cross(cone.x, cone.y), cone.axis) < 0.0f ? -1.0f * cone.y : cone.y;
    return cone;
}

// atan(x) / x and atanh(x) / x.
static inline real light_atan_over(real x)
{
    return x < 1e-3f && x > -1e-3f ? 1.0f - x * x / 3.0f : atan2(x, 1.0f) / x;
}

static inline real light_atanh_over(real x)
{
    return x < 1e-3f && x > -1e-3f ? 1.0f + x * x / 3.0f
                                   : 0.5f * log((1.0f + x) / max(1.0f - x, 1e-7f)) / x;
}

// Lambert's integral along the ellipse up to the point p of it is `rest` + `area` times `turn`:
// that of (z3 a b - z1 b cos p - z2 a sin p) / (1 + a^2 cos^2 p + b^2 sin^2 p), a >= b.
STRUCT(light_contour) {
    real turn; // an angle
    real area;
    real rest;
};

static inline light_contour light_ellipse_contour(light_ellipse_cone cone, vec3 p)
{
    real a2 = max(dot(cone.x, cone.x), AREA_TINY);
    real b2 = max(dot(cone.y, cone.y), AREA_TINY);
    real a = sqrt(a2);
    real b = sqrt(b2);
    real out_of = max(dot(cone.axis, p), AREA_TINY);
    real cos_p = clamp(dot(cone.x, p) / (out_of * a2), -1.0f, 1.0f);
    real sin_p = clamp(dot(cone.y, p) / (out_of * b2), -1.0f, 1.0f);
    real long_1 = sqrt(1.0f + a2);
    real short_1 = sqrt(1.0f + b2);
    real e = sqrt(max(a2 - b2, 0.0f));
    real rise = b / (long_1 * long_1) * sin_p * light_atanh_over(e / long_1 * sin_p);
    real fall = -a / (short_1 * short_1) * cos_p * light_atan_over(e / short_1 * cos_p);
    light_contour c;
    c.turn = atan2(sin_p * short_1, cos_p * long_1);
    c.area = cone.axis[2] * a * b / (long_1 * short_1);
    c.rest = -cone.x[2] / a * rise - cone.y[2] / b * fall;
    return c;
}

// From p on to q, less than once around.
static inline real light_contour_between(light_contour p, light_contour q)
{
    real turn = q.turn - p.turn;
    return (turn < -1.0f ? turn + 2.0f * PI : turn) * p.area + q.rest - p.rest;
}

static inline real light_disk_form_factor(vec3 centre, vec3 half_x, vec3 half_y)
{
    light_ellipse e = light_ellipse_from_axes(centre, half_x, half_y);
    if (e.dark)
        return 0.0f;
    light_ellipse_cone cone = light_ellipse_cone_from(e);
    if (e.cos_t <= -1.0f) {
        real a2 = dot(cone.x, cone.x);
        real b2 = dot(cone.y, cone.y);
        return clamp(sqrt(a2 / (1.0f + a2) * (b2 / (1.0f + b2))) * cone.axis[2], 0.0f, 1.0f);
    }
    real sin_t = sqrt(1.0f - e.cos_t * e.cos_t);
    vec3 p = light_ellipse_at(e, e.cos_t, sin_t);
    vec3 q = light_ellipse_at(e, e.cos_t, -sin_t);
    light_contour top = light_ellipse_contour(cone, light_ellipse_at(e, 1.0f, 0.0f));
    real arc = light_contour_between(light_ellipse_contour(cone, q), top) +
               light_contour_between(top, light_ellipse_contour(cone, p));
    real horizon = atan2(p[0] * q[1] - p[1] * q[0], p[0] * q[0] + p[1] * q[1]);
    return clamp((arc + horizon) * 0.5f * INV_PI, 0.0f, 1.0f);
}

static inline light_arc light_ellipse_arc(light_lobe lobe, light_ellipse e, vec2 from, vec2 to,
                                          vec2 middle, real cos_half)
{
    vec3 p0 = light_ellipse_at(e, from[0], from[1]);
    vec3 p1 = cos_half * e.centre + middle[0] * e.up + middle[1] * e.across;
    vec3 p2 = light_ellipse_at(e, to[0], to[1]);
    vec3 m = 0.25f * (p0 + 2.0f * p1 + p2);
    real n0 = sqrt(dot(p0, p0));
    real n2 = sqrt(dot(p2, p2));
    real n1 = 2.0f * sqrt(dot(m, m)) - 0.5f * (n0 + n2);
    light_arc arc;
    arc.p0 = lobe.unstretch * (n0 * lobe.v + p0);
    arc.p1 = lobe.unstretch * (n1 * lobe.v + p1);
    arc.p2 = lobe.unstretch * (n2 * lobe.v + p2);
    return arc;
}

// The point p of the ellipse as the cosine and sine of its angle in the cone.
static inline vec2 light_ellipse_angle(light_ellipse_cone cone, vec3 p)
{
    real x = dot(cone.x, p) / max(dot(cone.x, cone.x), AREA_TINY);
    real y = dot(cone.y, p) / max(dot(cone.y, cone.y), AREA_TINY);
    return vec2(x, y) / sqrt(max(x * x + y * y, AREA_TINY));
}

// The same outline about the axis of its cone: its points' distances vary least so.
static inline light_ellipse light_ellipse_about_axis(light_ellipse e)
{
    light_ellipse_cone cone = light_ellipse_cone_from(e);
    real sin_t = sqrt(1.0f - e.cos_t * e.cos_t);
    vec2 p = light_ellipse_angle(cone, light_ellipse_at(e, e.cos_t, sin_t));
    vec2 q = light_ellipse_angle(cone, light_ellipse_at(e, e.cos_t, -sin_t));
    vec2 d = p - q;
    real n = sqrt(d[0] * d[0] + d[1] * d[1]);
    // From q on to p, the middle is across the chord.
    vec2 near = light_ellipse_angle(cone, light_ellipse_at(e, e.cos_t < 0.0f ? -1.0f : 1.0f, 0.0f));
    vec2 m = n > 1e-4f ? vec2(d[1], -d[0]) / n : e.cos_t < 0.0f ? -near : near;
    light_ellipse round;
    round.centre = cone.axis;
    round.up = m[0] * cone.x + m[1] * cone.y;
    round.across = m[0] * cone.y - m[1] * cone.x;
    round.cos_t = e.cos_t <= -1.0f ? -1.0f : clamp(m[0] * p[0] + m[1] * p[1], -1.0f, 1.0f);
    round.dark = e.dark;
    return round;
}

// A walk along the ellipse in four arcs; the fifth is along the horizon.  Angles as cosine, sine.
STRUCT(light_disk_walk) {
    vec2 step; // half an arc
    vec2 from;
    light_arc arc;
};

static inline vec2 light_turned(vec2 a, vec2 by)
{
    return vec2(a[0] * by[0] - a[1] * by[1], a[1] * by[0] + a[0] * by[1]);
}

static inline light_disk_walk light_disk_walk_start(light_ellipse e)
{
    real half_cos = sqrt(max(0.5f + 0.5f * e.cos_t, 0.0f));
    light_disk_walk w;
    w.from = vec2(e.cos_t, -sqrt(1.0f - e.cos_t * e.cos_t));
    w.step = vec2(sqrt(0.5f + 0.5f * half_cos), sqrt(0.5f - 0.5f * half_cos));
    w.arc.p0 = w.arc.p1 = w.arc.p2 = e.centre;
    return w;
}

static inline light_disk_walk light_disk_walk_next(light_disk_walk w, light_lobe lobe,
                                                   light_ellipse e, bool last)
{
    vec2 middle = light_turned(w.from, w.step);
    vec2 to = light_turned(middle, w.step);
    w.arc = light_ellipse_arc(lobe, e, w.from, to, middle, w.step[0]);
    if (last)
        w.arc = light_arc_great(
            lobe, light_unit(light_ellipse_at(e, w.from[0], w.from[1])),
            light_unit(light_ellipse_at(e, w.from[0], -w.from[1])));
    w.from = to;
    return w;
}

static inline light_fan light_disk_fan(light_lobe lobe, vec3 centre, vec3 half_x, vec3 half_y)
{
    light_ellipse e = light_ellipse_about_axis(light_ellipse_from_axes(centre, half_x, half_y));
    int arcs = e.dark ? 0 : e.cos_t > -1.0f ? 5 : 4;
    light_fan fan = light_fan_start();
    light_disk_walk w = light_disk_walk_start(e);
    for (int i = 0; i < arcs; i++) {
        w = light_disk_walk_next(w, lobe, e, i == 4);
        fan = light_fan_survey(fan, w.arc);
    }
    fan = light_fan_settle(fan, lobe);
    w = light_disk_walk_start(e);
    for (int i = 0; i < arcs; i++) {
        w = light_disk_walk_next(w, lobe, e, i == 4);
        fan = light_fan_add(fan, lobe, w.arc);
    }
    return fan;
}

// As light_fan_ggx: L (f0 (x - y) + f90 y) is the radiance towards v.
static inline vec2 light_disk_ggx(vec3 centre, vec3 half_x, vec3 half_y, vec3 v, real ax, real ay)
{
    light_lobe lobe = light_lobe_from_view(v, ax, ay);
    return light_fan_ggx(light_disk_fan(lobe, centre, half_x, half_y), lobe);
}

#endif
