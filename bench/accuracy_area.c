// Prints the error of the highlights of rectangles, disks and tubes against quadrature: the table
// of docs/area-lights.md, a line a shape.
//
//   accuracy_area [STEP]     one direction in STEP is tried; default 23
//
// The cells are those of accuracy.c, size = half the shorter side or the radius over the distance.
// Each number is the RMS error over the directions of a cell over the RMS of the truth, in percent:
// the median and the worst cell, and how many of 175 are above 2; for lights wholly above the
// horizon, then for those that it cuts.
#include "physics/light_disk.glsl"
#include "physics/light_polygon.glsl"
#include "physics/light_tube.glsl"

#include "../tests/physics/area_truth.h"
#include "../tests/physics/cap_truth.h"

#include <stdio.h>
#include <stdlib.h>

typedef struct shape {
    const char *name;
    int kind;
    double spread, tilt, anisotropy;
} shape;

static const shape shapes[] = {
    { "square, facing", AREA_QUAD, 1, 0, 1 },
    { "rectangle 1:4, tilted", AREA_QUAD, 4, 0.7, 1 },
    { "the same, ax / ay = 10", AREA_QUAD, 4, 0.7, 10 },
    { "disk, facing", AREA_DISK, 1, 0, 1 },
    { "disk, tilted", AREA_DISK, 1, 0.7, 1 },
    { "tube, half length R", AREA_TUBE, 1, 0.3, 1 },
    { "tube, half length 4 R", AREA_TUBE, 4, 0.3, 1 },
};

enum { CELLS = 7 * 5 * 5 };

typedef struct table {
    double cells[4][CELLS]; // whole, cut for F = 1; whole, cut for f0 = .04
    int count;
} table;

static vec3 to_vec3(const double a[3])
{
    return vec3((float)a[0], (float)a[1], (float)a[2]);
}

static vec2 lobe(const area_case *c)
{
    vec3 m = to_vec3(c->centre), x = to_vec3(c->x), y = to_vec3(c->y), v = to_vec3(c->v);
    float ax = (float)c->ax, ay = (float)c->ay;
    switch (c->kind) {
    case AREA_QUAD: return light_quad_ggx(m - x - y, m + x - y, m + x + y, m - x + y, v, ax, ay);
    case AREA_DISK: return light_disk_ggx(m, x, y, v, ax, ay);
    default: return light_tube_ggx(m, x, (float)c->radius, v, ax, ay);
    }
}

static void add_cell(const shape *s, const cap_case *cap, area_case *c, int step, table *t)
{
    static double axes[CAP_AXES][3];
    double error[4] = { 0 }, total[4] = { 0 };
    int n = cap_cell_axes(cap, axes);
    for (int i = 0; i < n; i += step) {
        double truth[3];
        area_place(c, axes[i], cap->sin_s, s->spread, s->tilt, 0.4 + i);
        area_truth(c, truth);
        vec2 got = lobe(c);
        for (int k = 0; k < 2; k++) {
            double f0 = k ? 0.04 : 1, right = f0 * (truth[0] - truth[1]) + truth[1];
            double e = f0 * (double)(got[0] - got[1]) + (double)got[1] - right;
            int part = 2 * k + !area_is_whole(c);
            error[part] += e * e;
            total[part] += right * right;
        }
    }
    for (int part = 0; part < 4; part++)
        t->cells[part][t->count] = 100 * sqrt(error[part] / fmax(total[part], 1e-30));
    t->count++;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print_shape(const shape *s, table *t)
{
    printf("%-24s", s->name);
    for (int part = 0; part < 4; part++) {
        int above = 0;
        qsort(t->cells[part], (size_t)t->count, sizeof(double), compare);
        for (int i = 0; i < t->count; i++)
            above += t->cells[part][i] > 2;
        printf(" | %5.2f %6.2f %3d", t->cells[part][t->count / 2], t->cells[part][t->count - 1],
               above);
    }
    printf("\n");
    fflush(stdout);
}

int main(int argc, char **argv)
{
    const double roughness[] = { .05, .1, .2, .35, .5, .7, 1 }, size[] = { .005, .05, .2, .5, .9 },
                 view[] = { 1, 30, 60, 75, 85 };
    int step = argc > 1 ? atoi(argv[1]) : 23;
    if (step < 1) {
        fprintf(stderr, "accuracy_area: STEP must be 1 or more\n");
        return 2;
    }
    printf("%-24s | F = 1, whole     | cut              | f0 = .04, whole  | cut\n", "");
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        const shape *s = &shapes[i];
        double turn = s->anisotropy > 1 ? 0.6 : 0;
        table t = { .count = 0 };
        for (int cell = 0; cell < CELLS; cell++) {
            cap_case cap;
            area_case c;
            double r = roughness[cell / 25], v = view[cell % 5];
            cap_cell(&cap, r, size[cell / 5 % 5], v, s->anisotropy, turn);
            area_cell(&c, s->kind, r, v, s->anisotropy, turn);
            add_cell(s, &cap, &c, step, &t);
        }
        print_shape(s, &t);
    }
    return 0;
}
