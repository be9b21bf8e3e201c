// Halves: all 65536 of them, and the rounding between any two.
#include "files.h"

#include "image/half.h"

#include <math.h>

// From the definition (IEEE 754-2008, 3.4), in double.
static double value_of(unsigned half)
{
    int exponent = half >> 10 & 31, fraction = half & 1023;
    double v = exponent == 31 ? (fraction ? (double)NAN : (double)INFINITY)
               : exponent     ? ldexp(1024 + fraction, exponent - 25)
                              : ldexp(fraction, -24);
    return half & 0x8000 ? -v : v;
}

static void test_all_to_float(void **state)
{
    (void)state;
    static uint16_t in[65536 + 3];
    static float out[65536 + 3];
    for (unsigned i = 0; i < 65536 + 3; i++)
        in[i] = (uint16_t)i;
    half_to_floats(in, out, 65536 + 3);
    for (unsigned i = 0; i < 65536; i++) {
        double exact = value_of(i);
        float one = half_to_float((uint16_t)i);
        if (isnan(exact)) {
            assert_true(isnan(one) && isnan(out[i]));
            continue;
        }
        assert_true((double)one == exact && (double)out[i] == exact);
        assert_true(!signbit(one) == !signbit(exact) && !signbit(out[i]) == !signbit(exact));
        assert_int_equal(half_from_float(one), i);
    }
}

static void check(float v, unsigned expected)
{
    float in[11];
    uint16_t out[11];
    for (int i = 0; i < 11; i++)
        in[i] = v;
    half_from_floats(in, out, 11); // eight at once and three alone
    if (half_from_float(v) != expected || out[0] != expected || out[10] != expected)
        fail_msg("%.9g: %04x %04x %04x, not %04x", (double)v, half_from_float(v), out[0], out[10],
                 expected);
}

// Between two neighbours: below the middle the lower, above it the upper, on it the even.
static void test_rounding(void **state)
{
    (void)state;
    for (unsigned h = 0; h < 0x7c00; h++) {
        double low = value_of(h), high = h == 0x7bff ? 65536 : value_of(h + 1);
        float middle = (float)((low + high) / 2); // exact in float
        check(middle, h + (h & 1));
        check(nextafterf(middle, 0), h);
        check(nextafterf(middle, INFINITY), h + 1);
        check(-middle, 0x8000 | (h + (h & 1)));
    }
    check(INFINITY, 0x7c00);
    check(-INFINITY, 0xfc00);
    check(1e30f, 0x7c00);
    check(1e-30f, 0);
    check(-0.0f, 0x8000);
    assert_true(isnan(half_to_float(half_from_float(NAN))));
}

static void test_clamped(void **state)
{
    (void)state;
    static const float in[9] = { 1e9f, -1e9f, INFINITY, -INFINITY, NAN, 65504, 65519, 1, -2 };
    static const uint16_t expected[9] = { 0x7bff, 0xfbff, 0x7bff, 0xfbff, 0,
                                          0x7bff, 0x7bff, 0x3c00, 0xc000 };
    uint16_t out[9];
    half_from_floats_clamped(in, out, 9);
    for (int i = 0; i < 9; i++) {
        assert_int_equal(out[i], expected[i]);
        assert_int_equal(half_from_float_clamped(in[i]), expected[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_to_float),
        cmocka_unit_test(test_rounding),
        cmocka_unit_test(test_clamped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
