// Rays from the eye go through their pixels as the filter says, and the functions that draw them
// are those of the C library.
#include "stage.h"

#include "trace/elementary.h"
#include "trace/eye.h"
#include "trace/sampler.h"

// ---- Functions ---------------------------------------------------------------------------

static void logarithm_is_exact(void **state)
{
    (void)state;
    for (double x = 1e-30; x < 1e30; x *= 1.0007) {
        double wanted = log((double)(float)x),
               error = fabs((double)elementary_log((float)x) - wanted);
        assert_true(error <= 2e-7 * fmax(1, fabs(wanted)));
    }
}

static void circle_is_exact(void **state)
{
    (void)state;
    for (int i = 0; i <= 1 << 16; i++) {
        float turns = (float)i / (1 << 16);
        double a = 2 * pi * (double)turns;
        assert_true(fabs((double)elementary_cos(turns) - cos(a)) < 4e-7);
        assert_true(fabs((double)elementary_sin(turns) - sin(a)) < 4e-7);
        double seen = (double)elementary_angle((float)sin(a), (float)cos(a));
        assert_true(fabs(remainder(seen - a, 2 * pi)) < 1e-6);
    }
    assert_true(isfinite(elementary_angle(0, 0)));
}

// ---- Rays --------------------------------------------------------------------------------

enum { SAMPLES = 1 << 16, RINGS = 12, WIDTH = 40, HEIGHT = 30, X = 7, Y = 21 };

static view view_of(bool orthographic)
{
    const ag_camera_desc camera = { .position = { 1, 2, 9 },
                                    .target = { 0, 0.5f, 0 },
                                    .up = { 0, 1, 0 },
                                    .fov_y_rad = 0.8f,
                                    .height_m = orthographic ? 5 : 0 };
    const float from[3] = { -3, -3, -3 }, to[3] = { 3, 3, 3 };
    return view_make(&camera, WIDTH, HEIGHT, from, to);
}

// Where the ray of a lane pierces the picture, px from the middle of its pixel.
static void place_of(const view *v, const ray_packet *r, unsigned lane, double off[2])
{
    ray one = world_ray(r, lane);
    vec3 p = one.origin + one.direction * one.near;
    float at[3] = { p[0], p[1], p[2] }, place[2];
    assert_true(fabs((double)view_depth(v, at) - (double)v->near_m) < 1e-4 * (double)v->near_m);
    p = one.origin + one.direction * one.far;
    const float end[3] = { p[0], p[1], p[2] };
    assert_true(fabs((double)view_depth(v, end) - (double)v->far_m) < 1e-4 * (double)v->far_m);
    assert_true(fabs((double)dot(one.direction, one.direction) - 1) < 1e-5);
    assert_true(view_project(v, at, place));
    off[0] = (double)place[0] - (X + 0.5);
    off[1] = (double)place[1] - (Y + 0.5);
}

// The share of a Gaussian of .47 px, cut at 1.5 px, that is nearer than r.
static double within(double r)
{
    double s2 = 2 * .47 * .47;
    return (1 - exp(-r * r / s2)) / (1 - exp(-1.5 * 1.5 / s2));
}

static void assert_filtered(bool orthographic)
{
    view v = view_of(orthographic);
    double count[RINGS][8] = { { 0 } };
    for (uint32_t i = 0; i < SAMPLES; i += WORLD_PACKET) {
        eye_samples s;
        ray_packet r;
        for (uint32_t k = 0; k < WORLD_PACKET; k++) {
            s.x[k] = X;
            s.y[k] = Y;
            s.index[k] = i + k;
            s.seed[k] = 5;
        }
        eye_rays(&v, &s, &r);
        for (unsigned k = 0; k < WORLD_PACKET; k++) {
            double off[2];
            place_of(&v, &r, k, off);
            double share = within(hypot(off[0], off[1]));
            double turn = atan2(off[1], off[0]) / (2 * pi) + 0.5;
            assert_true(share < 1.001);
            count[(int)fmin(share * RINGS, RINGS - 1)][(int)fmin(turn * 8, 7)]++;
        }
    }
    for (int i = 0; i < RINGS; i++) // a net is far more even than chance
        for (int k = 0; k < 8; k++)
            assert_true(fabs(count[i][k] * RINGS * 8 / SAMPLES - 1) < 0.02);
}

static void filter_is_a_gaussian(void **state)
{
    (void)state;
    assert_filtered(false);
    assert_filtered(true);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(logarithm_is_exact),
        cmocka_unit_test(circle_is_exact),
        cmocka_unit_test(filter_is_a_gaussian),
    };
    return cmocka_run_group_tests_name("eye", tests, NULL, NULL);
}
