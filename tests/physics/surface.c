// The surface against what must hold of any surface: normalisation, reciprocity, energy.
#include "physics/surface.glsl"
#include "physics/sampling.glsl"

#include "albedo.h"
#include "near.h"

static const float ROUGHNESSES[] = { 0.15f, 0.3f, 0.5f, 0.7f, 0.85f, 1.0f };
static const float COSINES[] = { 0.06f, 0.2f, 0.5f, 0.8f, 0.99f };
enum { ROUGHNESS_COUNT = 6, COSINE_COUNT = 5 };

// The hemisphere of microfacet normals, their area projected down, is the surface.
static void distribution_is_normalised(void **state)
{
    (void)state;
    for (int r = 0; r < ROUGHNESS_COUNT; r++) {
        double alpha = (double)(ROUGHNESSES[r] * ROUGHNESSES[r]), sum = 0.0;
        int steps = 200000;
        for (int i = 0; i < steps; i++) {
            double t = (i + 0.5) / steps * (double)PI / 2.0;
            double d = (double)microfacet_d((float)cos(t), (float)(alpha * alpha));
            sum += d * cos(t) * sin(t) * (double)PI * (double)PI / steps;
        }
        assert_near(sum, 1.0, 1e-3);
    }
}

static void both_forms_of_the_distribution_agree(void **state)
{
    (void)state;
    for (uint i = 0; i < 1000; i++) {
        vec2 u = sampling_hammersley(i, 1000);
        vec3 wo = sampling_cosine(u), wi = sampling_cosine(vec2(u[1], u[0]));
        vec3 h = wo + wi, n = vec3(0.0f, 0.0f, 1.0f), t = cross(n, h);
        float NoH = dot(normalize(h), n);
        float a = microfacet_d(NoH, 0.09f), b = microfacet_d_half(dot(t, t), dot(n, h), 0.09f);
        assert_near((double)b, (double)a, 2e-4 * (double)a);
    }
}

// At the peak of a mirror D = 1 / (pi alpha^2); an angle alpha off it, a quarter of that.
static void mirror_peak_keeps_its_digits(void **state)
{
    (void)state;
    float alpha = SURFACE_MIN_ALPHA, a2 = alpha * alpha;
    double peak = 1.0 / ((double)PI * (double)a2);
    assert_near((double)microfacet_d_half(0.0f, 2.0f, a2) / peak, 1.0, 1e-5);
    float across = 2.0f * alpha; // |n x H| for |H| = 2
    assert_near((double)microfacet_d_half(across * across, 2.0f, a2) / peak, 0.25, 1e-4);
}

static void visible_normals_are_normalised(void **state)
{
    (void)state;
    for (int r = 0; r < ROUGHNESS_COUNT; r++) {
        for (int c = 0; c < COSINE_COUNT; c++) {
            float alpha = ROUGHNESSES[r] * ROUGHNESSES[r], NoV = COSINES[c];
            vec3 wo = vec3(sqrtf(1.0f - NoV * NoV), 0.0f, NoV);
            double sum = 0.0;
            int rows = 4000, columns = 200;
            for (int i = 0; i < rows; i++) {
                double z = 1.0 - pow((i + 0.5) / rows, 3.0); // finer towards the pole
                double dz = 3.0 * pow((i + 0.5) / rows, 2.0) / rows;
                for (int k = 0; k < columns; k++) {
                    double phi = (k + 0.5) / columns * 2.0 * (double)PI, s = sqrt(1.0 - z * z);
                    vec3 h = vec3((float)(s * cos(phi)), (float)(s * sin(phi)), (float)z);
                    sum += (double)sampling_visible_normal_density(wo, h, alpha) * dz * 2.0 *
                           (double)PI / columns;
                }
            }
            assert_near(sum, 1.0, 3e-3);
        }
    }
}

// The samples have the density they claim: means over them against the integral.
static void visible_normals_follow_their_density(void **state)
{
    (void)state;
    float alpha = 0.4f;
    vec3 wo = vec3(0.8f, 0.0f, 0.6f);
    vec3 mean = vec3(0.0f, 0.0f, 0.0f);
    enum { COUNT = 1 << 16 };
    for (uint i = 0; i < COUNT; i++)
        mean += sampling_visible_normal(wo, alpha, sampling_hammersley(i, COUNT)) / (float)COUNT;
    double expected[3] = { 0.0, 0.0, 0.0 };
    int steps = 1000;
    for (int i = 0; i < steps; i++) {
        for (int k = 0; k < steps; k++) {
            double z = (i + 0.5) / steps, phi = (k + 0.5) / steps * 2.0 * (double)PI;
            double s = sqrt(1.0 - z * z), area = 2.0 * (double)PI / steps / steps;
            vec3 h = vec3((float)(s * cos(phi)), (float)(s * sin(phi)), (float)z);
            double p = (double)sampling_visible_normal_density(wo, h, alpha) * area;
            for (int axis = 0; axis < 3; axis++)
                expected[axis] += p * (double)h[axis];
        }
    }
    for (int axis = 0; axis < 3; axis++)
        assert_near((double)mean[axis], expected[axis], 1e-3);
}

