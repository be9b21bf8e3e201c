// A sphere or a sun over a Lambert base and under a GGX lobe, without table or fit.
//
// Both lights are a cap of directions of constant radiance L.  The results are divided by
// pi sin_s^2, so that they multiply the irradiance that the light gives to a surface facing
// it, E = pi L sin_s^2: I / max(d, R)^2 for a sphere of intensity I (cd), the illuminance (lux)
// for a sun.  They stay finite and become the point light's as the cap shrinks to nothing.
//
// Symbols: all directions in the surface's frame, x = tangent, z = normal, unit, pointing away
// from the surface; v = towards the eye; ax, ay = GGX alpha along x and y.
//
// The derivation is in docs/sphere-light.md; its section numbers stand below.  In brief: the
// half vectors of a cap fill an elliptic cone (1), a stretch of space turns GGX's visible
// normals into a clamped cosine (2), and the cosine's integral over an elliptic cone is the
// area of an ellipse (3).  Shadowing and Fresnel are averaged over that ellipse by nine
// points; what the horizon cuts off, the points leave out (4, 5).
#ifndef AG_PHYSICS_LIGHT_SPHERE_GLSL
#define AG_PHYSICS_LIGHT_SPHERE_GLSL

#include "physics/fresnel.glsl"
#include "physics/lang.glsl"

// The directions from which light comes: within the angle s of `axis`, s <= 90 degrees.
STRUCT(light_cap) {
    vec3 axis;
    real sin_s;
    real cos_s;
};

// The quadratic form of (tau, sigma, s3): positive above the horizon, or within the light.
STRUCT(light_form) {
    real tt;
    real ss;
    real aa;
    real ts;
    real ta;
    real sa;
};

// The elliptic cone of stretched half vectors: unit axis, two conjugate half diameters z1, z2 of
// its ellipse (the cone's section with the unit sphere, seen along the axis), and what leads
// from an angle on the light's rim to one on the ellipse: a Lorentz boost, then a triangle.
STRUCT(light_cone) {
    vec3 axis;
    vec3 z1;
    vec3 z2;
    vec3 boost;
    vec3 triangle; // r11, r12, r22
    real square;   // the axis' eigenvalue
    real area;     // of the ellipse, over pi sin_s^2
};

// The visible part of that ellipse in three slices across it, ready to be sampled.
STRUCT(light_lens) {
    vec3 v;
    vec3 stretch; // ax, ay, 1
    vec3 along;   // half vectors are tau along + sigma across + s3 axis
    vec3 across;
    vec3 axis;
    vec3 metric; // along^2, along.across, across^2 before the stretch
    real length_v;
    real width;  // the slices stand at sigma = 0, +-width
    vec3 low;    // their ends in tau, for sigma = -width, 0, width
    vec3 high;
    real scale;
};

static const real LIGHT_TINY = 1e-30f;

// Gauss-Legendre on a slice, and the second-kind Chebyshev points across the slices.
static const real LIGHT_NODE = 0.77459667f;  // sqrt(3 / 5)
static const real LIGHT_SLICE = 0.70710678f; // cos(pi / 4)

// `to_centre` in metres.  On the sphere or in it, the hemisphere towards its centre: the cap is
// continuous everywhere but at the centre (no choice of hemispheres is, on a full ball), and the
// irradiance stays pi L.
static inline light_cap light_cap_sphere(vec3 to_centre, real radius)
{
    light_cap cap;
    real d = sqrt(dot(to_centre, to_centre));
    cap.axis = d > LIGHT_TINY ? to_centre / d : vec3(0.0f, 0.0f, 1.0f);
    cap.sin_s = radius < d ? radius / d : 1.0f;
    cap.cos_s = radius < d ? sqrt((d - radius) / d * ((d + radius) / d)) : 0.0f;
    return cap;
}

// `direction` = towards the sun; `angle` = its angular radius, in [0, pi/2].
static inline light_cap light_cap_sun(vec3 direction, real angle)
{
    light_cap cap;
    cap.axis = direction;
    cap.sin_s = sin(angle);
    cap.cos_s = cos(angle);
    return cap;
}

