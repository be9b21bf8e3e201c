// Three floats as a value.
#ifndef AG_SCENE_VECTOR_H
#define AG_SCENE_VECTOR_H

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

typedef struct vec3 {
    float x, y, z;
} vec3;

static inline vec3 vec3_from(const float v[3])
{
    return (vec3) { v[0], v[1], v[2] };
}

static inline void vec3_store(vec3 v, float out[3])
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

static inline vec3 vec3_add(vec3 a, vec3 b)
{
    return (vec3) { a.x + b.x, a.y + b.y, a.z + b.z };
}

static inline vec3 vec3_sub(vec3 a, vec3 b)
{
    return (vec3) { a.x - b.x, a.y - b.y, a.z - b.z };
}

static inline vec3 vec3_scale(vec3 a, float s)
{
    return (vec3) { a.x * s, a.y * s, a.z * s };
}

static inline float vec3_dot(vec3 a, vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline vec3 vec3_cross(vec3 a, vec3 b)
{
    return (vec3) { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

// The unit vector along `v`, also of tiny and of huge ones; zero when v is zero or not finite.
// One that is unit to a float's precision stays as it is.
static inline vec3 vec3_unit(vec3 v)
{
    double x = (double)v.x, y = (double)v.y, z = (double)v.z;
    double square = x * x + y * y + z * z;
    if (!(square > 0.0) || !isfinite(square))
        return (vec3) { 0.0f, 0.0f, 0.0f };
    if (fabs(square - 1.0) <= (double)FLT_EPSILON)
        return v;
    double s = 1.0 / sqrt(square);
    return (vec3) { (float)(x * s), (float)(y * s), (float)(z * s) };
}

static inline bool vec3_is_zero(vec3 v)
{
    return v.x == 0.0f && v.y == 0.0f && v.z == 0.0f;
}

// Some unit vector perpendicular to the unit vector `n`: Duff et al. 2017, "Building an
// Orthonormal Basis, Revisited", listing 3.
static inline vec3 vec3_perpendicular(vec3 n)
{
    float sign = copysignf(1.0f, n.z);
    float a = -1.0f / (sign + n.z);
    return (vec3) { 1.0f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x };
}

static inline bool all_finite(const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!isfinite(values[i]))
            return false;
    return true;
}

#endif
