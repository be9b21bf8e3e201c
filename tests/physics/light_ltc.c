// Lights by linearly transformed cosines and by their representative point: the integrals against
// quadrature of the transformed cosine, the table against the fit, and both against the lobe itself
// (cap_truth.c) within the errors that they are known for.
#include "physics/light_ltc.glsl"
#include "physics/light_representative.glsl"

#include "../../tools/ltc_fit.h"
#include "bake/dfg.h"
#include "bake/ltc.h"
#include "cap_truth.h"
#include "image/half.h"
#include "near.h"

static const double TAU = 6.28318530717958648;

// Deterministic, uniform in [0, 1).
static double next(uint *state)
{
    *state = *state * 747796405u + 2891336453u;
    uint word = ((*state >> ((*state >> 28) + 4u)) ^ *state) * 277803737u;
    return ((word >> 22) ^ word) / 4294967296.0;
}

static vec3 direction(uint *state, double lowest)
{
    double z = lowest + (1 - lowest) * next(state), phi = TAU * next(state), r = sqrt(1 - z * z);
    return vec3((float)(r * cos(phi)), (float)(r * sin(phi)), (float)z);
}

static vec4 matrix_at(float NoV, float roughness)
{
    float t[4];
    bake_ltc_fetch(NoV, roughness, t);
    return light_ltc_matrix(vec4(t[0], t[1], t[2], t[3]), roughness * roughness);
}

// The fitted lobe itself, 1/sr, from the matrix: Heitz et al. 2016, eq. 1.
static double density(light_ltc f, vec3 l)
{
    vec3 o = light_ltc_apply(f, l);
    double length2 = (double)dot(o, o);
    return fmax((double)o[2], 0) * (double)f.det / (length2 * length2 * TAU / 2);
}

// ---- the table ----------------------------------------------------------------------------------

static void table_is_the_fit(void **state)
{
    (void)state;
    const uint32_t at[][2] = { { 0, 31 }, { 12, 6 }, { 20, 13 }, { 25, 22 }, { 29, 28 } };
    for (int i = 0; i < 5; i++) {
        double NoV = bake_ltc_cosine(at[i][0]), alpha = bake_ltc_alpha(at[i][1]);
        ltc_shape start = ltc_fit_smooth(NoV);
        if (alpha > 0.3)
            start = (ltc_shape) { 1.6, 1.2, -0.4 };
        ltc_entry e = ltc_fit(NoV, alpha, start);
        const uint16_t *t = bake_ltc_table + 4 * (at[i][1] * BAKE_LTC_SIZE + at[i][0]);
        for (int k = 0; k < 4; k++)
            assert_near((double)half_to_float(t[k]), e.m[k], 2e-3);
    }
}

static double texel(uint32_t y, uint32_t x, uint32_t k)
{
    return (double)half_to_float(bake_ltc_table[4 * (y * BAKE_LTC_SIZE + x) + k]);
}

// No search got lost: second differences. The last column, of grazing lobes, is left out.
static void table_is_smooth(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < 4; k++) {
        for (uint32_t i = 1; i + 2 < BAKE_LTC_SIZE; i++) {
            for (uint32_t j = 0; j + 1 < BAKE_LTC_SIZE; j++) {
                assert_near(0.5 * (texel(j, i - 1, k) + texel(j, i + 1, k)), texel(j, i, k), 0.02);
                assert_near(0.5 * (texel(i - 1, j, k) + texel(i + 1, j, k)), texel(i, j, k), 0.02);
            }
        }
    }
}

// The norm of the fit is the albedo that the DFG table has: one table serves both.
static void norm_is_the_albedo(void **state)
{
    (void)state;
    static uint16_t table[BAKE_DFG_SIZE * BAKE_DFG_SIZE * 2];
    bake_dfg(table);
    for (uint32_t y = 9; y < BAKE_DFG_SIZE; y += 25) {
        for (uint32_t x = 3; x < BAKE_DFG_SIZE; x += 25) {
            double r = (y + 0.5) / BAKE_DFG_SIZE, NoV = (x + 0.5) / BAKE_DFG_SIZE;
            const uint16_t *t = table + 2 * (y * BAKE_DFG_SIZE + x);
            double albedo = (double)(half_to_float(t[0]) + half_to_float(t[1]));
            assert_near(ltc_fit(NoV, r * r, ltc_fit_smooth(NoV)).norm, albedo, 2e-3);
        }
    }
}

