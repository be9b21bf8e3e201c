// Sums over pictures of linear light: RGBA32F, of one size.  Colours count as far as they cover.
#ifndef CLI_LINEAR_H
#define CLI_LINEAR_H

#include "ways.h"

// The mean of all channels of all pixels.
double linear_mean(const ag_image *image);

// How far real time is from the reference: the mean difference without and with its sign, and
// the root of the mean square, from which noise is taken out.
typedef struct linear_difference {
    double error, bias, rms;
} linear_difference;
linear_difference linear_apart(const ways *ways);

// sum += factor * image, straight colours; `sum` is [height][width][4] and takes the image's alpha.
void linear_add(float (*sum)[4], const ag_image *image, float factor);

#endif
