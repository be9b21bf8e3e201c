// The physics in float against the same text in double: what rounding costs.
#include "cases.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

// The worst is sqrt(1 - z^2) near a pole, in the visible normals; most are below 1e-6.
static const double LIMIT = 1e-4;

static void float_agrees_with_double(void **state)
{
    (void)state;
    for (uint32_t id = 0; id < cases_count(); id++) {
        double worst = 0.0;
        for (uint32_t i = 0; i < CASES_INPUTS; i++) {
            float u[4];
            cases_input(i, u);
            double a = (double)cases_float(id, u), b = cases_double(id, u);
            assert_true(isfinite(a) && isfinite(b));
            double error = fabs(a - b) / (fabs(b) + 0.01);
            worst = error > worst ? error : worst;
        }
        if (worst > LIMIT)
            print_error("case %u: error %g\n", id, worst);
        assert_true(worst <= LIMIT);
    }
}

// A case that is the same for all inputs, or for another, tests nothing.
static void cases_differ(void **state)
{
    (void)state;
    for (uint32_t id = 0; id < cases_count(); id++) {
        float u[4], v[4];
        cases_input(1, u);
        cases_input(2, v);
        double first = cases_double(id, u);
        int changes = fabs(first - cases_double(id, v)) > 0.0;
        for (uint32_t i = 3; i < 64; i++) {
            cases_input(i, v);
            changes += fabs(first - cases_double(id, v)) > 0.0;
        }
        if (!changes)
            print_error("case %u is constant\n", id);
        assert_true(changes > 0);
        for (uint32_t other = 0; other < id; other++)
            assert_true(fabs(first - cases_double(other, u)) > 0.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(float_agrees_with_double),
        cmocka_unit_test(cases_differ),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
