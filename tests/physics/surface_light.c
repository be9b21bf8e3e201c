// Every choice of a surface under lights of extent: against points, and against sums over many.
#include "physics/surface_light.glsl"

#include "physics/sampling.glsl"

#include "near.h"

static const float TAU_F = 6.2831853f;
static const vec3 up = { 0, 0, 1 };

typedef struct choice {
    const char *name;
    uint model;
    float metallic, shininess;
    double whole, cut; // largest error under lights up to R/d = .5, of the root mean square
} choice;

// Tolerances are what was measured, rounded up; docs/physics.md has the table.
static const choice choices[] = {
    { "default, dielectric", 0, 0, 1, 0.02, 0.02 },
    { "default, metal", 0, 1, 1, 0.02, 0.02 },
    { "Oren-Nayar", SURFACE_OREN_NAYAR, 0, 1, 0.03, 0.02 },
    { "EON", SURFACE_EON, 0, 1, 0.04, 0.03 },
    { "anisotropic", SURFACE_ANISOTROPIC, 1, 1, 0.02, 0.02 },
    { "Schlick-GGX", SURFACE_SCHLICK_GGX, 1, 1, 0.05, 0.15 },
    { "conductor", SURFACE_CONDUCTOR, 1, 1, 0.02, 0.02 },
    { "F82", SURFACE_F82, 1, 1, 0.02, 0.02 },
    { "layered by F", SURFACE_LAYERED_BY_F, 0, 1, 0.03, 0.02 },
    { "layered as glTF", SURFACE_LAYERED_AS_GLTF, 0.5f, 1, 0.02, 0.02 },
    { "blended", SURFACE_BLENDED, 0, 1, 0.02, 0.02 },
    { "Blinn", SURFACE_BLINN, 0, 50, 0.13, 0.30 },
    { "Blinn, sharp", SURFACE_BLINN, 0, 500, 0.08, 0.09 },
};
enum { CHOICES = sizeof choices / sizeof choices[0] };

static surface make(const choice *c, float roughness, float NoV)
{
    surface_material m = {
        .base_color = vec3(0.8f, 0.5f, 0.3f),
        .metallic = c->metallic,
        .roughness = roughness,
        .dielectric_f0 = 0.04f,
        .specular_color = vec3(1, 1, 1),
        .specular = 1,
        .model = c->model,
        .diffuse_roughness = 1,
        .shininess = c->shininess,
        .anisotropy = 0.6f,
        .tangent = vec3(1, 0, 0),
        .conductor_n = vec3(0.186f, 0.596f, 2.9f),
        .conductor_k = vec3(3.37f, 2.08f, 2.9f),
        .f82_tint = vec3(0.7f, 0.8f, 0.9f),
        .reflectiveness = 0.75f,
    };
    surface s = surface_from_metallic_roughness(m, NoV, vec2(0.7f, 0.02f));
    if ((c->model & SURFACE_DIFFUSE) != 0) // the base alone
        s.f0 = s.lambert = s.bounced = vec3(0, 0, 0);
    return s;
}

static float next(uint *seed)
{
    return sampling_van_der_corput((*seed)++);
}

static vec3 towards(float elevation, float azimuth)
{
    return vec3(cosf(elevation) * cosf(azimuth), cosf(elevation) * sinf(azimuth), sinf(elevation));
}

// The mean of surface_direct over the cap, as surface_cap has its units.
static void sum_of_points(surface s, vec3 wo, light_cap cap, double sum[3])
{
    enum { RINGS = 40, ANGLES = 80 };
    vec3 other = fabsf(cap.axis[0]) < 0.7f ? vec3(1, 0, 0) : vec3(0, 1, 0);
    vec3 x = normalize(cross(cap.axis, other)), y = cross(cap.axis, x);
    float span = cap.sin_s * cap.sin_s / (1 + cap.cos_s); // 1 - cos s
    sum[0] = sum[1] = sum[2] = 0;
    for (int i = 0; i < RINGS * ANGLES; i++) {
        float t = span * ((float)(i / ANGLES) + 0.5f) / RINGS, r = sqrtf(t * (2 - t));
        float phi = TAU_F * ((float)(i % ANGLES) + 0.5f) / ANGLES;
        vec3 wi = (1 - t) * cap.axis + r * cosf(phi) * x + r * sinf(phi) * y;
        if (wi[2] <= 0)
            continue;
        vec3 f = surface_direct(s, up, wo, wi);
        for (int k = 0; k < 3; k++)
            sum[k] += 2 * (double)(f[k] * span / (cap.sin_s * cap.sin_s)) / (RINGS * ANGLES);
    }
}

// Lights above the horizon, a third of them where the mirror direction is, or cut by it.
static light_cap a_cap(float sin_s, float eye, bool cut, uint *seed)
{
    float s = asinf(sin_s), azimuth = TAU_F * next(seed);
    float elevation = cut ? s * (1.6f * next(seed) - 0.8f) : s + (TAU_F / 4 - s) * next(seed);
    if (!cut && *seed % 3 == 0) {
        azimuth = 0.6f + TAU_F / 2 + 0.3f * (next(seed) - 0.5f);
        elevation = fminf(fmaxf(s, TAU_F / 4 - eye + 0.3f * (next(seed) - 0.5f)), TAU_F / 4);
    }
    return (light_cap) { towards(elevation, azimuth), sin_s, cosf(s) };
}

