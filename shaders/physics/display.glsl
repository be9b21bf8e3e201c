// The last step: from exposed light to what a target that codes sRGB is handed.
#ifndef AG_PHYSICS_DISPLAY_GLSL
#define AG_PHYSICS_DISPLAY_GLSL

#include "physics/color.glsl"
#include "physics/tonemap.glsl"

// `tone`: a TONEMAP_ constant, and how its light is coded.
#define DISPLAY_TONEMAP  0xffu
#define DISPLAY_GAMMA_22 0x100u // else by sRGB

// Light whose sRGB code is c^(1/2.2).
static inline real display_gamma_22_channel(real c)
{
    return color_srgb_decode_channel(pow(c, 1.0f / 2.2f));
}

static inline vec3 display(uint tone, vec3 c)
{
    c = tonemap(tone & DISPLAY_TONEMAP, c);
    if ((tone & DISPLAY_GAMMA_22) != 0u)
        c = vec3(display_gamma_22_channel(c[0]), display_gamma_22_channel(c[1]),
                 display_gamma_22_channel(c[2]));
    return c;
}

#endif
