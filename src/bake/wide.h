// Eight floats at a time, for the loops over texels.
//
// The vector extensions of gcc and clang: SSE2 on any x86-64, and AVX2 with FMA where
// the processor has it, chosen at run time by WIDE_DISPATCH.
#ifndef AG_BAKE_WIDE_H
#define AG_BAKE_WIDE_H

#include <math.h>
#include <stdint.h>
#include <string.h>

typedef float f32x4 __attribute__((vector_size(16), aligned(4), may_alias));
typedef int32_t i32x4 __attribute__((vector_size(16)));
typedef float f32x8 __attribute__((vector_size(32)));
typedef int32_t i32x8 __attribute__((vector_size(32)));

// Inlined always, and not only for speed: a function with AVX and one without pass eight
// floats in different places.
#define WIDE_INLINE static inline __attribute__((always_inline))

// WIDE_DISPATCH(name, (parameters), (arguments)) makes `name` out of the WIDE_INLINE
// function `name_body`.
#if defined(__x86_64__)
#define WIDE_DISPATCH(name, parameters, arguments)                                                 \
    __attribute__((target("avx2,fma"))) static void name##_avx2 parameters                         \
    {                                                                                              \
        name##_body arguments;                                                                     \
    }                                                                                              \
    static void name##_any parameters                                                              \
    {                                                                                              \
        name##_body arguments;                                                                     \
    }                                                                                              \
    static void name parameters                                                                    \
    {                                                                                              \
        if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))                       \
            name##_avx2 arguments;                                                                 \
        else                                                                                       \
            name##_any arguments;                                                                  \
    }
#else
#define WIDE_DISPATCH(name, parameters, arguments)                                                 \
    static void name parameters                                                                    \
    {                                                                                              \
        name##_body arguments;                                                                     \
    }
#endif

WIDE_INLINE f32x8 wide_select(i32x8 mask, f32x8 yes, f32x8 no)
{
    return (f32x8)((mask & (i32x8)yes) | (~mask & (i32x8)no));
}

WIDE_INLINE f32x8 wide_max(f32x8 a, f32x8 b)
{
    return wide_select(a > b, a, b);
}

WIDE_INLINE f32x8 wide_min(f32x8 a, f32x8 b)
{
    return wide_select(a < b, a, b);
}

WIDE_INLINE f32x8 wide_abs(f32x8 a)
{
    return (f32x8)((i32x8)a & 0x7fffffff);
}

// `magnitude`, not negative, with the sign of `sign`.
WIDE_INLINE f32x8 wide_copysign(f32x8 magnitude, f32x8 sign)
{
    return (f32x8)((i32x8)magnitude | ((i32x8)sign & INT32_MIN));
}

WIDE_INLINE f32x8 wide_sqrt(f32x8 a)
{
    float lane[8];
    memcpy(lane, &a, sizeof lane);
    for (int i = 0; i < 8; i++)
        lane[i] = sqrtf(lane[i]);
    memcpy(&a, lane, sizeof lane);
    return a;
}

// The angle of (x, y), to 5e-7 rad: atan on [0, 1] by the odd polynomial of degree 13
// that meets it in the Chebyshev nodes of q^2, and the octants from there.
WIDE_INLINE f32x8 wide_atan2(f32x8 y, f32x8 x)
{
    f32x8 ax = wide_abs(x), ay = wide_abs(y);
    f32x8 q = wide_min(ax, ay) / wide_max(wide_max(ax, ay), (f32x8) { 0 } + 1e-30f);
    f32x8 s = q * q;
    f32x8 r = 0.007648354f * s - 0.036360431f;
    r = r * s + 0.083126453f;
    r = r * s - 0.134478641f;
    r = r * s + 0.198720403f;
    r = r * s - 0.333256780f;
    r = (r * s + 0.999999226f) * q;
    r = wide_select(ay > ax, 1.57079633f - r, r);
    r = wide_select(x < 0.0f, 3.14159265f - r, r);
    return wide_copysign(r, y);
}

#endif
