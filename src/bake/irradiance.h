// The environment as a white matte surface reflects it.
#ifndef AG_BAKE_IRRADIANCE_H
#define AG_BAKE_IRRADIANCE_H

#include "bake/cube.h"

// Fill `texels`, RGBA [6][size][size], with irradiance / pi for the normal at each texel,
// summed over every texel of `level` by its solid angle.  On all cores; false when there
// is no memory.
bool irradiance_integrate(const cube_level *level, uint32_t size, float *texels);

#endif
