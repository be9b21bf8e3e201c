// Linearly transformed cosines: area lights as Heitz, Dupuy, Hill and Neubelt 2016 do them, to be
// compared with.
//
// The GGX lobe times the cosine is taken for a clamped cosine whose directions went through a
// matrix; the light, sent through its inverse, then has a form factor to be found.  Disks and caps
// become elliptic cones [Heitz & Hill 2017], of which the horizon leaves what it leaves of a sphere
// of the same form factor and direction; polygons are exact.  Isotropic.
//
// That horizon is the fitted cosine's, not the surface's, through which the method leaks: a light
// that sets would not go out.  Here it fades as the last quarter of its height goes down.
//
// The table (bake/ltc.h) is fetched by the caller at light_ltc_uv.  In it is the inverse matrix
// ((m0 0 m1) (0 1 0) (m2 0 m3)), m1 to m3 over alpha, from the frame whose z is the mirror
// direction, x in the plane of incidence.  (The paper's is the surface's frame; this one makes the
// entries smooth to alpha = 0, and a table of 32 x 32 do.)  dfg = the albedo of the lobe as
// bake/dfg.h has it, the norm of the cosine and Fresnel's part: the paper's second table.
//
// All lights in the surface's frame, z = normal; v = towards the eye, unit, v.z > 0.  The results
// (x, y) are as those of light_sphere.glsl: E (f0 (x - y) + f90 y) is the radiance towards v for a
// cap of irradiance E, L (f0 (x - y) + f90 y) for the other lights, L being their radiance.
#ifndef AG_PHYSICS_LIGHT_LTC_GLSL
#define AG_PHYSICS_LIGHT_LTC_GLSL

#include "physics/lang.glsl"
#include "physics/light_polygon.glsl"
#include "physics/light_sphere.glsl"

static const real LIGHT_LTC_SIZE = 32.0f; // px, both ways

// The rows of the matrix that takes directions to where the lobe is a clamped cosine.
STRUCT(light_ltc) {
    vec3 x;
    vec3 y;
    vec3 z;
    real det;
};

// Where to fetch: the first and the last texels' centres are the ends of the ranges.
static inline vec2 light_ltc_uv(real NoV, real roughness)
{
    real side = (LIGHT_LTC_SIZE - 1.0f) / LIGHT_LTC_SIZE;
    real first = 0.5f / LIGHT_LTC_SIZE;
    return vec2(sqrt(max(1.0f - NoV, 0.0f)) * side + first, roughness * side + first);
}

// What the functions below call m, from what was fetched.
static inline vec4 light_ltc_matrix(vec4 texel, real alpha)
{
    return vec4(texel[0], alpha * texel[1], alpha * texel[2], alpha * texel[3]);
}

static inline light_ltc light_ltc_frame(vec3 v, vec4 m)
{
    real side = sqrt(v[0] * v[0] + v[1] * v[1]);
    vec2 u = side > 1e-6f ? vec2(v[0] / side, v[1] / side) : vec2(1.0f, 0.0f);
    vec3 x = vec3(v[2] * u[0], v[2] * u[1], side);
    vec3 mirror = vec3(-v[0], -v[1], v[2]);
    light_ltc f;
    f.x = m[0] * x + m[1] * mirror;
    f.y = vec3(-u[1], u[0], 0.0f);
    f.z = m[2] * x + m[3] * mirror;
    f.det = m[0] * m[3] - m[1] * m[2];
    return f;
}

static inline vec3 light_ltc_apply(light_ltc f, vec3 p)
{
    return vec3(dot(f.x, p), dot(f.y, p), dot(f.z, p));
}

// The fading of a light between the heights `low` and `high`.
static inline real light_ltc_fade(real low, real high)
{
    return clamp(4.0f * high / max(high - low, LIGHT_TINY), 0.0f, 1.0f);
}

