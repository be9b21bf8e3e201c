// From an equirectangular image to the faces of a cube.
#ifndef AG_BAKE_EQUIRECT_H
#define AG_BAKE_EQUIRECT_H

#include "bake/cube.h"

// Fill level 0 of a cube, without its borders, from `pixels` [height][width] RGBA (centre
// = +X, top = +Y), keeping the light's energy.  What is no radiance (negative, NaN) becomes
// 0; alpha becomes 1.  False when there is no memory.
bool equirect_to_cube(const float *pixels, uint32_t width, uint32_t height, cube_level *level);

#endif
