// The eye's veil as a sum of Gaussians, against the equation that it stands for.
#include "physics/glare.glsl"

#include "near.h"

static double cie(double degrees)
{
    double age = 1 + pow(25 / 62.5, 4), p = 0.5;
    return 10 / pow(degrees, 3) + (5 / pow(degrees, 2) + 0.1 * p / degrees) * age + 2.5e-3 * p;
}

static void veil_is_the_equation(void **state)
{
    (void)state;
    for (double degrees = 0.1; degrees <= 100; degrees *= 1.3)
        assert_near((double)glare((float)degrees) / cie(degrees), 1, 1e-6);
}

// At an angle: all Gaussians by their weights, each of two dimensions and in square degrees.
static double veil_of_gaussians(double degrees)
{
    const double step = 1.01, radian = 3.14159265358979 / 180;
    double sum = 0;
    for (double s = 1e-4; s < 1e4; s *= step) {
        double middle = s * sqrt(step), x = degrees / middle;
        double share = (double)glare_share((float)s, (float)(s * step));
        sum += share * exp(-x * x / 2) / (2 * 3.14159265358979 * middle * middle);
    }
    return sum / (radian * radian);
}

// All but the equation's constant, which no Gaussians have.
static void gaussians_are_the_veil(void **state)
{
    (void)state;
    for (double degrees = 0.1; degrees <= 30; degrees *= 1.5)
        assert_near(veil_of_gaussians(degrees) / (cie(degrees) - 2.5e-3 * 0.5), 1, 2e-3);
}

static void shares_add_up(void **state)
{
    (void)state;
    double halves = (double)glare_share(0.1f, 1.3f) + (double)glare_share(1.3f, 12.8f);
    assert_near(halves, (double)glare_share(0.1f, 12.8f), 1e-6);
    assert_near(halves, 0.2, 0.001); // what the public header calls a young eye's
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(veil_is_the_equation),
        cmocka_unit_test(gaussians_are_the_veil),
        cmocka_unit_test(shares_add_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