static void fetch_interpolates(void **state)
{
    (void)state;
    float t[4], a[4], b[4];
    float u[3] = { 5 / 31.0f, 5.25f / 31, 6 / 31.0f };
    bake_ltc_fetch(1 - u[0] * u[0], 9 / 31.0f, a);
    bake_ltc_fetch(1 - u[1] * u[1], 9 / 31.0f, t);
    bake_ltc_fetch(1 - u[2] * u[2], 9 / 31.0f, b);
    for (uint32_t k = 0; k < 4; k++) {
        double node = (double)half_to_float(bake_ltc_table[4 * (9 * BAKE_LTC_SIZE + 5) + k]);
        assert_near((double)a[k], node, 1e-5);
        assert_near((double)t[k], (double)(0.75f * a[k] + 0.25f * b[k]), 1e-5);
    }
    bake_ltc_fetch(0, 1, t);
    for (uint32_t k = 0; k < 4; k++)
        assert_near((double)t[k], (double)half_to_float(bake_ltc_table[4 * 32 * 32 - 4 + k]), 1e-6);
}

// ---- the integrals ------------------------------------------------------------------------------

static void transformed_cosine_is_a_density(void **state)
{
    (void)state;
    for (int i = 0; i < 24; i++) {
        float NoV = 0.05f + 0.18f * (float)(i % 6), roughness = 0.4f + 0.2f * (float)(i / 6);
        vec3 v = vec3(sqrt(1 - NoV * NoV) * 0.6f, sqrt(1 - NoV * NoV) * 0.8f, NoV);
        light_ltc f = light_ltc_frame(v, matrix_at(NoV, roughness));
        double sum = 0;
        enum { N = 300 };
        for (int k = 0; k < N * N; k++) {
            double z = 2 * (k / N + 0.5) / N - 1, phi = TAU * (k % N + 0.5) / N,
                   r = sqrt(1 - z * z);
            sum += density(f, vec3((float)(r * cos(phi)), (float)(r * sin(phi)), (float)z));
        }
        assert_near(sum * 2 * TAU / N / N, 1, 2e-3);
    }
}

// A cap of n x n directions of equal solid angle.
static double cap_by_quadrature(light_ltc f, light_cap cap, int n)
{
    vec3 up = light_rim_up(cap.axis), side = cross(cap.axis, up);
    double sum = 0, height = (double)(cap.sin_s * cap.sin_s / (1 + cap.cos_s));
    for (int i = 0; i < n * n; i++) {
        double c = 1 - (i / n + 0.5) / n * height, phi = TAU * (i % n + 0.5) / n;
        double s = sqrt((1 - c) * (1 + c));
        sum += density(f, (float)c * cap.axis + (float)(s * cos(phi)) * up +
                              (float)(s * sin(phi)) * side);
    }
    return sum * TAU * height / n / n;
}

// As it sets, a light fades: by its height above the horizon over a quarter of its whole height.
static double fade(double middle, double half_height)
{
    return fmax(0, fmin(1, 2 * (middle + half_height) / half_height));
}

// Does the fitted lobe's horizon cut the cone c0 + c1 cos t + c2 sin t, or nearly?  Nearly, because
// it then cuts the sphere that stands for the cone, whose ellipse may lie flat above it.
static bool is_cut(light_ltc f, vec3 c0, vec3 c1, vec3 c2)
{
    float z1 = dot(f.z, c1), z2 = dot(f.z, c2);
    return dot(f.z, c0) < 4 * sqrt(z1 * z1 + z2 * z2);
}

