// Directions sampled by the surface's lobes against the densities they claim, and these against
// the lobes.
#include "lobe_case.h"

#include "physics/surface.glsl"

#include "albedo.h"
#include "chi_squared.h"
#include "near.h"

static const double TAU = 6.283185307179586;

static lobe_case make(int kind, double cosine, double azimuth, double ax, double ay,
                      double parameter)
{
    double s = sqrt(1 - cosine * cosine);
    lobe_case c = { kind, { s * cos(azimuth), s * sin(azimuth), cosine }, ax, ay, parameter };
    for (int k = 0; k < 3; k++)
        c.wo[k] = (double)(float)c.wo[k];
    return c;
}

static const double COSINES[] = { 1, 0.8, 0.3, 0.05, 0.002 };
static const double ALPHAS[] = { 0.002, 0.02, 0.2, 0.6, 1 };
enum { COSINE_COUNT = 5, ALPHA_COUNT = 5, LOBES = COSINE_COUNT * (2 * ALPHA_COUNT + 7) };

// All lobes from all sides: GGX round and anisotropic, 10 : 1; Blinn; EON; the cosine.
static int lobes(lobe_case out[LOBES])
{
    int n = 0;
    for (int i = 0; i < COSINE_COUNT; i++) {
        double z = COSINES[i];
        for (int k = 0; k < ALPHA_COUNT; k++) {
            double a = ALPHAS[k];
            out[n++] = make(LOBE_GGX, z, 1.0, a, a, 0);
            a = fmax(a / 10, 0.002);
            a = fmax(a / 10, 0.002);
            out[n++] = make(LOBE_GGX, z, 0.4 + i, k % 2 ? a : 10 * a, k % 2 ? 10 * a : a, 0);
        }
        for (int k = 0; k < 3; k++) {
            double shininess = k == 0 ? 1 : k == 1 ? 30 : 10000, a = sqrt(2 / (shininess + 2));
            out[n++] = make(LOBE_BLINN, z, 2.0, a, a, shininess);
        }
        for (int k = 0; k < 3; k++)
            out[n++] = make(LOBE_EON, z, 0.7 * k, 1, 1, 0.5 * k);
        out[n++] = make(LOBE_COSINE, z, 0, 1, 1, 0);
    }
    return n;
}

// ---- the charts --------------------------------------------------------------

static bool is_diffuse(const lobe_case *c)
{
    return c->kind == LOBE_EON || c->kind == LOBE_COSINE;
}

// Diffuse lobes: height and azimuth of the direction.  The others: depth and azimuth of its half
// vector, stretched by 1 / (ax, ay, 1).
static double chart_density(const void *of, double s, double t)
{
    const lobe_case *c = of;
    double phi = TAU * t;
    if (is_diffuse(c)) {
        double r = sqrt(1 - s * s);
        return TAU * lobe_density_double(c, (double[]) { r * cos(phi), r * sin(phi), s });
    }
    double r = sqrt(1 / ((1 - s) * (1 - s)) - 1), x = c->ax * r * cos(phi),
           y = c->ay * r * sin(phi);
    double z = 1 / sqrt(1 + x * x + y * y), h[3] = { x * z, y * z, z }, wi[3];
    double VoH = h[0] * c->wo[0] + h[1] * c->wo[1] + h[2] * c->wo[2];
    for (int k = 0; k < 3; k++)
        wi[k] = 2 * VoH * h[k] - c->wo[k];
    double spread = TAU * c->ax * c->ay * pow(z / (1 - s), 3);
    return wi[2] > 0 && VoH > 0 ? 4 * VoH * spread * lobe_density_double(c, wi) : 0;
}

static void chart_sample(const void *of, const double u[2], double place[2])
{
    const lobe_case *c = of;
    vec3 d = lobe_sample(c, vec2((float)u[0], (float)u[1]));
    double wi[3] = { (double)d[0], (double)d[1], (double)d[2] }, x = wi[0], y = wi[1];
    place[0] = wi[2];
    if (!is_diffuse(c)) {
        double z = wi[2] + c->wo[2];
        x = (wi[0] + c->wo[0]) / (z * c->ax);
        y = (wi[1] + c->wo[1]) / (z * c->ay);
        place[0] = 1 - 1 / sqrt(1 + x * x + y * y);
    }
    if (wi[2] <= 0)
        place[0] = -1;
    double turn = atan2(y, x) / TAU;
    place[1] = turn - floor(turn);
}

static void lobes_have_the_density_they_claim(void **state)
{
    (void)state;
    lobe_case all[LOBES];
    int count = lobes(all);
    double least = 1 - pow(1 - 1e-3, 1.0 / count); // Sidak
    for (int i = 0; i < count; i++) {
        chi_chart chart = { &all[i], chart_density, chart_sample };
        double total, chance = chi_squared(&chart, 100000, 17 + (uint64_t)i, &total);

        if (!(chance > least && total < 1.002 && (!is_diffuse(&all[i]) || total > 0.998)))
            print_error("lobe %d of %d: chance %g, total %g\n", i, all[i].kind, chance, total);
        assert_true(chance > least);
        assert_true(total < 1.002);
        if (is_diffuse(&all[i]))
            assert_near(total, 1, 2e-3);
    }
}

