// Root mean squares, and SSIM (structural similarity, Wang et al. 2004).
#ifndef AG_IMAGE_DIFFERENCE_H
#define AG_IMAGE_DIFFERENCE_H

#include "image/picture.h"

enum { DIFFERENCE_TILE = 128 }; // px

// Sums over the pixels of a square.
typedef struct difference_sums {
    double squares_linear, squares_srgb; // of all three channels' differences
    double ssim;
} difference_sums;

// Floats of scratch memory that difference_tile() needs.
size_t difference_scratch_size(void);

// Of the square whose upper left pixel is (x, y), as far as the picture goes.
difference_sums difference_tile(const picture *reference, const picture *test, uint32_t x,
                                uint32_t y, float *scratch);

#endif