static void caps_are_their_quadrature(void **state)
{
    (void)state;
    uint seed = 5;
    int whole = 0;
    double worst_cut = 0;
    for (int i = 0; i < 200; i++) {
        vec3 v = direction(&seed, 0.1);
        float roughness = (float)(0.3 + 0.7 * next(&seed));
        light_cap cap =
            light_cap_sun(direction(&seed, -1), (float)(0.02 + 1.5 * next(&seed) * next(&seed)));
        vec4 m = matrix_at(v[2], roughness);
        light_ltc f = light_ltc_frame(v, m);
        vec2 got = light_ltc_cap(cap, v, m, vec2(0.7f, 0.3f));
        double form = (double)(got[0] * cap.sin_s * cap.sin_s) * TAU / 2;
        assert_near((double)got[1], 0.3 * (double)got[0], 1e-6 * (double)got[0]);
        double expected = cap_by_quadrature(f, cap, 100);
        expected *= fade((double)cap.axis[2], (double)cap.sin_s);
        vec3 up = light_rim_up(cap.axis), side = cross(cap.axis, up);
        if (is_cut(f, cap.cos_s * cap.axis, cap.sin_s * up, cap.sin_s * side)) {
            worst_cut = fmax(worst_cut, fabs(form - expected)); // an approximation there
            continue;
        }
        assert_near(form, expected, 2e-3 * expected + 1e-4);
        whole++;
    }
    print_message("caps: within %.3f, %d whole\n", worst_cut, whole);
    assert_true(whole > 20);
    assert_true(worst_cut < 0.04);
}

typedef struct area {
    vec3 centre, u, w; // half axes
} area;

static area random_area(uint *seed)
{
    area a = { .centre = (float)(1.2 + next(seed)) * direction(seed, -0.2) };
    a.u = (float)(0.1 + 0.5 * next(seed)) * direction(seed, -1);
    vec3 other = direction(seed, -1);
    a.w = (float)(0.1 + 0.5 * next(seed)) * normalize(cross(a.u, other));
    if (dot(cross(a.u, a.w), a.centre) > 0)
        a.u = -a.u;
    return a;
}

// Midpoints over the area: a square, or the disc in it.
static double area_by_quadrature(light_ltc f, area a, bool disk, int n)
{
    vec3 normal = cross(a.u, a.w);
    double sum = 0;
    for (int i = 0; i < n * n; i++) {
        double x = 2 * (i / n + 0.5) / n - 1, y = 2 * (i % n + 0.5) / n - 1, weight = 4;
        if (disk) { // equal areas
            double r = sqrt((i / n + 0.5) / n), phi = TAU * (i % n + 0.5) / n;
            x = r * cos(phi);
            y = r * sin(phi);
            weight = TAU / 2;
        }
        vec3 p = a.centre + (float)x * a.u + (float)y * a.w;
        double d2 = (double)dot(p, p), d = sqrt(d2);
        sum += weight * density(f, p / (float)d) * -(double)dot(p, normal) / (d2 * d);
    }
    return sum / n / n;
}

static void quads_are_their_quadrature(void **state)
{
    (void)state;
    uint seed = 11;
    for (int i = 0; i < 100; i++) {
        vec3 v = direction(&seed, 0.1);
        area a = random_area(&seed);
        vec4 m = matrix_at(v[2], (float)(0.4 + 0.6 * next(&seed)));
        vec2 got = light_ltc_quad(a.centre - a.u - a.w, a.centre + a.u - a.w, a.centre + a.u + a.w,
                                  a.centre - a.u + a.w, v, m, vec2(0.7f, 0.3f));
        double expected = area_by_quadrature(light_ltc_frame(v, m), a, false, 80);
        expected *= fade((double)a.centre[2], fabs((double)a.u[2]) + fabs((double)a.w[2]));
        assert_near((double)got[0], expected, 3e-3 * expected + 2e-4);
        assert_near((double)got[1], 0.3 * (double)got[0], 1e-6);
    }
}

