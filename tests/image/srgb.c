// The sRGB tables against the formula of IEC 61966-2-1.
#include "files.h"

#include "image/srgb.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

static double coded(double v)
{
    return v <= 0.0031308 ? 12.92 * v : 1.055 * pow(v, 1 / 2.4) - 0.055;
}

static void check_code(const srgb_encoder *encoder, float v)
{
    double exact = 255 * coded((double)v);
    if (fabs(exact - floor(exact) - 0.5) < 1e-9) // pow's own error could decide
        return;
    if (srgb_encode(encoder, v) != (int)lround(exact))
        fail_msg("%.9g is coded as %d, not %.9g", (double)v, srgb_encode(encoder, v), exact);
}

static void test_encode(void **state)
{
    (void)state;
    srgb_encoder encoder;
    srgb_encoder_init(&encoder);
    for (int i = 0; i <= 1 << 18; i++)
        check_code(&encoder, (float)i / (1 << 18));
    for (float v = 0x1p-14f; v < 1; v *= 1.0001f)
        check_code(&encoder, v);
    for (int i = 1; i < 256; i++) { // the floats around each step
        float v = (float)srgb_to_linear((i - 0.5) / 255);
        for (float near = nextafterf(nextafterf(v, 0), 0), n = 0; n < 5; n++) {
            check_code(&encoder, near);
            near = nextafterf(near, 1);
        }
    }
    assert_int_equal(srgb_encode(&encoder, NAN), 0);
    assert_int_equal(srgb_encode(&encoder, -1), 0);
    assert_int_equal(srgb_encode(&encoder, -INFINITY), 0);
    assert_int_equal(srgb_encode(&encoder, INFINITY), 255);
    assert_int_equal(srgb_encode(&encoder, nextafterf(1, 0)), 255);
    assert_int_equal(srgb_encode(&encoder, FLT_MIN / 2), 0);
}

static void test_decode(void **state)
{
    (void)state;
    float table[256];
    srgb_decoder_init(table);
    srgb_encoder encoder;
    srgb_encoder_init(&encoder);
    for (int i = 0; i < 256; i++) {
        double v = i / 255.0;
        double exact = v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
        assert_close((double)table[i], exact, 1e-7 * exact);
        assert_int_equal(srgb_encode(&encoder, table[i]), i);
    }
    // published: middle grey 0.18 is 0.46135613 coded; code 188 is half the light
    assert_close(srgb_from_linear(0.18), 0.46135613, 1e-8);
    assert_close((double)table[188], 0.5, 0.003);
}

static void test_convert(void **state)
{
    (void)state;
    static const float floats[8] = { 0.18f, 2, -1, 0.5f, NAN, INFINITY, 0.5f, 7 };
    ag_image_desc desc = { 2, 1, AG_FORMAT_RGBA32F, floats };
    ag_image *image, *bytes, *back;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    assert_int_equal(image_convert(NULL, image, AG_FORMAT_RGBA8, &bytes), AG_OK);
    assert_memory_equal(bytes->pixels, ((const uint8_t[]) { 118, 255, 0, 128, 0, 255, 188, 255 }),
                        8);
    assert_int_equal(image_convert(NULL, bytes, AG_FORMAT_RGBA32F, &back), AG_OK);
    assert_close((double)float_pixel(back, 0, 0)[3], 128 / 255.0, 1e-7);
    assert_false(image_is_opaque(bytes));
    ag_image_destroy(back);
    assert_int_equal(image_over_white(NULL, bytes, &back), AG_OK);
    // 118 * 128 / 255 + 127
    assert_memory_equal(back->pixels, ((const uint8_t[]) { 186, 255, 127, 255, 0, 255, 188, 255 }),
                        8);
    assert_true(image_is_opaque(back));
    ag_image_destroy(back);
    ag_image_destroy(bytes);
    ag_image_destroy(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_encode),
        cmocka_unit_test(test_decode),
        cmocka_unit_test(test_convert),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
