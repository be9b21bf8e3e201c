// The environment as a rough mirror reflects it.
#ifndef AG_BAKE_PREFILTER_H
#define AG_BAKE_PREFILTER_H

#include "bake/cube.h"

// Fill `texels`, RGBA [6][size][size], with the environment seen through a GGX lobe of
// `roughness` (perceptual, above 0) around each direction: eye, normal and reflection are
// taken as one (Karis 2013), light weighted by n.l.  `size`: a multiple of 8.
void prefilter(const cube *environment, float roughness, uint32_t size, float *texels);

#endif