// Irradiance of the surface over that of a surface facing the light: the clamped cosine for a
// point light, and (1 + c) / 2 for a hemisphere.  With c = cosine of the axis, x = cot s,
// y = -x c / sqrt(1 - c^2), q = sqrt(1 - c^2) sqrt(1 - y^2) it is
// (c acos y - x q + atan(q / x) / sin_s^2) / pi where the horizon cuts the cap; the last two
// terms nearly cancel for small caps, and are summed as a series there.
static inline real light_cap_cosine(light_cap cap)
{
    real c = cap.axis[2];
    real s2 = cap.sin_s * cap.sin_s;
    if (c >= cap.sin_s)
        return c;
    if (c <= -cap.sin_s)
        return 0.0f;
    real r = sqrt(max(1.0f - c * c, 0.0f));
    real y = clamp(-c * cap.cos_s / max(cap.sin_s * r, LIGHT_TINY), -1.0f, 1.0f);
    real w = sqrt(1.0f - y * y);
    real q = r * w;
    real arc;
    if (s2 < 0.1f) {
        real t = q * cap.sin_s / cap.cos_s; // below 1/3
        real u = t * t;
        real series = 1.0f / 3.0f - u * (0.2f - u * (1.0f / 7.0f - u * (1.0f / 9.0f - u / 11.0f)));
        arc = t - t * q * q * series / (1.0f - s2);
    } else {
        arc = atan2(q * cap.sin_s, cap.cos_s) / s2 - q * cap.cos_s / cap.sin_s;
    }
    return max((c * atan2(w, y) + arc) * INV_PI, 0.0f);
}

// The positive root of k^3 - a k^2 + b k - c, whose other roots are real and not positive, c >= 0.
// The first guess lies within [3/4, 1] of the root; a step of Laguerre's and one of Newton's
// leave nothing to float.
static inline real light_root(real a, real b, real c)
{
    real top = (a + 2.0f * sqrt(max(a * a - 3.0f * b, 0.0f))) / 3.0f; // not below the root
    // k^2 (top - a) + b k - c has its positive root not above it; a is not above it either.
    real w = max(top - a, LIGHT_TINY);
    real r = sqrt(max(b * b + 4.0f * c * w, 0.0f));
    real k = b > 0.0f ? 2.0f * c / (b + r) : 0.5f * (r - b) / w;
    k = max(min(k, max(top, a)), max(a, LIGHT_TINY));
    real p = ((k - a) * k + b) * k - c;
    real d = (3.0f * k - 2.0f * a) * k + b;
    r = sqrt(max(4.0f * d * d - 12.0f * p * (3.0f * k - a), 0.0f));
    k = k - 3.0f * p / max(d + r, LIGHT_TINY);
    p = ((k - a) * k + b) * k - c;
    d = (3.0f * k - 2.0f * a) * k + b;
    return max(k - p / max(d, LIGHT_TINY), LIGHT_TINY);
}

// The basis of a cap's rim: c0 + c1 cos t + c2 sin t, t = 0 at its highest point.
static inline vec3 light_rim_up(vec3 axis)
{
    real h2 = axis[0] * axis[0] + axis[1] * axis[1];
    real h = sqrt(h2);
    return h > 1e-7f ? vec3(-axis[2] * axis[0] / h, -axis[2] * axis[1] / h, h)
                     : vec3(-axis[2], 0.0f, 0.0f);
}