// Digits at the peak of a mirror, and no density that is infinite or none.
static void float_is_enough(void **state)
{
    (void)state;
    lobe_case all[LOBES];
    int count = lobes(all);
    for (int i = 0; i < count; i++) {
        for (uint k = 0; k < 2000; k++) {
            vec3 wi = lobe_sample(&all[i], sampling_hammersley(k, 2000));
            double d[3] = { (double)wi[0], (double)wi[1], (double)wi[2] };
            assert_near((double)dot(wi, wi), 1, 1e-5);
            double exact = lobe_density_double(&all[i], d);
            double got = (double)lobe_density(&all[i], wi);
            assert_near(got, exact, 2e-3 * exact);
            assert_true(wi[2] <= 0 || (got > 0 && got < 1e12));
        }
    }
}

static void ends_of_the_square_are_directions(void **state)
{
    (void)state;
    const float end[] = { 0, 0.5f, 0.99999994f };
    lobe_case all[LOBES];
    int count = lobes(all);
    for (int i = 0; i < 9 * count; i++) {
        vec3 wi = lobe_sample(&all[i / 9], vec2(end[i % 3], end[i / 3 % 3]));
        assert_near((double)dot(wi, wi), 1, 1e-5);
        assert_true(lobe_density(&all[i / 9], wi) >= 0);
    }
}

// ---- against the lobes -------------------------------------------------------

// What GGX reflects, by its samples, against quadrature over the half vectors.
static void ggx_samples_give_the_albedo(void **state)
{
    (void)state;
    for (int i = 0; i < (COSINE_COUNT - 1) * ALPHA_COUNT; i++) {
        double z = COSINES[i % (COSINE_COUNT - 1)], alpha = ALPHAS[i / (COSINE_COUNT - 1)];
        lobe_case c = make(LOBE_GGX, z, 0.5, alpha, alpha, 0);
        vec3 wo = lobe_vec3(c.wo);
        double sum = 0, square = 0;
        enum { COUNT = 1 << 14 };
        for (uint k = 0; k < COUNT; k++) {
            vec3 wi = lobe_sample(&c, sampling_hammersley(k, COUNT));
            if (wi[2] <= 0)
                continue;
            vec3 h = wo + wi;
            float f = microfacet_d_half(h[0] * h[0] + h[1] * h[1], h[2], (float)(alpha * alpha)) *
                      microfacet_v(wo[2], wi[2], (float)(alpha * alpha)) * wi[2];
            double w = (double)(f / lobe_density(&c, wi));
            sum += w / COUNT;
            square += w * w / COUNT;
            assert_true(w < 1.0001); // G2 / G1 and the part of the cap: none counts for more
        }
        albedo e = albedo_of(z, alpha, 400);
        assert_near(sum, e.scale + e.bias, 3e-3);
        assert_true(square - sum * sum < 0.1);
    }
}

// The bound leaves out directions below the horizon, and none above.
static void the_bound_saves_samples(void **state)
{
    (void)state;
    lobe_case c = make(LOBE_GGX, 0.3, 0, 1, 1, 0);
    vec3 wo = lobe_vec3(c.wo);
    int below = 0, below_free = 0;
    enum { COUNT = 1 << 14 };
    for (uint k = 0; k < COUNT; k++) {
        vec2 u = sampling_hammersley(k, COUNT);
        below += lobe_sample(&c, u)[2] <= 0;
        below_free += reflect(-wo, sampling_visible_normal(wo, 1, u))[2] <= 0;
    }
    assert_true(below_free > COUNT / 5);
    assert_true(below < below_free / 2);
}

// White EON by its samples is a mirror of all light, and evenly so.
static void eon_samples_give_the_albedo(void **state)
{
    (void)state;
    for (int i = 0; i < 3 * COSINE_COUNT; i++) {
        lobe_case c = make(LOBE_EON, COSINES[i % COSINE_COUNT], 2, 1, 1, 0.5 * (i / COSINE_COUNT));
        vec3 wo = lobe_vec3(c.wo), one = vec3(1, 1, 1);
        double sum = 0, square = 0, cosine = 0;
        enum { COUNT = 1 << 14 };
        for (uint k = 0; k < COUNT; k++) {
            vec2 u = sampling_hammersley(k, COUNT);
            vec3 wi = lobe_sample(&c, u), l = sampling_cosine(u);
            float r = (float)c.parameter;
            float f = diffuse_eon(one, r, wi[2], wo[2], dot(wi, wo))[0] * wi[2];
            double w = (double)(f / lobe_density(&c, wi));
            double by_cosine = (double)(PI * diffuse_eon(one, r, l[2], wo[2], dot(l, wo))[0]);
            sum += w / COUNT;
            square += w * w / COUNT;
            cosine += by_cosine * by_cosine / COUNT;
        }
        assert_near(sum, 1, 3e-3);
        assert_true(square - 1 < 0.15 && square < cosine + 2e-2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lobes_have_the_density_they_claim),
        cmocka_unit_test(float_is_enough),
        cmocka_unit_test(ends_of_the_square_are_directions),
        cmocka_unit_test(ggx_samples_give_the_albedo),
        cmocka_unit_test(the_bound_saves_samples),
        cmocka_unit_test(eon_samples_give_the_albedo),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
