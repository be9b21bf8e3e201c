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
// area of an ellipse (3).  Shadowing and Fresnel are averaged over that ellipse by seven
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

// The lobe seen from v, the same for every light.
STRUCT(light_ggx) {
    vec3 v;
    vec3 stretch;   // ax, ay, 1
    vec3 unstretch; // 1 / (ax, ay, 1), times the larger alpha
    real volume;    // the product of unstretch
    real larger;    // alpha
    real length_v;  // of the stretched v
    vec3 square;    // |Sl|^2 = ax^2 l.l + (ay^2 - ax^2) l.y^2 + (1 - ax^2) l.z^2
    real inverse_z; // 1 / v.z
};

// The part of a quadratic form of (tau, sigma, s3) that is even in sigma.
STRUCT(light_form) {
    real tt;
    real ss;
    real aa;
    real ta;
    real odd; // sa (along.across): s3 is not even
};

// On the lines sigma = +-s, where s3^2 + along^2 tau^2 = A, such a form is one of tau and s3 alone:
// tt tau^2 + 2 ta tau s3 + aa s3^2.  Here it is multiplied by A.
STRUCT(light_line) {
    real tt;
    real ta;
    real aa;
};

// The elliptic cone of stretched half vectors: unit axis, two conjugate half diameters n1, n2 of
// its section with the plane at distance 1, and what leads from an angle on the light's rim to one
// on the unit disc (a Lorentz boost, then a triangle) and from there to the unit sphere.
STRUCT(light_cone) {
    vec3 axis;
    vec3 n1;
    vec3 n2;
    vec3 boost;    // its two components, and 1 / (1 + the third)
    vec3 triangle; // r11^2, r11 r12, r11 r22
    vec3 inverse;  // 1 / r11, r12 / (r11 r22), 1 / r22
    real square;   // the axis' eigenvalue
    real area;     // of the ellipse that the sphere's part is along the axis, over pi sin_s^2
};

// The visible part of that ellipse in three slices across it, ready to be sampled.
STRUCT(light_lens) {
    vec4 along; // half vectors are tau along + sigma across + s3 axis; w = the dot product with v
    vec4 across;
    vec4 axis;
    vec3 metric;        // along^2, along.across, across^2 before the stretch
    light_form horizon; // positive above it
    real lift;          // 1 - tau^2 - sigma^2 - lift horizon: positive within the light
    real width;         // the slices stand at sigma = 0, +-width
    vec2 low;           // their ends in tau: outer, middle
    vec2 high;
    real scale;
};

static const real LIGHT_TINY = 1e-30f;

// Seven points of the unit disc: its centre and a hexagon, of which two stand on the diameter
// sigma = 0 and four on the chords sigma = +-slice, at +-pair of the half chord.  The weights are
// those of a slice's half length.  Section 5.
static const real LIGHT_RING = 0.83443363f;
static const real LIGHT_SLICE = 0.72264072f;        // ring sin 60
static const real LIGHT_PAIR = 0.60359148f;         // ring cos 60 / sqrt(1 - slice^2)
static const real LIGHT_RING_WEIGHT = 0.11968374f;  // 1 / (12 ring^2)
static const real LIGHT_SLICE_WEIGHT = 0.17314759f; // 1 / (12 ring^2 sqrt(1 - slice^2))

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
// The first guess lies within [.9, 1.2] of the root; a step of Halley's and one of Newton's leave
// 4e-6 of it at most.
static inline real light_root(real a, real b, real c)
{
    real top = (a + 2.0f * sqrt(max(a * a - 3.0f * b, 0.0f))) * (1.0f / 3.0f); // not below the root
    // k^2 (top - a) + b k - c has its positive root within [3/4, 1] of it.
    real w = top - a + LIGHT_TINY;
    real r = sqrt(max(b * b + 4.0f * c * w, 0.0f));
    bool is_up = b > 0.0f;
    real over = is_up ? 2.0f * c : r - b;
    real under = is_up ? b + r + LIGHT_TINY : 2.0f * w;
    real k = max(min(1.2f * over / under, top), max(a, LIGHT_TINY));
    real p = k * k * (k - a) + (b * k - c);
    real d = 3.0f * k * k + (b - 2.0f * a * k);
    k = k - p * d / max(d * d - p * (3.0f * k - a), LIGHT_TINY);
    p = k * k * (k - a) + (b * k - c);
    d = 3.0f * k * k + (b - 2.0f * a * k);
    return k - p / max(d, LIGHT_TINY);
}

