// Sums over pictures of linear light.
#include "linear.h"

#include <math.h>

static size_t pixel_count(const ag_image *image)
{
    return (size_t)ag_image_width(image) * ag_image_height(image);
}

static double channel(const float pixel[4], int c)
{
    return pixel[3] > 0 ? (double)pixel[c] * (double)pixel[3] : 0;
}

double linear_mean(const ag_image *image)
{
    const float(*p)[4] = ag_image_pixels(image);
    double sum = 0;
    size_t count = pixel_count(image);
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            sum += channel(p[i], c);
    return sum / (3 * (double)count);
}

linear_difference linear_apart(const ag_image *reference, const ag_image *test)
{
    const float(*p)[4] = ag_image_pixels(reference), (*q)[4] = ag_image_pixels(test);
    linear_difference sum = { 0, 0 };
    size_t count = pixel_count(reference);
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++) {
            double d = channel(q[i], c) - channel(p[i], c);
            sum.error += fabs(d);
            sum.bias += d;
        }
    sum.error /= 3 * (double)count;
    sum.bias /= 3 * (double)count;
    return sum;
}

void linear_add(float (*sum)[4], const ag_image *image, float factor)
{
    const float(*p)[4] = ag_image_pixels(image);
    size_t count = pixel_count(image);
    for (size_t i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++)
            sum[i][c] += factor * p[i][c];
        sum[i][3] = p[i][3];
    }
}
