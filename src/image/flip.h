// FLIP: the difference that a person sees who switches between two pictures.
// Andersson et al. 2020.
#ifndef AG_IMAGE_FLIP_H
#define AG_IMAGE_FLIP_H

#include "image/picture.h"

enum {
    FLIP_TILE = 128, // px: pictures are compared in squares of this size
    FLIP_PPD_MIN = 10,
    FLIP_PPD_MAX = 500,
    FLIP_RADIUS_MAX = 68,
};

typedef struct flip_kernel { // of a separable filter
    int radius;
    float weight[2 * FLIP_RADIUS_MAX + 1];
} flip_kernel;

// What the eye's filters are at a distance.
typedef struct flip_viewer {
    int border;                                       // px that the filters reach
    flip_kernel luminance, red_green, blue_yellow[2]; // contrast sensitivity
    flip_kernel smooth, edge, point;                  // detectors of features
    float color_max;                                  // the greatest difference of colours
} flip_viewer;

// `pixels_per_degree` in [FLIP_PPD_MIN, FLIP_PPD_MAX].
void flip_viewer_init(flip_viewer *viewer, float pixels_per_degree);

// Floats of scratch memory that flip_tile() needs.
size_t flip_scratch_size(const flip_viewer *viewer);

// The errors in [0, 1] of the square whose upper left pixel is (x, y), FLIP_TILE in a row; beyond
// the picture's edges, which repeat, they mean nothing.  `exposures`: factors on linear light, each
// followed by the tone curve of hdr_flip.h, of whose errors the greatest is taken; with
// `exposure_count` 0, the pictures as they are, in [0, 1].
void flip_tile(const flip_viewer *viewer, const picture *reference, const picture *test, uint32_t x,
               uint32_t y, const float *exposures, int exposure_count, float *scratch,
               float *errors);

#endif
