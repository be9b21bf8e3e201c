// Sums over pictures of linear light: RGBA32F, of one size.  Colours count as far as they cover.
#ifndef CLI_LINEAR_H
#define CLI_LINEAR_H

#include <argand/argand.h>

// The mean of all channels of all pixels.
double linear_mean(const ag_image *image);

// The mean of how far `test` is from `reference`, without and with its sign.
typedef struct linear_difference {
    double error, bias;
} linear_difference;
linear_difference linear_apart(const ag_image *reference, const ag_image *test);

// sum += factor * image, straight colours; `sum` is [height][width][4] and takes the image's alpha.
void linear_add(float (*sum)[4], const ag_image *image, float factor);

#endif
