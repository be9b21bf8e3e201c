// Pyramids of light: a picture halved again and again by quadratic B-splines, and summed up again
// by the same, so that each level adds the picture blurred by about a Gaussian.
//
// Burt (1981) has the scheme; as in Jimenez (2014), levels are blurred once more on the way up.
// What lies beyond the edges is the mirror image of what lies within: an even picture stays as it
// is, and no light is lost.
#ifndef AG_IMAGE_PYRAMID_H
#define AG_IMAGE_PYRAMID_H

#include "image/image.h"

enum { PYRAMID_LEVELS_MAX = 20 };

typedef float pyramid_texel __attribute__((vector_size(16)));

typedef struct pyramid_level {
    uint32_t width, height;
    pyramid_texel *texels;
} pyramid_level;

typedef struct pyramid {
    uint32_t count;
    pyramid_level levels[PYRAMID_LEVELS_MAX]; // the first is the image itself
} pyramid;

// The standard deviation, in px of a line of `size`, by which level `level` is blurred.
float pyramid_sigma(uint32_t size, uint32_t level);

// Levels of an RGBA32F image, `count` of them; each has half the size of the one before, rounded
// up.  The image is borrowed.  On all cores.
AG_CHECK ag_status pyramid_create(const ag_log *log, ag_image *image, uint32_t count, pyramid *p);
void pyramid_destroy(pyramid *p);

// The image becomes the sum of all levels by their weights.  On all cores.
AG_CHECK ag_status pyramid_sum(const ag_log *log, pyramid *p, const float *weights);

#endif
