// Sphere lights and suns: the closed form against quadrature (cap_truth.c), against the point
// light, and against itself in double; the form factor against quadrature.
#include "physics/light_sphere.glsl"
#include "physics/light_punctual.glsl"
#include "physics/microfacet.glsl"
#include "physics/surface_light.glsl"

#include "cap_truth.h"
#include "light_sphere.h"
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

static light_cap cap_of(const cap_case *c)
{
    return (light_cap) { to_vec3(c->axis), (float)c->sin_s, (float)c->cos_s };
}

// Per radiance, with Schlick's Fresnel.
static double lobe(const cap_case *c, double f0)
{
    vec2 x = light_cap_ggx(cap_of(c), to_vec3(c->v), (float)c->ax, (float)c->ay);
    return (f0 * (double)(x[0] - x[1]) + (double)x[1]) * TAU / 2 * c->sin_s * c->sin_s;
}

// ---- the truth itself ---------------------------------------------------------------------------

// A disc of n * n directions of equal solid angle, summed: slow, and independent of cap_truth.
static double brute_force(const cap_case *c, int n)
{
    double up[3] = { -c->axis[2], 0, c->axis[0] }, side[3], sum = 0;
    double length = hypot(up[0], up[2]);
    up[0] /= length;
    up[2] /= length;
    side[0] = c->axis[1] * up[2] - c->axis[2] * up[1];
    side[1] = c->axis[2] * up[0] - c->axis[0] * up[2];
    side[2] = c->axis[0] * up[1] - c->axis[1] * up[0];
    double a2 = c->ax * c->ax, NoV = c->v[2];
    for (int i = 0; i < n * n; i++) {
        double cos_t = 1 - (i / n + 0.5) / n * (1 - c->cos_s), sin_t = sqrt(1 - cos_t * cos_t);
        double phi = TAU * (i % n + 0.5) / n, h[3], h2 = 0, l[3];
        for (int k = 0; k < 3; k++) {
            l[k] = cos_t * c->axis[k] + sin_t * (cos(phi) * up[k] + sin(phi) * side[k]);
            h[k] = l[k] + c->v[k];
            h2 += h[k] * h[k];
        }
        if (l[2] <= 0)
            continue;
        double t = 1 - (1 - a2) * h[2] * h[2] / h2;
        double gv = l[2] * sqrt(NoV * NoV * (1 - a2) + a2);
        double gl = NoV * sqrt(l[2] * l[2] * (1 - a2) + a2);
        sum += a2 / (TAU / 2 * t * t) * 0.5 / (gv + gl) * l[2];
    }
    return sum * TAU * (1 - c->cos_s) / n / n;
}

static void the_truth_is_true(void **state)
{
    (void)state;
    const double radius[] = { 0.05, 0.5, 0.9 }, view[] = { 1, 60, 85 };
    for (int i = 0; i < 9; i++) {
        cap_case c;
        cap_cell(&c, 0.6, radius[i / 3], view[i % 3], 1, 0);
        for (int j = 0; j < 6; j++) {
            double up = 1.4 - 0.35 * j, turn = 0.3 + 0.5 * j; // the last ones are cut, or hidden
            c.axis[0] = -cos(up) * cos(turn);
            c.axis[1] = cos(up) * sin(turn);
            c.axis[2] = sin(up);
            double sum = brute_force(&c, 700);
            assert_near(cap_truth(&c, 0), sum, 2e-3 * sum + 1e-9);
        }
    }
}

// ---- the cubic ----------------------------------------------------------------------------------

