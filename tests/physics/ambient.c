// Ambient light against skies integrated by quadrature.
#include "physics/ambient.glsl"
#include "physics/sampling.glsl"

#include "near.h"

typedef double sky(vec3 d);

// Irradiance over pi: the sky's mean over the cosine-weighted hemisphere of n.
static double received(sky *radiance, vec3 n)
{
    enum { COUNT = 1 << 14 };
    vec3 side = max(n[0], -n[0]) < 0.7f ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f, 1.0f, 0.0f);
    vec3 t = normalize(cross(side, n)), b = cross(n, t);
    double sum = 0.0;
    for (uint i = 0; i < COUNT; i++) {
        vec3 l = sampling_cosine(sampling_hammersley(i, COUNT));
        sum += radiance(l[0] * t + l[1] * b + l[2] * n) / COUNT;
    }
    return sum;
}

// Normals all around.
enum { NORMALS = 60 };
static vec3 normal(uint i)
{
    vec2 u = sampling_hammersley(i, NORMALS);
    float z = 1.0f - 2.0f * u[0], r = sqrtf(1.0f - z * z), phi = 2.0f * PI * u[1];
    return vec3(r * cosf(phi), r * sinf(phi), z);
}

static vec3 grey(float x)
{
    return vec3(x, 2.0f * x, 0.0f);
}

static const float AXIS[3] = { 0.48f, 0.6f, -0.64f };

static double two_halves(vec3 d)
{
    return d[0] * AXIS[0] + d[1] * AXIS[1] + d[2] * AXIS[2] > 0.0f ? 0.9 : 0.2;
}

static void hemispheric_is_a_sky_of_two_halves(void **state)
{
    (void)state;
    vec3 axis = vec3(AXIS[0], AXIS[1], AXIS[2]);
    ambient_light light = ambient_from_hemispheric(grey(0.9f), grey(0.2f), axis);
    for (uint i = 0; i < NORMALS; i++) {
        vec3 n = normal(i);
        vec3 value = ambient_hemispheric(grey(0.9f), grey(0.2f), axis, n),
             sum = ambient_at(light, n);
        assert_near((double)value[0], received(two_halves, n), 2e-3);
        for (int k = 0; k < 3; k++)
            assert_near((double)sum[k], (double)value[k], 1e-6);
    }
}

// Each harmonic of radiance comes back as itself, by the clamped cosine's 1, 2/3 and 1/4
// (Ramamoorthi & Hanrahan 2001, eqs. 7-9, over pi).
static double nine_terms(vec3 d)
{
    double x = (double)d[0], y = (double)d[1], z = (double)d[2];
    return 3.0 + 0.1 * x - 0.2 * y + 0.3 * z + 0.4 * x * y - 0.5 * y * z +
           0.6 * (3.0 * z * z - 1.0) + 0.7 * x * z - 0.8 * (x * x - y * y);
}

static void nine_coefficients_are_a_smooth_sky(void **state)
{
    (void)state;
    float one = 2.0f / 3.0f, two = 0.25f;
    ambient_light light = {
        .c0 = grey(3.0f),
        .cx = grey(0.1f * one),
        .cy = grey(-0.2f * one),
        .cz = grey(0.3f * one),
        .cxy = grey(0.4f * two),
        .cyz = grey(-0.5f * two),
        .czz = grey(0.6f * two),
        .cxz = grey(0.7f * two),
        .cxxyy = grey(-0.8f * two),
    };
    for (uint i = 0; i < NORMALS; i++) {
        vec3 n = normal(i), e = ambient_at(light, n);
        double expected = received(nine_terms, n);
        assert_near((double)e[0], expected, 2e-3);
        assert_near((double)e[1], 2.0 * expected, 4e-3);
    }
}

static void light_is_not_negative(void **state)
{
    (void)state;
    ambient_light light = { .c0 = grey(0.1f), .cy = grey(1.0f) };
    assert_near((double)ambient_at(light, vec3(0.0f, -1.0f, 0.0f))[0], 0.0, 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hemispheric_is_a_sky_of_two_halves),
        cmocka_unit_test(nine_coefficients_are_a_smooth_sky),
        cmocka_unit_test(light_is_not_negative),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
