// How far apart pictures are, against numbers computed elsewhere.
//
// Expected values of FLIP and SSIM come from a program of their own: NumPy and SciPy in double
// precision, with the two-dimensional kernels of the papers, 67 pixels per degree.
#include "files.h"

#include "image/heat.h"

#include <argand/compare.h>

enum { PAIRS = 10 };
static const int sizes[PAIRS][2] = { { 64, 48 }, { 150, 131 }, { 140, 33 }, { 96, 96 },
                                     { 33, 31 }, { 200, 140 }, { 80, 60 },  { 1, 200 },
                                     { 32, 32 }, { 130, 130 } };

static int noise(int x, int y, int c, int seed)
{
    uint32_t h = (uint32_t)x * 374761393u + (uint32_t)y * 668265263u + (uint32_t)c * 2246822519u +
                 (uint32_t)seed * 3266489917u;
    h = (h ^ h >> 13) * 1274126177u;
    return (int)((h ^ h >> 16) >> 24);
}

static int disk(int x, int y, int c, int which)
{
    static const int colors[2][3] = { { 20, 40, 90 }, { 230, 120, 40 } };
    int dx = 2 * x - 200, dy = 2 * y - 140, diameter = 100 + 2 * which;
    return colors[dx * dx + dy * dy < diameter * diameter][c];
}

static int color(int pair, int which, int x, int y, int c)
{
    switch (pair) {
    case 0: { // a gradient, made brighter
        int v = (c == 0 ? x * 255 / 63 : c == 1 ? y * 255 / 47 : 128) + 8 * which;
        return v > 255 ? 255 : v;
    }
    case 1: return ((x + which) / 8 + y / 8) & 1 ? 220 : 30;           // moved by a pixel
    case 2: return noise(x, y, c, which);                              // nothing in common
    case 3: return which ? 127 : 255 * (x / 3 & 1);                    // lines and their mean
    case 4: return which && x == 16 && y == 15 ? 255 : 128;            // a firefly
    case 5: return disk(x, y, c, which);                               // a wider outline
    case 6: return c == 0 ? x * 255 / 79 : c == 1 ? y * 255 / 59 : 60; // less alpha
    case 7: return y * 239 / 199 + which * (noise(x, y, c, 7) / 16);   // noise on a gradient
    case 8: return c == 1 + which ? 255 : 0;                           // green and blue
    default: return noise(x / 7, y / 5, c, 9) * (8 - which) / 8;       // blocks, made darker
    }
}

static int sample(int pair, int which, int x, int y, int c)
{
    int alpha = pair == 6 ? x * 255 / 79 - 20 * which : 255;
    return c < 3 ? color(pair, which, x, y, c) : alpha > 0 ? alpha : 0;
}

static ag_image *make(uint32_t width, uint32_t height, ag_format format, const void *pixels)
{
    ag_image_desc desc = { width, height, format, pixels };
    ag_image *image;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    return image;
}

static ag_image *make_bytes(int pair, int which)
{
    int width = sizes[pair][0], height = sizes[pair][1];
    ag_image *image = make((uint32_t)width, (uint32_t)height, AG_FORMAT_RGBA8, NULL);
    uint8_t *out = image->pixels;
    for (int i = 0; i < width * height * 4; i++)
        out[i] = (uint8_t)sample(pair, which, i / 4 % width, i / 4 / width, i % 4);
    return image;
}

// The same over thirty stops.
static ag_image *make_floats(int pair, int which)
{
    int width = sizes[pair][0], height = sizes[pair][1];
    ag_image *image = make((uint32_t)width, (uint32_t)height, AG_FORMAT_RGBA32F, NULL);
    float *out = image->pixels;
    for (int i = 0; i < width * height * 4; i++) {
        float v = (float)sample(pair, which, i / 4 % width, i / 4 / width, i % 4) / 255;
        out[i] = i % 4 < 3 ? v * v * v * v * 20 : 1;
    }
    return image;
}

static ag_difference compare(ag_image *a, ag_image *b, float pixels_per_degree)
{
    ag_compare_options options = { .pixels_per_degree = pixels_per_degree };
    ag_difference d;
    assert_int_equal(ag_image_compare(NULL, a, b, &options, &d, NULL), AG_OK);
    ag_image_destroy(a);
    ag_image_destroy(b);
    return d;
}