// The cone of a cap under v (section 3).  `reach` = 1 + cos of the angle between the cap's rim and
// -v, as cos_s + axis.v; `unstretch` = 1 / (ax, ay, 1) times any factor, `volume` its product.
static inline light_cone light_cone_from_cap(light_cap cap, vec3 v, real reach, vec3 unstretch,
                                             real volume)
{
    vec3 up = light_rim_up(cap.axis);
    vec3 c0 = unstretch * (v + cap.cos_s * cap.axis);
    vec3 c1 = unstretch * (cap.sin_s * up);
    vec3 c2 = unstretch * (cap.sin_s * cross(cap.axis, up));
    real g00 = dot(c1, c1);
    real g11 = dot(c2, c2);
    real g01 = dot(c1, c2);
    real g02 = dot(c1, c0);
    real g12 = dot(c2, c0);
    vec3 x01 = cross(c1, c2);
    vec3 x02 = cross(c1, c0);
    vec3 x12 = cross(c2, c0);
    real minor = dot(x01, x01);
    real a = dot(c0, c0) - g00 - g11;
    real b = minor - dot(x02, x02) - dot(x12, x12);
    real det = volume * reach;                   // of (c1, c2, c0), over sin_s^2
    real c = det * cap.sin_s * cap.sin_s;
    c = c * c;
    real k = light_root(a, b, c);

    light_cone cone;
    cone.square = k;
    cone.area = det / sqrt(k * (k * k + k * max(k - a, 0.0f) + c / k));
    vec3 x = vec3(g01 * g12 - (g11 + k) * g02, g01 * g02 - (g00 + k) * g12,
                  k * (g00 + g11 + k) + minor);
    x = x / sqrt(max(x[2] * x[2] - x[0] * x[0] - x[1] * x[1], 1e-7f * x[2] * x[2]));
    cone.boost = x;
    vec3 shift = c0 + (x[0] * c1 + x[1] * c2) / (1.0f + x[2]);
    real scale = 1.0f / sqrt(k);
    vec3 b1 = scale * (c1 + x[0] * shift);
    vec3 b2 = scale * (c2 + x[1] * shift);
    vec3 b3 = x[0] * c1 + x[1] * c2 + x[2] * c0;
    cone.axis = b3 / sqrt(max(dot(b3, b3), LIGHT_TINY));
    real r11 = sqrt(1.0f + dot(b1, b1));
    real r12 = dot(b1, b2) / r11;
    real r22 = sqrt(max(1.0f + dot(b2, b2) - r12 * r12, LIGHT_TINY));
    cone.z1 = b1 / r11;
    cone.z2 = (b2 - r12 * cone.z1) / r22;
    cone.triangle = vec3(r11, r12, r22);
    return cone;
}

// The point of the ellipse's unit disc that belongs to the angle (cos_t, sin_t) on the rim.
static inline vec2 light_cone_rim(light_cone cone, real cos_t, real sin_t)
{
    vec3 x = cone.boost;
    real f = (x[0] * cos_t + x[1] * sin_t) / (1.0f + x[2]) - 1.0f;
    real y1 = cos_t + x[0] * f;
    real y2 = sin_t + x[1] * f;
    real z1 = cone.triangle[0] * y1 + cone.triangle[1] * y2;
    real z2 = cone.triangle[2] * y2;
    return vec2(z1, z2) / sqrt(max(z1 * z1 + z2 * z2, LIGHT_TINY));
}

// Where rim and horizon meet on the unit disc: at the angles +-gamma from the unit vector d.
// Returns d, cos(gamma), sin(gamma); gamma = pi for a light wholly up, d then points upwards.
static inline vec4 light_cone_meeting(light_cone cone, light_cap cap)
{
    real h = sqrt(cap.axis[0] * cap.axis[0] + cap.axis[1] * cap.axis[1]);
    real cos_t = clamp(-cap.axis[2] * cap.cos_s / max(cap.sin_s * h, LIGHT_TINY), -1.0f, 1.0f);
    real sin_t = sqrt(1.0f - cos_t * cos_t);
    vec2 p = light_cone_rim(cone, cos_t, sin_t);
    vec2 q = light_cone_rim(cone, cos_t, -sin_t);
    vec2 gap = 0.5f * (p - q);
    vec2 mid = 0.5f * (p + q);
    real sin_g = sqrt(gap[0] * gap[0] + gap[1] * gap[1]);
    real cos_g = sqrt(mid[0] * mid[0] + mid[1] * mid[1]);
    real turn = q[0] * p[1] - q[1] * p[0]; // sin(2 gamma); fails where the points fall together
    cos_g = (sin_g > 0.1f ? turn : cos_t) < 0.0f ? -cos_g : cos_g;
    return vec4(p[0] * cos_g + p[1] * sin_g, p[1] * cos_g - p[0] * sin_g, cos_g, sin_g);
}