// Cubics of known roots, whose coefficients are rounded; Newton's steps in double follow the root.
static void the_root_is_found(void **state)
{
    (void)state;
    uint seed = 23;
    for (int i = 0; i < 200000; i++) {
        double k = pow(10, 6 * next(&seed) - 3), k1 = k * pow(10, 13 * next(&seed) - 9);
        double k2 = i % 7 ? k * pow(10, 13 * next(&seed) - 9) : k1;
        float a = (float)(k - k1 - k2), b = (float)(k1 * k2 - k * (k1 + k2)),
              c = (float)(k * k1 * k2);
        for (int j = 0; j < 20; j++)
            k -= (((k - (double)a) * k + (double)b) * k - (double)c) /
                 ((3 * k - 2 * (double)a) * k + (double)b);
        assert_near((double)light_root(a, b, c) / k, 1, 5e-6);
    }
}

// ---- accuracy -----------------------------------------------------------------------------------

typedef struct bounds {
    double whole, cut, whole_fresnel, cut_fresnel; // RMS error / RMS of the truth
} bounds;

// Some of the directions: the program `accuracy` prints the full table.
static void check_cell(const cap_case *cell, bounds b)
{
    static double axes[CAP_AXES][3];
    double error[4] = { 0 }, total[4] = { 0 };
    int n = cap_cell_axes(cell, axes);
    for (int i = 0; i < n; i += cell->ax == cell->ay ? 3 : 5) {
        cap_case c = *cell;
        memcpy(c.axis, axes[i], sizeof c.axis);
        double plain = cap_truth(&c, 0), bent = cap_truth(&c, 5);
        double truth[2] = { plain, 0.04 * (plain - bent) + bent };
        for (int k = 0; k < 2; k++) {
            int part = 2 * k + (c.axis[2] <= c.sin_s);
            double e = lobe(&c, k ? 0.04 : 1) - truth[k];
            error[part] += e * e;
            total[part] += truth[k] * truth[k];
        }
    }
    const double limit[4] = { b.whole, b.cut, b.whole_fresnel, b.cut_fresnel };
    for (int part = 0; part < 4; part++)
        assert_near(sqrt(error[part] / total[part]), 0, limit[part]);
}

static void check_table(double anisotropy, double turn, bounds small, bounds large)
{
    const double roughness[] = { 0.05, 0.2, 0.5, 1 }, radius[] = { 0.005, 0.2, 0.9 };
    const double view[] = { 1, 60, 85 };
    for (int i = 0; i < 36; i++) {
        cap_case c;
        cap_cell(&c, roughness[i / 9], radius[i / 3 % 3], view[i % 3], anisotropy, turn);
        check_cell(&c, c.sin_s > 0.5 ? large : small);
    }
}

static void the_highlight_is_right(void **state)
{
    (void)state;
    check_table(1, 0, (bounds) { 0.01, 0.02, 0.015, 0.02 }, (bounds) { 0.01, 0.03, 0.02, 0.07 });
}

static void the_anisotropic_highlight_is_right(void **state)
{
    (void)state;
    check_table(10, 0.6, (bounds) { 0.01, 0.02, 0.02, 0.025 }, (bounds) { 0.01, 0.05, 0.02, 0.06 });
}

// Summed over all positions of the light, by equal solid angle.
static void energy_is_kept(void **state)
{
    (void)state;
    const double roughness[] = { 0.2, 0.5, 1 }, radius[] = { 0.2, 0.5, 0.9 },
                 view[] = { 1, 60, 85 };
    enum { POSITIONS = 400 };
    for (int i = 0; i < 27; i++) {
        cap_case c;
        cap_cell(&c, roughness[i / 9], radius[i / 3 % 3], view[i % 3], 1, 0);
        double sum = 0, truth = 0;
        for (int j = 0; j < POSITIONS; j++) {
            double z = 1 - (j + 0.5) / POSITIONS * (1 + c.sin_s), r = sqrt(1 - z * z);
            double phi = TAU * 0.61803398875 * j;
            double axis[3] = { r * cos(phi), r * sin(phi), z };
            memcpy(c.axis, axis, sizeof axis);
            sum += lobe(&c, 1);
            truth += cap_truth(&c, 0);
        }
        assert_near(sum / truth, 1, c.sin_s > 0.5 ? 0.02 : 0.01);
    }
}

// ---- limits -------------------------------------------------------------------------------------

