// Exposure values against the tables that photographers have, and the eye's adaptation against
// its differential equation.
#include "helpers.h"

#include <argand/eye.h>

#include <math.h>

static void near(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance))
        fail_msg("%.9g is not %.9g", a, b);
}

// ISO 2720's EV is 0 at f/1 and 1 s; f/16 at 1/125 s is 15 but for the roundings on the dial.
static void cameras_have_their_exposure_values(void **state)
{
    (void)state;
    near((double)ag_ev100_from_camera(1, 1, 100), 0, 1e-6);
    near((double)ag_ev100_from_camera(16, 1 / 128.f, 100), 15, 1e-5);
    near((double)ag_ev100_from_camera(16, 1 / 125.f, 100), 15, .04);
    near((double)ag_ev100_from_camera(2.8f, 1 / 60.f, 800), 5.877, .001); // an interior
    // Each of these is one stop less.
    near((double)ag_ev100_from_camera(4, 1 / 30.f, 100) -
             (double)ag_ev100_from_camera(4, 1 / 60.f, 100),
         -1, 1e-5);
    near((double)ag_ev100_from_camera(4, 1 / 30.f, 200) -
             (double)ag_ev100_from_camera(4, 1 / 30.f, 100),
         -1, 1e-5);
}

// ISO 12232's saturation, 78 / (100 * .65) = 1.2 times 2^EV100 nit, becomes 1.
static void exposure_saturates_where_the_standard_does(void **state)
{
    (void)state;
    for (int ev = -30; ev <= 30; ev++) {
        double saturates = 78 / (100 * .65) * exp2(ev);
        near(saturates * (double)ag_exposure_from_ev100((float)ev), 1, 1e-6);
        near((double)ag_ev100_from_exposure(ag_exposure_from_ev100((float)ev)), ev, 1e-5);
    }
}

// d ev / dt = (target - ev) / tau, in steps of a 10000th of a second.
static double integrated(double ev, double target, double tau, double seconds)
{
    const double step = 1e-4;
    for (double t = 0; t < seconds - step / 2; t += step) {
        double k1 = (target - ev) / tau, k2 = (target - ev - step / 2 * k1) / tau;
        ev += step * k2;
    }
    return ev;
}

static void adaptation_obeys_its_equation(void **state)
{
    (void)state;
    const ag_adaptation a = { .to_bright_s = .3f, .to_dark_s = 2 };
    near((double)ag_eye_adapt(&a, 3, 9, .5f), integrated(3, 9, .3, .5), 1e-4);
    near((double)ag_eye_adapt(&a, 9, 3, .5f), integrated(9, 3, 2, .5), 1e-4);
    near((double)ag_eye_adapt(NULL, 9, 3, .5f), integrated(9, 3, 1.2, .5), 1e-4);
    near((double)ag_eye_adapt(NULL, 3, 9, .5f), integrated(3, 9, .4, .5), 1e-4);
}

// A second at 7, 60 and 144 frames, and at frames of any length; the target changes half-way.
static void adaptation_is_the_same_at_any_frame_rate(void **state)
{
    (void)state;
    float whole = ag_eye_adapt(NULL, 12, -3, .5f);
    whole = ag_eye_adapt(NULL, whole, 14, .5f);
    const int rates[] = { 7, 60, 144 };
    for (int i = 0; i < 3; i++) {
        float ev = 12;
        for (int half = 0; half < 2; half++)
            for (int frame = 0; frame < rates[i]; frame++)
                ev = ag_eye_adapt(NULL, ev, half ? 14 : -3, .5f / (float)rates[i]);
        near((double)ev, (double)whole, 2e-5);
    }
}

static void adaptation_has_its_ends(void **state)
{
    (void)state;
    const ag_adaptation at_once = { .to_bright_s = -1, .to_dark_s = -1 };
    near((double)ag_eye_adapt(&at_once, 3, 9, 0), 9, 0);
    near((double)ag_eye_adapt(&at_once, 9, 3, 0), 3, 0);
    near((double)ag_eye_adapt(NULL, 9, 3, 0), 9, 1e-6);
    near((double)ag_eye_adapt(NULL, 9, 3, INFINITY), 3, 0);
    near((double)ag_eye_adapt(NULL, 5, 5, .1f), 5, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cameras_have_their_exposure_values),
        cmocka_unit_test(exposure_saturates_where_the_standard_does),
        cmocka_unit_test(adaptation_obeys_its_equation),
        cmocka_unit_test(adaptation_is_the_same_at_any_frame_rate),
        cmocka_unit_test(adaptation_has_its_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