// The form factor of the elliptic cone with the rim c0 + s (c1 cos t + c2 sin t), over s^2;
// `det` = that of (c1, c2, c0).  The cone is diagonalised as in docs/sphere-light.md, section 3.
static inline real light_ltc_cone(vec3 c0, vec3 c1, vec3 c2, real s, real det)
{
    real s2 = s * s;
    real g00 = s2 * dot(c1, c1);
    real g11 = s2 * dot(c2, c2);
    real g01 = s2 * dot(c1, c2);
    real g02 = s * dot(c1, c0);
    real g12 = s * dot(c2, c0);
    vec3 x01 = s2 * cross(c1, c2);
    vec3 x02 = s * cross(c1, c0);
    vec3 x12 = s * cross(c2, c0);
    real minor = dot(x01, x01);
    real a = dot(c0, c0) - g00 - g11;
    real b = minor - dot(x02, x02) - dot(x12, x12);
    real c = s2 * det * s2 * det;
    real k = light_root(a, b, c);
    real area = det / sqrt(max(k * (k * k + k * max(k - a, 0.0f) + c / k), LIGHT_TINY));
    area = min(area, 1.0f / max(s2, LIGHT_TINY));

    vec3 axis = s * (g01 * g12 - (g11 + k) * g02) * c1 + s * (g01 * g02 - (g00 + k) * g12) * c2 +
                (k * (g00 + g11 + k) + minor) * c0;
    light_cap proxy;
    proxy.axis = axis / sqrt(max(dot(axis, axis), LIGHT_TINY));
    proxy.sin_s = s * sqrt(area);
    proxy.cos_s = sqrt(max(1.0f - s2 * area, 0.0f));
    return area * light_cap_cosine(proxy);
}

// A sphere or a sun.  Irradiance E as in light_sphere.glsl.
static inline vec2 light_ltc_cap(light_cap cap, vec3 v, vec4 m, vec2 dfg)
{
    light_ltc f = light_ltc_frame(v, m);
    vec3 up = light_rim_up(cap.axis);
    real cos_s = max(cap.cos_s, 1e-3f);
    real form = light_ltc_cone(cos_s * light_ltc_apply(f, cap.axis), light_ltc_apply(f, up),
                               light_ltc_apply(f, cross(cap.axis, up)), cap.sin_s, cos_s * f.det);
    form *= light_ltc_fade(cap.axis[2] - cap.sin_s, cap.axis[2] + cap.sin_s);
    return INV_PI * form * vec2(dfg[0] + dfg[1], dfg[1]);
}

// A disk or ellipse that emits to the side of half_x x half_y, its half axes.
static inline vec2 light_ltc_disk(vec3 centre, vec3 half_x, vec3 half_y, vec3 v, vec4 m, vec2 dfg)
{
    light_ltc f = light_ltc_frame(v, m);
    real facing = -dot(cross(half_x, half_y), centre);
    // Scaled, that the numbers stay near 1.
    real size2 = dot(centre, centre) + dot(half_x, half_x) + dot(half_y, half_y);
    real g = 1.0f / sqrt(max(size2, LIGHT_TINY));
    real form = light_ltc_cone(g * light_ltc_apply(f, centre), g * light_ltc_apply(f, half_x),
                               g * light_ltc_apply(f, half_y), 1.0f,
                               max(facing, 0.0f) * g * g * g * f.det);
    real half_height = sqrt(half_x[2] * half_x[2] + half_y[2] * half_y[2]);
    form *= light_ltc_fade(centre[2] - half_height, centre[2] + half_height);
    return form * vec2(dfg[0] + dfg[1], dfg[1]);
}

// A convex quadrilateral that emits to the side of (p1 - p0) x (p3 - p0).
static inline vec2 light_ltc_quad(vec3 p0, vec3 p1, vec3 p2, vec3 p3, vec3 v, vec4 m, vec2 dfg)
{
    light_ltc f = light_ltc_frame(v, m);
    real form = light_quad_form_factor(light_ltc_apply(f, p0), light_ltc_apply(f, p1),
                                       light_ltc_apply(f, p2), light_ltc_apply(f, p3));
    form *= light_ltc_fade(min(min(p0[2], p1[2]), min(p2[2], p3[2])),
                            max(max(p0[2], p1[2]), max(p2[2], p3[2])));
    return form * vec2(dfg[0] + dfg[1], dfg[1]);
}

// A capsule, taken for the rectangle through its axis that faces the point, as long as gives the
// ends' half discs their area.
static inline vec2 light_ltc_tube(vec3 centre, vec3 half_axis, real radius, vec3 v, vec4 m,
                                  vec2 dfg)
{
    vec3 c = centre / sqrt(max(dot(centre, centre), LIGHT_TINY));
    vec3 across = half_axis - dot(half_axis, c) * c;
    vec3 other = max(c[0], -c[0]) < 0.7f ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f, 1.0f, 0.0f);
    real length2 = dot(across, across);
    across = length2 > 1e-12f * dot(half_axis, half_axis) ? across : other - dot(other, c) * c;
    across = across / sqrt(max(dot(across, across), LIGHT_TINY));
    vec3 a = half_axis + (0.25f * PI * radius) * across;
    vec3 b = radius * cross(c, across);
    return light_ltc_quad(centre - a - b, centre - a + b, centre + a + b, centre + a - b, v, m,
                          dfg);
}

#endif
