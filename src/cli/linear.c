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

// Half by half the differences have the same mean, and noise that knows nothing of the other's:
// the mean of their product has none.
static double mean_product(const ways *w)
{
    const float(*p[2])[4], (*q[2])[4];
    for (int i = 0; i < 2; i++) {
        p[i] = ag_image_pixels(side_half(&w->reference, i));
        q[i] = ag_image_pixels(side_half(&w->real_time, i));
    }
    double sum = 0;
    size_t count = pixel_count(w->reference.mean);
    for (size_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            sum += (channel(q[0][i], c) - channel(p[0][i], c)) *
                   (channel(q[1][i], c) - channel(p[1][i], c));
    return sum / (3 * (double)count);
}

linear_difference linear_apart(const ways *w)
{
    const float(*p)[4] = ag_image_pixels(w->reference.mean);
    const float(*q)[4] = ag_image_pixels(w->real_time.mean);
    linear_difference sum = { .rms = sqrt(fmax(mean_product(w), 0)) };
    size_t count = pixel_count(w->reference.mean);
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
