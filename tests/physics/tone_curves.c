// Tone curves against their published definitions, typed again from the publications in double.
#include "physics/tonemap.glsl"

#include "near.h"

typedef struct color {
    double c[3];
} color;

static color through(uint kind, color in)
{
    vec3 out = tonemap(kind, vec3((float)in.c[0], (float)in.c[1], (float)in.c[2]));
    return (color) { { (double)out[0], (double)out[1], (double)out[2] } };
}

static double channel(uint kind, double grey)
{
    return through(kind, (color) { { grey, grey, grey } }).c[1];
}

static double least(color in)
{
    return fmin(fmin(in.c[0], in.c[1]), in.c[2]);
}

static double greatest(color in)
{
    return fmax(fmax(in.c[0], in.c[1]), in.c[2]);
}

static color transform(const double m[3][3], color in)
{
    color out;
    for (int i = 0; i < 3; i++)
        out.c[i] = m[i][0] * in.c[0] + m[i][1] * in.c[1] + m[i][2] * in.c[2];
    return out;
}

static color saturate(color in)
{
    for (int i = 0; i < 3; i++)
        in.c[i] = fmin(fmax(in.c[i], 0), 1);
    return in;
}

// ---- What was published ------------------------------------------------------

// Khronos PBR Neutral Specification: the equations of its README.
static const double F90 = 0.04, Ks = 0.8 - 0.04, Kd = 0.15;

static color neutral(color in)
{
    double x = least(in), f = x <= 2 * F90 ? x - x * x / (4 * F90) : F90;
    double p = greatest(in) - f, pn = 1 - (1 - Ks) * (1 - Ks) / (p + 1 - 2 * Ks);
    double g = 1 / (Kd * (p - pn) + 1);
    color out;
    for (int i = 0; i < 3; i++)
        out.c[i] = p <= Ks ? in.c[i] - f : (in.c[i] - f) * pn / p * g + pn * (1 - g);
    return out;
}

// The equations solved for c_in.
static color neutral_inverse(color out)
{
    double pn = greatest(out);
    if (pn > Ks) {
        double p = (1 - Ks) * (1 - Ks) / (1 - pn) - 1 + 2 * Ks, g = 1 / (Kd * (p - pn) + 1);
        for (int i = 0; i < 3; i++)
            out.c[i] = (out.c[i] - pn * (1 - g)) / g * p / pn;
    }
    double y = fmax(least(out), 0), f = y <= F90 ? sqrt(4 * F90 * y) - y : F90;
    for (int i = 0; i < 3; i++)
        out.c[i] += f;
    return out;
}

// Reinhard et al. 2002, equation 3.
static color reinhard(color in)
{
    for (int i = 0; i < 3; i++)
        in.c[i] = in.c[i] / (1 + in.c[i]);
    return in;
}

// Stephen Hill's ACES.hlsl in BakingLab; three.js, Filament and the Khronos sample viewer have
// the same matrices and fit, and divide by .6 first.
static color aces(color in)
{
    static const double into[3][3] = { { 0.59719, 0.35458, 0.04823 },
                                       { 0.07600, 0.90834, 0.01566 },
                                       { 0.02840, 0.13383, 0.83777 } };
    static const double from[3][3] = { { 1.60475, -0.53108, -0.07367 },
                                       { -0.10208, 1.10813, -0.00605 },
                                       { -0.00327, -0.07276, 1.07602 } };
    color v = transform(into, in);
    for (int i = 0; i < 3; i++) {
        double x = v.c[i] / 0.6;
        double a = x * (x + 0.0245786) - 0.000090537;
        double b = x * (0.983729 * x + 0.4329510) + 0.238081;
        v.c[i] = a / b;
    }
    return transform(from, v);
}

// Krzysztof Narkowicz, "ACES Filmic Tone Mapping Curve", 2016.
static color narkowicz(color in)
{
    const double a = 2.51, b = 0.03, c = 2.43, d = 0.59, e = 0.14;
    for (int i = 0; i < 3; i++) {
        double x = in.c[i];
        in.c[i] = (x * (a * x + b)) / (x * (c * x + d) + e);
    }
    return in;
}