static void disks_are_their_quadrature(void **state)
{
    (void)state;
    uint seed = 13;
    int whole = 0;
    double worst = 0;
    for (int i = 0; i < 200; i++) {
        vec3 v = direction(&seed, 0.1);
        area a = random_area(&seed);
        vec4 m = matrix_at(v[2], (float)(0.4 + 0.6 * next(&seed)));
        light_ltc f = light_ltc_frame(v, m);
        double got = (double)light_ltc_disk(a.centre, a.u, a.w, v, m, vec2(0.7f, 0.3f))[0];
        double expected = area_by_quadrature(f, a, true, 80);
        expected *= fade((double)a.centre[2], hypot((double)a.u[2], (double)a.w[2]));
        bool cut = is_cut(f, a.centre, a.u, a.w);
        worst = fmax(worst, fabs(got - expected));
        assert_near(got, expected, cut ? 0.01 : 3e-3 * expected + 1e-4);
        vec2 back = light_ltc_disk(a.centre, a.w, a.u, v, m, vec2(1, 0));
        assert_near((double)back[0], 0, 0);
        whole += !cut;
    }
    print_message("disks: within %.3f, %d whole\n", worst, whole);
    assert_true(whole > 50);
}

// A short capsule is a sphere; one that goes by is its rectangle, wherever the eye is.
static void tubes_shrink_to_spheres(void **state)
{
    (void)state;
    uint seed = 17;
    for (int i = 0; i < 100; i++) {
        vec3 v = direction(&seed, 0.1), centre = 2.0f * direction(&seed, 0.3);
        vec3 axis = (float)(1e-6 * next(&seed)) * direction(&seed, -1);
        vec4 m = matrix_at(v[2], (float)(0.4 + 0.6 * next(&seed)));
        double tube = (double)light_ltc_tube(centre, axis, 0.1f, v, m, vec2(1, 0))[0];
        light_cap cap = light_cap_sphere(centre, 0.1f);
        double sphere = (double)(light_ltc_cap(cap, v, m, vec2(1, 0))[0] * cap.sin_s * cap.sin_s);
        assert_near(tube, sphere * TAU / 2, 0.02 * sphere * TAU / 2 + 1e-5);
    }
}

// ---- limits -------------------------------------------------------------------------------------

static void a_sky_gives_the_albedo(void **state)
{
    (void)state;
    light_cap sky = { vec3(0, 0, 1), 1, 0 };
    for (int i = 0; i < 40; i++) {
        float NoV = 0.12f + 0.22f * (float)(i % 5), roughness = 0.1f + 0.3f * (float)(i / 10);
        vec3 v = vec3(sqrt(1 - NoV * NoV), 0, NoV);
        double form = (double)light_ltc_cap(sky, v, matrix_at(NoV, roughness), vec2(1, 0))[0];
        // What is missing leaks below the horizon: the fit's own error.
        double leak = roughness < 0.3f || NoV > 0.9f ? 0.02 : 0.16;
        assert_near(form * TAU / 2, 1, leak);
        assert_true(form * TAU / 2 <= 1.00001);
    }
}

// RMS over the light's directions, over the RMS of the truth; lights wholly above the horizon.
static double cell_error(double roughness, double sin_s, double view, int step)
{
    static double axes[CAP_AXES][3];
    cap_case c;
    cap_cell(&c, roughness, sin_s, view, 1, 0);
    vec3 v = vec3((float)c.v[0], (float)c.v[1], (float)c.v[2]);
    vec4 m = matrix_at(v[2], (float)roughness);
    double albedo = ltc_fit(c.v[2], c.ax, ltc_fit_smooth(c.v[2])).norm, error = 0, truth = 0;
    int n = cap_cell_axes(&c, axes);
    for (int i = 0; i < n; i += step) {
        if (axes[i][2] <= sin_s)
            continue;
        memcpy(c.axis, axes[i], sizeof c.axis);
        light_cap cap = { vec3((float)axes[i][0], (float)axes[i][1], (float)axes[i][2]),
                          (float)c.sin_s, (float)c.cos_s };
        double x = (double)light_ltc_cap(cap, v, m, vec2((float)albedo, 0))[0];
        double t = cap_truth(&c, 0), d = x * TAU / 2 * sin_s * sin_s - t;
        error += d * d;
        truth += t * t;
    }
    return sqrt(error / truth);
}

