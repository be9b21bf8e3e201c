// Tone curves, sRGB and exposure against their standards and numbers worked out by hand.
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

// Khronos PBR Neutral, by its specification: grey .18 loses 4 %; below start it shifts
// only; white 10 is compressed to 1 - .24^2 / (9.96 + .24 - .76); saturated blue turns white.
static void neutral_is_the_specification(void **state)
{
    (void)state;
    assert_near((double)tonemap(TONEMAP_NEUTRAL, grey(0.18f))[0], 0.14, 1e-6);
    assert_near((double)tonemap(TONEMAP_NEUTRAL, grey(0.79f))[0], 0.75, 1e-6);
    assert_near((double)tonemap(TONEMAP_NEUTRAL, grey(0.04f))[0], 6.25 * 0.0016, 1e-6);
    assert_near((double)tonemap(TONEMAP_NEUTRAL, grey(10.0f))[0], 0.9938983, 1e-6);
    vec3 blue = tonemap(TONEMAP_NEUTRAL, vec3(0.0f, 0.0f, 10.0f));
    assert_near((double)blue[2], 0.9939241, 1e-6);
    assert_near((double)blue[0], 0.5711418, 1e-5);
}

// The matrices and the fit worked out in double elsewhere.
static void aces_is_the_definition(void **state)
{
    (void)state;
    assert_near((double)tonemap(TONEMAP_ACES, grey(0.18f))[0], 0.2131054, 1e-6);
    assert_near((double)tonemap(TONEMAP_ACES, grey(1.0f))[1], 0.7633974, 1e-6);
    vec3 c = tonemap(TONEMAP_ACES, vec3(1.0f, 0.5f, 0.25f));
    assert_near((double)c[0], 0.7892629, 1e-6);
    assert_near((double)c[1], 0.5691753, 1e-6);
    assert_near((double)c[2], 0.3642314, 1e-6);
    assert_near((double)tonemap(TONEMAP_ACES_NARKOWICZ, grey(1.0f))[0], 2.54 / 3.16, 1e-6);
    assert_near((double)tonemap(TONEMAP_ACES_NARKOWICZ, grey(0.18f))[0],
                (0.18 * (2.51 * 0.18 + 0.03)) / (0.18 * (2.43 * 0.18 + 0.59) + 0.14), 1e-6);
}

static void reinhard_and_none(void **state)
{
    (void)state;
    assert_near((double)tonemap(TONEMAP_REINHARD, grey(1.0f))[0], 0.5, 1e-7);
    assert_near((double)tonemap(TONEMAP_REINHARD, grey(3.0f))[0], 0.75, 1e-7);
    assert_near((double)tonemap(TONEMAP_NONE, grey(0.3f))[0], 0.3, 1e-7);
    assert_near((double)tonemap(TONEMAP_NONE, grey(3.0f))[0], 1.0, 0.0);
}

// Sobotka's sigmoid turns about middle grey, which it gives the code value .18^(1/2.4);
// the ends of its 16.5 stops are black and white.  The polynomial may miss by .01.
static void agx_is_anchored(void **state)
{
    (void)state;
    float code = powf(tonemap(TONEMAP_AGX, grey(0.18f))[0], 1.0f / 2.2f);
    assert_near((double)code, pow(0.18, 1.0 / 2.4), 0.01);
    assert_near((double)tonemap(TONEMAP_AGX, grey(0.0f))[0], 0.0, 1e-3);
    assert_near((double)tonemap(TONEMAP_AGX, grey(16.3f))[0], 1.0, 0.02);
    assert_near((double)tonemap_agx_log(1.0f), 12.47393 / 16.499999, 1e-6);
    vec3 red = tonemap(TONEMAP_AGX, vec3(4.0f, 0.0f, 0.0f)); // goes to white, not to a clip
    assert_true(red[1] > 0.02f && red[0] > red[1]);
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
        cmocka_unit_test(neutral_is_the_specification),
        cmocka_unit_test(aces_is_the_definition),
        cmocka_unit_test(reinhard_and_none),
        cmocka_unit_test(agx_is_anchored),
        cmocka_unit_test(curves_rise),
        cmocka_unit_test(endless_light_is_white),
        cmocka_unit_test(exposure_is_the_standard),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