// Positive above the horizon: 2 h.z (v.h) - v.z h.h.
static inline light_form light_form_horizon(light_lens lens)
{
    vec3 d = lens.along;
    vec3 s = lens.across;
    vec3 a = lens.axis;
    real z = lens.v[2];
    real vd = dot(lens.v, d);
    real vs = dot(lens.v, s);
    real va = dot(lens.v, a);
    light_form f;
    f.tt = 2.0f * d[2] * vd - z * dot(d, d);
    f.ss = 2.0f * s[2] * vs - z * dot(s, s);
    f.aa = 2.0f * a[2] * va - z * dot(a, a);
    f.ts = d[2] * vs + s[2] * vd - z * dot(d, s);
    f.ta = d[2] * va + a[2] * vd - z * dot(d, a);
    f.sa = s[2] * va + a[2] * vs - z * dot(s, a);
    return f;
}

// Positive within the light: 1 - tau^2 - sigma^2 less `lift` times the horizon's form.
static inline light_form light_form_rim(vec3 metric, light_form horizon, real lift)
{
    light_form f;
    f.tt = metric[0] - 1.0f - lift * horizon.tt;
    f.ss = metric[2] - 1.0f - lift * horizon.ss;
    f.aa = 1.0f - lift * horizon.aa;
    f.ts = metric[1] - lift * horizon.ts;
    f.ta = -lift * horizon.ta;
    f.sa = -lift * horizon.sa;
    return f;
}

// Where the line sigma = 0 crosses a form's zero, as tau: upwards (into the positive) or
// downwards; the disc's rim where it does not cross within.
static inline real light_form_cross(light_form f, real along2, bool upwards)
{
    real rim = 1.0f / sqrt(max(1.0f - along2, 1e-12f)); // tau = 1 as x = tau / s3
    real way = upwards ? -1.0f : 1.0f;                  // f(x) = tt x^2 + 2 ta x + aa
    real b = -way * f.ta;
    real disc = b * b - f.tt * f.aa;
    real r = sqrt(max(disc, 0.0f));
    // In units of way x the wanted root is the descending one.
    real x = b >= 0.0f ? f.aa / max(b + r, LIGHT_TINY) : (b - r) / min(f.tt, -LIGHT_TINY);
    x = b < 0.0f && f.tt >= 0.0f ? rim : x;
    x = disc < 0.0f ? (f.aa > 0.0f ? rim : -rim) : x;
    x = clamp(x, -rim, rim);
    return way * x / sqrt(1.0f + x * x * along2);
}

// One step of Newton's along tau; `way` = the sign of the form's slope at the crossing.
static inline real light_form_refine(light_form f, vec3 metric, real t, real s, real way)
{
    real a2 = 1.0f - t * t * metric[0] - 2.0f * t * s * metric[1] - s * s * metric[2];
    real a = sqrt(max(a2, 1e-6f));
    real ft = f.tt * t + f.ts * s + f.ta * a;
    real fs = f.ts * t + f.ss * s + f.sa * a;
    real fa = f.ta * t + f.sa * s + f.aa * a;
    real da = -(t * metric[0] + s * metric[1]) / a;
    real slope = way * (ft + fa * da);
    real bend = way * (f.tt + 2.0f * f.ta * da + f.aa * da * da - fa * (metric[0] + da * da) / a);
    real value = way * (ft * t + fs * s + fa * a);
    real step = value / max(slope + sqrt(max(slope * slope - value * bend, 0.0f)), LIGHT_TINY);
    real rim = sqrt(max(1.0f - s * s, 0.0f));
    return clamp(t - clamp(step, -0.5f, 0.5f), -rim, rim);
}

// Of the form that bounds the slice there.
static inline real light_form_end(light_form first, light_form second, bool is_first, vec3 metric,
                                  real t, real s, real way)
{
    light_form f;
    f.tt = is_first ? first.tt : second.tt;
    f.ss = is_first ? first.ss : second.ss;
    f.aa = is_first ? first.aa : second.aa;
    f.ts = is_first ? first.ts : second.ts;
    f.ta = is_first ? first.ta : second.ta;
    f.sa = is_first ? first.sa : second.sa;
    return light_form_refine(f, metric, t, s, way);
}