static surface make(float metallic, float roughness, float base, albedo e)
{
    surface_material m = {
        .base_color = vec3(base, base, base),
        .metallic = metallic,
        .roughness = roughness,
        .dielectric_f0 = 0.04f,
        .specular_color = vec3(1.0f, 1.0f, 1.0f),
        .specular = 1.0f,
    };
    return surface_from_metallic_roughness(m, 1.0f, vec2((float)e.scale, (float)e.bias));
}

// The visibility term against Heitz' own form of it, G2 / (4 NoL NoV).
static void visibility_is_the_paper_s(void **state)
{
    (void)state;
    for (int r = 0; r < ROUGHNESS_COUNT; r++) {
        for (int i = 0; i < COSINE_COUNT * COSINE_COUNT; i++) {
            double v = (double)COSINES[i / COSINE_COUNT], l = (double)COSINES[i % COSINE_COUNT];
            float a2 = powf(ROUGHNESSES[r], 4.0f);
            double expected = albedo_g2(v, l, (double)a2) / (4.0 * v * l);
            assert_near((double)microfacet_v((float)v, (float)l, a2) / expected, 1.0, 1e-5);
        }
    }
}

static void lobe_is_reciprocal(void **state)
{
    (void)state;
    vec3 n = vec3(0.0f, 0.0f, 1.0f);
    for (uint i = 0; i < 1000; i++) {
        vec2 u = sampling_hammersley(i, 1000);
        vec3 a = sampling_cosine(vec2(u[0] * 0.99f, u[1]));
        vec3 b = sampling_cosine(vec2(u[1] * 0.99f, u[0]));
        surface s = make(0.5f, 0.2f + 0.8f * u[0], 0.7f, (albedo) { 0.8, 0.1 });
        s.lambert = s.bounced = vec3(0.0f, 0.0f, 0.0f);
        float ab = surface_direct(s, n, a, b)[0] / b[2], ba = surface_direct(s, n, b, a)[0] / a[2];
        assert_near((double)ab, (double)ba, 1e-4 * (double)ab);
    }
}

// What the lobe alone reflects under a white sky: half vectors by the distribution's
// inverse, the light's solid angle 4 v.h times theirs.
static double lobe_albedo(surface s, float NoV, double alpha)
{
    s.lambert = s.bounced = vec3(0.0f, 0.0f, 0.0f);
    vec3 n = vec3(0.0f, 0.0f, 1.0f), wo = vec3(sqrtf(1.0f - NoV * NoV), 0.0f, NoV);
    double a2 = alpha * alpha, sum = 0.0;
    enum { STEPS = 300 };
    for (int i = 0; i < STEPS; i++) {
        double t = (i + 0.5) / STEPS, u = 1.0 - pow(1.0 - t, 3.0); // as in albedo.h
        double density = 3.0 * (1.0 - t) * (1.0 - t);
        double NoH = sqrt((1.0 - u) / (1.0 + (a2 - 1.0) * u));
        double sh = sqrt(1.0 - NoH * NoH);
        double d = a2 / ((double)PI * pow(NoH * NoH * (a2 - 1.0) + 1.0, 2.0));
        for (int k = 0; k < STEPS; k++) {
            double phi = (double)PI * (k + 0.5) / STEPS;
            vec3 h = vec3((float)(sh * cos(phi)), (float)(sh * sin(phi)), (float)NoH);
            double VoH = (double)dot(wo, h);
            vec3 wi = reflect(-wo, h);
            if (VoH > 0.0 && wi[2] > 0.0f)
                sum += (double)surface_direct(s, n, wo, wi)[0] * 4.0 * VoH / (d * NoH) * density;
        }
    }
    return sum / ((double)STEPS * STEPS);
}

static double lambert_albedo(surface s)
{
    s.f0 = vec3(0.0f, 0.0f, 0.0f);
    s.f90 = 0.0f;
    vec3 n = vec3(0.0f, 0.0f, 1.0f);
    double sum = 0.0;
    for (int i = 0; i < 1000; i++) {
        float c = ((float)i + 0.5f) / 1000.0f;
        vec3 wi = vec3(sqrtf(1.0f - c * c), 0.0f, c);
        sum += (double)surface_direct(s, n, n, wi)[0] * 2.0 * (double)PI / 1000.0;
    }
    return sum;
}

