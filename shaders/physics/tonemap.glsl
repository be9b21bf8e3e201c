// Tone curves: from exposed linear Rec. 709 to display-linear Rec. 709 in [0, 1].
// The sRGB coding comes after; values are clipped there where a curve leaves the range.
#ifndef AG_PHYSICS_TONEMAP_GLSL
#define AG_PHYSICS_TONEMAP_GLSL

#include "physics/lang.glsl"

// As ag_tonemap of argand/renderer.h.
static const uint TONEMAP_NEUTRAL = 0u;
static const uint TONEMAP_NONE = 1u;
static const uint TONEMAP_REINHARD = 2u;
static const uint TONEMAP_ACES = 3u;
static const uint TONEMAP_ACES_NARKOWICZ = 4u;
static const uint TONEMAP_AGX = 5u;

// Khronos PBR Neutral 2024: the base colour comes out as it went in up to .8 less the
// 4 % of the dielectric's Fresnel; highlights are compressed and lose their colour.
static inline vec3 tonemap_neutral(vec3 c)
{
    real start = 0.8f - 0.04f;
    real x = min(min(c[0], c[1]), c[2]);
    c = c - (x < 0.08f ? x - 6.25f * x * x : 0.04f);
    real peak = max(max(c[0], c[1]), c[2]);
    if (peak < start)
        return c;
    real d = 1.0f - start;
    real new_peak = 1.0f - d * d / (peak + d - start);
    real g = 1.0f - 1.0f / (0.15f * (peak - new_peak) + 1.0f);
    return mix(c * (new_peak / peak), vec3(new_peak, new_peak, new_peak), g);
}

// Reinhard et al. 2002, eq. 3, on each channel.
static inline vec3 tonemap_reinhard(vec3 c)
{
    return c / (c + 1.0f);
}

// Hill 2016: a fit of ACES' reference rendering and output transforms in his own space,
// between matrices from and to Rec. 709.  Exposed 1 / .6 brighter, as the viewers of the
// web have it.
static inline vec3 tonemap_aces(vec3 c)
{
    c = c / 0.6f;
    vec3 a = vec3(dot(vec3(0.59719f, 0.35458f, 0.04823f), c),
                  dot(vec3(0.07600f, 0.90834f, 0.01566f), c),
                  dot(vec3(0.02840f, 0.13383f, 0.83777f), c));
    a = (a * (a + 0.0245786f) - 0.000090537f) / (a * (0.983729f * a + 0.4329510f) + 0.238081f);
    return vec3(dot(vec3(1.60475f, -0.53108f, -0.07367f), a),
                dot(vec3(-0.10208f, 1.10813f, -0.00605f), a),
                dot(vec3(-0.00327f, -0.07276f, 1.07602f), a));
}

// Narkowicz 2015: one rational curve a channel through the same transforms.
static inline vec3 tonemap_aces_narkowicz(vec3 c)
{
    return c * (2.51f * c + 0.03f) / (c * (2.43f * c + 0.59f) + 0.14f);
}

// The sigmoid of AgX's default look, fitted by a polynomial: Wrensch 2023.
static inline vec3 tonemap_agx_contrast(vec3 x)
{
    return (((((15.5f * x - 40.14f) * x + 31.96f) * x - 6.868f) * x + 0.4298f) * x + 0.1191f) * x -
           0.00232f;
}

static inline real tonemap_agx_log(real x)
{
    // Sobotka's range: 12.47393 stops below 1 to 4.026069 above.
    return clamp((log2(max(x, 0.0000000001f)) + 12.47393f) / 16.499999f, 0.0f, 1.0f);
}

// AgX, Sobotka 2022: channels drawn together, a logarithm, a sigmoid, and back to
// display-linear by the exponent 2.2 that its display coding has.
static inline vec3 tonemap_agx(vec3 c)
{
    vec3 a = vec3(dot(vec3(0.842479062253094f, 0.0784335999999992f, 0.0792237451477643f), c),
                  dot(vec3(0.0423282422610123f, 0.878468636469772f, 0.0791661274605434f), c),
                  dot(vec3(0.0423756549057051f, 0.0784336f, 0.879142973793104f), c));
    a = tonemap_agx_contrast(
        vec3(tonemap_agx_log(a[0]), tonemap_agx_log(a[1]), tonemap_agx_log(a[2])));
    c = vec3(dot(vec3(1.19687900512017f, -0.0980208811401368f, -0.0990297440797205f), a),
             dot(vec3(-0.0528968517574562f, 1.15190312990417f, -0.0989611768448433f), a),
             dot(vec3(-0.0529716355144438f, -0.0980434501171241f, 1.15107367264116f), a));
    c = max(c, 0.0f);
    return vec3(pow(c[0], 2.2f), pow(c[1], 2.2f), pow(c[2], 2.2f));
}

// `kind`: a TONEMAP_ constant.
static inline vec3 tonemap(uint kind, vec3 c)
{
    // Nothing is darker than black; the upper end is white for every curve, and none overflows.
    c = clamp(c, 0.0f, 1000000.0f);
    if (kind == TONEMAP_NEUTRAL)
        c = tonemap_neutral(c);
    else if (kind == TONEMAP_REINHARD)
        c = tonemap_reinhard(c);
    else if (kind == TONEMAP_ACES)
        c = tonemap_aces(c);
    else if (kind == TONEMAP_ACES_NARKOWICZ)
        c = tonemap_aces_narkowicz(c);
    else if (kind == TONEMAP_AGX)
        c = tonemap_agx(c);
    return clamp(c, 0.0f, 1.0f);
}

#endif
