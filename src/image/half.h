// IEEE 754-2008 binary16 ("half") to and from float.
#ifndef AG_IMAGE_HALF_H
#define AG_IMAGE_HALF_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

// Rounds to nearest, ties to even; above 65519.99 infinity; NaN stays NaN, quiet.
static inline uint16_t half_from_float(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    uint16_t sign = (uint16_t)(bits >> 16 & 0x8000);
    bits &= 0x7fffffff;
    if (bits > 0x7f800000)
        return (uint16_t)(sign | 0x7e00 | (bits >> 13 & 0x3ff));
    if (bits >= 0x477ff000) // 65520
        return sign | 0x7c00;
    if (bits < 0x38800000) { // below 2^-14: the sum's last bit is 2^-24, the adder rounds
        float sum;
        memcpy(&sum, &bits, sizeof sum);
        sum += 0.5f;
        memcpy(&bits, &sum, sizeof bits);
        return (uint16_t)(sign | (bits - 0x3f000000));
    }
    bits += 0xfff + (bits >> 13 & 1);
    return (uint16_t)(sign | (bits - 0x38000000) >> 13);
}

// The same, but finite: clipped to +-65504, NaN -> 0.
static inline uint16_t half_from_float_clamped(float value)
{
    if (!(value == value))
        return 0;
    return half_from_float(value > 65504 ? 65504 : value < -65504 ? -65504 : value);
}

// Exact; a signalling NaN becomes quiet.
static inline float half_to_float(uint16_t half)
{
    uint32_t sign = (uint32_t)(half & 0x8000) << 16, rest = half & 0x7fff, bits;
    if (rest >= 0x7c00)
        bits = 0x7f800000 | rest << 13 | (rest > 0x7c00 ? 0x400000 : 0);
    else if (rest >= 0x400)
        bits = (rest << 13) + 0x38000000;
    else { // a multiple of 2^-24
        float small = (float)rest * 0x1p-24f;
        memcpy(&bits, &small, sizeof bits);
    }
    bits |= sign;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

// `count` values; `in` and `out` do not overlap.  With the processor's own conversion
// where it has one; the results are the same.
void half_from_floats(const float *in, uint16_t *out, size_t count);
void half_from_floats_clamped(const float *in, uint16_t *out, size_t count);
void half_to_floats(const uint16_t *in, float *out, size_t count);

#endif
