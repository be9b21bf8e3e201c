// Ambient light without an image: what comes from all around, as a polynomial in the normal.
//
// All values are irradiance over pi: times the albedo, the radiance that a Lambert surface
// sends back.  A constant is c0 alone, four terms are harmonics of order 1, nine of order 2;
// lights are summed by their coefficients.
#ifndef AG_PHYSICS_AMBIENT_GLSL
#define AG_PHYSICS_AMBIENT_GLSL

#include "physics/lang.glsl"

// The coefficients of 1, x, y, z, xy, yz, 3z^2 - 1, xz, x^2 - y^2 of the unit normal.
STRUCT(ambient_light) {
    vec3 c0;
    vec3 cx;
    vec3 cy;
    vec3 cz;
    vec3 cxy;
    vec3 cyz;
    vec3 czz;
    vec3 cxz;
    vec3 cxxyy;
};

// Light is not negative, though the polynomial may be.
static inline vec3 ambient_at(ambient_light a, vec3 n)
{
    vec3 e = a.c0 + n[0] * a.cx + n[1] * a.cy + n[2] * a.cz;
    e += (n[0] * n[1]) * a.cxy + (n[1] * n[2]) * a.cyz + (n[0] * n[2]) * a.cxz;
    e += (3.0f * n[2] * n[2] - 1.0f) * a.czz + (n[0] * n[0] - n[1] * n[1]) * a.cxxyy;
    return max(e, 0.0f);
}

// A sky of radiance `up` in the hemisphere of the unit vector `axis` and of `down` in the
// other.  Exact: a hemisphere's form factor is (1 + n.axis) / 2.
static inline vec3 ambient_hemispheric(vec3 up, vec3 down, vec3 axis, vec3 n)
{
    return mix(down, up, 0.5f + 0.5f * dot(n, axis));
}

// The same as coefficients.
static inline ambient_light ambient_from_hemispheric(vec3 up, vec3 down, vec3 axis)
{
    vec3 none = vec3(0.0f, 0.0f, 0.0f);
    vec3 rise = 0.5f * (up - down);
    ambient_light a;
    a.c0 = 0.5f * (up + down);
    a.cx = axis[0] * rise;
    a.cy = axis[1] * rise;
    a.cz = axis[2] * rise;
    a.cxy = none;
    a.cyz = none;
    a.czz = none;
    a.cxz = none;
    a.cxxyy = none;
    return a;
}

#endif
