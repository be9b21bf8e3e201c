// A picture as it is compared: without alpha, over white, linear or sRGB-coded.
#ifndef AG_IMAGE_PICTURE_H
#define AG_IMAGE_PICTURE_H

#include "image/image.h"

typedef struct picture {
    const ag_image *image; // borrowed
    float decoded[256];    // linear value of a byte
} picture;

void picture_init(picture *picture, const ag_image *image);

// Pixel `index`, rows from the top.  Bytes are composited as they are coded, floats as they are.
// NaN is 0, infinities are the greatest floats.
void picture_linear(const picture *picture, size_t index, float rgb[3]);

// The same, sRGB-coded in [0, 1].
void picture_coded(const picture *picture, size_t index, float rgb[3]);

#endif
