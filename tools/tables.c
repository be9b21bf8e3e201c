// Fits the table of linearly transformed cosines and writes src/bake/ltc_table.c (`make tables`).
//
//   tables FILE
#include "bake/ltc.h"
#include "base/threads.h"
#include "image/half.h"
#include "ltc_fit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct table {
    uint16_t texels[BAKE_LTC_SIZE][BAKE_LTC_SIZE][4];
    double residual[BAKE_LTC_SIZE][BAKE_LTC_SIZE];
} table;

// A row of one roughness, from the lobe straight above, whose fit is nearly known, to the grazing.
static void fit_row(void *context, size_t y)
{
    table *t = context;
    ltc_shape shape = ltc_fit_smooth(1.0);
    for (uint32_t x = 0; x < BAKE_LTC_SIZE; x++) {
        ltc_entry e = ltc_fit(bake_ltc_cosine(x), bake_ltc_alpha((uint32_t)y), shape);
        for (int k = 0; k < 4; k++)
            t->texels[y][x][k] = half_from_float((float)e.m[k]);
        t->residual[y][x] = e.residual;
        shape = e.shape;
    }
    printf("row %2u of %d\n", (unsigned)y, BAKE_LTC_SIZE);
    fflush(stdout);
}

static void print_residuals(const table *t)
{
    printf("\nresidual of the fit, in percent: cubes of the difference over cubes of the lobe\n"
           "\nalpha   |  NoV");
    for (int x = 0; x < BAKE_LTC_SIZE; x += 4)
        printf(" %5.3f", bake_ltc_cosine((uint32_t)x));
    printf("\n");
    double sum = 0, worst = 0;
    for (int y = 0; y < BAKE_LTC_SIZE; y++) {
        for (int x = 0; x < BAKE_LTC_SIZE; x++) {
            sum += t->residual[y][x] / (BAKE_LTC_SIZE * BAKE_LTC_SIZE);
            worst = fmax(worst, t->residual[y][x]);
        }
        if (y % 4)
            continue;
        printf("%6.4f  |     ", bake_ltc_alpha((uint32_t)y));
        for (int x = 0; x < BAKE_LTC_SIZE; x += 4)
            printf(" %5.1f", 100 * t->residual[y][x]);
        printf("\n");
    }
    printf("\nmean %.2f %%, worst %.1f %%\n", 100 * sum, 100 * worst);
}

static int write_table(const table *t, const char *path)
{
    FILE *f = fopen(path, "w");
    if (!f) {
        perror(path);
        return EXIT_FAILURE;
    }
    fprintf(
        f,
        "// Linearly transformed cosines of the GGX lobe: half floats, written by `make tables`.\n"
        "#include \"bake/ltc.h\"\n\n// clang-format off\n"
        "const uint16_t bake_ltc_table[BAKE_LTC_SIZE * BAKE_LTC_SIZE * 4] = {");
    const uint16_t *texel = t->texels[0][0];
    for (int i = 0; i < BAKE_LTC_SIZE * BAKE_LTC_SIZE * 4; i++)
        fprintf(f, "%s0x%04x,", i % 12 ? " " : "\n    ", texel[i]);
    fprintf(f, "\n};\n");
    if (fclose(f)) {
        perror(path);
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fprintf(stderr, "usage: tables FILE\n");
        return 2;
    }
    static table t;
    parallel_for(BAKE_LTC_SIZE, fit_row, &t);
    print_residuals(&t);
    return write_table(&t, argv[1]);
}
