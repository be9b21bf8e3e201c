// Metering against sorted luminances and pictures whose mean is known.
#include "helpers.h"

enum { W = 96, H = 64 };

static float luminance(const float c[4])
{
    return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
}

static ag_image *image_of(float (*pixels)[4])
{
    ag_image *image;
    const ag_image_desc desc = { W, H, AG_FORMAT_RGBA32F, pixels };
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    return image;
}

static float metered(float (*pixels)[4], float exposure, const ag_metering *m)
{
    ag_image *image = image_of(pixels);
    float ev;
    assert_int_equal(ag_image_meter(NULL, image, exposure, m, &ev), AG_OK);
    ag_image_destroy(image);
    return ev;
}

static void fill(float (*pixels)[4], float r, float g, float b)
{
    for (int i = 0; i < W * H; i++)
        memcpy(pixels[i], (float[4]) { r, g, b, 1 }, sizeof *pixels);
}

// ISO 2720: EV100 = log2(L 100 / K), K = 12.5; so metered, a surface is .104 of what saturates.
static void grey_is_metered_as_the_standard_says(void **state)
{
    (void)state;
    float(*pixels)[4] = malloc(sizeof *pixels * W * H);
    for (ag_meter meter = AG_METER_CENTER; meter <= AG_METER_SPOT; meter++)
        for (float nit = 2e-4f; nit < 4e5f; nit *= 1.7f) {
            fill(pixels, nit / 16, nit / 16, nit / 16);
            float ev = metered(pixels, 1 / 16.f, &(ag_metering) { .meter = meter });
            assert_near(ev, log2((double)nit * 100 / 12.5), .015);
            assert_near(nit * ag_exposure_from_ev100(ev), 12.5 / 100 / 1.2, .0012);
        }
    fill(pixels, 1, 0, 0); // the luminance of Rec. 709's red
    assert_near(metered(pixels, 1, NULL), log2(8 * .2126), .015);
    free(pixels);
}