static void a_small_light_is_a_point(void **state)
{
    (void)state;
    uint seed = 5;
    for (int i = 0; i < 2000; i++) {
        double roughness = 0.3 + 0.7 * next(&seed), l[3], v[3];
        float alpha = (float)(roughness * roughness);
        direction(&seed, v);
        direction(&seed, l);
        v[2] = 0.1 + 0.9 * fabs(v[2]);
        l[2] = 0.1 + 0.9 * fabs(l[2]);
        vec3 wo = normalize(to_vec3(v)), wi = normalize(to_vec3(l)), h = wo + wi;
        float across = h[0] * h[0] + h[1] * h[1];
        float expected = microfacet_d_half(across, h[2], alpha * alpha) *
                         microfacet_v(wo[2], wi[2], alpha * alpha) * wi[2];
        for (int k = 2; k <= 8; k++) { // 8: nothing left of it
            float radius = k < 8 ? powf(10, (float)-k) : 0;
            light_cap cap = light_cap_sphere(2.0f * wi, 2.0f * radius);
            float got = light_cap_ggx(cap, wo, alpha, alpha)[0];
            double tolerance = 1e-4 + (k == 2 ? 0.02 : k == 3 ? 3e-4 : 0);
            assert_near((double)(got / expected), 1, tolerance);
            assert_near((double)light_cap_cosine(cap), (double)wi[2], 1e-6);
        }
    }
}

static void a_sun_is_a_sphere_far_away(void **state)
{
    (void)state;
    uint seed = 11;
    for (int i = 0; i < 500; i++) {
        double l[3];
        direction(&seed, l);
        vec3 wi = normalize(to_vec3(l));
        float angle = (float)(0.9 * next(&seed));
        light_cap sun = light_cap_sun(wi, angle), sphere = light_cap_sphere(wi, sinf(angle));
        vec3 wo = vec3(0.6f, 0, 0.8f);
        vec2 a = light_cap_ggx(sun, wo, 0.3f, 0.1f), b = light_cap_ggx(sphere, wo, 0.3f, 0.1f);
        assert_near((double)a[0], (double)b[0], 1e-3 * (double)b[0] + 1e-5);
        assert_near((double)light_cap_cosine(sun), (double)light_cap_cosine(sphere), 1e-5);
    }
}

// In any frame, under any normal; the eye may stand on the normal or below the horizon.
static void a_surface_sees_a_small_light_as_a_point(void **state)
{
    (void)state;
    uint seed = 41;
    const surface s = {
        .lambert = vec3(0.3f, 0.2f, 0.1f), .f0 = vec3(0.9f, 0.5f, 0.04f), .f90 = 1, .a2 = 0.09f
    };
    for (int i = 0; i < 2000; i++) {
        double a[3], b[3], c[3];
        direction(&seed, a);
        direction(&seed, b);
        direction(&seed, c);
        vec3 n = normalize(to_vec3(a)), wi = normalize(to_vec3(c));
        vec3 wo = i % 7 == 0 ? n : normalize(to_vec3(b));
        wo = dot(n, wo) < 0 ? -wo : wo;
        wi = dot(n, wi) < 0 ? -wi : wi;
        if (dot(n, wi) < 0.05f || dot(n, wo) < 0.05f)
            continue;
        vec3 expected = surface_direct(s, n, wo, wi);
        vec3 got = surface_cap(s, n, wo, light_cap_sphere(3.0f * wi, 3e-4f));
        for (int k = 0; k < 3; k++)
            assert_near((double)got[k], (double)expected[k], 1e-3 * (double)expected[k]);
    }
}