// The basis of a cap's rim is c0 + c1 cos t + c2 sin t, t = 0 at its highest point: c2 is
// horizontal, and c1 = cross(c2, axis).
static inline vec3 light_rim_side(vec3 axis)
{
    real h = sqrt(axis[0] * axis[0] + axis[1] * axis[1]);
    real inverse = 1.0f / max(h, 1e-7f);
    return h > 1e-7f ? vec3(inverse * axis[1], -inverse * axis[0], 0.0f) : vec3(0.0f, -1.0f, 0.0f);
}

static inline vec3 light_rim_up(vec3 axis)
{
    return cross(light_rim_side(axis), axis);
}

// The cone of a cap under v (section 3).  `side` = its light_rim_side; `reach` = 1 + cos of the
// angle between the cap's rim and -v, as cos_s + axis.v; `unstretch` = 1 / (ax, ay, 1) times any
// factor, `volume` its product.
static inline light_cone light_cone_from_cap(light_cap cap, vec3 side, vec3 v, real reach,
                                             vec3 unstretch, real volume)
{
    vec3 wide = cap.sin_s * unstretch;
    vec3 c0 = unstretch * (v + cap.cos_s * cap.axis);
    vec3 c1 = wide * cross(side, cap.axis);
    vec3 c2 = wide * side;
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
    real inverse_k = 1.0f / k;
    real others = k * (2.0f * k - a) + c * inverse_k; // (k + k1) (k + k2)
    real scale = sqrt(inverse_k);

    // A column of the adjugate of G + k J, which is (k + k1) (k + k2) x x^T; `length` = its
    // Lorentz length.
    vec3 column = vec3(g01 * g12 - (g11 + k) * g02, g01 * g02 - (g00 + k) * g12,
                       k * (g00 + g11 + k) + minor);
    real length = sqrt(others) * sqrt(column[2]);
    real inverse_length = 1.0f / length;
    real fold = 1.0f / (length + column[2]);
    vec3 tilt = column[0] * c1 + column[1] * c2;
    vec3 shift = c0 + fold * tilt;
    light_cone cone;
    cone.square = k;
    cone.boost = vec3(inverse_length * column[0], inverse_length * column[1], length * fold);
    cone.n1 = scale * (c1 + cone.boost[0] * shift);
    cone.n2 = scale * (c2 + cone.boost[1] * shift);
    cone.axis = (scale * inverse_length) * (tilt + column[2] * c0);

    // Cholesky of 1 + N^T N, the determinant of which is (k + k1) (k + k2) / k^2.
    real r11_2 = 1.0f + dot(cone.n1, cone.n1);
    real r11_r12 = dot(cone.n1, cone.n2);
    real r11_r22 = sqrt(others) * inverse_k;
    real r11 = sqrt(r11_2);
    real inverse = 1.0f / (r11 * r11_r22);
    cone.triangle = vec3(r11_2, r11_r12, r11_r22);
    cone.inverse = inverse * vec3(r11_r22, r11_r12, r11_2);
    cone.area = det * scale * inverse_k * r11 * inverse;
    return cone;
}

// The point of the unit disc (z1, z2) across the axis, in multiples of n1 and n2.
static inline vec2 light_cone_disc(light_cone cone, real z1, real z2)
{
    return vec2(cone.inverse[0] * z1 - cone.inverse[1] * z2, cone.inverse[2] * z2);
}

