// sRGB and exposure against their standards, and what holds for all tone curves.
#include "physics/display.glsl"
#include "physics/exposure.glsl"

#include <argand/renderer.h>

#include "near.h"

static vec3 grey(float x)
{
    return vec3(x, x, x);
}

static void constants_are_the_public_ones(void **state)
{
    (void)state;
    assert_int_equal(TONEMAP_NEUTRAL, AG_TONEMAP_NEUTRAL);
    assert_int_equal(TONEMAP_NONE, AG_TONEMAP_NONE);
    assert_int_equal(TONEMAP_REINHARD, AG_TONEMAP_REINHARD);
    assert_int_equal(TONEMAP_ACES, AG_TONEMAP_ACES);
    assert_int_equal(TONEMAP_ACES_NARKOWICZ, AG_TONEMAP_ACES_NARKOWICZ);
    assert_int_equal(TONEMAP_AGX, AG_TONEMAP_AGX);
}

// IEC 61966-2-1: the joint of the branches and three points of the curve.
static void srgb_is_the_standard(void **state)
{
    (void)state;
    assert_near((double)color_srgb_encode(grey(0.0031308f))[0], 0.0404499, 1e-6);
    assert_near((double)color_srgb_encode(grey(0.18f))[0], 0.4613561, 1e-6);
    assert_near((double)color_srgb_encode(grey(1.0f))[0], 1.0, 1e-6);
    assert_near((double)color_srgb_decode(grey(0.5f))[1], 0.2140411, 1e-6);
    assert_near((double)color_srgb_decode(grey(0.04f))[2], 0.04 / 12.92, 1e-8);
    for (int i = 0; i < 256; i++) {
        float x = (float)i / 255.0f;
        assert_near((double)color_srgb_encode(color_srgb_decode(grey(x)))[0], (double)x, 1e-6);
    }
}

// What an sRGB target codes as x^(1/2.2): .5 is shown by code 186.1 of 255 instead of 187.5.
static void gamma_is_coded_through_srgb(void **state)
{
    (void)state;
    for (int i = 0; i <= 100; i++) {
        float x = (float)(i * i) * 1e-4f;
        vec3 handed = display(TONEMAP_NONE | DISPLAY_GAMMA_22, grey(x));
        assert_near((double)color_srgb_encode(handed)[0], pow((double)x, 1 / 2.2), 1e-6);
    }
    assert_near((double)display(TONEMAP_REINHARD, grey(3.0f))[1], 0.75, 1e-6);
}

static void luminance_is_rec_709(void **state)
{
    (void)state;
    assert_near((double)color_luminance(grey(1.0f)), 1.0, 1e-6);
    assert_near((double)color_luminance(vec3(0.0f, 1.0f, 0.0f)), 0.7152, 1e-7);
}

// Brighter never comes out darker, nor outside of [0, 1].
static void curves_rise(void **state)
{
    (void)state;
    for (uint kind = 0; kind < 6; kind++) {
        float last = -1.0f;
        for (int i = 0; i <= 200; i++) {
            float y = tonemap(kind, grey(0.001f * powf(1.06f, (float)i)))[1];
            assert_true(y >= last - 1e-6f && y >= 0.0f && y <= 1.0f);
            last = y;
        }
    }
}

// Light beyond all measure is white, not the NaN of an overflow.
static void endless_light_is_white(void **state)
{
    (void)state;
    const float lights[] = { 1e10f, 3e38f, INFINITY };
    for (uint kind = 0; kind < 6; kind++)
        for (int i = 0; i < 3; i++)
            assert_near((double)tonemap(kind, grey(lights[i]))[0], 1.0, 0.02);
}

static void exposure_is_the_standard(void **state)
{
    (void)state;
    assert_near((double)exposure_from_ev100(0.0f), 1.0 / 1.2, 1e-7);
    assert_near((double)exposure_from_ev100(15.0f), 1.0 / (1.2 * 32768.0), 1e-11);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constants_are_the_public_ones),
        cmocka_unit_test(srgb_is_the_standard),
        cmocka_unit_test(gamma_is_coded_through_srgb),
        cmocka_unit_test(luminance_is_rec_709),
        cmocka_unit_test(curves_rise),
        cmocka_unit_test(endless_light_is_white),
        cmocka_unit_test(exposure_is_the_standard),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