// Troy Sobotka's sigmoid, as his configuration of 2022 makes its table: slope 2 through
// (10/16.5, .5), power 3 in the toe and 3.25 in the shoulder, scaled to meet (0, 0) and (1, 1).
static double agx_sigmoid(double x)
{
    const double pivot = 10 / 16.5, d = fabs(x - pivot);
    double power = x < pivot ? 3 : 3.25, run = x < pivot ? pivot : 1 - pivot;
    double a = pow(4, power) - pow(run, -power); // 2 run (1 + a run^power)^(-1/power) = 1/2
    return 0.5 + 2 * (x - pivot) * pow(1 + a * pow(d, power), -1 / power);
}

// Benjamin Wrensch's polynomial for it, "Minimal AgX Implementation".
static double agx_polynomial(double x)
{
    return 15.5 * pow(x, 6) - 40.14 * pow(x, 5) + 31.96 * pow(x, 4) - 6.868 * pow(x, 3) +
           0.4298 * pow(x, 2) + 0.1191 * x - 0.00232;
}

// The code values of the same, with matrices (by columns there) and range.
static color agx_code(color in, double sigmoid(double))
{
    static const double into[3][3] = {
        { 0.842479062253094, 0.0784335999999992, 0.0792237451477643 },
        { 0.0423282422610123, 0.878468636469772, 0.0791661274605434 },
        { 0.0423756549057051, 0.0784336, 0.879142973793104 },
    };
    static const double from[3][3] = {
        { 1.19687900512017, -0.0980208811401368, -0.0990297440797205 },
        { -0.0528968517574562, 1.15190312990417, -0.0989611768448433 },
        { -0.0529716355144438, -0.0980434501171241, 1.15107367264116 },
    };
    color v = transform(into, in);
    for (int i = 0; i < 3; i++) {
        double ev = fmin(fmax(log2(v.c[i]), -12.47393), 4.026069);
        v.c[i] = sigmoid((ev + 12.47393) / (4.026069 + 12.47393));
    }
    return saturate(transform(from, v));
}

static color agx(color in)
{
    color v = agx_code(in, agx_polynomial);
    for (int i = 0; i < 3; i++)
        v.c[i] = pow(v.c[i], 2.2);
    return v;
}

// ---- Colours -----------------------------------------------------------------

enum { LEVELS = 15, COLORS = LEVELS * LEVELS * LEVELS };

// Each channel 0, or from 1e-4 to 1e6 by factors of 10^(10/13): greys, saturated and all between.
static color color_of(int index)
{
    color out;
    for (int i = 0; i < 3; i++, index /= LEVELS) {
        int level = index % LEVELS;
        out.c[i] = level ? (double)(float)pow(10, -4 + (level - 1) * 10.0 / 13) : 0;
    }
    return out;
}

static void compare(uint kind, color definition(color), double tolerance)
{
    for (int k = 0; k < COLORS; k++) {
        color in = color_of(k), want = saturate(definition(in)), out = through(kind, in);
        for (int i = 0; i < 3; i++)
            assert_near(out.c[i], want.c[i], tolerance);
    }
}

static void curves_are_their_definitions(void **state)
{
    (void)state;
    compare(TONEMAP_NEUTRAL, neutral, 1e-6);
    compare(TONEMAP_REINHARD, reinhard, 1e-7);
    compare(TONEMAP_ACES, aces, 2e-6);
    compare(TONEMAP_ACES_NARKOWICZ, narkowicz, 1e-6);
    compare(TONEMAP_AGX, agx, 6e-6);
}

static void none_only_clips(void **state)
{
    (void)state;
    for (int k = 0; k < COLORS; k++)
        for (int i = 0; i < 3; i++)
            assert_true(through(TONEMAP_NONE, color_of(k)).c[i] == fmin(color_of(k).c[i], 1));
}

// ---- What the publications say of their curves -------------------------------

// "c_out = c_in - F90 for all input colors" with channels of .08 to .8: base colours come back.
static void neutral_keeps_base_colors(void **state)
{
    (void)state;
    for (int k = 0; k < 1000; k++) {
        color in = { { 0.08 + 0.08 * (k % 10), 0.08 + 0.08 * (k / 10 % 10),
                       0.08 + 0.08 * (k / 100) } };
        color out = through(TONEMAP_NEUTRAL, in);
        for (int i = 0; i < 3; i++)
            assert_near(out.c[i], in.c[i] - 0.04, 2e-7);
    }
}

