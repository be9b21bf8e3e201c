// The sRGB transfer curve, IEC 61966-2-1:1999.
#include "image/srgb.h"

#include <math.h>

double srgb_to_linear(double coded)
{
    return coded <= 0.04045 ? coded / 12.92 : pow((coded + 0.055) / 1.055, 2.4);
}

double srgb_from_linear(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

void srgb_decoder_init(float table[256])
{
    for (int i = 0; i < 256; i++)
        table[i] = (float)srgb_to_linear(i / 255.0);
}

static float least_float_not_below(double value)
{
    float f = (float)value;
    return (double)f < value ? nextafterf(f, INFINITY) : f;
}

void srgb_encoder_init(srgb_encoder *encoder)
{
    encoder->threshold[0] = 0;
    for (int i = 1; i < 256; i++)
        encoder->threshold[i] = least_float_not_below(srgb_to_linear((i - 0.5) / 255));
    encoder->threshold[256] = INFINITY;
    unsigned code = 0;
    for (int i = 0; i < SRGB_BUCKETS; i++) {
        float start = ldexpf(1 + (float)(i & 127) / 128, i / 128 - 13);
        while (start >= encoder->threshold[code + 1])
            code++;
        encoder->guess[i] = (uint8_t)code;
    }
}
