// The directions that stand for a light of extent where a formula takes but one.
//
// All in the surface's frame, z = normal; the results are unit and up, but for the mean.
#ifndef AG_PHYSICS_LIGHT_DIRECTION_GLSL
#define AG_PHYSICS_LIGHT_DIRECTION_GLSL

#include "physics/surface_light.glsl"

static inline vec3 light_direction_up(vec3 d)
{
    real length2 = max(dot(d, d), 1e-30f);
    vec3 unit = d / sqrt(length2);
    return normalize(vec3(unit[0], unit[1], max(unit[2], 1e-3f)));
}

// light_cap_mean of a cap as large as the light seems: around `centre`, of that area, a vector
// along its normal.
static inline vec3 light_direction_mean(vec3 centre, vec3 area)
{
    real d2 = max(dot(centre, centre), 1e-30f);
    light_cap cap;
    cap.axis = centre / sqrt(d2);
    real facing = dot(area, cap.axis);
    real s2 = min(max(facing, -facing) * INV_PI / d2, 1.0f);
    cap.sin_s = sqrt(s2);
    cap.cos_s = sqrt(1.0f - s2);
    return light_cap_mean(cap);
}

// The area of a tube for it: seen from here, towards here.
static inline vec3 light_direction_tube_area(vec3 centre, vec3 half_axis, real radius)
{
    vec3 side = cross(half_axis, centre);
    real d2 = max(dot(centre, centre), 1e-30f);
    real area = 4.0f * radius * sqrt(dot(side, side) / d2) + PI * radius * radius;
    return -area / sqrt(d2) * centre;
}

// Of a flat light with these half axes, towards the point nearest to where the mirror ray of v
// meets its plane; `round` = a disk.
static inline vec3 light_direction_flat(vec3 centre, vec3 half_x, vec3 half_y, vec3 v, bool round)
{
    vec3 r = vec3(-v[0], -v[1], v[2]);
    vec3 n = cross(half_x, half_y);
    real along = dot(r, n);
    real t = dot(centre, n) / (along < 0.0f ? min(along, -1e-30f) : max(along, 1e-30f));
    vec3 off = (t > 0.0f ? t : 0.0f) * r - centre;
    real x = dot(off, half_x) / max(dot(half_x, half_x), 1e-30f);
    real y = dot(off, half_y) / max(dot(half_y, half_y), 1e-30f);
    real out_by = sqrt(x * x + y * y);
    real shrink = round && out_by > 1.0f ? 1.0f / out_by : 1.0f;
    x = clamp(x * shrink, -1.0f, 1.0f);
    y = clamp(y * shrink, -1.0f, 1.0f);
    return light_direction_up(centre + x * half_x + y * half_y);
}

// Of a tube: from the point of its axis nearest to the mirror ray towards that ray.
static inline vec3 light_direction_tube(vec3 centre, vec3 half_axis, real radius, vec3 v)
{
    vec3 r = vec3(-v[0], -v[1], v[2]);
    vec3 c = centre - dot(centre, r) * r;
    vec3 a = half_axis - dot(half_axis, r) * r;
    real t = clamp(-dot(c, a) / max(dot(a, a), 1e-30f), -1.0f, 1.0f);
    vec3 p = centre + t * half_axis;
    vec3 to_ray = max(dot(p, r), 0.0f) * r - p;
    real pull = min(radius / sqrt(max(dot(to_ray, to_ray), 1e-30f)), 1.0f);
    return light_direction_up(p + pull * to_ray);
}

#endif
