// The environment's spherical harmonics.
#ifndef AG_BAKE_HARMONICS_H
#define AG_BAKE_HARMONICS_H

#include "bake/cube.h"

// Project a level on the nine functions of sh_basis(), by the exact solid angles.
void harmonics_project(const cube_level *level, float coefficients[9][3]);

#endif
