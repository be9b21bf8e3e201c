// Prints the error of the sphere light's highlight against quadrature, methods side by side: the
// tables of docs/sphere-light.md.
//
//   accuracy [--tsv] [ANISOTROPY [VIEW_TURN]]
//
// Each number is the RMS error over all light directions of a cell over the RMS of the truth, in
// percent; for lights wholly above the horizon, and for those that it cuts.  --tsv prints a line a
// cell and method instead, for plots.
#include "bake/dfg.h"
#include "bake/ltc.h"
#include "base/threads.h"
#include "image/half.h"
#include "physics/light_ltc.glsl"
#include "physics/light_representative.glsl"
#include "physics/light_sphere.glsl"

#include "../tests/physics/cap_truth.h"

#include <stdio.h>
#include <stdlib.h>

enum { METHODS = 3, CELLS = 7 * 5 * 5 };
static const char *const method_name[METHODS] = { "closed form", "LTC", "representative point" };

static const double roughnesses[] = { .05, .1, .2, .35, .5, .7, 1 };
static const double radii[] = { .005, .05, .2, .5, .9 };
static const double views[] = { 1, 30, 60, 75, 85 };
static const double reflectances[] = { 1, .04 };

// One view, lobe and size of light.
typedef struct cell {
    cap_case c;
    float roughness;
    vec4 ltc;
    vec2 dfg;
    double error[2][METHODS][2]; // for each f0; in percent; whole, cut
} cell;

typedef struct table {
    cell cells[CELLS];
    double anisotropy, turn;
    int methods;
    uint16_t dfg[BAKE_DFG_SIZE * BAKE_DFG_SIZE * 2];
} table;

static vec3 to_vec3(const double a[3])
{
    return vec3((float)a[0], (float)a[1], (float)a[2]);
}

// The DFG table as a GPU interpolates it.
static vec2 dfg_at(const uint16_t *dfg, float NoV, float roughness)
{
    float x = clamp(NoV * BAKE_DFG_SIZE - 0.5f, 0.0f, BAKE_DFG_SIZE - 1.001f);
    float y = clamp(roughness * BAKE_DFG_SIZE - 0.5f, 0.0f, BAKE_DFG_SIZE - 1.001f);
    int x0 = (int)x, y0 = (int)y;
    vec2 sum = vec2(0, 0);
    for (int k = 0; k < 4; k++) {
        int xk = x0 + k % 2, yk = y0 + k / 2;
        float w = (k % 2 ? x - (float)x0 : 1 - x + (float)x0) *
                  (k / 2 ? y - (float)y0 : 1 - y + (float)y0);
        const uint16_t *t = dfg + 2 * (yk * BAKE_DFG_SIZE + xk);
        sum += w * vec2(half_to_float(t[0]), half_to_float(t[1]));
    }
    return sum;
}

// What each method gives, over the light's irradiance.
static vec2 evaluate(const cell *at, int method, const double axis[3])
{
    const cap_case *c = &at->c;
    light_cap cap = { to_vec3(axis), (float)c->sin_s, (float)c->cos_s };
    if (method == 1)
        return light_ltc_cap(cap, to_vec3(c->v), at->ltc, at->dfg);
    if (method == 2)
        return light_representative_cap(cap, to_vec3(c->v), (float)c->ax);
    return light_cap_ggx(cap, to_vec3(c->v), (float)c->ax, (float)c->ay);
}

static double reflected(double f0, double all, double grazing)
{
    return f0 * (all - grazing) + grazing;
}

static void fill_cell(void *context, size_t index)
{
    table *t = context;
    cell *at = &t->cells[index];
    double axes[CAP_AXES][3], errors[2][METHODS][2] = { 0 }, truths[2][2] = { 0 };
    int n = cap_cell_axes(&at->c, axes);
    double irradiance = (double)PI * at->c.sin_s * at->c.sin_s;
    for (int i = 0; i < n; i++) {
        cap_case c = at->c;
        for (int k = 0; k < 3; k++)
            c.axis[k] = axes[i][k];
        int part = c.axis[2] <= c.sin_s;
        double all = cap_truth(&c, 0), grazing = cap_truth(&c, 5);
        for (int f = 0; f < 2; f++)
            truths[f][part] += pow(reflected(reflectances[f], all, grazing), 2);
        for (int m = 0; m < t->methods; m++) {
            vec2 x = evaluate(at, m, axes[i]);
            for (int f = 0; f < 2; f++)
                errors[f][m][part] +=
                    pow(reflected(reflectances[f], (double)x[0] * irradiance - all,
                                  (double)x[1] * irradiance - grazing),
                        2);
        }
    }
    for (int k = 0; k < 2 * METHODS * 2; k++) {
        int f = k / (2 * METHODS), m = k / 2 % METHODS, part = k % 2;
        at->error[f][m][part] = 100 * sqrt(errors[f][m][part] / truths[f][part]);
    }
}