static double error_of(const choice *c, float roughness, float eye, float sin_s, bool cut)
{
    vec3 wo = towards(TAU_F / 4 - eye, 0.6f);
    surface s = make(c, roughness, wo[2]);
    double wrong = 0, right = 0, sum[3];
    uint seed = 5;
    for (int i = 0; i < 12; i++) {
        light_cap cap = a_cap(sin_s, eye, cut, &seed);
        vec3 got = surface_cap(s, up, wo, cap);
        sum_of_points(s, wo, cap, sum);
        for (int k = 0; k < 3; k++) {
            wrong += ((double)got[k] - sum[k]) * ((double)got[k] - sum[k]);
            right += sum[k] * sum[k];
        }
    }
    return sqrt(wrong / right);
}

static void lights_of_extent_are_sums_of_points(void **state)
{
    (void)state;
    const float sizes[] = { 0.05f, 0.2f, 0.5f }, eyes[] = { 0.1f, 0.6f, 1.05f, 1.35f };
    for (int c = 0; c < CHOICES; c++) {
        for (int cut = 0; cut < 2; cut++) {
            double worst = 0;
            for (int i = 0; i < 3 * 4 * 2; i++)
                worst = fmax(worst, error_of(&choices[c], i % 2 ? 0.7f : 0.4f, eyes[i / 2 % 4],
                                             sizes[i / 8], cut));
            if (worst > (cut ? choices[c].cut : choices[c].whole))
                print_error("%s, %s: %g\n", choices[c].name, cut ? "cut" : "whole", worst);
            assert_true(worst <= (cut ? choices[c].cut : choices[c].whole));
        }
    }
}

static void small_lights_are_points(void **state)
{
    (void)state;
    uint seed = 1;
    for (int i = 0; i < 40 * CHOICES; i++) {
        vec3 wo = towards(0.1f + 1.4f * next(&seed), TAU_F * next(&seed));
        vec3 wi = towards(0.1f + 1.4f * next(&seed), TAU_F * next(&seed));
        surface s = make(&choices[i % CHOICES], 0.5f, wo[2]);
        vec3 expected = surface_direct(s, up, wo, wi);
        vec3 got = surface_cap(s, up, wo, light_cap_sphere(2.0f * wi, 2e-4f));
        for (int k = 0; k < 3; k++)
            assert_near((double)got[k], (double)expected[k], 3e-3 * (double)expected[k] + 1e-7);
    }
}

// Against the second moment of the light's directions by a sum.
static void mean_direction_is_that_of_the_irradiance(void **state)
{
    (void)state;
    for (int i = 0; i < 5 * 9; i++) {
        float sin_s = (float[]) { 0.05f, 0.3f, 0.6f, 0.9f, 1 }[i / 9], c = sqrtf(1 - sin_s * sin_s);
        float z = fminf(sin_s * (-0.7f + 0.25f * (float)(i % 9)), 0.999f), flat = sqrtf(1 - z * z);
        double sum[3] = { 0, 0, 0 };
        enum { RINGS = 100, ANGLES = 200 };
        for (int k = 0; k < RINGS * ANGLES; k++) {
            float t = (1 - c) * ((float)(k / ANGLES) + 0.5f) / RINGS, r = sqrtf(t * (2 - t));
            float phi = TAU_F * ((float)(k % ANGLES) + 0.5f) / ANGLES;
            float lx = (1 - t) * flat - r * cosf(phi) * z, lz = (1 - t) * z + r * cosf(phi) * flat;
            sum[0] += lz > 0 ? (double)(lx * lz) : 0;
            sum[1] += lz > 0 ? (double)lz : 0;
            sum[2] += lz > 0 ? (double)(lz * lz) : 0;
        }
        light_cap cap = { vec3(flat, 0, z), sin_s, c };
        vec3 mean = light_cap_mean(cap);
        double allowed = z >= sin_s ? 2e-3 : sin_s < 0.95f ? 0.09 : 0.18;
        assert_near((double)mean[0], sum[0] / sum[1], allowed);
        assert_near((double)mean[2], sum[2] / sum[1], allowed);
    }
}

static void nothing_is_infinite(void **state)
{
    (void)state;
    const vec3 d[] = { vec3(0, 0, 1),  vec3(0, 0, -1),      vec3(1, 0, 0),       vec3(-1, 0, 0),
                       vec3(0, -1, 0), vec3(0.6f, 0, 0.8f), vec3(-0.6f, 0, 0.8f) };
    const float sizes[] = { 0, 1e-6f, 0.1f, 1 }, roughness[] = { 0, 0.05f, 1 };
    for (int c = 0; c < CHOICES; c++) {
        for (int i = 0; i < 7 * 7 * 4 * 3; i++) {
            vec3 wo = d[i % 7], wi = d[i / 7 % 7];
            surface s = make(&choices[c], roughness[i / 196], surface_cosine(up, wo));
            float size = sizes[i / 49 % 4];
            light_cap cap = { wi, size, sqrtf(1 - size * size) };
            vec3 f = surface_cap(s, up, wo, cap) + surface_direct(s, up, wo, wi) +
                     surface_environment(s, vec3(1, 1, 1), vec3(1, 1, 1));
            for (int k = 0; k < 3; k++)
                assert_true(isfinite(f[k]) && f[k] > -1e-3f);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_of_extent_are_sums_of_points),
        cmocka_unit_test(small_lights_are_points),
        cmocka_unit_test(mean_direction_is_that_of_the_irradiance),
        cmocka_unit_test(nothing_is_infinite),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
