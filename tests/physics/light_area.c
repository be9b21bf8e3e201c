// Lights with an outline: the highlight and the form factor against quadrature over the light
// (area_truth.c), against the point light, and against themselves in double.
#include "physics/light_disk.glsl"
#include "physics/light_polygon.glsl"
#include "physics/light_tube.glsl"
#include "physics/microfacet.glsl"

#include "area_truth.h"
#include "cap_truth.h"
#include "light_area.h"
#include "near.h"

static const double TAU = 6.28318530717958648;

// Deterministic, uniform in [0, 1).
static double next(uint *state)
{
    *state = *state * 747796405u + 2891336453u;
    uint word = ((*state >> ((*state >> 28) + 4u)) ^ *state) * 277803737u;
    return ((word >> 22) ^ word) / 4294967296.0;
}

static void direction(uint *state, double d[3])
{
    double z = 2 * next(state) - 1, phi = TAU * next(state), r = sqrt(1 - z * z);
    d[0] = r * cos(phi);
    d[1] = r * sin(phi);
    d[2] = z;
}

static vec3 to_vec3(const double a[3])
{
    return vec3((float)a[0], (float)a[1], (float)a[2]);
}

static vec2 lobe(const area_case *c)
{
    vec3 o = to_vec3(c->centre), x = to_vec3(c->x), y = to_vec3(c->y), v = to_vec3(c->v);
    float ax = (float)c->ax, ay = (float)c->ay;
    if (c->kind == AREA_DISK)
        return light_disk_ggx(o, x, y, v, ax, ay);
    if (c->kind == AREA_TUBE)
        return light_tube_ggx(o, x, (float)c->radius, v, ax, ay);
    return light_quad_ggx(o - x - y, o + x - y, o + x + y, o - x + y, v, ax, ay);
}

static double form_factor(const area_case *c)
{
    vec3 o = to_vec3(c->centre), x = to_vec3(c->x), y = to_vec3(c->y);
    if (c->kind == AREA_DISK)
        return (double)light_disk_form_factor(o, x, y);
    if (c->kind == AREA_TUBE)
        return (double)light_tube_form_factor(o, x, (float)c->radius);
    return (double)light_quad_form_factor(o - x - y, o + x - y, o + x + y, o - x + y);
}

static double lobe_double(const area_case *c)
{
    double y[2];
    light_area_double(c, y);
    return 0.2 * y[0] + 0.8 * y[1];
}

// ---- the truth itself ---------------------------------------------------------------------------

// A light that faces the point, by n * n points of its area.
static double brute_force(const area_case *c, int n)
{
    double m[3] = { c->x[1] * c->y[2] - c->x[2] * c->y[1], c->x[2] * c->y[0] - c->x[0] * c->y[2],
                    c->x[0] * c->y[1] - c->x[1] * c->y[0] };
    double sum = 0, a2 = c->ax * c->ax, NoV = c->v[2];
    for (int i = 0; i < n * n; i++) {
        double s = 2 * (i / n + 0.5) / n - 1, t = 2 * (i % n + 0.5) / n - 1, l[3], h[3];
        double p2 = 0, h2 = 0, pm = 0;
        if (c->kind == AREA_DISK && s * s + t * t > 1)
            continue;
        for (int k = 0; k < 3; k++) {
            l[k] = c->centre[k] + s * c->x[k] + t * c->y[k];
            p2 += l[k] * l[k];
            pm -= l[k] * m[k];
        }
        for (int k = 0; k < 3; k++) {
            l[k] /= sqrt(p2);
            h[k] = l[k] + c->v[k];
            h2 += h[k] * h[k];
        }
        if (l[2] <= 0)
            continue;
        double d = 1 - (1 - a2) * h[2] * h[2] / h2;
        double g = l[2] * sqrt(NoV * NoV * (1 - a2) + a2) + NoV * sqrt(l[2] * l[2] * (1 - a2) + a2);
        sum += a2 / (TAU / 2 * d * d) * 0.5 / g * l[2] * fmax(pm, 0) / (p2 * sqrt(p2));
    }
    return sum * 4 / n / n;
}

static void the_truth_is_true(void **state)
{
    (void)state;
    uint seed = 77;
    for (int i = 0; i < 24; i++) {
        area_case c;
        double axis[3], truth[3], size = i % 3 == 0 ? 0.05 : i % 3 == 1 ? 0.3 : 0.9;
        area_cell(&c, i % 2 ? AREA_QUAD : AREA_DISK, 0.6, 85 * next(&seed), 1, 0);
        direction(&seed, axis);
        axis[2] = i % 4 ? fabs(axis[2]) : axis[2];
        area_place(&c, axis, size, 1 + i % 3, 0.8 * next(&seed), 3 * next(&seed));
        area_truth(&c, truth);
        double sum = brute_force(&c, 500);
        assert_near(truth[0], sum, 2e-3 * sum + 1e-6);
    }
}

