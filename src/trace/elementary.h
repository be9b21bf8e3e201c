// Elementary functions without branches or calls, for loops that compilers make wide.
#ifndef AG_TRACE_ELEMENTARY_H
#define AG_TRACE_ELEMENTARY_H

#include <math.h>
#include <stdint.h>
#include <string.h>

// The logarithm of a positive, normal number, to 2e-7 or 2e-7 of it: log((1 + s) / (1 - s)) =
// 2 (s + s^3 / 3 + s^5 / 5 + ...), of the part of x in [sqrt(.5), sqrt(2)].
static inline float elementary_log(float x)
{
    int32_t bits;
    memcpy(&bits, &x, sizeof bits);
    int32_t exponent = (bits - 0x3f3504f3) >> 23;
    bits -= (int32_t)((uint32_t)exponent << 23);
    float m;
    memcpy(&m, &bits, sizeof m);
    float s = (m - 1) / (m + 1), q = s * s;
    float p = ((2.0f / 9 * q + 2.0f / 7) * q + 2.0f / 5) * q + 2.0f / 3;
    return (float)exponent * 0.693147181f + (p * q + 2) * s;
}

// The sine of so many quarters of a turn, of [-1/2, 1/2], and its cosine: Taylor's.
static inline float elementary_quarter_sin(float f)
{
    float a = f * 1.57079633f, q = a * a;
    return ((((q * (1.0f / 72) - 1) * q * (1.0f / 42) + 1) * q * (1.0f / 20) - 1) * q * (1.0f / 6) +
            1) *
           a;
}

static inline float elementary_quarter_cos(float f)
{
    float a = f * 1.57079633f, q = a * a;
    return (((q * (1.0f / 56) - 1) * q * (1.0f / 30) + 1) * q * (1.0f / 12) - 1) * q * 0.5f + 1;
}

// The cosine of `turns`, in [0, 1], to 2e-7.
static inline float elementary_cos(float turns)
{
    float x = 4 * turns;
    int32_t quarter = (int32_t)(x + 0.5f);
    float f = x - (float)quarter;
    float even = elementary_quarter_cos(f), odd = elementary_quarter_sin(f);
    float v = quarter & 1 ? odd : even;
    return (quarter + 1) & 2 ? -v : v;
}

static inline float elementary_sin(float turns)
{
    float x = 4 * turns;
    int32_t quarter = (int32_t)(x + 0.5f);
    float f = x - (float)quarter;
    float even = elementary_quarter_sin(f), odd = elementary_quarter_cos(f);
    float v = quarter & 1 ? odd : even;
    return quarter & 2 ? -v : v;
}

// The angle of (x, y) to 5e-7 rad, as wide_atan2 (bake/wide.h).
static inline float elementary_angle(float y, float x)
{
    float ax = fabsf(x), ay = fabsf(y);
    float high = ax > ay ? ax : ay, low = ax > ay ? ay : ax;
    float q = low / (high > 1e-37f ? high : 1e-37f), s = q * q;
    float p = 0.007648354f * s - 0.036360431f;
    p = p * s + 0.083126453f;
    p = p * s - 0.134478641f;
    p = p * s + 0.198720403f;
    p = p * s - 0.333256780f;
    p = (p * s + 0.999999226f) * q;
    p = ay > ax ? 1.57079633f - p : p;
    p = x < 0 ? 3.14159265f - p : p;
    return copysignf(p, y);
}

#endif
