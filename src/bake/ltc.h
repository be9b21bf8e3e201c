// The table of linearly transformed cosines for shaders/physics/light_ltc.glsl.
#ifndef AG_BAKE_LTC_H
#define AG_BAKE_LTC_H

#include <stdint.h>

enum { BAKE_LTC_SIZE = 32 }; // px, both ways

// [BAKE_LTC_SIZE][BAKE_LTC_SIZE][4] half floats: x = sqrt(1 - NoV), y = perceptual roughness, both
// from 0 at the first texel's centre to 1 at the last one's.  light_ltc.glsl says what is in it.
extern const uint16_t bake_ltc_table[BAKE_LTC_SIZE * BAKE_LTC_SIZE * 4];

// What column x and row y were fitted for; never quite 0.
double bake_ltc_cosine(uint32_t x);
double bake_ltc_alpha(uint32_t y);

// The texel at NoV and roughness, in [0, 1], interpolated as a GPU does it.
void bake_ltc_fetch(float NoV, float roughness, float texel[4]);

#endif