// ---- accuracy -----------------------------------------------------------------------------------

typedef struct bounds {
    double whole, cut, whole_fresnel, cut_fresnel; // RMS error / RMS of the truth
} bounds;

typedef struct shape {
    int kind;
    double spread, tilt;
} shape;

// Some of the directions.
static void check_cell(const area_case *cell, const cap_case *cap, const shape *s, bounds b)
{
    static double axes[CAP_AXES][3];
    double error[4] = { 0 }, total[4] = { 0 };
    int n = cap_cell_axes(cap, axes);
    for (int i = 0; i < n; i += 17) {
        area_case c = *cell;
        area_place(&c, axes[i], cap->sin_s, s->spread, s->tilt, 0.4 + i);
        double truth[3];
        area_truth(&c, truth);
        vec2 got = lobe(&c);
        for (int k = 0; k < 2; k++) {
            double f0 = k ? 0.04 : 1, t = f0 * (truth[0] - truth[1]) + truth[1];
            double e = f0 * (double)(got[0] - got[1]) + (double)got[1] - t;
            int part = 2 * k + !area_is_whole(&c);
            error[part] += e * e;
            total[part] += t * t;
        }
    }
    const double limit[4] = { b.whole, b.cut, b.whole_fresnel, b.cut_fresnel };
    for (int part = 0; part < 4; part++)
        assert_near(sqrt(error[part] / fmax(total[part], 1e-30)), 0, limit[part]);
}

static void check_table(shape s, double anisotropy, bounds usual, bounds wide)
{
    const double roughness[] = { 0.1, 0.35, 1 }, size[] = { 0.01, 0.2, 0.7 }, view[] = { 30, 80 };
    for (int i = 0; i < 18; i++) {
        cap_case cap;
        area_case c;
        double r = roughness[i / 6], turn = anisotropy > 1 ? 0.6 : 0;
        cap_cell(&cap, r, size[i / 2 % 3], view[i % 2], anisotropy, turn);
        area_cell(&c, s.kind, r, view[i % 2], anisotropy, turn);
        check_cell(&c, &cap, &s, s.spread * cap.sin_s > 0.5 ? wide : usual);
    }
}

static const bounds USUAL = { 0.015, 0.03, 0.045, 0.07 }, WIDE = { 0.02, 0.03, 0.08, 0.25 };

static void a_rectangle_s_highlight_is_right(void **state)
{
    (void)state;
    check_table((shape) { AREA_QUAD, 1, 0 }, 1, USUAL, WIDE);
    check_table((shape) { AREA_QUAD, 4, 0.7 }, 1, USUAL, WIDE);
}

static void a_disk_s_highlight_is_right(void **state)
{
    (void)state;
    check_table((shape) { AREA_DISK, 1, 0 }, 1, USUAL, WIDE);
}

static void a_tube_s_highlight_is_right(void **state)
{
    (void)state;
    bounds wide = { 0.05, 0.05, 0.2, 0.25 };
    check_table((shape) { AREA_TUBE, 2, 0.3 }, 1, USUAL, wide);
}

// Summed over all positions of the light, by equal solid angle.
static void check_energy(int kind)
{
    const double roughness[] = { 0.2, 0.6 }, view[] = { 1, 75 };
    enum { POSITIONS = 100 };
    for (int i = 0; i < 4; i++) {
        area_case c;
        area_cell(&c, kind, roughness[i / 2], view[i % 2], 1, 0);
        double sum = 0, all = 0;
        for (int j = 0; j < POSITIONS; j++) {
            double z = 1 - (j + 0.5) / POSITIONS * 1.5, r = sqrt(1 - z * z);
            double phi = TAU * 0.61803398875 * j, truth[3];
            double axis[3] = { r * cos(phi), r * sin(phi), z };
            area_place(&c, axis, 0.3, 1, 0.3, j);
            area_truth(&c, truth);
            sum += (double)lobe(&c)[0];
            all += truth[0];
        }
        assert_near(sum / all, 1, kind == AREA_TUBE ? 0.015 : 0.01);
    }
}

static void energy_is_kept(void **state)
{
    (void)state;
    check_energy(AREA_QUAD);
    check_energy(AREA_DISK);
    check_energy(AREA_TUBE);
}

// ---- the form factor ----------------------------------------------------------------------------