static void caps_are_as_good_as_published(void **state)
{
    (void)state;
    const double roughness[] = { 0.1, 0.35, 0.7, 1 }, view[] = { 1, 60 };
    double worst = 0, sum = 0;
    for (int i = 0; i < 8; i++) {
        double e = cell_error(roughness[i / 2], 0.2, view[i % 2], 3);
        worst = fmax(worst, e);
        sum += e / 8;
    }
    print_message("caps of R/d = .2: mean %.1f %%, worst %.1f %%\n", 100 * sum, 100 * worst);
    assert_true(worst < 0.15 && sum < 0.06);
}

// ---- the representative point -------------------------------------------------------------------

// GGX under a point light by the papers' formulas: D G2 / (4 NoV), Schlick's weight by `power`.
static double point_light(vec3 v, vec3 l, double alpha, int power)
{
    double h[3], h2 = 0, a2 = alpha * alpha;
    for (int k = 0; k < 3; k++) {
        h[k] = (double)v[k] + (double)l[k];
        h2 += h[k] * h[k];
    }
    double tan2 = (h[0] * h[0] + h[1] * h[1]) / (h[2] * h[2]), cos4 = pow(h[2] * h[2] / h2, 2);
    double d = 1 / (TAU / 2 * a2 * cos4 * pow(1 + tan2 / a2, 2));
    double g2 = 1;
    for (int k = 0; k < 2; k++) {
        double c = (double)(k ? v[2] : l[2]);
        g2 += (sqrt(1 + a2 * (1 / (c * c) - 1)) - 1) / 2;
    }
    return d / g2 / (4 * (double)v[2]) * pow(1 - sqrt(h2) / 2, power);
}

static void small_lights_become_points(void **state)
{
    (void)state;
    uint seed = 31;
    for (int i = 0; i < 2000; i++) {
        vec3 v = direction(&seed, 0.02), l = direction(&seed, 0.02);
        float alpha = (float)(0.02 + 0.98 * next(&seed)), sine = i % 2 ? 1e-6f : 0;
        light_cap cap = { l, sine, sqrt(1 - sine * sine) };
        vec2 x = light_representative_cap(cap, v, alpha);
        double all = point_light(v, l, (double)alpha, 0);
        assert_near((double)x[0], all, 2e-3 * all);
        assert_near((double)x[1], point_light(v, l, (double)alpha, 5), 2e-3 * all);
        // A tube of a length that vanishes with its radius is the sphere.
        vec2 tube = light_representative_tube(2.0f * l, 1e-6f * v, 1e-3f, v, alpha);
        cap = light_cap_sphere(2.0f * l, 1e-3f);
        x = light_representative_cap(cap, v, alpha);
        double omega = TAU / 2 * (double)(cap.sin_s * cap.sin_s);
        assert_near((double)tube[0], omega * (double)x[0], 0.01 * omega * (double)x[0]);
    }
}

// The light around the mirror direction: its point is the mirror direction itself, the peak that of
// a wider lobe.  The angle from the mirror ray within a light makes no difference.
static void nearest_point_is_on_the_ray(void **state)
{
    (void)state;
    vec3 v = vec3(0.6f, 0, 0.8f);
    vec2 at =
        light_representative_cap((light_cap) { vec3(-0.6f, 0, 0.8f), 0.2f, sqrt(0.96f) }, v, 0.1f);
    double peak = point_light(v, vec3(-0.6f, 0, 0.8f), 0.1, 0) * 0.25; // (0.1 / 0.2)^2
    assert_near((double)at[0], peak, 1e-3 * peak);
    vec3 near_it = normalize(vec3(-0.6f, 0.19f, 0.8f));
    vec2 beside = light_representative_cap((light_cap) { near_it, 0.2f, sqrt(0.96f) }, v, 0.1f);
    assert_near((double)beside[0], peak, 1e-3 * peak);
    // Behind the eye's mirror ray there is nothing to be drawn to: the centre stands for the light.
    vec3 behind = normalize(vec3(0.95f, 0, 0.1f));
    vec2 away = light_representative_cap((light_cap) { behind, 0.2f, sqrt(0.96f) }, v, 0.9f);
    double centre = point_light(v, behind, 0.9, 0) * pow(0.9 / 1, 2);
    assert_near((double)away[0], centre, 1e-3 * centre);
}

