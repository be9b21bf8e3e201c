// The exposures of HDR-FLIP.
#include "image/hdr_flip.h"

#include "base/log.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

// Where the tone curve is 0.85, as the paper has it: the positive root of
// a v^2 + b v + c = 0, from v (2.51 v + 0.03) = 0.85 (v (2.43 v + 0.59) + 0.14).
static double bright(void)
{
    double t = 0.85, a = 2.51 - 2.43 * t, b = 0.03 - 0.59 * t, c = -0.14 * t;
    return (sqrt(b * b - 4 * a * c) - b) / (2 * a) / 0.6;
}

// The value that stands at `rank` when `values` are sorted (Hoare 1961, FIND): none of those
// before it is above it then, none of those behind it below.
static float select_rank(float *values, ptrdiff_t count, ptrdiff_t rank)
{
    ptrdiff_t low = 0, high = count - 1;
    while (low < high) {
        float pivot = values[low + (high - low) / 2];
        ptrdiff_t i = low, j = high;
        while (i <= j) {
            while (values[i] < pivot)
                i++;
            while (values[j] > pivot)
                j--;
            if (i > j)
                break;
            float swap = values[i];
            values[i++] = values[j];
            values[j--] = swap;
        }
        if (rank <= j)
            high = j;
        else if (rank >= i)
            low = i;
        else
            break;
    }
    return values[rank];
}

static float greatest(const float *values, ptrdiff_t count)
{
    float most = 0;
    for (ptrdiff_t i = 0; i < count; i++)
        most = values[i] > most ? values[i] : most;
    return most;
}

// `count` >= 1.
static double median(float *values, ptrdiff_t count)
{
    double upper = (double)select_rank(values, count, count / 2);
    return count % 2 ? upper : (upper + (double)greatest(values, count / 2)) / 2;
}

// Of the pixels that are not black.  Returns how many there are.
static ptrdiff_t luminances(const picture *p, float *out)
{
    size_t pixels = (size_t)p->image->width * p->image->height;
    ptrdiff_t lit = 0;
    for (size_t i = 0; i < pixels; i++) {
        float rgb[3];
        picture_linear(p, i, rgb);
        float y = 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
        if (y > 0)
            out[lit++] = fminf(y, FLT_MAX);
    }
    return lit;
}

// The paper has the median of all pixels.  Where more than half of them are black there is no
// such exposure, and the median is that of the others.
static void find_range(float *lit, ptrdiff_t count, ptrdiff_t black, hdr_exposures *e)
{
    if (black > count)
        black = 0;
    for (ptrdiff_t i = 0; i < black; i++)
        lit[count + i] = 0;
    e->start = (float)log2(bright() / (double)greatest(lit, count));
    e->stop = (float)log2(bright() / median(lit, count + black));
}

static void spread(hdr_exposures *e)
{
    int count = (int)ceilf(e->stop - e->start);
    e->count = count > HDR_EXPOSURES_MAX ? HDR_EXPOSURES_MAX : count > 2 ? count : 2;
    for (int i = 0; i < e->count; i++)
        e->factor[i] = exp2f(e->start + (e->stop - e->start) * (float)i / (float)(e->count - 1));
}

ag_status hdr_exposures_init(const ag_log *log, const picture *reference, hdr_exposures *e)
{
    *e = (hdr_exposures) { .count = 1, .factor = { 1 } };
    size_t pixels = (size_t)reference->image->width * reference->image->height;
    float *values = malloc(pixels * sizeof *values);
    if (!values)
        return log_fail(log, AG_ERROR_MEMORY, "compare: no memory for %zu pixels", pixels);
    ptrdiff_t lit = luminances(reference, values);
    if (lit > 0) { // black: any exposure does
        find_range(values, lit, (ptrdiff_t)pixels - lit, e);
        spread(e);
    }
    free(values);
    return AG_OK;
}
