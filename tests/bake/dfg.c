// The DFG table against quadrature of another kind.
#include "bake/dfg.h"
#include "image/half.h"

#include "../physics/albedo.h"
#include "../physics/near.h"

static void table_is_the_albedo(void **state)
{
    (void)state;
    static uint16_t table[BAKE_DFG_SIZE * BAKE_DFG_SIZE * 2];
    bake_dfg(table);
    double worst = 0.0;
    for (int y = 0; y < BAKE_DFG_SIZE; y += 7) {
        for (int x = 0; x < BAKE_DFG_SIZE; x += 7) {
            double r = (y + 0.5) / BAKE_DFG_SIZE;
            albedo e = albedo_of((x + 0.5) / BAKE_DFG_SIZE, r * r, 300);
            const uint16_t *t = table + 2 * (y * BAKE_DFG_SIZE + x);
            double scale = fabs((double)half_to_float(t[0]) - e.scale);
            double bias = fabs((double)half_to_float(t[1]) - e.bias);
            worst = fmax(worst, fmax(scale, bias));
        }
    }
    if (worst > 0.0015)
        print_error("worst error %g\n", worst);
    assert_true(worst <= 0.0015);
}

// Smooth: everything comes back, and Schlick's weight is (1 - cos)^5.
static void mirror_has_no_loss(void **state)
{
    (void)state;
    static uint16_t table[BAKE_DFG_SIZE * BAKE_DFG_SIZE * 2];
    bake_dfg(table);
    for (int x = 0; x < BAKE_DFG_SIZE; x++) {
        double c = (x + 0.5) / BAKE_DFG_SIZE;
        double scale = (double)half_to_float(table[2 * x]);
        double bias = (double)half_to_float(table[2 * x + 1]);
        assert_near(scale + bias, 1.0, 0.001);
        assert_near(bias, pow(1.0 - c, 5.0), 0.001);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(table_is_the_albedo),
        cmocka_unit_test(mirror_has_no_loss),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
