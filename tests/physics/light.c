// Fresnel, punctual lights, environments and their harmonics against published numbers,
// numbers worked out by hand, and quadrature.
#include "physics/environment.glsl"
#include "physics/fresnel.glsl"
#include "physics/light_punctual.glsl"
#include "physics/sampling.glsl"
#include "physics/sh.glsl"
#include "physics/specular_aa.glsl"

#include "near.h"

#include <complex.h>
#undef I

static const double TAU = 6.28318530717958648;

// Indices from refractiveindex.info at 650, 550 and 450 nm or near; reflectances worked
// out from them with complex arithmetic.
typedef struct metal {
    float n[3], k[3], f0[3];
} metal;

static const metal GOLD = { { 0.18601f, 0.59580f, 1.4120f },
                            { 3.3762f, 2.0765f, 1.7827f },
                            { 0.941896f, 0.652515f, 0.372149f } };
static const metal SILVER = { { 0.15865f, 0.14215f, 0.13533f },
                              { 3.8929f, 3.0051f, 2.3276f },
                              { 0.961533f, 0.944984f, 0.919287f } };
static const metal COPPER = { { 0.28046f, 0.85418f, 1.3284f },
                              { 3.5587f, 2.4518f, 2.2949f },
                              { 0.921571f, 0.638416f, 0.502845f } };

// Fresnel's amplitudes by complex arithmetic: Born & Wolf 1999, section 1.5.2, eq. 20.
static double reflectance(double complex index, double c)
{
    double complex t = csqrt(1.0 - (1.0 - c * c) / (index * index));
    double s = cabs((c - index * t) / (c + index * t));
    double p = cabs((index * c - t) / (index * c + t));
    return 0.5 * (s * s + p * p);
}

static void metals_reflect_as_measured(void **state)
{
    (void)state;
    const metal metals[] = { GOLD, SILVER, COPPER };
    for (int i = 0; i < 9; i++) {
        const metal *m = &metals[i / 3];
        float n = m->n[i % 3], k = m->k[i % 3];
        assert_near((double)fresnel_f0_conductor(n, k), (double)m->f0[i % 3], 1e-6);
        for (int step = 0; step <= 20; step++) {
            double c = step / 20.0,
                   expected = reflectance((double)n + (double)k * (double complex)_Complex_I, c);
            assert_near((double)fresnel_conductor((float)c, n, k), expected, 2e-6);
        }
    }
}

static void dielectrics_reflect_as_fresnel_says(void **state)
{
    (void)state;
    assert_near((double)fresnel_f0_dielectric(1.5f), 0.04, 1e-7);
    assert_near((double)fresnel_f0_dielectric(0.0f), 1.0, 0.0); // KHR_materials_ior
    for (int step = 1; step <= 20; step++) {
        double c = step / 20.0;
        assert_near((double)fresnel_dielectric((float)c, 1.5f), reflectance(1.5, c), 1e-6);
        assert_near((double)fresnel_dielectric((float)c, 0.7f), reflectance(0.7, c), 2e-6);
    }
    float critical = sqrtf(1.0f - 0.7f * 0.7f); // below it everything is reflected
    assert_near((double)fresnel_dielectric(critical * 0.99f, 0.7f), 1.0, 0.0);
    // Brewster: no p-polarised light comes back, so half of the s-polarised is all.
    double c = 1.0 / sqrt(1.0 + 1.5 * 1.5), t = sqrt(1.0 - (1.0 - c * c) / 2.25);
    double s = (c - 1.5 * t) / (c + 1.5 * t);
    assert_near((double)fresnel_dielectric((float)c, 1.5f), 0.5 * s * s, 1e-6);
}

static void schlick_has_its_ends_and_mean(void **state)
{
    (void)state;
    vec3 f0 = vec3(0.04f, 0.5f, 1.0f);
    assert_near((double)fresnel_schlick(f0, 0.9f, 1.0f)[1], 0.5, 1e-7);
    assert_near((double)fresnel_schlick(f0, 0.9f, 0.0f)[1], 0.9, 1e-7);
    assert_near((double)fresnel_schlick(f0, 1.0f, 0.5f)[0], 0.04 + 0.96 / 32.0, 1e-7);
    double mean = 0.0;
    for (int i = 0; i < 1000; i++) {
        float c = ((float)i + 0.5f) / 1000.0f;
        mean += 2.0 * (double)(c * fresnel_schlick(f0, 0.9f, c)[0]) / 1000.0;
    }
    assert_near((double)fresnel_schlick_mean(f0, 0.9f)[0], mean, 1e-5);
}