// No step as a light sets, nor as it passes the mirror ray.
static void it_moves_smoothly(void **state)
{
    (void)state;
    vec3 v = vec3(0.8f, 0, 0.6f);
    double last = 0, most = 0;
    for (int i = 0; i <= 20000; i++) {
        double angle = -0.5 + 4 * i / 20000.0;
        vec3 l = vec3((float)-cos(angle), 0.05f, (float)sin(angle));
        double x = (double)light_representative_cap((light_cap) { normalize(l), 0.3f, 0.954f }, v,
                                                    0.2f)[0];
        if (i)
            most = fmax(most, fabs(x - last));
        last = x;
    }
    assert_true(most < 2e-3); // of a peak near .3, in steps of .0002
}

// ---- all of it is total -------------------------------------------------------------------------

static double odd(uint *seed, double x)
{
    double r = next(seed);
    return r < 0.15 ? 0 : r < 0.25 ? 1e-6 * x : r < 0.3 ? 1e4 * x : x;
}

static void nothing_breaks_it(void **state)
{
    (void)state;
    uint seed = 29;
    for (int i = 0; i < 50000; i++) {
        vec3 v = direction(&seed, i % 3 ? 0 : 0.999);
        v[2] = (float)fmax((double)v[2], 1e-4);
        vec4 m = matrix_at(v[2], (float)fmax(0.05, odd(&seed, 1) > 1 ? 1 : next(&seed)));
        vec3 centre = (float)odd(&seed, 1) * (i % 5 ? direction(&seed, -1) : v);
        vec3 u = (float)odd(&seed, 1) * direction(&seed, -1);
        vec3 w = (float)odd(&seed, 1) *
                 (i % 7 ? normalize(cross(u, direction(&seed, -1)) + 1e-9f) : direction(&seed, 0));
        float radius = (float)odd(&seed, 1);
        light_cap cap = i % 2 ? light_cap_sphere(centre, radius)
                              : light_cap_sun(direction(&seed, -1), fmin(radius, 1.5707f));
        vec2 white = vec2(1, 0);
        double form = (double)light_ltc_cap(cap, v, m, white)[0] * TAU / 2;
        form *= (double)(cap.sin_s * cap.sin_s);
        assert_true(form >= 0 && form <= 1.0001 && isfinite(form));
        form = (double)light_ltc_disk(centre, u, w, v, m, white)[0];
        assert_true(form >= 0 && form <= 1.0001);
        form = (double)light_ltc_quad(centre - u - w, centre + u - w, centre + u + w,
                                      centre - u + w, v, m, white)[0];
        assert_true(form >= 0 && form <= 1.0001);
        float alpha = (float)fmax(0.002, next(&seed));
        vec2 x = light_representative_cap(cap, v, alpha);
        assert_true(x[0] >= 0 && x[1] >= 0 && x[1] <= x[0] && isfinite(x[0]));
        x = light_representative_tube(centre, u, radius, v, alpha);
        assert_true(x[0] >= 0 && x[1] >= 0 && x[1] <= x[0] && isfinite(x[0]));
        form = (double)light_ltc_tube(centre, u, radius, v, m, white)[0];
        assert_true(form >= 0 && form <= 1.0001);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(table_is_the_fit),
        cmocka_unit_test(table_is_smooth),
        cmocka_unit_test(norm_is_the_albedo),
        cmocka_unit_test(fetch_interpolates),
        cmocka_unit_test(transformed_cosine_is_a_density),
        cmocka_unit_test(caps_are_their_quadrature),
        cmocka_unit_test(quads_are_their_quadrature),
        cmocka_unit_test(disks_are_their_quadrature),
        cmocka_unit_test(tubes_shrink_to_spheres),
        cmocka_unit_test(a_sky_gives_the_albedo),
        cmocka_unit_test(caps_are_as_good_as_published),
        cmocka_unit_test(small_lights_become_points),
        cmocka_unit_test(nearest_point_is_on_the_ray),
        cmocka_unit_test(it_moves_smoothly),
        cmocka_unit_test(nothing_breaks_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
