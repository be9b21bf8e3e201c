// Every codec against files that were made without it (make_files.py).
#include "files.h"

#include <math.h>

static void check_size(const ag_image *image, uint32_t width, uint32_t height)
{
    assert_int_equal(ag_image_width(image), width);
    assert_int_equal(ag_image_height(image), height);
}

// The 8 bits that stand for `value` of `depth` bits (ISO/IEC 15948, 13.12).
static unsigned to_byte(unsigned value, int depth)
{
    return (unsigned)lround(value * 255.0 / ((1 << depth) - 1));
}

// `channels` 1 to 4: gray, gray and alpha, RGB, RGBA.
static void check_png(const char *name, int channels, int depth)
{
    ag_image *image = load_file(name);
    check_size(image, FILE_WIDTH, FILE_HEIGHT);
    for (int y = 0; y < FILE_HEIGHT; y++)
        for (int x = 0; x < FILE_WIDTH; x++) {
            unsigned s[4];
            for (int c = 0; c < 4; c++)
                s[c] = to_byte(file_sample(x, y, c, depth), depth);
            const uint8_t *p = byte_pixel(image, (uint32_t)x, (uint32_t)y);
            for (int c = 0; c < 3; c++)
                assert_int_equal(p[c], s[channels >= 3 ? c : 0]);
            assert_int_equal(p[3], channels % 2 ? 255 : s[channels - 1]);
        }
    ag_image_destroy(image);
}

static void test_png_kinds(void **state)
{
    (void)state;
    check_png("png/gray-1.png", 1, 1);
    check_png("png/gray-2.png", 1, 2);
    check_png("png/gray-4.png", 1, 4);
    check_png("png/gray-8.png", 1, 8);
    check_png("png/gray-16.png", 1, 16);
    check_png("png/gray-alpha-8.png", 2, 8);
    check_png("png/gray-alpha-16.png", 2, 16);
    check_png("png/rgb-8.png", 3, 8);
    check_png("png/rgb-16.png", 3, 16);
    check_png("png/rgba-8.png", 4, 8);
    check_png("png/rgba-16.png", 4, 16);
    check_png("png/interlaced-rgb-8.png", 3, 8);
    check_png("png/interlaced-gray-2.png", 1, 2);
    check_png("png/extra-chunks.png", 4, 8); // gAMA among them, which is not applied
}

static void check_palette(const char *name, int depth)
{
    ag_image *image = load_file(name);
    for (int y = 0; y < FILE_HEIGHT; y++)
        for (int x = 0; x < FILE_WIDTH; x++) {
            unsigned i = file_sample(x, y, 0, depth);
            const uint8_t *p = byte_pixel(image, (uint32_t)x, (uint32_t)y);
            assert_int_equal(p[0], i * 5 & 255);
            assert_int_equal(p[1], i * 11 & 255);
            assert_int_equal(p[2], 255 - i);
            assert_int_equal(p[3], i < 1u << (depth - 1) ? i * 3 & 255 : 255);
        }
    ag_image_destroy(image);
}

static void test_png_palettes(void **state)
{
    (void)state;
    check_palette("png/palette-1.png", 1);
    check_palette("png/palette-2.png", 2);
    check_palette("png/palette-4.png", 4);
    check_palette("png/palette-8.png", 8);
}

// One colour is transparent, compared in all of its bits.
static void test_png_color_keys(void **state)
{
    (void)state;
    const char *const names[] = { "png/gray-16-key.png", "png/rgb-8-key.png" };
    for (int n = 0; n < 2; n++) {
        ag_image *image = load_file(names[n]);
        for (uint32_t y = 0; y < FILE_HEIGHT; y++)
            for (uint32_t x = 0; x < FILE_WIDTH; x++)
                assert_int_equal(byte_pixel(image, x, y)[3], x == 3 && y == 2 ? 0 : 255);
        ag_image_destroy(image);
    }
}

static void check_block(const char *name, uint32_t block, int r, int g, int b)
{
    ag_image *image = load_file(name);
    for (uint32_t y = 0; y < 8; y++)
        for (uint32_t x = block * 8; x < block * 8 + 8 && x < image->width; x++) {
            const uint8_t *p = byte_pixel(image, x, y);
            assert_in_range(p[0], r > 0 ? r - 1 : 0, r + 1);
            assert_in_range(p[1], g > 0 ? g - 1 : 0, g + 1);
            assert_in_range(p[2], b > 0 ? b - 1 : 0, b + 1);
            assert_int_equal(p[3], 255);
        }
    ag_image_destroy(image);
}