static void point_lights_fall_off(void **state)
{
    (void)state;
    assert_near((double)light_point(4.0f, 0.0f), 0.25, 0.0);
    // d = 2 m, range 4 m: (1 - 1/16) / 4.
    assert_near((double)light_point(4.0f, 1.0f / 16.0f), 0.234375, 1e-7);
    assert_near((double)light_point(16.0f, 1.0f / 16.0f), 0.0, 0.0);
    assert_near((double)light_point(25.0f, 1.0f / 16.0f), 0.0, 0.0);
    assert_true(isfinite(light_point(0.0f, 0.0f)));
}

static void spot_lights_have_their_cone(void **state)
{
    (void)state;
    vec2 cone = light_spot_cone(1.0f, cosf(PI / 4.0f)); // inner 0, outer 45 degrees
    // At 30 degrees ((cos 30 - cos 45) / (1 - cos 45))^2.
    assert_near((double)light_spot(cosf(PI / 6.0f), cone), 0.294395, 2e-6);
    assert_near((double)light_spot(1.0f, cone), 1.0, 1e-6);
    assert_near((double)light_spot(cosf(PI / 4.0f + 0.01f), cone), 0.0, 0.0);
    cone = light_spot_cone(cosf(0.3f), cosf(0.3f)); // a hard edge is .001 wide
    assert_near((double)light_spot(cosf(0.29f), cone), 1.0, 0.0);
    assert_near((double)light_spot(cosf(0.31f), cone), 0.0, 0.0);
}

static void normals_spread_into_roughness(void **state)
{
    (void)state;
    vec3 x = vec3(sqrtf(0.02f), 0.0f, 0.0f), y = vec3(0.0f, sqrtf(0.03f), 0.0f);
    // .01 + 2 (.02 + .03) / (2 pi)
    assert_near((double)specular_aa_alpha2(0.01f, x, y), 0.0259155, 1e-6);
    assert_near((double)specular_aa_alpha2(0.01f, 9.0f * x, y), 0.19, 1e-6);
    vec3 none = vec3(0.0f, 0.0f, 0.0f);
    assert_near((double)specular_aa_alpha2(0.35f, none, none), 0.35, 1e-6);
    assert_near((double)specular_aa_alpha2(1.0f, x, y), 1.0, 0.0);
}

static void harmonics_are_orthonormal(void **state)
{
    (void)state;
    enum { COUNT = 1 << 16 };
    double product[9][9] = { { 0 } };
    for (uint i = 0; i < COUNT; i++) { // points of equal area on the sphere
        vec2 u = sampling_hammersley(i, COUNT);
        double z = 1.0 - 2.0 * (double)u[0], s = sqrt(1.0 - z * z), phi = TAU * (double)u[1];
        vec3 d = vec3((float)(s * cos(phi)), (float)(s * sin(phi)), (float)z);
        for (uint a = 0; a < 9; a++)
            for (uint b = 0; b < 9; b++)
                product[a][b] += (double)(sh_basis(a, d) * sh_basis(b, d)) * 2.0 * TAU / COUNT;
    }
    for (int a = 0; a < 9; a++)
        for (int b = 0; b < 9; b++)
            assert_near(product[a][b], a == b, 1e-3);
}

// A sky without anything above order 2, and one that is white above and black below.
static double smooth_sky(vec3 d)
{
    return (double)(1.0f + 0.5f * d[0] - 0.3f * d[1] * d[2] + 0.4f * d[2] * d[2] + 0.2f * d[1]);
}
static double half_sky(vec3 d)
{
    return d[1] > 0.0f ? 1.0 : 0.0;
}

static void project(double (*sky)(vec3 d), vec3 c[9])
{
    enum { COUNT = 1 << 18 };
    double sum[9] = { 0 };
    for (uint i = 0; i < COUNT; i++) {
        vec2 u = sampling_hammersley(i, COUNT);
        double z = 1.0 - 2.0 * (double)u[0], s = sqrt(1.0 - z * z), phi = TAU * (double)u[1];
        vec3 d = vec3((float)(s * cos(phi)), (float)(s * sin(phi)), (float)z);
        for (uint k = 0; k < 9; k++)
            sum[k] += sky(d) * (double)sh_basis(k, d) * 2.0 * TAU / COUNT;
    }
    for (int k = 0; k < 9; k++)
        c[k] = vec3((float)sum[k], 0.0f, 0.0f);
}

