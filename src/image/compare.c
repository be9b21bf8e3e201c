// How far apart two pictures are: square by square, on all cores.
#include "image/difference.h"
#include "image/flip.h"
#include "image/hdr_flip.h"
#include "image/heat.h"

#include "base/log.h"
#include "base/threads.h"

#include <argand/compare.h>
#include <math.h>
#include <stdlib.h>

enum { TILE = FLIP_TILE };
_Static_assert((int)TILE == (int)DIFFERENCE_TILE, "one square for all measures");

// What a square has to say.
typedef struct tile_result {
    difference_sums sums;
    double flip; // sum
    float flip_max;
    uint32_t worst_x, worst_y;
    bool no_memory;
} tile_result;

typedef struct comparison {
    picture reference, test;
    flip_viewer viewer;
    hdr_exposures exposures; // none of bytes
    uint32_t columns, rows;  // of squares
    tile_result *results;
    ag_image *heat; // or NULL
} comparison;

static void add_pixel(const comparison *c, tile_result *r, uint32_t x, uint32_t y, float error)
{
    r->flip += (double)error;
    if (error > r->flip_max) {
        r->flip_max = error;
        r->worst_x = x;
        r->worst_y = y;
    }
    if (c->heat)
        heat_color(error, (uint8_t *)c->heat->pixels + ((size_t)y * c->heat->width + x) * 4);
}

static void add_errors(const comparison *c, tile_result *r, uint32_t x, uint32_t y,
                       const float *errors)
{
    const ag_image *image = c->reference.image;
    r->worst_x = x;
    r->worst_y = y;
    for (uint32_t j = 0; j < TILE && y + j < image->height; j++)
        for (uint32_t i = 0; i < TILE && x + i < image->width; i++)
            add_pixel(c, r, x + i, y + j, errors[j * TILE + i]);
}

static void compare_tile(void *context, size_t index)
{
    const comparison *c = context;
    tile_result *r = &c->results[index];
    uint32_t x = (uint32_t)(index % c->columns) * TILE, y = (uint32_t)(index / c->columns) * TILE;
    size_t flip = flip_scratch_size(&c->viewer), rest = difference_scratch_size();
    float *errors = malloc((TILE * TILE + (flip > rest ? flip : rest)) * sizeof *errors);
    r->no_memory = !errors;
    if (!errors)
        return;
    float *scratch = errors + TILE * TILE;
    flip_tile(&c->viewer, &c->reference, &c->test, x, y, c->exposures.factor, c->exposures.count,
              scratch, errors);
    add_errors(c, r, x, y, errors);
    r->sums = difference_tile(&c->reference, &c->test, x, y, scratch);
    free(errors);
}

// In the order of squares, so that any number of threads gives the same sum.
static bool add_results(const comparison *c, tile_result *sum)
{
    *sum = (tile_result) { .no_memory = false };
    for (size_t i = 0; i < (size_t)c->columns * c->rows; i++) {
        const tile_result *r = &c->results[i];
        sum->no_memory |= r->no_memory;
        sum->flip += r->flip;
        sum->sums.squares_linear += r->sums.squares_linear;
        sum->sums.squares_srgb += r->sums.squares_srgb;
        sum->sums.ssim += r->sums.ssim;
        if (r->flip_max > sum->flip_max) {
            sum->flip_max = r->flip_max;
            sum->worst_x = r->worst_x;
            sum->worst_y = r->worst_y;
        }
    }
    return !sum->no_memory;
}

static ag_difference conclude(const comparison *c, const tile_result *sum)
{
    double pixels = (double)c->reference.image->width * c->reference.image->height;
    double rmse_srgb = sqrt(sum->sums.squares_srgb / (3 * pixels));
    return (ag_difference) {
        .flip = (float)(sum->flip / pixels),
        .flip_max = sum->flip_max,
        .worst_x = sum->worst_x,
        .worst_y = sum->worst_y,
        .ev_start = c->exposures.start,
        .ev_stop = c->exposures.stop,
        .rmse_linear = sqrt(sum->sums.squares_linear / (3 * pixels)),
        .rmse_srgb = rmse_srgb,
        .psnr_db = rmse_srgb > 0 ? -20 * log10(rmse_srgb) : (double)INFINITY,
        .ssim = sum->sums.ssim / pixels,
    };
}

static ag_status check(const ag_log *log, const ag_image *a, const ag_image *b, float ppd)
{
    if (a->width != b->width || a->height != b->height)
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "compare: %u x %u and %u x %u pixels; only pictures of one size can be "
                        "compared",
                        a->width, a->height, b->width, b->height);
    if (a->format != b->format)
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "compare: one picture is of bytes, the other of floats; give both alike");
    if (!(ppd >= FLIP_PPD_MIN && ppd <= FLIP_PPD_MAX))
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "compare: %g pixels per degree; it has to be %d to %d", (double)ppd,
                        FLIP_PPD_MIN, FLIP_PPD_MAX);
    return AG_OK;
}

static ag_status prepare(const ag_log *log, comparison *c, const ag_image *reference,
                         const ag_image *test, float ppd)
{
    picture_init(&c->reference, reference);
    picture_init(&c->test, test);
    flip_viewer_init(&c->viewer, ppd);
    if (reference->format == AG_FORMAT_RGBA32F) {
        ag_status status = hdr_exposures_init(log, &c->reference, &c->exposures);
        if (status)
            return status;
    }
    c->columns = (reference->width - 1) / TILE + 1;
    c->rows = (reference->height - 1) / TILE + 1;
    c->results = calloc((size_t)c->columns * c->rows, sizeof *c->results);
    if (!c->results)
        return log_fail(log, AG_ERROR_MEMORY, "compare: no memory");
    return AG_OK;
}

static ag_status compare(const ag_log *log, comparison *c, ag_difference *difference)
{
    tile_result sum;
    parallel_for((size_t)c->columns * c->rows, compare_tile, c);
    if (!add_results(c, &sum))
        return log_fail(log, AG_ERROR_MEMORY, "compare: no memory");
    *difference = conclude(c, &sum);
    return AG_OK;
}

ag_status ag_image_compare(const ag_log *log, const ag_image *reference, const ag_image *test,
                           const ag_compare_options *options, ag_difference *difference,
                           ag_image **heat)
{
    *difference = (ag_difference) { 0 };
    if (heat)
        *heat = NULL;
    float ppd = options && options->pixels_per_degree != 0 ? options->pixels_per_degree : 67.02f;
    comparison c = { .heat = NULL };
    ag_status status = check(log, reference, test, ppd);
    if (!status)
        status = prepare(log, &c, reference, test, ppd);
    if (!status && heat)
        status = image_allocate(log, "heat map", reference->width, reference->height,
                                AG_FORMAT_RGBA8, &c.heat);
    if (!status)
        status = compare(log, &c, difference);
    free(c.results);
    if (status)
        ag_image_destroy(c.heat);
    else if (heat)
        *heat = c.heat;
    return status;
}