// The conversion of JFIF (ITU-T T.871, 7).
static void check_color(const char *name, uint32_t block, double y, double cb, double cr)
{
    double rgb[3] = { 128 + y + 1.402 * cr, 128 + y - 0.344136 * cb - 0.714136 * cr,
                      128 + y + 1.772 * cb };
    for (int c = 0; c < 3; c++)
        rgb[c] = fmin(fmax(rgb[c], 0), 255);
    check_block(name, block, (int)lround(rgb[0]), (int)lround(rgb[1]), (int)lround(rgb[2]));
}

static void test_jpeg(void **state)
{
    (void)state;
    static const int gray[] = { 0, 100, 128, 255 };
    for (uint32_t i = 0; i < 4; i++)
        check_block("jpeg/gray.jpg", i, gray[i], gray[i], gray[i]);
    check_color("jpeg/color.jpg", 0, -20, 30, -40);
    check_color("jpeg/color.jpg", 1, 40, -50, 20);
    check_color("jpeg/color.jpg", 2, -128, 0, 0);
    check_block("jpeg/rgb.jpg", 0, 100, 200, 150);
    check_block("jpeg/rgb.jpg", 1, 228, 28, 128);
    check_block("jpeg/cmyk.jpg", 0, 200, 100, 150); // key 255: no black
    check_block("jpeg/cmyk.jpg", 1, 64, 64, 64);    // 128 * 128 / 255
    ag_image *image = load_file("jpeg/part-block.jpg");
    check_size(image, 11, 8);
    ag_image_destroy(image);
}

static void test_webp(void **state)
{
    (void)state;
    for (int alpha = 0; alpha < 2; alpha++) {
        ag_image *image = load_file(alpha ? "webp/alpha.webp" : "webp/opaque.webp");
        check_size(image, FILE_WIDTH, FILE_HEIGHT);
        for (uint32_t y = 0; y < FILE_HEIGHT; y++)
            for (uint32_t x = 0; x < FILE_WIDTH; x++) {
                const uint8_t *p = byte_pixel(image, x, y);
                assert_int_equal(p[0], 33);
                assert_int_equal(p[1], (x + y) % 2 ? 200 : 20);
                assert_int_equal(p[2], 77);
                assert_int_equal(p[3], alpha ? 100 : 255);
            }
        ag_image_destroy(image);
    }
}

static double hdr_value(int x, int y, int c)
{
    int exponent = 120 + (int)file_sample(x, y, 3, 4);
    return ldexp(128 + file_sample(x, y, c, 7), exponent - 136);
}

static void check_hdr(const char *name, const double factor[3])
{
    ag_image *image = load_file(name);
    check_size(image, FILE_WIDTH, FILE_HEIGHT);
    for (int y = 0; y < FILE_HEIGHT; y++)
        for (int x = 0; x < FILE_WIDTH; x++) {
            const float *p = float_pixel(image, (uint32_t)x, (uint32_t)y);
            for (int c = 0; c < 3; c++)
                assert_true((double)p[c] == hdr_value(x, y, c) * factor[c]);
            assert_true(p[3] == 1);
        }
    ag_image_destroy(image);
}

static void test_hdr(void **state)
{
    (void)state;
    static const double one[3] = { 1, 1, 1 };
    check_hdr("hdr/flat.hdr", one);
    check_hdr("hdr/new.hdr", one);
    for (int i = 0; i < 8; i++) {
        char name[64];
        snprintf(name, sizeof name, "hdr/%s-%s-%s.hdr", i & 4 ? "columns" : "rows",
                 i & 2 ? "up" : "down", i & 1 ? "left" : "right");
        check_hdr(name, one);
    }
    // exposures 4 * 0.5; corrections 1, 2, 0.25
    check_hdr("hdr/exposure.hdr", (const double[]) { 0.5, 0.25, 2 });
}

static void test_hdr_old_runs(void **state)
{
    (void)state;
    ag_image *image = load_file("hdr/old.hdr");
    for (int y = 0; y < FILE_HEIGHT; y++)
        for (int x = 0; x < FILE_WIDTH; x++)
            assert_true((double)float_pixel(image, (uint32_t)x, (uint32_t)y)[1] ==
                        hdr_value(x == FILE_WIDTH - 1 ? x : 0, y, 1));
    ag_image_destroy(image);
    image = load_file("hdr/old-long.hdr");
    check_size(image, 302, 1);
    for (uint32_t x = 0; x < 302; x++)
        assert_true((double)float_pixel(image, x, 0)[2] == hdr_value(x ? 1 : 0, 0, 2));
    ag_image_destroy(image);
}

