// White balance: linear Rec. 709 light as it would be, were the light that falls on things not
// of some colour temperature but D65.
#ifndef AG_PHYSICS_WHITE_BALANCE_GLSL
#define AG_PHYSICS_WHITE_BALANCE_GLSL

#include "physics/lang.glsl"

// A linear map of colours: what a unit of each channel becomes.
STRUCT(rgb_matrix)
{
    vec3 red, green, blue;
};

// CIE 1931 x and y of a black body, 1667 to 25000 K: Kang et al. 2002, "Design of Advanced
// Color Temperature Control System for HDTV Applications".
static inline vec2 white_planckian(real kelvin)
{
    real t = 1000.0f / kelvin;
    if (kelvin > 4000.0f) {
        real x = ((-3.0258469f * t + 2.1070379f) * t + 0.2226347f) * t + 0.240390f;
        return vec2(x, ((3.0817580f * x - 5.87338670f) * x + 3.75112997f) * x - 0.37001483f);
    }
    real x = ((-0.2661239f * t - 0.2343589f) * t + 0.8776956f) * t + 0.179910f;
    if (kelvin > 2222.0f)
        return vec2(x, ((-0.9549476f * x - 1.37418593f) * x + 2.09137015f) * x - 0.16748867f);
    return vec2(x, ((-1.1063814f * x - 1.34811020f) * x + 2.18555832f) * x - 0.20219683f);
}

// The same of daylight, 4000 to 25000 K: CIE 15:2004, equations 3.2 to 3.4.
static inline vec2 white_daylight(real kelvin)
{
    real t = 1000.0f / kelvin;
    real x = kelvin > 7000.0f
                 ? ((-2.0064f * t + 1.9018f) * t + 0.24748f) * t + 0.237040f
                 : ((-4.6070f * t + 2.9678f) * t + 0.09911f) * t + 0.244063f;
    return vec2(x, (-3.000f * x + 2.870f) * x - 0.275f);
}

// CIE 1960 u and v of x and y.
static inline vec2 white_uv(vec2 xy)
{
    real d = -2.0f * xy[0] + 12.0f * xy[1] + 3.0f;
    return vec2(4.0f * xy[0] / d, 6.0f * xy[1] / d);
}

// CIE 1931 XYZ at Y = 1: of a lamp up to 4000 K, of daylight from 5000 K on, between them of
// both.  `tint`: how far it is greener than that, square to the black body's way, in 3000ths of
// u and v.
static inline vec3 white_xyz(real kelvin, real tint)
{
    real day = clamp(kelvin / 1000.0f - 4.0f, 0.0f, 1.0f);
    vec2 lamp = white_planckian(kelvin), sky = white_daylight(max(kelvin, 4000.0f));
    vec2 at = white_uv(vec2(mix(lamp[0], sky[0], day), mix(lamp[1], sky[1], day)));
    vec2 a = white_uv(white_planckian(kelvin * 0.99f));
    vec2 b = white_uv(white_planckian(kelvin * 1.01f));
    real du = b[0] - a[0], dv = b[1] - a[1], off = tint / 3000.0f / sqrt(du * du + dv * dv);
    real u = at[0] + off * dv, v = at[1] - off * du;
    // x / y = 3 u / (2 v), (1 - x - y) / y = (4 - u - 10 v) / (2 v)
    return vec3(1.5f * u / v, 1.0f, (2.0f - 0.5f * u) / v - 5.0f);
}

// CAT16's cone responses: Li et al. 2017, "Comprehensive Color Solutions: CAM16, CAT16, and
// CAM16-UCS".
static inline vec3 white_cones(vec3 xyz)
{
    return vec3(dot(vec3(0.401288f, 0.650173f, -0.051461f), xyz),
                dot(vec3(-0.250268f, 1.204414f, 0.045854f), xyz),
                dot(vec3(-0.002079f, 0.048952f, 0.953127f), xyz));
}

// All adaptation, of each cone alone [von Kries 1902]: kelvin 1667 to 25000, tint -150 to 150.
static inline rgb_matrix white_balance(real kelvin, real tint)
{
    // Rec. 709's primaries and white in XYZ: ITU-R BT.709-6, item 1.3 and 1.4.
    vec3 r = white_cones(vec3(0.4123908f, 0.2126390f, 0.0193308f)),
         g = white_cones(vec3(0.3575843f, 0.7151687f, 0.1191948f)),
         b = white_cones(vec3(0.1804808f, 0.0721923f, 0.9505322f));
    // A green lamp of few kelvin would be light of no spectrum.
    vec3 gain = (r + g + b) / max(white_cones(white_xyz(kelvin, tint)), 0.1f);
    // Back from cones: the rows of an inverse are cross products of the columns.
    vec3 to_r = cross(g, b), to_g = cross(b, r), to_b = cross(r, g);
    real scale = 1.0f / dot(r, to_r);
    r = r * gain;
    g = g * gain;
    b = b * gain;
    rgb_matrix w;
    w.red = vec3(dot(to_r, r), dot(to_g, r), dot(to_b, r)) * scale;
    w.green = vec3(dot(to_r, g), dot(to_g, g), dot(to_b, g)) * scale;
    w.blue = vec3(dot(to_r, b), dot(to_g, b), dot(to_b, b)) * scale;
    return w;
}

static inline rgb_matrix white_kept(void)
{
    rgb_matrix w;
    w.red = vec3(1.0f, 0.0f, 0.0f);
    w.green = vec3(0.0f, 1.0f, 0.0f);
    w.blue = vec3(0.0f, 0.0f, 1.0f);
    return w;
}

// Finite for every colour up to infinity: no sum of it is one of opposite infinities.
static inline vec3 white_balanced(vec3 c, vec3 red, vec3 green, vec3 blue)
{
    c = min(c, 1e30f);
    return c[0] * red + c[1] * green + c[2] * blue;
}

#endif
