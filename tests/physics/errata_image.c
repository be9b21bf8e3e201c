// docs/errata.md, environments and display: each printed form, written out here, misses a truth
// that the text of shaders/physics meets.  In float, as shaders have it.
#include "physics/color.glsl"
#include "physics/environment.glsl"
#include "physics/sampling.glsl"
#include "physics/surface.glsl"
#include "physics/tonemap.glsl"

#include "errata.h"

static surface_material matte(float base)
{
    return (surface_material) { .base_color = vec3(base, base, base), .roughness = 1.0f };
}

static const vec3 WHITE = { 1.0f, 1.0f, 1.0f };

// 7: a mirror shows what lies in the reflected direction.
static void a_mirror_shows_the_reflection(void **state)
{
    (void)state;
    vec3 n = vec3(0.0f, 0.0f, 1.0f), wo = vec3(0.6f, 0.0f, 0.8f);
    vec3 r = vec3(-0.6f, 0.0f, 0.8f), printed = n;
    vec3 project = environment_dominant(n, reflect(-wo, n), 0.0f);
    assert_near((double)dot(project, r), 1.0, 1e-6);
    assert_misses((double)dot(printed, r), 1.0, 0.15);
}

// 30: a matte surface returns its albedo of a white sky; a sample of the sky over pi is too dark,
// and the same sample, as printed, serves the lobe of roughness 1 without the division.
static void a_matte_surface_returns_its_albedo(void **state)
{
    (void)state;
    double albedo = 0.6, truth = 0.0;
    enum { COUNT = 4096 };
    for (int i = 0; i < COUNT; i++) // albedo / pi, the cosine and the sky's 1 over the hemisphere
        truth += albedo / (TURN / 2.0) * (i + 0.5) / COUNT * TURN / COUNT;
    surface s = surface_from_metallic_roughness(matte(0.6f), 1.0f, vec2(0.0f, 0.0f));
    assert_near((double)surface_environment(s, WHITE, WHITE)[0], truth, 1e-5);
    double sky = 1.0, printed = albedo / (TURN / 2.0) * sky;
    assert_misses(printed, truth, 0.4);
}

// 31: `levels` mips end with the level `levels - 1`.  With the printed product all roughnesses
// above (levels - 1) / levels look alike, and none below is looked up where it was filtered.
static void levels_are_counted_from_0(void **state)
{
    (void)state;
    const float levels = 6.0f;
    for (int i = 0; i <= 10; i++) {
        float roughness = (float)i / 10.0f, level = environment_mip(roughness, levels);
        assert_true(level <= levels - 1.0f);
        assert_near((double)environment_roughness(level, levels), (double)roughness, 1e-5);
    }
    double printed_rough = fmin(0.85 * 6.0, 5.0), printed_roughest = fmin(1.0 * 6.0, 5.0);
    assert_misses(printed_roughest - printed_rough, 0.15 * 5.0, 0.7);
    assert_true(environment_mip(0.85f, levels) < environment_mip(1.0f, levels) - 0.1f);
}

// 18: at the document's least roughness alpha^2 is lost beside 1, and the peak is infinite.
static void the_peak_of_a_mirror_survives_float(void **state)
{
    (void)state;
    float roughness = 0.01f, alpha = roughness * roughness, a2 = alpha * alpha, NoH = 1.0f;
    float part = NoH * NoH * (a2 - 1.0f) + 1.0f, printed = a2 / (PI * part * part);
    double truth = 1.0 / (TURN / 2.0 * (double)a2);
    assert_near((double)microfacet_d_half(0.0f, 2.0f, a2) / truth, 1.0, 1e-5);
    assert_true(isinf(printed));
}

// 32: such a peak, or a sun in a mirror, is infinity over infinity on the printed tone curve.
static void bright_light_is_white(void **state)
{
    (void)state;
    float x = 3e19f, printed = (x * (2.51f * x + 0.03f)) / (x * (2.43f * x + 0.59f) + 0.14f);
    assert_near((double)tonemap(TONEMAP_ACES_NARKOWICZ, x * WHITE)[0], 1.0, 0.0);
    assert_true(isnan(printed));
}

// 33: the power 1 / 2.2 is not the curve of an sRGB display (IEC 61966-2-1, written out).
static void the_display_is_srgb(void **state)
{
    (void)state;
    double worst = 0.0;
    for (int i = 0; i <= 1000; i++) {
        double light = i / 1000.0, code = pow(light, 1.0 / 2.2);
        double shown = code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
        double ours = (double)color_srgb_encode_channel((float)light);
        double back = ours <= 0.04045 ? ours / 12.92 : pow((ours + 0.055) / 1.055, 2.4);
        assert_near(back, light, 1e-5);
        if (i > 0 && i <= 10)
            worst = fmax(worst, fabs(shown / light - 1.0));
    }
    assert_true(worst > 0.5); // of dark light
}

// 9: an ambient term is added: it is what a surface shows whose lights are out; and pi.
static void ambient_light_is_added(void **state)
{
    (void)state;
    surface s = surface_from_metallic_roughness(matte(0.5f), 1.0f, vec2(0.0f, 0.0f));
    vec3 n = vec3(0.0f, 0.0f, 1.0f), below = -n;
    double Lo = (double)surface_direct(s, n, n, below)[0];
    double ambient = (double)surface_environment(s, 0.03f * WHITE, 0.0f * WHITE)[0];
    assert_near(Lo + ambient, 0.03 * 0.5, 1e-6);
    assert_misses(Lo * ambient, 0.03 * 0.5, 0.01);
}

static void pi_is_pi(void **state)
{
    (void)state;
    double truth = acos(-1.0);
    assert_near((double)PI, truth, 1e-7); // the nearest float
    assert_misses(3.141592655359, truth, 1e-9);
    assert_misses(3.141592665259, truth, 1e-8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_mirror_shows_the_reflection),
        cmocka_unit_test(a_matte_surface_returns_its_albedo),
        cmocka_unit_test(levels_are_counted_from_0),
        cmocka_unit_test(the_peak_of_a_mirror_survives_float),
        cmocka_unit_test(bright_light_is_white),
        cmocka_unit_test(the_display_is_srgb),
        cmocka_unit_test(ambient_light_is_added),
        cmocka_unit_test(pi_is_pi),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