// Towards the point of the unit disc's rim that belongs to the angle (cos_t, sin_t) on the light's.
static inline vec2 light_cone_rim(light_cone cone, real cos_t, real sin_t)
{
    vec3 x = cone.boost;
    real f = (x[0] * cos_t + x[1] * sin_t) * x[2] - 1.0f;
    real y1 = cos_t + x[0] * f;
    real y2 = sin_t + x[1] * f;
    real z1 = cone.triangle[0] * y1 + cone.triangle[1] * y2;
    real z2 = cone.triangle[2] * y2;
    return vec2(z1, z2);
}

// Where rim and horizon meet on the unit disc: at the angles +-gamma from the unit vector d.
// Returns d, cos(gamma), sin(gamma); gamma = pi for a light wholly up, d then points upwards.
static inline vec4 light_cone_meeting(light_cone cone, light_cap cap, vec3 side)
{
    real h = side[0] * cap.axis[1] - side[1] * cap.axis[0];
    real cos_t = clamp(-cap.axis[2] * cap.cos_s / max(cap.sin_s * h, LIGHT_TINY), -1.0f, 1.0f);
    real sin_t = sqrt(1.0f - cos_t * cos_t);
    vec2 p = light_cone_rim(cone, cos_t, sin_t);
    vec2 q = light_cone_rim(cone, cos_t, -sin_t);
    real length_p = sqrt(p[0] * p[0] + p[1] * p[1]);
    real length_q = sqrt(q[0] * q[0] + q[1] * q[1]);
    real inverse = 1.0f / max(length_p * length_q, LIGHT_TINY);
    vec2 gap = length_q * p - length_p * q;
    vec2 mid = length_q * p + length_p * q;
    real half_inverse = 0.5f * inverse;
    real sin_g = half_inverse * sqrt(gap[0] * gap[0] + gap[1] * gap[1]);
    real cos_g = half_inverse * sqrt(mid[0] * mid[0] + mid[1] * mid[1]);
    real turn = q[0] * p[1] - q[1] * p[0]; // sin(2 gamma); fails where the points fall together
    cos_g = (sin_g > 0.1f ? turn : cos_t) < 0.0f ? -cos_g : cos_g;
    p = (inverse * length_q) * p;
    return vec4(p[0] * cos_g + p[1] * sin_g, p[1] * cos_g - p[0] * sin_g, cos_g, sin_g);
}

// A half vector, and its dot product with v.
static inline vec4 light_half(light_ggx lobe, vec3 stretched)
{
    vec3 h = lobe.stretch * stretched;
    return vec4(h[0], h[1], h[2], dot(h, lobe.v));
}