static void fill_table(table *t)
{
    bake_dfg(t->dfg);
    for (int i = 0; i < CELLS; i++) {
        cell *at = &t->cells[i];
        at->roughness = (float)roughnesses[i / 25];
        cap_cell(&at->c, roughnesses[i / 25], radii[i / 5 % 5], views[i % 5], t->anisotropy,
                 t->turn);
        float NoV = (float)at->c.v[2], m[4];
        bake_ltc_fetch(NoV, at->roughness, m);
        at->ltc = light_ltc_matrix(vec4(m[0], m[1], m[2], m[3]), (float)at->c.ax);
        at->dfg = dfg_at(t->dfg, NoV, at->roughness);
    }
    parallel_for(CELLS, fill_cell, t);
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print_summary(const table *t, int f, int part)
{
    for (int m = 0; m < t->methods; m++) {
        double all[CELLS];
        for (int i = 0; i < CELLS; i++)
            all[i] = t->cells[i].error[f][m][part];
        qsort(all, CELLS, sizeof *all, compare);
        printf("%s: median %.2f %%, worst cell %.2f %%\n", method_name[m], all[CELLS / 2],
               all[CELLS - 1]);
    }
}

static void print_table(const table *t, int f, int part)
{
    static const char *const format[METHODS] = { " %4.2f", " %4.1f", " %4.0f" };
    printf("\n%s, f0 = %g, alpha ratio %g; a column:", part ? "cut by the horizon" : "whole",
           reflectances[f], t->anisotropy);
    for (int m = 0; m < t->methods; m++)
        printf("%s %s", m ? "," : "", method_name[m]);
    printf("\n\nroughness R/d |");
    for (int k = 0; k < 5; k++)
        printf("%*g deg |", 5 * t->methods - 5, views[k]);
    for (int i = 0; i < CELLS; i++) {
        if (i % 5 == 0)
            printf("\n  %4.2f   %5.3f|", roughnesses[i / 25], radii[i / 5 % 5]);
        for (int m = 0; m < t->methods; m++)
            printf(format[m], t->cells[i].error[f][m][part]);
        printf("|");
    }
    printf("\n\n");
    print_summary(t, f, part);
}

static void print_tsv(const table *t)
{
    printf("roughness\tradius\tview\tf0\tmethod\twhole\tcut\n");
    for (int i = 0; i < CELLS * 2 * t->methods; i++) {
        const cell *at = &t->cells[i / 2 / t->methods];
        int f = i / t->methods % 2, m = i % t->methods;
        printf("%g\t%g\t%g\t%g\t%s\t%.4f\t%.4f\n", (double)at->roughness, at->c.sin_s,
               views[i / 2 / t->methods % 5], reflectances[f], method_name[m], at->error[f][m][0],
               at->error[f][m][1]);
    }
}

int main(int argc, char **argv)
{
    static table t;
    bool is_tsv = argc > 1 && strcmp(argv[1], "--tsv") == 0;
    argc -= is_tsv;
    argv += is_tsv;
    t.anisotropy = argc > 1 ? atof(argv[1]) : 1;
    t.turn = argc > 2 ? atof(argv[2]) : 0;
    if (!(t.anisotropy >= 1 && t.anisotropy <= 100)) {
        fprintf(stderr, "usage: accuracy [--tsv] [ANISOTROPY in 1..100 [VIEW_TURN in radians]]\n");
        return 2;
    }
    t.methods = t.anisotropy == 1 ? METHODS : 1; // the others are isotropic
    fill_table(&t);
    if (is_tsv) {
        print_tsv(&t);
        return 0;
    }
    for (int i = 0; i < 4; i++)
        print_table(&t, i / 2, i % 2);
    return 0;
}
