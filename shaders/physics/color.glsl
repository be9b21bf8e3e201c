// Colours: linear Rec. 709 and its sRGB coding.
#ifndef AG_PHYSICS_COLOR_GLSL
#define AG_PHYSICS_COLOR_GLSL

#include "physics/lang.glsl"

// Relative luminance.  ITU-R BT.709-6, item 3.2.
static inline real color_luminance(vec3 c)
{
    return dot(c, vec3(0.2126f, 0.7152f, 0.0722f));
}

// IEC 61966-2-1: both branches, exactly.
static inline real color_srgb_encode_channel(real x)
{
    return x <= 0.0031308f ? 12.92f * x : 1.055f * pow(x, 1.0f / 2.4f) - 0.055f;
}

static inline real color_srgb_decode_channel(real x)
{
    return x <= 0.04045f ? x / 12.92f : pow((x + 0.055f) / 1.055f, 2.4f);
}

static inline vec3 color_srgb_encode(vec3 c)
{
    return vec3(color_srgb_encode_channel(c[0]), color_srgb_encode_channel(c[1]),
                color_srgb_encode_channel(c[2]));
}

static inline vec3 color_srgb_decode(vec3 c)
{
    return vec3(color_srgb_decode_channel(c[0]), color_srgb_decode_channel(c[1]),
                color_srgb_decode_channel(c[2]));
}

#endif
