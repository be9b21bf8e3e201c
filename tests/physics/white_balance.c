// White balance against spectra of light, and published white points.
#include "physics/white_balance.glsl"

#include "physics/color.glsl"

#include "near.h"

// ---- Spectra ---------------------------------------------------------------------------

static double lobe(double nm, double peak, double below, double above)
{
    double t = (nm - peak) * (nm < peak ? below : above);
    return exp(-.5 * t * t);
}

// The CIE 1931 observer: Wyman, Sloan & Shirley 2013, "Simple Analytic Approximations to the CIE
// XYZ Color Matching Functions", equation 4.
static void observe(double nm, double power, double xyz[3])
{
    xyz[0] +=
        power * (.362 * lobe(nm, 442.0, .0624, .0374) + 1.056 * lobe(nm, 599.8, .0264, .0323) -
                 .065 * lobe(nm, 501.1, .0490, .0382));
    xyz[1] += power * (.821 * lobe(nm, 568.8, .0213, .0247) + .286 * lobe(nm, 530.9, .0613, .0322));
    xyz[2] +=
        power * (1.217 * lobe(nm, 437.0, .0845, .0278) + .681 * lobe(nm, 459.0, .0385, .0725));
}

// Planck's law; second radiation constant 1.438777e-2 m K.
static void black_body(double kelvin, double xyz[3])
{
    xyz[0] = xyz[1] = xyz[2] = 0;
    for (double nm = 360; nm <= 830; nm++)
        observe(nm, pow(nm / 560, -5) / expm1(1.438777e7 / (nm * kelvin)), xyz);
}

// Linear Rec. 709 of equal luminance: IEC 61966-2-1's matrix.
static vec3 rgb_of(const double xyz[3])
{
    double x = xyz[0] / xyz[1], z = xyz[2] / xyz[1];
    return vec3((float)(3.2406 * x - 1.5372 - .4986 * z), (float)(-.9689 * x + 1.8758 + .0415 * z),
                (float)(.0557 * x - .2040 + 1.0570 * z));
}

static vec3 balanced(float kelvin, float tint, vec3 c)
{
    rgb_matrix m = white_balance(kelvin, tint);
    return white_balanced(c, m.red, m.green, m.blue);
}

// A grey card, its luminance 1.
static void assert_grey(vec3 c, double tolerance)
{
    for (int i = 0; i < 3; i++)
        assert_near((double)c[i], 1, tolerance);
}

// Up to 4000 K, a card lit by a black body comes out grey, within the error of the observer's fit.
static void lamps_come_out_grey(void **state)
{
    (void)state;
    for (float kelvin = 2000; kelvin <= 4000; kelvin += 250) {
        double xyz[3];
        black_body((double)kelvin, xyz);
        vec3 as_it_is = rgb_of(xyz);
        assert_true(as_it_is[0] > 1.3f && as_it_is[2] < .6f); // it was orange
        assert_grey(balanced(kelvin, 0, as_it_is), kelvin < 2500 ? .05 : .03);
    }
}

// CIE 15:2004, tables: white points of daylight, and of illuminant A.
static void published_whites_come_out_grey(void **state)
{
    (void)state;
    static const struct {
        float kelvin;
        double x, y;
    } whites[] = { { 2856, .44757, .40745 },
                   { 5003, .34567, .35850 },
                   { 5503, .33242, .34743 },
                   { 6504, .31272, .32903 },
                   { 7504, .29902, .31485 } };
    for (int i = 0; i < 5; i++) {
        double x = whites[i].x, y = whites[i].y, xyz[3] = { x, y, 1 - x - y };
        assert_grey(balanced(whites[i].kelvin, 0, rgb_of(xyz)), .005);
    }
}

// Where nothing is to be done: D65's own 6504 K.
static void d65_stays(void **state)
{
    (void)state;
    vec3 c = balanced(6504, 0, vec3(.2f, .5f, .9f));
    assert_near((double)c[0], .2, .001);
    assert_near((double)c[1], .5, .001);
    assert_near((double)c[2], .9, .001);
}

// Duv = .01 above the black body of 3000 K, moved by hand along the normal of its locus: the
// tint that says so makes it grey, the other one twice as green.
static void tint_is_the_distance_from_the_locus(void **state)
{
    (void)state;
    double a[3], b[3], c[3];
    black_body(2990, a);
    black_body(3000, b);
    black_body(3010, c);
    double at[3][2], *xyz[3] = { a, b, c };
    for (int i = 0; i < 3; i++) { // CIE 1960
        double d = xyz[i][0] + 15 * xyz[i][1] + 3 * xyz[i][2];
        at[i][0] = 4 * xyz[i][0] / d;
        at[i][1] = 6 * xyz[i][1] / d;
    }
    double du = at[2][0] - at[0][0], dv = at[2][1] - at[0][1], length = hypot(du, dv);
    double u = at[1][0] + .01 * dv / length, v = at[1][1] - .01 * du / length;
    assert_true(v > at[1][1]); // greener
    double x = 3 * u / (2 * u - 8 * v + 4), y = 2 * v / (2 * u - 8 * v + 4);
    const double green[3] = { x, y, 1 - x - y };
    assert_grey(balanced(3000, 30, rgb_of(green)), .02);
    vec3 other = balanced(3000, -30, rgb_of(green));
    assert_true(other[1] > other[0] + .05f && other[1] > other[2] + .1f);
}

// Everywhere that is allowed: a card lit by the light, where there is such light, is grey and as
// bright as it was; no step of a hundredth moves anything far.
static void it_is_total_and_steady(void **state)
{
    (void)state;
    for (float tint = -150; tint <= 150; tint += 30) {
        vec3 before = balanced(1667, tint, vec3(1, 1, 1));
        for (float kelvin = 1667; kelvin <= 25000; kelvin *= 1.01f) {
            vec3 at = white_xyz(kelvin, tint), c = balanced(kelvin, tint, vec3(1, 1, 1));
            const double xyz[3] = { (double)at[0], (double)at[1], (double)at[2] };
            if (white_cones(at)[2] > .1f)
                assert_grey(balanced(kelvin, tint, rgb_of(xyz)), .01);
            vec3 step = c - before;
            assert_true(dot(step, step) < .1f * .1f * dot(before, before));
            before = c;
        }
    }
    vec3 most = balanced(2000, 0, vec3(INFINITY, INFINITY, INFINITY));
    assert_true(isfinite(most[0]) && isfinite(most[1]) && isfinite(most[2]));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lamps_come_out_grey),
        cmocka_unit_test(published_whites_come_out_grey),
        cmocka_unit_test(d65_stays),
        cmocka_unit_test(tint_is_the_distance_from_the_locus),
        cmocka_unit_test(it_is_total_and_steady),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