static double exr_value(int x, int y, int c)
{
    return file_sample(x, y, c, 8) / 256.0;
}

static void check_exr(const char *name, double scale)
{
    ag_image *image = load_file(name);
    check_size(image, FILE_WIDTH, FILE_HEIGHT);
    for (int y = 0; y < FILE_HEIGHT; y++)
        for (int x = 0; x < FILE_WIDTH; x++) {
            const float *p = float_pixel(image, (uint32_t)x, (uint32_t)y);
            for (int c = 0; c < 3; c++)
                assert_true((double)p[c] == exr_value(x, y, c) * scale);
            assert_true(p[3] == 1);
        }
    ag_image_destroy(image);
}

static void test_exr(void **state)
{
    (void)state;
    check_exr("exr/half-rgb.exr", 1);
    check_exr("exr/half-rgb-zip.exr", 1);
    check_exr("exr/half-rgb-zips.exr", 1);
    check_exr("exr/tiles.exr", 1);
    check_exr("exr/mip-tiles.exr", 1);
    check_exr("exr/uint.exr", 256);
}

// Colours are divided by alpha, except where that is 0.
static void test_exr_alpha(void **state)
{
    (void)state;
    const char *const names[] = { "exr/float-rgba.exr", "exr/mixed.exr" };
    for (int n = 0; n < 2; n++) {
        ag_image *image = load_file(names[n]);
        for (int y = 0; y < FILE_HEIGHT; y++)
            for (int x = 0; x < FILE_WIDTH; x++) {
                const float *p = float_pixel(image, (uint32_t)x, (uint32_t)y);
                double alpha = exr_value(x, y, 3);
                assert_true((double)p[3] == alpha);
                for (int c = 0; c < 3; c++) {
                    double v = exr_value(x, y, c);
                    assert_close((double)p[c], alpha > 0 ? v / alpha : v,
                                 1e-6 * (1 + v / (alpha + 1e-9)));
                }
            }
        ag_image_destroy(image);
    }
}

// Written by the OpenEXR library itself: 20 x 18, value (79 x + 100 y + 2001 c + 1234) mod
// 65536, its upper 8 bits, / 256.  B44 keeps about 6 bits.
static void test_exr_compressions(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double tolerance;
    } files[] = { { "exr/library-rle.exr", 0 },
                  { "exr/library-piz.exr", 0 },
                  { "exr/library-pxr24.exr", 0 },
                  { "exr/library-b44.exr", 1.0 / 64 },
                  { "exr/library-b44a.exr", 1.0 / 64 } };
    for (int i = 0; i < 5; i++) {
        ag_image *image = load_file(files[i].name);
        check_size(image, 20, 18);
        for (uint32_t y = 0; y < 18; y++)
            for (uint32_t x = 0; x < 20; x++)
                for (uint32_t c = 0; c < 3; c++) {
                    uint32_t v = (79 * x + 100 * y + 2001 * c + 1234) % 65536 >> 8;
                    assert_close((double)float_pixel(image, x, y)[c], v / 256.0,
                                 files[i].tolerance);
                }
        ag_image_destroy(image);
    }
}

static void test_exr_luminance(void **state)
{
    (void)state;
    ag_image *image = load_file("exr/luminance.exr");
    for (int y = 0; y < FILE_HEIGHT; y++)
        for (int x = 0; x < FILE_WIDTH; x++)
            for (int c = 0; c < 3; c++)
                assert_true((double)float_pixel(image, (uint32_t)x, (uint32_t)y)[c] ==
                            exr_value(x, y, 0));
    ag_image_destroy(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_png_kinds),
        cmocka_unit_test(test_png_palettes),
        cmocka_unit_test(test_png_color_keys),
        cmocka_unit_test(test_jpeg),
        cmocka_unit_test(test_webp),
        cmocka_unit_test(test_hdr),
        cmocka_unit_test(test_hdr_old_runs),
        cmocka_unit_test(test_exr),
        cmocka_unit_test(test_exr_alpha),
        cmocka_unit_test(test_exr_luminance),
        cmocka_unit_test(test_exr_compressions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
