// Mip chains against box filters in double precision, each level from the one before it.
#include "files.h"

#include "image/mip.h"

#include <stdlib.h>

// The part of input texel `i` in output texel `o` when `n` texels become `m`.
static double overlap(int n, int m, int i, int o)
{
    double left = fmax(i, (double)o * n / m), right = fmin(i + 1, (double)(o + 1) * n / m);
    return right > left ? (right - left) * m / n : 0;
}

static bool is_srgb(image_mip_kind kind)
{
    return kind == IMAGE_MIP_SRGB || kind == IMAGE_MIP_SRGB_OPAQUE;
}

static double decode(image_mip_kind kind, int v)
{
    double c = v / 255.0;
    if (kind == IMAGE_MIP_NORMAL)
        return 2 * c - 1;
    if (kind == IMAGE_MIP_LINEAR)
        return c;
    return c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
}

// 255 times the code that is wanted, not yet rounded.
static void reference(image_mip_kind kind, const uint8_t *in, int w, int h, int ow, int oh, int ox,
                      int oy, double out[4])
{
    double plain[3] = { 0 }, weighted[3] = { 0 }, alpha = 0, length = 0;
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++) {
            double part = overlap(w, ow, x, ox) * overlap(h, oh, y, oy);
            const uint8_t *p = in + ((size_t)y * (size_t)w + (size_t)x) * 4;
            alpha += part * p[3] / 255;
            for (int c = 0; part > 0 && c < 3; c++) {
                plain[c] += part * decode(kind, p[c]);
                weighted[c] += part * p[3] / 255 * decode(kind, p[c]);
            }
        }
    for (int c = 0; c < 3; c++)
        length += plain[c] * plain[c];
    for (int c = 0; c < 3; c++) {
        double v = kind == IMAGE_MIP_SRGB && alpha > 0 ? weighted[c] / alpha : plain[c];
        if (is_srgb(kind))
            v = v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
        if (kind == IMAGE_MIP_NORMAL)
            v = (v / sqrt(length) + 1) / 2;
        out[c] = 255 * v;
    }
    out[3] = kind == IMAGE_MIP_SRGB_OPAQUE ? 255 : 255 * alpha;
}

static void check_level(image_mip_kind kind, const uint8_t *in, int w, int h, const uint8_t *level,
                        int ow, int oh)
{
    for (int y = 0; y < oh; y++)
        for (int x = 0; x < ow; x++) {
            double exact[4];
            reference(kind, in, w, h, ow, oh, x, y, exact);
            const uint8_t *p = level + ((size_t)y * (size_t)ow + (size_t)x) * 4;
            for (int c = 0; c < 4; c++) // rounded, but for what the table of sums leaves open
                assert_close(p[c], exact[c], is_srgb(kind) && c < 3 ? 0.58 : 0.501);
        }
}

static ag_image *make(int w, int h, bool opaque)
{
    ag_image_desc desc = { (uint32_t)w, (uint32_t)h, AG_FORMAT_RGBA8, NULL };
    ag_image *image;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    uint32_t random = (uint32_t)(w * 1000 + h);
    uint8_t *p = image->pixels;
    for (size_t i = 0; i < (size_t)w * (size_t)h * 4; i++) {
        random = random * 1664525 + 1013904223;
        unsigned v = random >> 24;
        p[i] = (uint8_t)(i % 4 == 3 ? (opaque ? 255 : v < 100 ? 0 : v) : v);
    }
    return image;
}

static void check_chain(image_mip_kind kind, int w, int h, bool opaque)
{
    ag_image *image = make(w, h, opaque);
    uint8_t *levels = image_mips(image, kind);
    assert_non_null(levels);
    const uint8_t *in = image->pixels;
    uint32_t width = (uint32_t)w, height = (uint32_t)h;
    uint32_t count = image_mip_count(width, height);
    for (uint32_t l = 1; l < count; l++) {
        int ow = w > 1 ? w / 2 : 1, oh = h > 1 ? h / 2 : 1;
        const uint8_t *level = levels + image_mip_offset(width, height, l);
        check_level(kind, in, w, h, level, ow, oh);
        in = level;
        w = ow;
        h = oh;
    }
    assert_true(w == 1 && h == 1);
    free(levels);
    ag_image_destroy(image);
}

static void test_chains(void **state)
{
    (void)state;
    static const int sizes[][2] = { { 1, 1 },  { 2, 2 },  { 32, 32 }, { 64, 16 },
                                    { 16, 1 }, { 1, 16 }, { 31, 31 }, { 33, 20 },
                                    { 3, 2 },  { 47, 1 }, { 28, 23 }, { 40, 40 } };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        for (int kind = 0; kind <= IMAGE_MIP_NORMAL; kind++)
            for (int opaque = 0; opaque < 2; opaque++)
                check_chain((image_mip_kind)kind, sizes[i][0], sizes[i][1], opaque);
}