// The visible part of the light's ellipse between the horizon and the rim: both are taken for
// circular arcs through the two points where they meet, at (tau, sigma) = (cos_g, +-sin_g), and
// through where they cross sigma = 0, at tau = `low` and `high`; then refined.  Section 5.
static inline light_lens light_lens_slice(light_lens lens, light_form horizon, light_form rim,
                                          real cos_g, real sin_g)
{
    real low = light_form_cross(horizon, lens.metric[0], true);
    real high = max(light_form_cross(rim, lens.metric[0], false), low);

    // Sagitta, curvature and half width of the arcs.
    real rise = high - cos_g;
    real sink = cos_g - low;
    real rise2 = sin_g * sin_g + rise * rise;
    real sink2 = sin_g * sin_g + sink * sink;
    real rise_k = 2.0f * rise / max(rise2, 1e-12f);
    real sink_k = 2.0f * sink / max(sink2, 1e-12f);
    real abs_rise = max(rise, -rise);
    real abs_sink = max(sink, -sink);
    real rise_w = abs_rise > sin_g ? 0.5f * rise2 / max(abs_rise, 1e-6f) : sin_g;
    real sink_w = abs_sink > sin_g ? 0.5f * sink2 / max(abs_sink, 1e-6f) : sin_g;
    real width = min(max(rise > 0.0f ? rise_w : sin_g, sink > 0.0f ? sink_w : sin_g), 1.0f);

    real s = LIGHT_SLICE * width;
    real s2 = s * s;
    real rise_c = 1.0f + sqrt(max(1.0f - rise_k * rise_k * s2, 0.0f));
    real sink_c = 1.0f + sqrt(max(1.0f - sink_k * sink_k * s2, 0.0f));
    bool on_rim = s <= rise_w;
    bool on_horizon = s <= sink_w;
    // Beyond its half width an arc's other half bounds the slice on both sides.
    real t1 = on_rim ? high - rise_k * s2 / rise_c : low + sink_c / max(sink_k, 1e-6f);
    real t0 = on_horizon ? low + sink_k * s2 / sink_c : high - rise_c / max(rise_k, 1e-6f);
    lens.low = vec3(light_form_end(horizon, rim, on_horizon, lens.metric, t0, -s, 1.0f), low,
                    light_form_end(horizon, rim, on_horizon, lens.metric, t0, s, 1.0f));
    lens.high = vec3(light_form_end(rim, horizon, on_rim, lens.metric, t1, -s, -1.0f), high,
                     light_form_end(rim, horizon, on_rim, lens.metric, t1, s, -1.0f));
    lens.width = s;
    lens.scale *= width;
    return lens;
}

// What light_lens_node samples.  v.z > 0; alpha in (0, 1].
static inline light_lens light_lens_from_cap(light_cap cap, vec3 v, real ax, real ay)
{
    // Nothing of the light is up: any light that is, for nothing.
    bool hidden = cap.axis[2] <= -cap.sin_s;
    vec3 axis = hidden ? vec3(0.0f, 0.0f, 1.0f) : cap.axis;
    real s2 = cap.sin_s * cap.sin_s;
    vec3 sum = v + axis;
    real reach = 0.5f * dot(sum, sum) - s2 / (1.0f + cap.cos_s); // cos_s + axis.v

    // Another cap with the same part above the horizon's circle, or more: its axis is raised so
    // far that the axis is up and -v well outside.  Section 4.
    real lift = max(max(-axis[2], s2 / (1.0f + cap.cos_s) - reach / v[2]), 0.0f);
    real grow = lift * (2.0f * axis[2] + lift);
    real inverse = 1.0f / sqrt(1.0f + grow);
    real shrink = max(1.0f + grow / max(s2, LIGHT_TINY), 0.0f) * inverse * inverse;
    light_cap raised;
    raised.axis = inverse * (axis + vec3(0.0f, 0.0f, lift));
    raised.cos_s = inverse * cap.cos_s;
    raised.sin_s = cap.sin_s * sqrt(shrink);
    real raised_reach = inverse * (reach + lift * v[2]);

    real m = max(ax, ay) / max(sqrt(dot(sum, sum)), 0.01f); // any; keeps numbers near 1
    light_cone cone = light_cone_from_cap(raised, v, raised_reach, vec3(m / ax, m / ay, m),
                                          m * m * m / (ax * ay));

    vec4 meeting = light_cone_meeting(cone, raised);
    real cos_g = meeting[2];
    real sin_g = meeting[3];
    vec2 d = vec2(meeting[0], meeting[1]);

    light_lens lens;
    vec3 qd = d[0] * cone.z1 + d[1] * cone.z2;
    vec3 qs = d[0] * cone.z2 - d[1] * cone.z1;
    lens.v = v;
    lens.stretch = vec3(ax, ay, 1.0f);
    lens.along = lens.stretch * qd;
    lens.across = lens.stretch * qs;
    lens.axis = lens.stretch * cone.axis;
    lens.metric = vec3(dot(qd, qd), dot(qd, qs), dot(qs, qs));
    vec3 sv = lens.stretch * v;
    lens.length_v = sqrt(dot(sv, sv));
    // 4 / (2 pi) area, 1 / pi for sin_s^2, pi / 4 of the slices' weights.
    real area = min(shrink * cone.area, 1.0f / max(s2, LIGHT_TINY)); // at most the disc
    lens.scale = hidden ? 0.0f : 0.5f * INV_PI * area;

    // The raised cap's form is f (1 - tau^2 - sigma^2), the light's is that less the lift.
    light_form horizon = light_form_horizon(lens);
    real f = m * m * raised_reach * raised.sin_s * raised.sin_s / (cone.square * inverse);
    light_form rim = light_form_rim(lens.metric, horizon, min(lift / max(f, LIGHT_TINY), 1e15f));
    return light_lens_slice(lens, horizon, rim, cos_g, sin_g);
}