static double irradiance_over_pi(double (*sky)(vec3 d), vec3 n)
{
    enum { COUNT = 1 << 16 };
    vec3 up = fabsf(n[1]) < 0.9f ? vec3(0.0f, 1.0f, 0.0f) : vec3(1.0f, 0.0f, 0.0f);
    vec3 t = normalize(cross(up, n)), b = cross(n, t);
    double sum = 0.0;
    for (uint i = 0; i < COUNT; i++) {
        vec3 l = sampling_cosine(sampling_hammersley(i, COUNT));
        sum += sky(t * l[0] + b * l[1] + n * l[2]) / COUNT;
    }
    return sum;
}

static void harmonics_give_the_irradiance(void **state)
{
    (void)state;
    vec3 smooth[9], half[9];
    project(smooth_sky, smooth);
    project(half_sky, half);
    for (uint i = 0; i < 32; i++) {
        vec3 n = sampling_cosine(sampling_hammersley(i, 32));
        n = i % 2 ? n : -n;
        n = i % 3 ? n : vec3(n[1], n[2], n[0]);
        assert_near((double)sh_irradiance(smooth, n)[0], irradiance_over_pi(smooth_sky, n), 2e-3);
        assert_near((double)sh_irradiance(half, n)[0], 0.5 + 0.5 * (double)n[1], 2e-3);
    }
    vec3 lobe[9] = { [3] = vec3(1.0f, 1.0f, 1.0f) }; // negative on the far side
    assert_near((double)sh_irradiance(lobe, vec3(-1.0f, 0.0f, 0.0f))[0], 0.0, 0.0);
}

static void directions_map_to_the_image_and_back(void **state)
{
    (void)state;
    vec2 centre = environment_uv(vec3(1.0f, 0.0f, 0.0f)), up = environment_uv(vec3(0, 1.0f, 0));
    vec2 side = environment_uv(vec3(0.0f, 0.0f, 1.0f));
    assert_near((double)centre[0], 0.5, 0.0);
    assert_near((double)centre[1], 0.5, 1e-7);
    assert_near((double)up[1], 0.0, 0.0);
    assert_near((double)side[0], 0.75, 1e-7);
    for (uint i = 0; i < 1000; i++) {
        vec2 u = sampling_hammersley(i + 1, 1002); // not a pole, where u means nothing
        vec3 d = environment_direction(u);
        vec2 uv = environment_uv(d);
        assert_near((double)uv[0], (double)u[0], 1e-5);
        assert_near((double)uv[1], (double)u[1], 1e-5);
        // The definition by acos, in double.
        assert_near((double)uv[1], 2.0 * acos((double)d[1]) / TAU, 1e-4);
    }
}

// Vulkan 1.3, table "Cube map face and coordinate selection".
static void cube_faces_lie_as_vulkan_s(void **state)
{
    (void)state;
    const float s = 0.3f, t = -0.6f;
    for (uint face = 0; face < 6; face++) {
        vec3 d = environment_cube_direction(face, s, t);
        float sc[6] = { -d[2], d[2], d[0], d[0], d[0], -d[0] };
        float tc[6] = { -d[1], -d[1], d[2], -d[2], -d[1], -d[1] };
        assert_near((double)d[face / 2], face % 2 ? -1.0 : 1.0, 0.0);
        assert_near((double)sc[face], (double)s, 0.0);
        assert_near((double)tc[face], (double)t, 0.0);
    }
}

static void mips_and_roughness_invert(void **state)
{
    (void)state;
    assert_near((double)environment_roughness(0.0f, 6.0f), 0.0, 0.0);
    assert_near((double)environment_roughness(5.0f, 6.0f), 1.0, 0.0);
    for (int i = 0; i <= 50; i++) {
        float mip = (float)i / 10.0f;
        float back = environment_mip(environment_roughness(mip, 6.0f), 6.0f);
        assert_near((double)back, (double)mip, 1e-5);
    }
}

