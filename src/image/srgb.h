// The sRGB transfer curve (IEC 61966-2-1:1999), exact to the last of 8 bits.
//
// No state is kept: both directions are tables that the caller owns; filling one takes
// some microseconds.
#ifndef AG_IMAGE_SRGB_H
#define AG_IMAGE_SRGB_H

#include <stdint.h>
#include <string.h>

// The curve itself: coded in [0, 1] -> linear in [0, 1], and back.
double srgb_to_linear(double coded);
double srgb_from_linear(double linear);

// table[code] = linear value of code / 255.
void srgb_decoder_init(float table[256]);

// Between 2^-13, below which everything is coded as 0, and 1 the codes rise by less than
// one over 1/128 of an octave: the guess for such a bucket is off by at most one.
enum { SRGB_BUCKETS = 13 * 128 };

typedef struct srgb_encoder {
    float threshold[257]; // the least float that is coded as i or higher; [256]: infinity
    uint8_t guess[SRGB_BUCKETS];
} srgb_encoder;

void srgb_encoder_init(srgb_encoder *encoder);

// round(255 * srgb_from_linear(v)), v clipped to [0, 1]; NaN -> 0.
static inline uint8_t srgb_encode(const srgb_encoder *encoder, float v)
{
    if (!(v > 0x1p-13f))
        return 0;
    if (v >= 1.0f)
        return 255;
    uint32_t bits, least = (127 - 13) << 7;
    memcpy(&bits, &v, sizeof bits);
    unsigned guess = encoder->guess[(bits >> 16) - least];
    return (uint8_t)(guess + (v >= encoder->threshold[guess + 1]));
}

#endif