// A white surface in a white room cannot be seen, however rough, metal or not.
static void white_furnace(void **state)
{
    (void)state;
    for (int metallic = 0; metallic <= 1; metallic++) {
        for (int r = 0; r < ROUGHNESS_COUNT; r++) {
            for (int c = 0; c < COSINE_COUNT; c++) {
                double alpha = (double)(ROUGHNESSES[r] * ROUGHNESSES[r]);
                albedo e = albedo_of((double)COSINES[c], alpha, 300);
                surface s = make((float)metallic, ROUGHNESSES[r], 1.0f, e);
                double direct = lobe_albedo(s, COSINES[c], alpha) + lambert_albedo(s);
                assert_near(direct, 1.0, 0.005);
                vec3 one = vec3(1.0f, 1.0f, 1.0f);
                assert_near((double)surface_environment(s, one, one)[0], 1.0, 1e-5);
            }
        }
    }
}

// Nothing reflects more than it receives; a darker base reflects less.
static void no_surface_makes_light(void **state)
{
    (void)state;
    for (uint i = 0; i < 2000; i++) {
        vec2 u = sampling_hammersley(i, 2000);
        float NoV = 0.05f + 0.94f * u[0], roughness = 0.1f + 0.9f * u[1];
        albedo e = albedo_of((double)NoV, (double)(roughness * roughness), 24);
        surface_material m = {
            .base_color = vec3(u[0], u[1], 1.0f),
            .metallic = sampling_van_der_corput(i * 7u),
            .roughness = roughness,
            .dielectric_f0 = 0.3f * u[1],
            .specular_color = vec3(1.0f, u[0], 0.0f),
            .specular = sampling_van_der_corput(i * 3u),
        };
        surface s = surface_from_metallic_roughness(m, NoV, vec2((float)e.scale, (float)e.bias));
        vec3 one = vec3(1.0f, 1.0f, 1.0f), all = surface_environment(s, one, one);
        for (int k = 0; k < 3; k++)
            assert_true(all[k] >= 0.0f && all[k] <= 1.0001f);
    }
}

// The sum of the bounces: E leaves after the first, sqrt(E) of the rest after each other.
static void bounces_sum_to_their_series(void **state)
{
    (void)state;
    // Schlick's rise to f90 = 1 lifts the mean, at roughness 1 by .1 (1 - .55 (1 + f)) (1 - f)
    // straight on, after the first bounce.
    double f = 0.6, mean = f + (1.0 - f) * 0.1 * (1.0 - 0.55 * (1.0 + f)), e = 0.55;
    double series = f * e, left = f * (1.0 - e);
    for (int i = 0; i < 200;
         i++) { // hit a facet, keep its share; some escapes, the rest hits again
        left *= mean;
        series += left * sqrt(e);
        left *= 1.0 - sqrt(e);
    }
    surface_material m = { .base_color = vec3(0.6f, 0.6f, 0.6f), .metallic = 1.0f, .roughness = 1 };
    surface s = surface_from_metallic_roughness(m, 1.0f, vec2(0.55f, 0.0f));
    assert_near((double)(s.bounced[0] + s.single[0]), series, 1e-6);
}

static void grazing_and_backfacing_are_finite(void **state)
{
    (void)state;
    vec3 n = vec3(0.0f, 0.0f, 1.0f);
    surface s = make(0.0f, 0.0f, 1.0f, (albedo) { 0.9, 0.1 });
    const vec3 directions[] = { vec3(1.0f, 0.0f, 0.0f), vec3(-1.0f, 0.0f, 0.0f),
                                vec3(0.0f, 0.0f, 1.0f), vec3(0.0f, 0.0f, -1.0f),
                                vec3(0.6f, 0.0f, -0.8f) };
    for (int i = 0; i < 25; i++) {
        float f = surface_direct(s, n, directions[i / 5], directions[i % 5])[0];
        assert_true(isfinite(f) && f >= 0.0f);
        if (directions[i % 5][2] <= 0.0f)
            assert_true(f <= 0.0f);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distribution_is_normalised),
        cmocka_unit_test(both_forms_of_the_distribution_agree),
        cmocka_unit_test(mirror_peak_keeps_its_digits),
        cmocka_unit_test(visible_normals_are_normalised),
        cmocka_unit_test(visible_normals_follow_their_density),
        cmocka_unit_test(visibility_is_the_paper_s),
        cmocka_unit_test(lobe_is_reciprocal),
        cmocka_unit_test(white_furnace),
        cmocka_unit_test(no_surface_makes_light),
        cmocka_unit_test(bounces_sum_to_their_series),
        cmocka_unit_test(grazing_and_backfacing_are_finite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