static void occlusion_has_its_ends(void **state)
{
    (void)state;
    for (int i = 0; i <= 10; i++) {
        float x = (float)i / 10.0f;
        assert_near((double)environment_specular_occlusion(0.01f + 0.9f * x, 1.0f, x), 1.0, 0.0);
        float some = environment_specular_occlusion(0.5f, x, 0.3f);
        assert_true(some >= 0.0f && some <= 1.0f);
    }
    // (.5 + .25)^(2^-1) - 1 + .25 for a mirror.
    assert_near((double)environment_specular_occlusion(0.5f, 0.25f, 0.0f), 0.1160254, 1e-6);
    vec3 n = vec3(0.0f, 1.0f, 0.0f);
    assert_near((double)environment_horizon_occlusion(vec3(1.0f, 0.0f, 0.0f), n), 1.0, 0.0);
    assert_near((double)environment_horizon_occlusion(vec3(0.0f, -0.5f, 0.0f), n), 0.25, 1e-7);
    vec3 r = vec3(0.6f, 0.8f, 0.0f);
    assert_near((double)environment_dominant(n, r, 0.0f)[0], 0.6, 1e-6);
    assert_near((double)environment_dominant(n, r, 1.0f)[1], 1.0, 1e-6);
}

// The mean direction of the light that a rough mirror sends to the eye, over visible
// normals: their weight is G2 / G1.
static void dominant_direction_is_the_mean(void **state)
{
    (void)state;
    enum { COUNT = 4096 };
    double squares = 0.0;
    int cells = 0;
    vec3 n = vec3(0.0f, 0.0f, 1.0f);
    for (float roughness = 0.1f; roughness < 1.0f; roughness += 0.1f) {
        for (float NoV = 0.05f; NoV < 1.0f; NoV += 0.1f) {
            float alpha = roughness * roughness, a2 = alpha * alpha;
            vec3 wo = vec3(sqrtf(1.0f - NoV * NoV), 0.0f, NoV), mean = vec3(0.0f, 0.0f, 0.0f);
            for (uint i = 0; i < COUNT; i++) {
                vec2 u = sampling_hammersley(i, COUNT);
                vec3 wi = reflect(-wo, sampling_visible_normal(wo, alpha, u));
                if (wi[2] <= 0.0f)
                    continue;
                float v = microfacet_v(NoV, wi[2], a2);
                mean += wi * (4.0f * NoV * wi[2] * v / microfacet_g1(NoV, a2));
            }
            vec3 d = environment_dominant(n, reflect(-wo, n), alpha);
            double angle =
                atan2((double)-mean[0], (double)mean[2]) - atan2((double)-d[0], (double)d[2]);
            assert_near(angle, 0.0, 0.1);
            squares += angle * angle;
            cells++;
        }
    }
    assert_true(sqrt(squares / cells) < 0.03);
}

// Mean 0; per axis the variance of a Gaussian whose radius is cut at c, from the integral of
// r^3 exp(-r^2 / 2 s^2): s^2 (1 - q e^-q / (1 - e^-q)) with q = c^2 / 2 s^2; none beyond c.
static void gaussian_points_have_their_variance(void **state)
{
    (void)state;
    enum { POINTS = 4096 };
    const double s = 0.47, c = 0.8, q = c * c / (2 * s * s);
    double sum[2] = { 0 }, square[2] = { 0 };
    for (uint i = 0; i < POINTS; i++) {
        vec2 p = sampling_gaussian(sampling_hammersley(i, POINTS), 0.47f, 0.8f);
        for (int k = 0; k < 2; k++) {
            sum[k] += (double)p[k] / POINTS;
            square[k] += (double)p[k] * (double)p[k] / POINTS;
        }
        assert_true((double)(p[0] * p[0] + p[1] * p[1]) <= c * c * 1.00001);
    }
    for (int k = 0; k < 2; k++) {
        assert_near(sum[k], 0.0, 1e-3);
        assert_near(square[k], s * s * (1 - q * exp(-q) / (1 - exp(-q))), 1e-3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(metals_reflect_as_measured),
        cmocka_unit_test(dielectrics_reflect_as_fresnel_says),
        cmocka_unit_test(schlick_has_its_ends_and_mean),
        cmocka_unit_test(point_lights_fall_off),
        cmocka_unit_test(spot_lights_have_their_cone),
        cmocka_unit_test(normals_spread_into_roughness),
        cmocka_unit_test(gaussian_points_have_their_variance),
        cmocka_unit_test(harmonics_are_orthonormal),
        cmocka_unit_test(harmonics_give_the_irradiance),
        cmocka_unit_test(directions_map_to_the_image_and_back),
        cmocka_unit_test(cube_faces_lie_as_vulkan_s),
        cmocka_unit_test(mips_and_roughness_invert),
        cmocka_unit_test(occlusion_has_its_ends),
        cmocka_unit_test(dominant_direction_is_the_mean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