static void test_bytes(void **state)
{
    (void)state;
    static const struct {
        double flip, flip_max, rmse_linear, rmse_srgb, psnr, ssim;
    } expected[PAIRS] = {
        { 0.17781, 0.23101, 0.03487, 0.03108, 30.14950, 0.99118 },
        { 0.25597, 0.70561, 0.24343, 0.25811, 11.76392, 0.65262 },
        { 0.45019, 0.96616, 0.42143, 0.41339, 7.67289, -0.01573 },
        { 0.61443, 0.94515, 0.57690, 0.50000, 6.02053, 0.00387 },
        { 0.00420, 0.37882, 0.02452, 0.01557, 36.15349, 0.95846 },
        { 0.04171, 0.70042, 0.05097, 0.05710, 24.86744, 0.94130 },
        { 0.23155, 0.34741, 0.07359, 0.04852, 26.28105, 0.98777 },
        { 0.17096, 0.26899, 0.03836, 0.03418, 29.32419, 0.85527 },
        { 1.00000, 1.00000, 0.81650, 0.81650, 1.76091, 0.20002 },
        { 0.40761, 0.65109, 0.11290, 0.07351, 22.67274, 0.98236 },
    };
    for (int p = 0; p < PAIRS; p++) {
        ag_difference d = compare(make_bytes(p, 0), make_bytes(p, 1), 67);
        assert_close((double)d.flip, expected[p].flip, 1e-4);
        assert_close((double)d.flip_max, expected[p].flip_max, 1e-4);
        assert_close(d.rmse_linear, expected[p].rmse_linear, 1e-5);
        assert_close(d.rmse_srgb, expected[p].rmse_srgb, 1e-5);
        assert_close(d.psnr_db, expected[p].psnr, 1e-4);
        assert_close(d.ssim, expected[p].ssim, 1e-4);
        assert_true(d.ev_start == 0 && d.ev_stop == 0);
    }
}

static void test_floats(void **state)
{
    (void)state;
    static const struct {
        int pair;
        double flip, flip_max, start, stop;
    } expected[] = {
        { 0, 0.28466, 0.42951, -3.13763, -0.16967 }, // 3 exposures
        { 1, 0.30520, 0.79239, -2.38666, 9.11122 },  // 12
        { 2, 0.54482, 0.97538, -3.17037, -0.26934 }, { 5, 0.07311, 0.96191, -0.73084, 6.08432 },
        { 9, 0.44576, 0.72817, -2.91219, -0.14664 },
    };
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        int p = expected[i].pair;
        ag_difference d = compare(make_floats(p, 0), make_floats(p, 1), 67);
        assert_close((double)d.flip, expected[i].flip, 1e-4);
        assert_close((double)d.flip_max, expected[i].flip_max, 1e-4);
        assert_close((double)d.ev_start, expected[i].start, 1e-4);
        assert_close((double)d.ev_stop, expected[i].stop, 1e-4);
    }
}

static void test_identical(void **state)
{
    (void)state;
    for (int p = 0; p < PAIRS; p++)
        for (int floats = 0; floats <= (p == 0); floats++) {
            ag_image *(*of)(int, int) = floats ? make_floats : make_bytes;
            ag_difference d = compare(of(p, 1), of(p, 1), 0);
            assert_true(d.flip == 0 && d.flip_max == 0);
            assert_true(d.rmse_linear == 0 && d.rmse_srgb == 0);
            assert_true(isinf(d.psnr_db) && d.psnr_db > 0);
            assert_close(d.ssim, 1, 1e-6);
        }
}

// What a hand can compute of two even pictures: linear 0.25 and 0.75 of one channel.
static void test_even(void **state)
{
    (void)state;
    const float a[4] = { 0.25f, 0, 0, 1 }, b[4] = { 0.75f, 0, 0, 1 };
    ag_difference d =
        compare(make(1, 1, AG_FORMAT_RGBA32F, a), make(1, 1, AG_FORMAT_RGBA32F, b), 0);
    double coded = 1.055 * (pow(0.75, 1 / 2.4) - pow(0.25, 1 / 2.4)) / sqrt(3);
    assert_close(d.rmse_linear, 0.5 / sqrt(3), 1e-7);
    assert_close(d.rmse_srgb, coded, 1e-6);
    assert_close(d.psnr_db, -10 * log10(coded * coded), 1e-4);
    assert_true(d.worst_x == 0 && d.worst_y == 0);
    // Half transparent black is grey over white; bytes as they are coded.
    const uint8_t glass[4] = { 0, 0, 0, 51 }, grey[4] = { 204, 204, 204, 255 };
    d = compare(make(1, 1, AG_FORMAT_RGBA8, glass), make(1, 1, AG_FORMAT_RGBA8, grey), 0);
    assert_close(d.rmse_srgb, 0, 1e-7);
    const float light_glass[4] = { 0, 0, 0, 0.25f }, light_grey[4] = { 0.75f, 0.75f, 0.75f, 1 };
    d = compare(make(1, 1, AG_FORMAT_RGBA32F, light_glass),
                make(1, 1, AG_FORMAT_RGBA32F, light_grey), 0);
    assert_true(d.rmse_linear == 0 && d.flip == 0);
}

// The firefly is seen where it is, and from afar less.
static void test_worst_place(void **state)
{
    (void)state;
    ag_difference near = compare(make_bytes(4, 0), make_bytes(4, 1), 40);
    ag_difference far = compare(make_bytes(4, 0), make_bytes(4, 1), 120);
    assert_int_equal(near.worst_x, 16);
    assert_int_equal(near.worst_y, 15);
    assert_true(near.flip_max > far.flip_max && far.flip_max > 0);
}