// Weight and cosine v.h of a node: `slice` and `place` = -1, 0, 1.  The light's reflection is the
// sum of weight F(v.h) over all nine nodes, times E.
static inline vec2 light_lens_node(light_lens lens, int slice, int place)
{
    real low = slice < 0 ? lens.low[0] : slice > 0 ? lens.low[2] : lens.low[1];
    real high = slice < 0 ? lens.high[0] : slice > 0 ? lens.high[2] : lens.high[1];
    real half_length = max(0.5f * (high - low), 0.0f);
    real t = 0.5f * (high + low) + half_length * (LIGHT_NODE * to_real(place));
    real s = lens.width * to_real(slice);
    real weight = half_length * (place == 0 ? 8.0f / 9.0f : 5.0f / 9.0f) *
                  (slice == 0 ? 1.0f : LIGHT_SLICE);
    vec3 metric = lens.metric;
    real a2 = 1.0f - t * t * metric[0] - 2.0f * t * s * metric[1] - s * s * metric[2];
    real a = sqrt(max(a2, 1e-6f));
    vec3 h = t * lens.along + s * lens.across + a * lens.axis;
    real vh = max(dot(lens.v, h), 0.0f);
    real h1 = 1.0f / sqrt(dot(h, h));
    real h2 = h1 * h1;
    vec3 l = (2.0f * vh * h2) * h - lens.v;
    vec3 sl = lens.stretch * l;
    real NoL = max(l[2], 0.0f);
    // G2 / G1 = (|Sv| + NoV) NoL / (|Sv| NoL + |Sl| NoV); Heitz 2014, eqs. 43, 99, 72 and 86.
    real g = NoL / max(a * (lens.length_v * NoL + sqrt(dot(sl, sl)) * lens.v[2]), LIGHT_TINY);
    return vec2(lens.scale * weight * vh * g, min(vh * h1, 1.0f));
}

static inline vec2 light_lens_slice_sum(light_lens lens, int slice)
{
    vec2 a = light_lens_node(lens, slice, -1);
    vec2 b = light_lens_node(lens, slice, 0);
    vec2 c = light_lens_node(lens, slice, 1);
    return vec2(a[0] + b[0] + c[0],
                a[0] * pow5(1.0f - a[1]) + b[0] * pow5(1.0f - b[1]) + c[0] * pow5(1.0f - c[1]));
}

// The GGX lobe under the light: x without Fresnel, y with the factor (1 - v.h)^5 of Schlick's,
// so that E (f0 (x - y) + f90 y) is the radiance towards v.
static inline vec2 light_cap_ggx(light_cap cap, vec3 v, real ax, real ay)
{
    light_lens lens = light_lens_from_cap(cap, v, ax, ay);
    vec2 sum = light_lens_slice_sum(lens, -1) + light_lens_slice_sum(lens, 0) +
               light_lens_slice_sum(lens, 1);
    // No light is reflected brighter than it is.
    real most = INV_PI / max(cap.sin_s * cap.sin_s, LIGHT_TINY);
    return sum * min(1.0f, most / max(sum[0], LIGHT_TINY));
}

#endif