// The clamped cosine over a cap by quadrature in rings about the axis.
static double cosine_by_rings(double c, double sin_s)
{
    enum { RINGS = 400, ANGLES = 400 };
    double sum = 0, q = sqrt(fmax(0, 1 - c * c));
    for (int i = 0; i < RINGS; i++) {
        double t = (i + 0.5) / RINGS * asin(sin_s), ring = 0;
        for (int j = 0; j < ANGLES; j++)
            ring += fmax(0, c * cos(t) + q * sin(t) * cos(TAU * (j + 0.5) / ANGLES));
        sum += ring / ANGLES * TAU * sin(t);
    }
    return sum / RINGS * asin(sin_s) / (TAU / 2 * sin_s * sin_s);
}

static void the_form_factor_is_exact(void **state)
{
    (void)state;
    const float sines[] = { 1e-3f, 0.05f, 0.3f, 0.33f, 0.6f, 0.95f, 1 };
    for (int i = 0; i < 7; i++) {
        for (int j = 0; j <= 40; j++) {
            float s = sines[i], c = clamp((float)(j - 20) / 20, -1.0f, 1.0f);
            if (i < 3) // small ones are cut near the horizon only
                c *= 1.1f * s;
            light_cap cap = { vec3(0, sqrtf(1 - c * c), c), s, sqrtf((1 - s) * (1 + s)) };
            assert_near((double)light_cap_cosine(cap), cosine_by_rings((double)c, (double)s),
                        2e-5 * (double)s + 1e-4 * (s == 1));
        }
    }
    // The hemisphere, exactly, and from within.
    light_cap within = light_cap_sphere(vec3(0, 3, 4), 6);
    assert_near((double)light_cap_cosine(within), (1 + 0.8) / 2, 1e-6);
    assert_near((double)light_cap_cosine(light_cap_sphere(vec3(0, 0, 0), 1)), 1, 1e-6);
}

// ---- robustness ---------------------------------------------------------------------------------

// Corner upon corner: lights at the pole, at the eye, behind the mirror, touching the horizon.
static void odd_axis(uint *seed, const double v[3], double s, double axis[3])
{
    direction(seed, axis);
    double way = next(seed) < 0.5 ? -1 : 1, at = next(seed), turn = TAU * next(seed);
    double z = s * (at < 0.5 ? way : 2 * next(seed) - 1), r = sqrt(fmax(0, 1 - z * z));
    switch ((int)(8 * next(seed))) {
    case 0: axis[0] = axis[1] = 0, axis[2] = way; break;
    case 1: axis[0] = way * v[0], axis[1] = way * v[1], axis[2] = way * v[2]; break;
    case 2: axis[0] = -v[0], axis[1] = -v[1], axis[2] = v[2]; break;
    case 3: axis[2] = 0; break;
    case 4: axis[0] = r * cos(turn), axis[1] = r * sin(turn), axis[2] = z; break;
    case 5: axis[0] = -v[0], axis[1] = -v[1], axis[2] = -v[2] + 0.01 * at; break;
    default: break;
    }
}

static void no_input_breaks_it(void **state)
{
    (void)state;
    uint seed = 3;
    for (int i = 0; i < 200000; i++) {
        double v[3], axis[3], at = next(&seed);
        direction(&seed, v);
        v[2] = at < 0.1 ? 1e-4 : at < 0.2 ? 1e-4 + 0.01 * next(&seed) : fabs(v[2]);
        vec3 wo = at > 0.95 ? vec3(0, 0, 1) : normalize(to_vec3(v));
        double eye[3] = { (double)wo[0], (double)wo[1], (double)wo[2] };
        double radius = at < 0.3 ? 1 - pow(10, -7 * next(&seed)) : pow(10, 1 - 8 * next(&seed));
        radius = at > 0.5 && at < 0.52 ? 0 : radius;
        odd_axis(&seed, eye, fmin(1, radius), axis);
        light_cap cap = light_cap_sphere(normalize(to_vec3(axis)), (float)radius);
        float ax = (float)(0.002 + 0.998 * pow(next(&seed), 3));
        float ay = at < 0.6 ? ax : (float)(0.002 + 0.998 * pow(next(&seed), 3));
        vec2 x = light_cap_ggx(cap, wo, ax, ay);
        double most = 1.001 / ((double)PI * fmax((double)cap.sin_s * (double)cap.sin_s, 1e-30));
        assert_true(x[0] >= 0 && (double)x[0] <= most);
        assert_true(x[1] >= 0 && x[1] <= x[0] * 1.0001f);
        float c = light_cap_cosine(cap);
        assert_true(c >= 0 && c <= 1.0001f);
    }
}

