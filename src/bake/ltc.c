// The table of linearly transformed cosines as a GPU sees it.
#include "bake/ltc.h"

#include "image/half.h"
#include "physics/light_ltc.glsl"

double bake_ltc_cosine(uint32_t x)
{
    double u = x / (BAKE_LTC_SIZE - 1.0);
    return fmax(1.0 - u * u, 0.002);
}

double bake_ltc_alpha(uint32_t y)
{
    double roughness = y / (BAKE_LTC_SIZE - 1.0);
    return fmax(roughness * roughness, 1e-4);
}

static uint32_t texel_before(float t)
{
    float last = BAKE_LTC_SIZE - 2;
    return (uint32_t)clamp(t, 0.0f, last);
}

void bake_ltc_fetch(float NoV, float roughness, float texel[4])
{
    vec2 uv = light_ltc_uv(NoV, roughness) * (float)BAKE_LTC_SIZE - 0.5f;
    uint32_t x = texel_before(uv[0]), y = texel_before(uv[1]);
    float tx = uv[0] - (float)x, ty = uv[1] - (float)y;
    const uint16_t *at = bake_ltc_table + 4 * (y * BAKE_LTC_SIZE + x);
    for (int k = 0; k < 4; k++) {
        float above = mix(half_to_float(at[k]), half_to_float(at[4 + k]), tx);
        const uint16_t *next = at + 4 * BAKE_LTC_SIZE;
        float below = mix(half_to_float(next[k]), half_to_float(next[4 + k]), tx);
        texel[k] = mix(above, below, ty);
    }
}