static bool is_outside(const area_case *c)
{
    double hh = 0, ch = 0, dd = 0;
    for (int k = 0; k < 3; k++) {
        hh += c->x[k] * c->x[k];
        ch += c->centre[k] * c->x[k];
    }
    double at = fmax(-1, fmin(1, -ch / hh));
    for (int k = 0; k < 3; k++)
        dd += pow(c->centre[k] + at * c->x[k], 2);
    return dd > 1.1 * c->radius * c->radius;
}

static void form_factors_are_exact(void **state)
{
    (void)state;
    uint seed = 31;
    int cut = 0;
    for (int i = 0; i < 600; i++) {
        area_case c;
        double axis[3], truth[3];
        area_cell(&c, i % 2 ? AREA_DISK : AREA_TUBE, 1, 0, 1, 0);
        direction(&seed, axis);
        area_place(&c, axis, 0.02 + 0.7 * next(&seed), 1 + i % 3, 1.3 * next(&seed), TAU * i / 7);
        if (!is_outside(&c))
            continue;
        area_truth(&c, truth);
        assert_near(form_factor(&c), truth[2], 1e-4);
        cut += truth[2] > 1e-3 && !area_is_whole(&c);
    }
    assert_true(cut > 150);
}

// Half the sky, a facing disk's sin^2, and a tube without length as a sphere is.
static void form_factors_are_the_textbook_ones(void **state)
{
    (void)state;
    vec3 x = vec3(1, 0, 0), y = vec3(0, 1, 0), z = vec3(0, 0, 1), zero = vec3(0, 0, 0);
    assert_near((double)light_disk_form_factor(z, y, x), 0.5, 1e-6);
    assert_near((double)light_disk_form_factor(z, x, y), 0, 0);
    assert_near((double)light_disk_form_factor(1e-3f * z, y, x), 1, 1e-5);
    assert_near((double)light_disk_form_factor(1e-4f * x, z, y), 0.5, 1e-3);
    assert_near((double)light_tube_form_factor(2.0f * z, zero, 1), 0.25, 1e-6);
    assert_near((double)light_tube_form_factor(z, 1e4f * x, 0.5f), 0.5, 1e-4);
}

// ---- limits -------------------------------------------------------------------------------------

static void a_small_light_is_a_point(void **state)
{
    (void)state;
    uint seed = 5;
    for (int i = 0; i < 600; i++) {
        area_case c;
        double axis[3], size = pow(10, -2 - i % 3);
        area_cell(&c, i % 2 ? AREA_QUAD : AREA_DISK, 0.3 + 0.7 * next(&seed), 80 * next(&seed), 1,
                  0);
        direction(&seed, axis);
        axis[2] = 0.1 + 0.9 * fabs(axis[2]);
        vec3 wi = normalize(to_vec3(axis)), wo = to_vec3(c.v), h = wo + wi;
        double l[3] = { (double)wi[0], (double)wi[1], (double)wi[2] };
        area_place(&c, l, size, 1, 0, 3 * next(&seed));
        float a2 = (float)(c.ax * c.ax);
        float expected = microfacet_d_half(h[0] * h[0] + h[1] * h[1], h[2], a2) *
                         microfacet_v(wo[2], wi[2], a2) * wi[2];
        double area = (i % 2 ? 4 : TAU / 2) * size * size, got = (double)lobe(&c)[0] / area;
        double tolerance = 0.02 * (i % 3 == 0) + 3e-3; // float corners: 1e-4 of the distance apart
        assert_near(got / (double)expected, 1, tolerance);
    }
}

// ---- robustness ---------------------------------------------------------------------------------

// The light around the point, through it, edge-on, of no size, with its middle at -v or along v.
static void odd_light(uint *seed, area_case *c, int kind)
{
    double axis[3], at = next(seed);
    area_cell(c, kind, 0.05 + 0.95 * next(seed), 1, 1, 0);
    direction(seed, c->v);
    c->v[2] = at < 0.1 ? 1e-3 : fabs(c->v[2]) + 1e-4;
    vec3 v = normalize(to_vec3(c->v));
    for (int k = 0; k < 3; k++)
        c->v[k] = (double)v[k];
    c->ay = next(seed) < 0.5 ? c->ax : c->ax * (0.1 + 0.9 * next(seed));
    direction(seed, axis);
    for (int k = 0; k < 3; k++)
        axis[k] = at < 0.2 ? -c->v[k] : at < 0.3 ? c->v[k] : axis[k];
    axis[2] *= at > 0.3 && at < 0.4 ? 1e-3 : 1;
    double size = pow(10, 2 - 9 * next(seed)), spread = pow(10, 2 * next(seed) - 1);
    area_place(c, axis, size, spread, TAU * next(seed), TAU * next(seed));
    int odd = (int)(12 * next(seed));
    for (int k = 0; k < 3; k++) {
        double corner = odd == 0 ? c->x[k] + c->y[k] : odd == 1 ? c->x[k] : 0;
        c->centre[k] = odd <= 2 ? corner : c->centre[k];
        c->x[k] *= odd == 3 || odd == 4 ? 0 : odd == 5 ? 1e-8 : 1;
        c->y[k] *= odd == 4 ? 0 : 1;
    }
    c->radius *= odd == 4 ? 0 : 1;
    if (odd == 6)
        c->centre[2] = c->x[2] = c->y[2] = 0;
}

