// Root mean squares, and SSIM: structural similarity.
#include "image/difference.h"

#include <math.h>

// SSIM's window: a Gaussian of 1.5 px, cut at 3.5 deviations; pictures are mirrored at their edges.
enum { RADIUS = 5, SIDE = DIFFERENCE_TILE + 2 * RADIUS, PLANE = SIDE * SIDE };

// Planes in scratch memory, SIDE x SIDE.
enum { LUMA_A, LUMA_B, PRODUCT_AA, PRODUCT_BB, PRODUCT_AB, PLANES };

size_t difference_scratch_size(void)
{
    return PLANES * PLANE;
}

// ... 2 1 0 0 1 2 ... count - 1, count - 1, count - 2 ...
static size_t mirror_index(int64_t i, uint32_t count)
{
    int64_t period = 2 * (int64_t)count, at = ((i % period) + period) % period;
    return (size_t)(at < count ? at : period - 1 - at);
}

static double squared_distance(const float a[3], const float b[3])
{
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        double d = (double)a[c] - (double)b[c];
        sum += d * d;
    }
    return sum;
}

static float luma(const float coded[3])
{
    return 0.2126f * coded[0] + 0.7152f * coded[1] + 0.0722f * coded[2];
}

// A pixel's lumas and their products.  Returns the square of the coded difference.
static double load(const picture *reference, const picture *test, size_t pixel, float *planes)
{
    float a[3], b[3];
    picture_coded(reference, pixel, a);
    picture_coded(test, pixel, b);
    float la = luma(a), lb = luma(b);
    planes[LUMA_A * PLANE] = la;
    planes[LUMA_B * PLANE] = lb;
    planes[PRODUCT_AA * PLANE] = la * la;
    planes[PRODUCT_BB * PLANE] = lb * lb;
    planes[PRODUCT_AB * PLANE] = la * lb;
    return squared_distance(a, b);
}

static double linear_square(const picture *reference, const picture *test, size_t pixel)
{
    float a[3], b[3];
    picture_linear(reference, pixel, a);
    picture_linear(test, pixel, b);
    return squared_distance(a, b);
}

static void window_init(float weight[2 * RADIUS + 1])
{
    double sum = 0;
    for (int i = -RADIUS; i <= RADIUS; i++)
        sum += exp(-i * i / (2 * 1.5 * 1.5));
    for (int i = -RADIUS; i <= RADIUS; i++)
        weight[i + RADIUS] = (float)(exp(-i * i / (2 * 1.5 * 1.5)) / sum);
}

// In place, since what is read lies behind what is written: out[i] is in[i + RADIUS], smoothed.
static void smooth(float *plane, int step, int count, const float *weight)
{
    for (int i = 0; i < count; i++) {
        float sum = 0;
        for (int j = 0; j <= 2 * RADIUS; j++)
            sum += weight[j] * plane[i + j * step];
        plane[i] = sum;
    }
}

static void smooth_all(float *planes)
{
    float weight[2 * RADIUS + 1];
    window_init(weight);
    for (int p = 0; p < PLANES; p++) {
        float *plane = planes + p * PLANE;
        for (int y = 0; y < SIDE; y++)
            smooth(plane + y * SIDE, 1, DIFFERENCE_TILE, weight);
        for (int y = 0; y < DIFFERENCE_TILE; y++)
            smooth(plane + y * SIDE, SIDE, DIFFERENCE_TILE, weight);
    }
}

// Eq. 13 with K1 = 0.01, K2 = 0.03.
static double similarity(const float *planes)
{
    const double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    double a = (double)planes[LUMA_A * PLANE], b = (double)planes[LUMA_B * PLANE];
    double variances =
        (double)planes[PRODUCT_AA * PLANE] - a * a + (double)planes[PRODUCT_BB * PLANE] - b * b;
    double covariance = (double)planes[PRODUCT_AB * PLANE] - a * b;
    return (2 * a * b + c1) * (2 * covariance + c2) / ((a * a + b * b + c1) * (variances + c2));
}

difference_sums difference_tile(const picture *reference, const picture *test, uint32_t x,
                                uint32_t y, float *scratch)
{
    difference_sums sums = { 0 };
    uint32_t width = reference->image->width, height = reference->image->height;
    uint32_t columns = width - x < DIFFERENCE_TILE ? width - x : DIFFERENCE_TILE;
    uint32_t rows = height - y < DIFFERENCE_TILE ? height - y : DIFFERENCE_TILE;
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++) {
            size_t pixel = mirror_index((int64_t)y + j - RADIUS, height) * width +
                           mirror_index((int64_t)x + i - RADIUS, width);
            double square = load(reference, test, pixel, scratch + j * SIDE + i);
            int64_t column = i - RADIUS, row = j - RADIUS;
            if (column < 0 || column >= columns || row < 0 || row >= rows)
                continue;
            sums.squares_srgb += square;
            sums.squares_linear += linear_square(reference, test, pixel);
        }
    smooth_all(scratch);
    for (uint32_t j = 0; j < rows; j++)
        for (uint32_t i = 0; i < columns; i++)
            sums.ssim += similarity(scratch + j * SIDE + i);
    return sums;
}