static void test_heat(void **state)
{
    (void)state;
    ag_image *green = make_bytes(8, 0), *blue = make_bytes(8, 1), *heat;
    ag_difference d;
    assert_int_equal(ag_image_compare(NULL, green, green, NULL, &d, &heat), AG_OK);
    assert_memory_equal(byte_pixel(heat, 31, 31), ((uint8_t[]) { 0, 0, 0, 255 }), 4);
    ag_image_destroy(heat);
    assert_int_equal(ag_image_compare(NULL, green, blue, NULL, &d, &heat), AG_OK);
    assert_int_equal(heat->width, 32);
    assert_int_equal(heat->height, 32);
    assert_memory_equal(byte_pixel(heat, 31, 31), ((uint8_t[]) { 255, 251, 206, 255 }), 4);
    ag_image_destroy(heat);
    ag_image_destroy(green);
    ag_image_destroy(blue);
}

static double lightness(const uint8_t rgb[4])
{
    double y = 0;
    for (int c = 0; c < 3; c++) {
        double v = rgb[c] / 255.0, weight = (double[]) { 0.2126, 0.7152, 0.0722 }[c];
        y += weight * (v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4));
    }
    return y > 0.008856 ? 116 * cbrt(y) - 16 : 903.3 * y;
}

static void test_heat_rises(void **state)
{
    (void)state;
    double before = -1;
    for (int i = 0; i <= 250; i++) {
        uint8_t rgba[4];
        heat_color((float)i / 250, rgba);
        double now = lightness(rgba);
        assert_true(now > before);
        assert_close(now, 98 * i / 250.0, 3);
        before = now;
    }
    uint8_t rgba[4];
    heat_color(NAN, rgba);
    assert_int_equal(rgba[0] + rgba[1] + rgba[2], 0);
}

// Black, almost black, and floats that are no light.
static void test_odd_floats(void **state)
{
    (void)state;
    enum { SIDE = 12, VALUES = SIDE * SIDE * 4 };
    static const float values[] = { 0, 1, -1, NAN, INFINITY, -INFINITY, 1e-45f, 3e38f };
    for (int i = 0; i < 24; i++) {
        float a[VALUES], b[VALUES];
        int lit = VALUES / 2 * (i / 8); // none, half, all
        for (int v = 0; v < VALUES; v++) {
            a[v] = v % 4 == 3 ? 1 : v < lit ? values[i % 8] : 0;
            b[v] = v % 4 == 3 ? 1 : v < lit ? values[(3 * i + 1) % 8] : 0;
        }
        ag_difference d = compare(make(SIDE, SIDE, AG_FORMAT_RGBA32F, a),
                                  make(SIDE, SIDE, AG_FORMAT_RGBA32F, b), 0);
        assert_true(d.flip >= 0 && d.flip <= 1 && d.flip_max >= d.flip);
        assert_true(isfinite(d.ev_start) && isfinite(d.ev_stop));
        assert_true(d.rmse_linear >= 0 && isfinite(d.rmse_linear) && d.rmse_srgb <= 1);
    }
}

static void refused(const ag_image *a, const ag_image *b, float ppd, const char *text)
{
    kept_log kept;
    ag_log log = log_that_keeps(&kept);
    ag_compare_options options = { .pixels_per_degree = ppd };
    ag_difference d;
    ag_image *heat;
    assert_int_equal(ag_image_compare(&log, a, b, &options, &d, &heat), AG_ERROR_ARGUMENT);
    assert_null(heat);
    assert_int_equal(kept.count, 1);
    assert_non_null(strstr(kept.text, text));
}

static void test_refused(void **state)
{
    (void)state;
    ag_image *small = make_bytes(8, 0), *large = make_bytes(0, 0), *floats = make_floats(8, 0);
    refused(small, large, 0, "32 x 32 and 64 x 48 pixels");
    refused(small, floats, 0, "one picture is of bytes, the other of floats");
    refused(small, small, 9, "9 pixels per degree; it has to be 10 to 500");
    refused(small, small, 501, "10 to 500");
    refused(small, small, NAN, "10 to 500");
    ag_image_destroy(small);
    ag_image_destroy(large);
    ag_image_destroy(floats);
    assert_true(compare(make_bytes(4, 0), make_bytes(4, 1), 10).flip > 0);
    assert_true(compare(make_bytes(4, 0), make_bytes(4, 1), 500).flip > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bytes),       cmocka_unit_test(test_floats),
        cmocka_unit_test(test_identical),   cmocka_unit_test(test_even),
        cmocka_unit_test(test_worst_place), cmocka_unit_test(test_heat),
        cmocka_unit_test(test_heat_rises),  cmocka_unit_test(test_odd_floats),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
