// Pearson's test of samples against the density they claim.
//
// Both are taken over a chart, a unit square.  What it leaves out is one more cell.
#ifndef TESTS_PHYSICS_CHI_SQUARED_H
#define TESTS_PHYSICS_CHI_SQUARED_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

typedef struct chi_chart {
    const void *of;
    double (*density)(const void *of, double s, double t); // over the square
    // The place of the sample that u makes; outside of the square: it left the chart.
    void (*sample)(const void *of, const double u[2], double place[2]);
} chi_chart;

enum { CHI_ROWS = 12, CHI_CELLS = CHI_ROWS * CHI_ROWS, CHI_DEPTH = 6 };

// Deterministic, uniform in [0, 1), of 24 bits.
static inline double chi_next(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return (double)((*state * 2685821657736338717u) >> 40) / 16777216.0;
}

// Gauss & Legendre's four nodes along each side.
static inline double chi_gauss(const chi_chart *chart, double s, double t, double size)
{
    static const double node[] = { 0.06943184420297371, 0.33000947820757187, 0.66999052179242813,
                                   0.93056815579702629 };
    static const double weight[] = { 0.17392742256872693, 0.32607257743127307 };
    double sum = 0;
    for (int i = 0; i < 16; i++) {
        int x = i / 4, y = i % 4;
        sum += weight[x % 3 != 0] * weight[y % 3 != 0] *
               chart->density(chart->of, s + node[x] * size, t + node[y] * size);
    }
    return sum * size * size;
}

// Quartered where that makes a difference, at outlines and peaks; `calm`: last time it did not.
static inline double chi_piece(const chi_chart *chart, double s, double t, double size,
                               double whole, int depth, bool calm)
{
    double part[4], sum = 0, half = size / 2;
    for (int i = 0; i < 4; i++)
        sum += part[i] = chi_gauss(chart, s + i / 2 * half, t + i % 2 * half, half);
    bool small = fabs(sum - whole) < 3e-6;
    if ((small && calm) || depth == 0)
        return sum;
    sum = 0;
    for (int i = 0; i < 4; i++)
        sum +=
            chi_piece(chart, s + i / 2 * half, t + i % 2 * half, half, part[i], depth - 1, small);
    return sum;
}

static inline double chi_cell(const chi_chart *chart, int cell)
{
    double size = 1.0 / CHI_ROWS, s = cell / CHI_ROWS * size, t = cell % CHI_ROWS * size;
    return chi_piece(chart, s, t, size, chi_gauss(chart, s, t, size), CHI_DEPTH, false);
}

static inline int chi_cell_of(const double place[2])
{
    double s = floor(place[0] * CHI_ROWS), t = floor(place[1] * CHI_ROWS);
    bool within = s >= 0 && s < CHI_ROWS && t >= 0 && t < CHI_ROWS;
    return within ? (int)(s * CHI_ROWS + t) : CHI_CELLS;
}

// The chance of a sum that is as great or greater; Wilson & Hilferty 1931.
static inline double chi_chance(double sum, int freedom)
{
    double v = 2.0 / (9.0 * freedom);
    return 0.5 * erfc((cbrt(sum / freedom) - 1 + v) / sqrt(2 * v));
}

// The chance that samples of this density are as uneven as these; `total` = the density's integral
// over the chart.
static inline double chi_squared(const chi_chart *chart, int count, uint64_t seed, double *total)
{
    double expected[CHI_CELLS + 1], few = 0, few_seen = 0, sum = 0;
    int seen[CHI_CELLS + 1] = { 0 }, freedom = 0;
    *total = 0;
    for (int i = 0; i < CHI_CELLS; i++)
        *total += expected[i] = chi_cell(chart, i);
    expected[CHI_CELLS] = fmax(1 - *total, 0);
    for (int i = 0; i < count; i++) {
        double u[2] = { chi_next(&seed), chi_next(&seed) }, place[2];
        chart->sample(chart->of, u, place);
        seen[chi_cell_of(place)]++;
    }
    for (int i = 0; i <= CHI_CELLS; i++) {
        double e = expected[i] * count;
        if (e < 10) {
            few += e;
            few_seen += seen[i];
            continue;
        }
        sum += (seen[i] - e) * (seen[i] - e) / e;
        freedom++;
    }
    // Quadrature may miss slivers.
    sum += (few_seen - few) * (few_seen - few) / fmax(few, 3e-4 * count);
    return chi_chance(sum, freedom > 0 ? freedom : 1);
}

#endif
