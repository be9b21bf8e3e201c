// The directional albedo of the GGX lobe, split by Fresnel: scale and bias of F0.
#ifndef AG_BAKE_DFG_H
#define AG_BAKE_DFG_H

#include <stdint.h>

enum { BAKE_DFG_SIZE = 64 }; // px, both ways

// Fill [BAKE_DFG_SIZE][BAKE_DFG_SIZE][2] half floats: x = NoV, y = perceptual roughness,
// texel centres at (i + 0.5) / size.  Channel 0 multiplies f0, channel 1 multiplies f90;
// their sum is the albedo of a white (F = 1) lobe.
void bake_dfg(uint16_t *table);

#endif