static void test_layout(void **state)
{
    (void)state;
    assert_int_equal(image_mip_count(1, 1), 1);
    assert_int_equal(image_mip_count(2048, 2048), 12);
    assert_int_equal(image_mip_count(5, 3), 3);
    assert_int_equal(image_mip_offset(5, 3, 1), 0);
    assert_int_equal(image_mip_offset(5, 3, 2), 2 * 1 * 4);
    assert_int_equal(image_mip_offset(5, 3, 3), (2 * 1 + 1) * 4);
}

static void one_level(const uint8_t in[16], image_mip_kind kind, uint8_t out[4])
{
    ag_image_desc desc = { 2, 2, AG_FORMAT_RGBA8, in };
    ag_image *image;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    uint8_t *level = image_mips(image, kind);
    assert_non_null(level);
    memcpy(out, level, 4);
    free(level);
    ag_image_destroy(image);
}

static void test_known_texels(void **state)
{
    (void)state;
    uint8_t out[4];
    // black and white: half the light is code 188, half the number 128
    static const uint8_t checks[16] = { 0,   0,   0,   255, 255, 255, 255, 255,
                                        255, 255, 255, 255, 0,   0,   0,   255 };
    one_level(checks, IMAGE_MIP_SRGB, out);
    assert_memory_equal(out, ((const uint8_t[]) { 188, 188, 188, 255 }), 4);
    one_level(checks, IMAGE_MIP_LINEAR, out);
    assert_memory_equal(out, ((const uint8_t[]) { 128, 128, 128, 255 }), 4);
    // green behind transparent texels does not bleed into red
    static const uint8_t leaf[16] = { 200, 0, 0, 255, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0 };
    one_level(leaf, IMAGE_MIP_SRGB, out);
    assert_memory_equal(out, ((const uint8_t[]) { 200, 0, 0, 64 }), 4);
    // unless alpha means nothing
    one_level(leaf, IMAGE_MIP_SRGB_OPAQUE, out);
    assert_memory_equal(out, ((const uint8_t[]) { 106, 225, 0, 255 }), 4);
    // wholly transparent: the colours' own mean
    static const uint8_t clear[16] = { 90, 9, 0, 0, 90, 9, 0, 0, 90, 9, 0, 0, 90, 9, 0, 0 };
    one_level(clear, IMAGE_MIP_SRGB, out);
    assert_memory_equal(out, ((const uint8_t[]) { 90, 9, 0, 0 }), 4);
    // two normals 45 degrees to either side; four that cancel out
    static const uint8_t valley[16] = { 218, 128, 218, 255, 37, 128, 218, 255,
                                        218, 128, 218, 255, 37, 128, 218, 255 };
    one_level(valley, IMAGE_MIP_NORMAL, out);
    assert_in_range(out[0], 127, 128);
    assert_in_range(out[2], 254, 255);
    static const uint8_t none[16] = { 0, 255, 0, 255, 255, 0, 255, 255,
                                      0, 255, 0, 255, 255, 0, 255, 255 };
    one_level(none, IMAGE_MIP_NORMAL, out);
    assert_memory_equal(out, ((const uint8_t[]) { 128, 128, 255, 255 }), 4);
}

static void check_halve(int w, int h)
{
    ag_image_desc desc = { (uint32_t)w, (uint32_t)h, AG_FORMAT_RGBA32F, NULL };
    ag_image *image, *half;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    float *p = image->pixels;
    for (int i = 0; i < w * h * 4; i++)
        p[i] = (float)(i * 7919 % 1009) / 100;
    assert_int_equal(image_halve(NULL, image, &half), AG_OK);
    int ow = w > 1 ? w / 2 : 1, oh = h > 1 ? h / 2 : 1;
    assert_int_equal(half->width, ow);
    assert_int_equal(half->height, oh);
    for (int o = 0; o < ow * oh * 4; o++) {
        double sum = 0;
        for (int i = o % 4; i < w * h * 4; i += 4)
            sum += (double)p[i] * overlap(w, ow, i / 4 % w, o / 4 % ow) *
                   overlap(h, oh, i / 4 / w, o / 4 / ow);
        assert_close((double)((float *)half->pixels)[o], sum, 1e-5);
    }
    ag_image_destroy(half);
    ag_image_destroy(image);
}

static void test_halve(void **state)
{
    (void)state;
    check_halve(32, 16);
    check_halve(33, 17);
    check_halve(1, 6);
    check_halve(7, 1);
    check_halve(1, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_chains),
        cmocka_unit_test(test_layout),
        cmocka_unit_test(test_known_texels),
        cmocka_unit_test(test_halve),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