// "This mapping is 1:1 and onto, and analytically invertible."
static void neutral_inverts(void **state)
{
    (void)state;
    for (int k = 0; k < COLORS; k++) {
        color in = color_of(k);
        if (greatest(in) > 4)
            continue; // a float near white does not hold it
        color back = neutral_inverse(through(TONEMAP_NEUTRAL, in));
        for (int i = 0; i < 3; i++)
            assert_near(back.c[i], in.c[i], 1e-3);
    }
}

// "There are no hue shifts (angle around the white axis)": differences of channels keep their
// ratios.
static void neutral_keeps_hues(void **state)
{
    (void)state;
    for (int k = 0; k < COLORS; k++) {
        color in = color_of(k), out = through(TONEMAP_NEUTRAL, in);
        double a = in.c[0] - in.c[1], b = in.c[1] - in.c[2], size = fabs(a) + fabs(b) + 1e-9;
        assert_near((out.c[0] - out.c[1]) * b / size, (out.c[1] - out.c[2]) * a / size, 2e-7);
    }
}

// "All partial derivatives are continuous", and so at both joints, for greys and for a hue.
static void neutral_is_smooth(void **state)
{
    (void)state;
    const double joints[] = { 0.08, 0.8 }, h = 2e-3;
    for (int j = 0; j < 2; j++)
        for (double blue = 0.5; blue <= 1; blue += 0.5) {
            double y[3];
            for (int i = 0; i < 3; i++) {
                double x = joints[j] + (i - 1) * h;
                y[i] = through(TONEMAP_NEUTRAL, (color) { { x, x, x * blue } }).c[0];
            }
            assert_near((y[2] - y[1]) / h, (y[1] - y[0]) / h, 0.04);
        }
}

// The reference transforms put middle grey at 4.8 of 48 nit; the factor 1 / .6 is the viewers'.
static void aces_has_middle_grey_at_a_tenth(void **state)
{
    (void)state;
    assert_near(channel(TONEMAP_ACES, 0.18 * 0.6), 0.1, 0.006);
}

// How far the polynomial is from the sigmoid, in code values: 1.5 steps of 8 bits on the grey
// axis, and what the outward matrix makes of it in colours.
static void agx_is_near_its_sigmoid(void **state)
{
    (void)state;
    double worst = 0;
    for (double x = 0; x <= 1; x += 1e-4)
        worst = fmax(worst, fabs(agx_polynomial(x) - agx_sigmoid(x)));
    assert_near(worst, 0.0058, 1e-4);
    for (int k = 0; k < COLORS; k++) {
        color in = color_of(k), want = agx_code(in, agx_sigmoid), out = through(TONEMAP_AGX, in);
        for (int i = 0; i < 3; i++)
            assert_near(pow(out.c[i], 1 / 2.2), want.c[i], 0.02);
    }
}

// The sigmoid's fixed points: black, white, and middle grey at half of the code values.
static void agx_is_anchored(void **state)
{
    (void)state;
    assert_near(agx_sigmoid(0), 0, 1e-12);
    assert_near(agx_sigmoid(1), 1, 1e-12);
    assert_near(pow(channel(TONEMAP_AGX, 0.18), 1 / 2.2), 0.5, 0.004);
    assert_near(pow(channel(TONEMAP_AGX, 0.18 * 0x1p-10), 1 / 2.2), 0, 0.004);
    assert_near(pow(channel(TONEMAP_AGX, 0.18 * 90.51), 1 / 2.2), 1, 0.004); // 2^6.5
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_are_their_definitions),
        cmocka_unit_test(none_only_clips),
        cmocka_unit_test(neutral_keeps_base_colors),
        cmocka_unit_test(neutral_inverts),
        cmocka_unit_test(neutral_keeps_hues),
        cmocka_unit_test(neutral_is_smooth),
        cmocka_unit_test(aces_has_middle_grey_at_a_tenth),
        cmocka_unit_test(agx_is_near_its_sigmoid),
        cmocka_unit_test(agx_is_anchored),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