// Of the half vectors.
static inline real light_half_dot(vec4 a, vec4 b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Positive above the horizon: 2 h.z (v.h) / v.z - h.h.
static inline light_form light_form_horizon(light_lens lens, real inverse_z)
{
    vec4 d = lens.along;
    vec4 s = lens.across;
    vec4 a = lens.axis;
    real dz = inverse_z * d[2];
    real sz = inverse_z * s[2];
    real az = inverse_z * a[2];
    light_form f;
    f.tt = 2.0f * dz * d[3] - light_half_dot(d, d);
    f.ss = 2.0f * sz * s[3] - light_half_dot(s, s);
    f.aa = 2.0f * az * a[3] - light_half_dot(a, a);
    f.ta = dz * a[3] + az * d[3] - light_half_dot(d, a);
    f.odd = (sz * a[3] + az * s[3] - light_half_dot(s, a)) * lens.metric[1];
    return f;
}

static inline light_line light_line_horizon(light_lens lens, real s2)
{
    light_form f = lens.horizon;
    real a = 1.0f - s2 * lens.metric[2];
    light_line line;
    line.tt = a * f.tt + s2 * f.ss * lens.metric[0];
    line.ta = a * f.ta - s2 * f.odd;
    line.aa = a * f.aa + s2 * f.ss;
    return line;
}

// 1 - tau^2 - sigma^2 - lift horizon.
static inline light_line light_line_rim(light_lens lens, light_line horizon, real s2)
{
    light_line line;
    line.tt = (1.0f - s2) * lens.metric[0] - (1.0f - s2 * lens.metric[2]) - lens.lift * horizon.tt;
    line.ta = -lens.lift * horizon.ta;
    line.aa = 1.0f - s2 - lens.lift * horizon.aa;
    return line;
}

// Where a line's form falls through zero as tau grows; +-1 where it does not.
static inline real light_line_fall(light_line line, real along2, real a)
{
    real square = line.ta * line.ta - line.tt * line.aa;
    real r = sqrt(max(square, 0.0f));
    bool is_far = line.ta > 0.0f;
    real x = is_far ? r + line.ta : line.aa; // tau / s3 = x / y
    real y = is_far ? -line.tt : r - line.ta;
    real t = x * sqrt(a / max(y * y + x * x * along2, LIGHT_TINY));
    real end = square < 0.0f && line.aa <= 0.0f ? -1.0f : 1.0f;
    bool falls = square >= 0.0f && y >= 0.0f;
    return falls ? t : end;
}

// The ends of the slices at +-s: below and above, either the horizon bounds them or the light's
// rim.
static inline vec2 light_lens_ends(light_lens lens, real s, bool on_ground, bool on_rim)
{
    real s2 = s * s;
    real along2 = lens.metric[0];
    real a = max(1.0f - s2 * lens.metric[2], 1e-6f);
    light_line ground = light_line_horizon(lens, s2);
    light_line rim = light_line_rim(lens, ground, s2);
    light_line below;
    below.tt = on_ground ? ground.tt : rim.tt;
    below.ta = on_ground ? -ground.ta : -rim.ta;
    below.aa = on_ground ? ground.aa : rim.aa;
    light_line above;
    above.tt = on_rim ? rim.tt : ground.tt;
    above.ta = on_rim ? rim.ta : ground.ta;
    above.aa = on_rim ? rim.aa : ground.aa;
    real end = sqrt(1.0f - s2);
    real low = clamp(-light_line_fall(below, along2, a), -end, end);
    real high = clamp(light_line_fall(above, along2, a), -end, end);
    return vec2(low, max(high, low));
}

// The half width of a circular arc through (cos_g, +-sin_g) that rises by `rise` between.
static inline real light_lens_half_width(real rise, real sin_g)
{
    real size = max(rise, -rise);
    return size > sin_g ? 0.5f * (size + sin_g * sin_g / max(size, 1e-6f)) : sin_g;
}

// The visible part of the light's ellipse between the horizon and the rim, which meet at
// (tau, sigma) = (cos_g, +-sin_g).  Beyond these points one of the two bounds it on both sides,
// and is taken for a circular arc to say how far.  Section 5.
static inline light_lens light_lens_slice(light_lens lens, real cos_g, real sin_g)
{
    vec2 middle = light_lens_ends(lens, 0.0f, true, true);
    real rise = middle[1] - cos_g;
    real sink = cos_g - middle[0];
    real rim = light_lens_half_width(rise, sin_g);
    real ground = light_lens_half_width(sink, sin_g);
    real width = min(max(rise > 0.0f ? rim : sin_g, sink > 0.0f ? ground : sin_g), 1.0f);
    real s = LIGHT_SLICE * width;
    vec2 outer = light_lens_ends(lens, s, s <= ground, s <= rim);
    lens.low = vec2(outer[0], middle[0]);
    lens.high = vec2(outer[1], middle[1]);
    lens.width = s;
    lens.scale *= width;
    return lens;
}

// v.z > 0; alpha in (0, 1].
static inline light_ggx light_ggx_from(vec3 v, real ax, real ay)
{
    light_ggx lobe;
    lobe.v = v;
    lobe.stretch = vec3(ax, ay, 1.0f);
    lobe.larger = max(ax, ay);
    lobe.unstretch = vec3(lobe.larger / ax, lobe.larger / ay, lobe.larger);
    lobe.volume = lobe.unstretch[0] * lobe.unstretch[1] * lobe.larger;
    vec3 sv = lobe.stretch * v;
    lobe.length_v = sqrt(dot(sv, sv));
    lobe.square = vec3(ax * ax, ay * ay - ax * ax, 1.0f - ax * ax);
    lobe.inverse_z = 1.0f / v[2];
    return lobe;
}

// What light_lens_node samples.
static inline light_lens light_lens_from_cap(light_cap cap, light_ggx lobe)
{
    // Nothing of the light is up: any light that is, for nothing.
    bool hidden = cap.axis[2] <= -cap.sin_s;
    vec3 axis = hidden ? vec3(0.0f, 0.0f, 1.0f) : cap.axis;
    vec3 v = lobe.v;
    real s2 = cap.sin_s * cap.sin_s;
    real depth = s2 / (1.0f + cap.cos_s); // 1 - cos_s
    vec3 sum = v + axis;
    real reach = 0.5f * dot(sum, sum) - depth; // cos_s + axis.v

    // Another cap with the same part above the horizon's circle, or more: its axis is raised so
    // far that the axis is up and -v well outside.  Section 4.
    real lift = max(max(-axis[2], depth - reach * lobe.inverse_z), 0.0f);
    real grow = lift * (2.0f * axis[2] + lift);
    real inverse = 1.0f / sqrt(1.0f + grow);
    real inverse_s2 = 1.0f / max(s2, LIGHT_TINY);
    real shrink = max(1.0f + grow * inverse_s2, 0.0f);
    vec3 side = light_rim_side(axis);
    light_cap raised;
    raised.axis = inverse * (axis + vec3(0.0f, 0.0f, lift));
    raised.cos_s = inverse * cap.cos_s;
    raised.sin_s = inverse * cap.sin_s * sqrt(shrink);
    real raised_reach = inverse * (reach + lift * v[2]);
    light_cone cone =
        light_cone_from_cap(raised, side, v, raised_reach, lobe.unstretch, lobe.volume);

    vec4 meeting = light_cone_meeting(cone, raised, side);
    vec2 d = light_cone_disc(cone, meeting[0], meeting[1]);
    vec2 s = light_cone_disc(cone, -meeting[1], meeting[0]);
    light_lens lens;
    lens.along = light_half(lobe, d[0] * cone.n1 + d[1] * cone.n2);
    lens.across = light_half(lobe, s[0] * cone.n1 + s[1] * cone.n2);
    lens.axis = light_half(lobe, cone.axis);
    lens.metric = vec3(1.0f - d[0] * d[0] - d[1] * d[1], -d[0] * s[0] - d[1] * s[1],
                       1.0f - s[0] * s[0] - s[1] * s[1]);
    lens.horizon = light_form_horizon(lens, lobe.inverse_z);
    // The raised cap's form is f (1 - tau^2 - sigma^2), the light's is that less the lift.
    real f = lobe.larger * lobe.larger * raised_reach * raised.sin_s * raised.sin_s;
    lens.lift = min(lift * v[2] * cone.square * inverse / max(f, LIGHT_TINY), 1e15f);
    real area = min(shrink * inverse * inverse * cone.area, inverse_s2); // at most the disc
    lens.scale = hidden ? 0.0f : 2.0f * INV_PI * area;
    return light_lens_slice(lens, meeting[2], meeting[3]);
}

// The lobe at a half vector, over its share of the ellipse: without and with Schlick's factor.
static inline vec2 light_lens_node(light_ggx lobe, vec4 half_v, real s3)
{
    real hh = light_half_dot(half_v, half_v);
    real vh = max(half_v[3], 0.0f);
    real vh2 = 2.0f * vh;
    real y = vh2 * half_v[1] - hh * lobe.v[1]; // of l, of length h.h
    real NoL = max(vh2 * half_v[2] - hh * lobe.v[2], 0.0f);
    vec3 square = lobe.square;
    real length_l =
        sqrt(max(square[0] * hh * hh + square[1] * y * y + square[2] * NoL * NoL, 0.0f));
    // G2 / G1 = (|Sv| + NoV) NoL / (|Sv| NoL + |Sl| NoV); Heitz 2014, eqs. 43, 99, 72 and 86.
    real below = s3 * (lobe.length_v * NoL + length_l * lobe.v[2]);
    real length_h = sqrt(hh);
    real r = vh / max(below * length_h, LIGHT_TINY);
    real x = r * NoL * length_h;
    return vec2(x, x * pow5(max(1.0f - r * below, 0.0f)));
}

// `flat_half` = the half vector less its part along the cone's axis; `axial2` = that part squared.
static inline vec2 light_lens_at(light_lens lens, light_ggx lobe, vec4 flat_half, real axial2)
{
    real s3 = sqrt(max(axial2, 1e-6f));
    return light_lens_node(lobe, flat_half + s3 * lens.axis, s3);
}

// The nodes at tau = t, sigma = +-width together.
static inline vec2 light_lens_outer(light_lens lens, light_ggx lobe, real t)
{
    vec3 metric = lens.metric;
    real s = lens.width;
    real even = 1.0f - s * s * metric[2] - t * t * metric[0];
    real odd = 2.0f * s * metric[1] * t;
    vec4 d = t * lens.along;
    vec4 e = s * lens.across;
    return light_lens_at(lens, lobe, d - e, even + odd) +
           light_lens_at(lens, lobe, d + e, even - odd);
}

// The node at tau = t, sigma = 0.
static inline vec2 light_lens_middle(light_lens lens, light_ggx lobe, real t)
{
    return light_lens_at(lens, lobe, t * lens.along, 1.0f - t * t * lens.metric[0]);
}

static inline vec2 light_lens_sum(light_lens lens, light_ggx lobe)
{
    vec2 middle = 0.5f * (lens.high + lens.low);
    vec2 extent = 0.5f * (lens.high - lens.low);
    real pair = LIGHT_PAIR * extent[0];
    real ring = LIGHT_RING * extent[1];
    vec2 outer = light_lens_outer(lens, lobe, middle[0] - pair) +
                 light_lens_outer(lens, lobe, middle[0] + pair);
    vec2 inner = light_lens_middle(lens, lobe, middle[1] - ring) +
                 light_lens_middle(lens, lobe, middle[1] + ring);
    vec2 centre = light_lens_middle(lens, lobe, middle[1]);
    return lens.scale *
           (LIGHT_SLICE_WEIGHT * extent[0] * outer + LIGHT_RING_WEIGHT * extent[1] * inner +
            (1.0f - 6.0f * LIGHT_RING_WEIGHT) * extent[1] * centre);
}

// The GGX lobe under the light: x without Fresnel, y with the factor (1 - v.h)^5 of Schlick's,
// so that E (f0 (x - y) + f90 y) is the radiance towards v.
static inline vec2 light_cap_lobe(light_cap cap, light_ggx lobe)
{
    vec2 sum = light_lens_sum(light_lens_from_cap(cap, lobe), lobe);
    // No light is reflected brighter than it is.
    real x = min(sum[0], INV_PI / max(cap.sin_s * cap.sin_s, LIGHT_TINY));
    return vec2(x, min(sum[1], x));
}

static inline vec2 light_cap_ggx(light_cap cap, vec3 v, real ax, real ay)
{
    return light_cap_lobe(cap, light_ggx_from(v, ax, ay));
}

#endif