static bool are_finite(const area_case *c)
{
    vec3 o = to_vec3(c->centre), x = to_vec3(c->x), y = to_vec3(c->y), v = to_vec3(c->v);
    float ax = (float)c->ax, ay = (float)c->ay;
    light_lobe b = light_lobe_from_view(v, ax, ay);
    light_fan f = c->kind == AREA_DISK ? light_disk_fan(b, o, x, y)
                  : c->kind == AREA_TUBE
                      ? light_tube_fan(b, o, x, (float)c->radius)
                      : light_quad_fan(b, o - x - y, o + x - y, o + x + y, o - x + y);
    return isfinite(f.sectors) && isfinite(f.whole) && isfinite(f.sum[0]) && isfinite(f.sum[1]) &&
           isfinite(f.node[0]) && isfinite(f.weight);
}

static void no_light_breaks_it(void **state)
{
    (void)state;
    uint seed = 3;
    for (int i = 0; i < 15000; i++) {
        area_case c;
        odd_light(&seed, &c, i % 3);
        vec2 x = lobe(&c);
        assert_true(x[0] >= 0 && x[0] <= 1 && x[1] >= 0 && x[1] <= x[0]);
        assert_true(are_finite(&c));
        double f = form_factor(&c);
        assert_true(f >= 0 && f <= 1);
    }
}

static void float_is_enough(void **state)
{
    (void)state;
    uint seed = 17;
    for (int i = 0; i < 2000; i++) {
        area_case c;
        double axis[3], size = 0.9 * pow(10, -3 * next(&seed));
        area_cell(&c, i % 3, 0.05 + 0.95 * next(&seed), 80 * next(&seed), 1 + 3 * (i % 2), 0.6);
        direction(&seed, axis);
        area_place(&c, axis, size, 1 + i % 4, 1.2 * next(&seed), TAU * next(&seed));
        double y[2];
        light_area_double(&c, y);
        assert_near((double)lobe(&c)[0], y[0], 1e-2 * y[0] + 1e-4);
    }
}

// A small step moves the double text by less than two hundredths of its greatest value nearby:
// there is no seam.
static void there_are_no_seams(void **state)
{
    (void)state;
    const double low[6] = { 0.1, 0.01, 1, -60, -180, 0 }, high[6] = { 1, 0.9, 85, 89, 180, 1.2 };
    uint seed = 29;
    for (int i = 0; i < 180; i++) {
        double p[6];
        for (int k = 0; k < 6; k++)
            p[k] = low[k] + (high[k] - low[k]) * next(&seed);
        int moved = i % 6;
        double step = (high[moved] - low[moved]) / 8192, most = 1e-3, f[65], jump = 0;
        for (int j = 0; j <= 64; j++, p[moved] += step) {
            double up = p[3] * TAU / 360, turn = p[4] * TAU / 360;
            double axis[3] = { -cos(up) * cos(turn), cos(up) * sin(turn), sin(up) };
            area_case c;
            area_cell(&c, i / 6 % 3, p[0], p[2], 2, 0);
            area_place(&c, axis, p[1], 1 + i % 4, p[5], 0.3 * i);
            f[j] = lobe_double(&c);
            most = fmax(most, f[j]);
        }
        for (int j = 1; j < 64; j++)
            jump = fmax(jump, fabs(f[j + 1] - 2 * f[j] + f[j - 1]));
        assert_near(jump / most, 0, 0.02);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_truth_is_true),
        cmocka_unit_test(a_rectangle_s_highlight_is_right),
        cmocka_unit_test(a_disk_s_highlight_is_right),
        cmocka_unit_test(a_tube_s_highlight_is_right),
        cmocka_unit_test(energy_is_kept),
        cmocka_unit_test(form_factors_are_exact),
        cmocka_unit_test(form_factors_are_the_textbook_ones),
        cmocka_unit_test(a_small_light_is_a_point),
        cmocka_unit_test(no_light_breaks_it),
        cmocka_unit_test(float_is_enough),
        cmocka_unit_test(there_are_no_seams),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