static void float_is_enough(void **state)
{
    (void)state;
    uint seed = 17;
    for (int i = 0; i < 100000; i++) {
        double v[3], axis[3], radius = pow(10, -5 * next(&seed)) * 0.95;
        direction(&seed, v);
        v[2] = 0.1 + fabs(v[2]);
        vec3 wo = normalize(to_vec3(v));
        double eye[3] = { (double)wo[0], (double)wo[1], (double)wo[2] };
        odd_axis(&seed, eye, radius, axis);
        axis[2] = fabs(axis[2]);
        light_cap cap = light_cap_sphere(normalize(to_vec3(axis)), (float)radius);
        float ax = (float)(0.0025 + 0.9975 * pow(next(&seed), 3)), ay = i % 2 ? ax : 0.4f * ax;
        float a[3] = { cap.axis[0], cap.axis[1], cap.axis[2] }, e[3] = { wo[0], wo[1], wo[2] };
        double x[2];
        light_sphere_double(a, cap.sin_s, cap.cos_s, e, ax, ay, x);
        double got = (double)light_cap_ggx(cap, wo, ax, ay)[0];
        assert_near(got, x[0], 5e-3 * x[0] + 1e-3);
    }
}

// A small step moves the double text by less than a hundredth of its greatest value nearby:
// there is no seam.  Roughness, radius, view, elevation, azimuth.
static double swept(const double p[5])
{
    double theta = p[2] * TAU / 360, up = p[3] * TAU / 360, turn = p[4] * TAU / 360, x[2];
    float v[3] = { (float)sin(theta), 0, (float)cos(theta) };
    float axis[3] = { (float)(-cos(up) * cos(turn)), (float)(cos(up) * sin(turn)), (float)sin(up) };
    float s = (float)p[1], alpha = (float)(p[0] * p[0]);
    light_sphere_double(axis, s, sqrtf((1 - s) * (1 + s)), v, alpha, 0.5f * alpha, x);
    return (0.2 * x[0] + 0.8 * x[1]) * p[1] * p[1];
}

static void there_are_no_seams(void **state)
{
    (void)state;
    const double low[5] = { 0.1, 0.01, 1, -60, -180 }, high[5] = { 1, 0.95, 85, 89, 180 };
    uint seed = 29;
    for (int i = 0; i < 3000; i++) {
        double p[5];
        for (int k = 0; k < 5; k++)
            p[k] = low[k] + (high[k] - low[k]) * next(&seed);
        int moved = i % 5;
        double step = (high[moved] - low[moved]) / 8192, most = 1e-3, f[65], jump = 0;
        for (int j = 0; j <= 64; j++, p[moved] += step) {
            f[j] = swept(p);
            most = fmax(most, f[j]);
        }
        for (int j = 1; j < 64; j++)
            jump = fmax(jump, fabs(f[j + 1] - 2 * f[j] + f[j - 1]));
        assert_near(jump / most, 0, 0.01);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_truth_is_true),
        cmocka_unit_test(the_root_is_found),
        cmocka_unit_test(the_highlight_is_right),
        cmocka_unit_test(the_anisotropic_highlight_is_right),
        cmocka_unit_test(energy_is_kept),
        cmocka_unit_test(a_small_light_is_a_point),
        cmocka_unit_test(a_surface_sees_a_small_light_as_a_point),
        cmocka_unit_test(a_sun_is_a_sphere_far_away),
        cmocka_unit_test(the_form_factor_is_exact),
        cmocka_unit_test(no_input_breaks_it),
        cmocka_unit_test(float_is_enough),
        cmocka_unit_test(there_are_no_seams),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