static int by_size(const void *a, const void *b)
{
    float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

// The mean of those from `low` to `high` in their order, worked out from the sorted list.
static double sorted_ev(float (*pixels)[4], double low, double high)
{
    float sorted[W * H];
    double sum = 0;
    for (int i = 0; i < W * H; i++)
        sorted[i] = luminance(pixels[i]);
    qsort(sorted, W * H, sizeof *sorted, by_size);
    for (int i = 0; i < W * H; i++)
        sum += (double)sorted[i] * fmax(0, fmin(i + 1, high * W * H) - fmax(i, low * W * H));
    return log2(8 * sum / ((high - low) * W * H));
}

// Luminances over twelve stops, and some that are black.
static void scatter(float (*pixels)[4])
{
    uint32_t seed = 1;
    for (int i = 0; i < W * H; i++)
        for (int c = 0; c < 4; c++)
            pixels[i][c] = c == 3 ? 1 : i % 7 == 0 ? 0 : exp2f(12 * noise(&seed) - 6);
}

static void percentiles_are_those_of_the_sorted_pixels(void **state)
{
    (void)state;
    static const float cuts[][2] = { { 0, 1 },      { .1f, .9f }, { .5f, .95f },
                                     { .2f, .25f }, { .9f, 1 },   { 0, .3f } };
    float(*pixels)[4] = malloc(sizeof *pixels * W * H);
    scatter(pixels);
    for (size_t i = 0; i < sizeof cuts / sizeof *cuts; i++) {
        const ag_metering m = { .meter = AG_METER_AVERAGE, .low = cuts[i][0], .high = cuts[i][1] };
        double wanted = sorted_ev(pixels, (double)cuts[i][0], (double)cuts[i][1]);
        // Without a cut the histogram's mean is the light's own; a cut is within a bin.
        assert_near(metered(pixels, 1, &m), wanted, i ? .03 : 1e-3);
    }
    assert_near(metered(pixels, 1, &(ag_metering) { .meter = AG_METER_AVERAGE }),
                sorted_ev(pixels, .1, .9), .03);
    free(pixels);
}

// 2 % of the picture is a light of 100 nit, the rest is black: on the mean, 2 nit.  A histogram
// that leaves its darkest bin out, as many do, sees 100, and is 5.6 stops darker.
static void black_is_counted(void **state)
{
    (void)state;
    float(*pixels)[4] = malloc(sizeof *pixels * W * H);
    fill(pixels, 0, 0, 0);
    int lit = W * H / 50;
    for (int i = 0; i < lit; i++)
        memcpy(pixels[i * 50], (float[4]) { 100, 100, 100, 1 }, sizeof *pixels);
    const ag_metering all = { .meter = AG_METER_AVERAGE, .low = 0, .high = 1 };
    double counted = log2(8 * 100.0 * lit / (W * H)), left_out = log2(8 * 100.0);
    assert_near(metered(pixels, 1, &all), counted, 1e-3);
    assert_near(left_out - counted, 5.64, .02);
    // By default the brightest tenth is cut, and nothing is left but black.
    assert_near(metered(pixels, 1, &(ag_metering) { .meter = AG_METER_AVERAGE }), -10, 0);
    const ag_metering limited = { .meter = AG_METER_AVERAGE, .min_ev100 = -2, .max_ev100 = 15 };
    assert_near(metered(pixels, 1, &limited), -2, 0);
    free(pixels);
}

// A white disk of a quarter of the height about the middle of a picture that is black otherwise.
static void the_middle_weighs_three_quarters(void **state)
{
    (void)state;
    float(*pixels)[4] = malloc(sizeof *pixels * W * H);
    fill(pixels, 0, 0, 0);
    for (int i = 0; i < W * H; i++)
        if (hypot(i % W + .5 - W / 2., i / W + .5 - H / 2.) < H / 4.)
            memcpy(pixels[i], (float[4]) { 1, 1, 1, 1 }, sizeof *pixels);
    const ag_metering all = { .meter = AG_METER_CENTER, .low = 0, .high = 1 };
    assert_near(exp2((double)metered(pixels, 1, &all)) / 8, .75, .01);
    free(pixels);
}

// Left dark, right bright, and a lamp that is 8 px wide in the lower right corner.
static void a_spot_sees_where_it_is(void **state)
{
    (void)state;
    float(*pixels)[4] = malloc(sizeof *pixels * W * H);
    for (int i = 0; i < W * H; i++) {
        bool lamp = i % W >= W - 8 && i / W >= H - 8;
        float l = lamp ? 64 : i % W < W / 2 ? .25f : 4;
        memcpy(pixels[i], (float[4]) { l, l, l, 1 }, sizeof *pixels);
    }
    ag_metering m = { .meter = AG_METER_SPOT, .spot_x = -.25f };
    assert_near(metered(pixels, 1, &m), 1, 1e-3);
    m.spot_x = .25f;
    assert_near(metered(pixels, 1, &m), 5, 1e-3);
    m.spot_x = .5f - 4.f / W;
    m.spot_y = .5f - 4.f / H;
    assert_near(metered(pixels, 1, &m), 9, 1e-3);
    m.spot_y = -m.spot_y;
    assert_near(metered(pixels, 1, &m), 5, 1e-3);
    m.spot_x = 0;
    m.spot_radius = 1;
    m.low = 0;
    m.high = 1;
    assert_true(metered(pixels, 1, &m) < 4.9f); // the dark half is seen too
    free(pixels);
}

static void what_is_open_does_not_count(void **state)
{
    (void)state;
    float(*pixels)[4] = malloc(sizeof *pixels * W * H);
    fill(pixels, 3, 3, 3);
    for (int i = 0; i < W * H; i += 2)
        memcpy(pixels[i], (float[4]) { 0, 0, 0, 0 }, sizeof *pixels);
    const ag_metering all = { .low = 0, .high = 1 };
    assert_near(metered(pixels, 1, &all), log2(24), 1e-3);
    free(pixels);
}

static void limits_come_before_compensation(void **state)
{
    (void)state;
    float(*pixels)[4] = malloc(sizeof *pixels * W * H);
    fill(pixels, 128, 128, 128); // EV100 10
    assert_near(metered(pixels, 1, &(ag_metering) { .compensation_ev = 1.5f }), 8.5, 1e-3);
    ag_metering m = { .min_ev100 = 2, .max_ev100 = 7, .compensation_ev = -1 };
    assert_near(metered(pixels, 1, &m), 8, 1e-6);
    m.min_ev100 = 12;
    m.max_ev100 = 14;
    assert_near(metered(pixels, 1, &m), 13, 1e-6);
    free(pixels);
}

static void nothing_breaks_it(void **state)
{
    (void)state;
    const float strange[] = { NAN, INFINITY, -INFINITY, -1, 1e38f, 1e-38f };
    float(*pixels)[4] = malloc(sizeof *pixels * W * H);
    for (size_t i = 0; i < sizeof strange / sizeof *strange; i++) {
        fill(pixels, strange[i], strange[i], strange[i]);
        float ev = metered(pixels, 1, NULL);
        assert_true(ev >= -10 && ev <= 21.75f);
    }
    free(pixels);
}

static void wrong_meterings_are_refused(void **state)
{
    (void)state;
    const ag_metering wrong[] = {
        { .meter = (ag_meter)7 },
        { .spot_x = .6f },
        { .spot_y = -NAN },
        { .spot_radius = -1 },
        { .low = .5f },
        { .low = .5f, .high = .5f },
        { .high = 1.1f },
        { .min_ev100 = 3 },
        { .max_ev100 = NAN },
        { .compensation_ev = INFINITY },
        { .min_ev100 = -INFINITY, .max_ev100 = 2 },
    };
    const ag_image_desc floats = { 2, 2, AG_FORMAT_RGBA32F, NULL },
                        bytes = { .width = 2, .height = 2 };
    const ag_log quiet = { keep_sentence, &(sentences) { 0 }, AG_LOG_ERROR };
    ag_image *image, *coded;
    float ev;
    assert_int_equal(ag_image_create(NULL, &floats, &image), AG_OK);
    assert_int_equal(ag_image_create(NULL, &bytes, &coded), AG_OK);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_int_equal(ag_image_meter(&quiet, image, 1, &wrong[i], &ev), AG_ERROR_ARGUMENT);
    assert_int_equal(ag_image_meter(&quiet, coded, 1, NULL, &ev), AG_ERROR_ARGUMENT);
    assert_int_equal(ag_image_meter(&quiet, image, 0, NULL, &ev), AG_ERROR_ARGUMENT);
    ag_image_destroy(image);
    ag_image_destroy(coded);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grey_is_metered_as_the_standard_says),
        cmocka_unit_test(percentiles_are_those_of_the_sorted_pixels),
        cmocka_unit_test(black_is_counted),
        cmocka_unit_test(the_middle_weighs_three_quarters),
        cmocka_unit_test(a_spot_sees_where_it_is),
        cmocka_unit_test(what_is_open_does_not_count),
        cmocka_unit_test(limits_come_before_compensation),
        cmocka_unit_test(nothing_breaks_it),
        cmocka_unit_test(wrong_meterings_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
