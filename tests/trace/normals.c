// Normals that are not those of the triangles: mapped, and of curved surfaces.
#include "stage.h"

enum { SIZE = 24 };

// ---- Normal maps ---------------------------------------------------------------------------

// Bumps of up to 60 degrees, each texel another way.
static ag_texture bumps(ag_scene *scene)
{
    enum { TEXELS = 16 };
    uint8_t pixels[TEXELS * TEXELS][4];
    uint32_t seed = 2;
    for (int i = 0; i < TEXELS * TEXELS; i++) {
        seed = seed * 1664525u + 1013904223u;
        float phi = (float)(seed >> 16), tilt = 0.5f + 0.36f * (float)(i % 2);
        pixels[i][0] = (uint8_t)(127.5f + 127.5f * tilt * cosf(phi));
        pixels[i][1] = (uint8_t)(127.5f + 127.5f * tilt * sinf(phi));
        pixels[i][2] = (uint8_t)(127.5f + 127.5f * sqrtf(1 - tilt * tilt));
        pixels[i][3] = 255;
    }
    const ag_image_desc image_desc = { TEXELS, TEXELS, AG_FORMAT_RGBA8, pixels };
    ag_image *image;
    ag_texture texture;
    OK(ag_image_create(NULL, &image_desc, &image));
    const ag_texture_desc desc = { .image = image, .mag = AG_FILTER_NEAREST };
    OK(ag_scene_add_texture(scene, &desc, &texture));
    ag_image_destroy(image);
    return texture;
}

// A white floor of bumps, seen from `NoV` in a white furnace: what one bump sends into the next
// comes out of that, so that none is seen.
static void assert_not_seen(const ag_material_desc *material, float NoV)
{
    ag_scene *scene = stage_dark();
    ag_material_desc bumpy = *material;
    bumpy.normal_texture.texture = bumps(scene);
    stage_surround(scene, 1);
    stage_show(scene, stage_floor(scene, 0, 4), &bumpy, NULL);
    float slope = sqrtf(1 - NoV * NoV);
    const ag_camera_desc camera = { .position = { 9 * slope * 0.6f, 9 * NoV, 9 * slope * 0.8f },
                                    .height_m = 3 * NoV };
    const ag_render_options picture = stage_linear(SIZE, SIZE);
    ag_image *image =
        stage_trace(scene, &camera, &picture, &(ag_reference_options) { .seed = 4 }, 64);
    double darkest = 2, brightest = 0;
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        double value = (double)stage_pixel(image, i % SIZE, i / SIZE)[1];
        darkest = fmin(darkest, value);
        brightest = fmax(brightest, value);
    }
    if (!(darkest > 0.8 && brightest < 1.2))
        print_error("NoV %g: %g to %g\n", (double)NoV, darkest, brightest);
    assert_true(darkest > 0.8 && brightest < 1.2);
    assert_agrees("bumps", stage_estimate(image, 1), 1, 0.001);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

static void white_bumps_are_not_seen(void **state)
{
    (void)state;
    const ag_material_desc matte = stage_matte(1), smooth = stage_metal(1, 0.2f),
                           rough = stage_metal(1, 0.7f);
    ag_material_desc glossy = stage_matte(1);
    glossy.specular = 1;
    glossy.roughness = 0.3f;
    for (float NoV = 0.05f; NoV < 1; NoV += 0.3f) {
        assert_not_seen(&matte, NoV);
        assert_not_seen(&smooth, NoV);
        assert_not_seen(&rough, NoV);
        assert_not_seen(&glossy, NoV);
    }
}

// ---- The shadow's edge on coarse balls -------------------------------------------------------

// Lit from the side, a ball of few triangles is shaded as the round one: no facet is black before
// the light has set.  Here it has set by 2 degrees on the middle of facets.
static void coarse_balls_are_round(void **state)
{
    (void)state;
    ag_scene *scene = stage_dark();
    const ag_material_desc white = stage_matte(1);
    const ag_light_desc light = { .kind = AG_LIGHT_DIRECTIONAL,
                                  .direction = { -0.85f, 0, -0.52678f },
                                  .intensity = (float)pi };
    stage_light(scene, &light);
    stage_show(scene, stage_ball(scene, 8, 1, false, true), &white, NULL);
    enum { ACROSS = 48 };
    const ag_camera_desc camera = { .position = { 0, 0, 5 }, .height_m = 2 };
    const ag_render_options picture = stage_linear(ACROSS, ACROSS);
    ag_image *image =
        stage_trace(scene, &camera, &picture, &(ag_reference_options) { .direct_only = true }, 16);
    double worst = 0, square = 0, count = 0;
    for (uint32_t i = 0; i < ACROSS * ACROSS; i++) {
        double x = 2 * (i % ACROSS + 0.5) / ACROSS - 1, y = 1 - 2 * (i / ACROSS + 0.5) / ACROSS;
        if (x * x + y * y > 0.8)
            continue;
        double wanted = fmax(0.85 * x + 0.52678 * sqrt(1 - x * x - y * y), 0);
        double off = fabs((double)stage_pixel(image, i % ACROSS, i / ACROSS)[1] - wanted);
        worst = fmax(worst, off);
        square += off * off;
        count++;
    }
    if (!(worst < 0.05 && sqrt(square / count) < 0.015))
        print_error("off by %g, root mean square %g\n", worst, sqrt(square / count));
    assert_true(worst < 0.05 && sqrt(square / count) < 0.015);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(white_bumps_are_not_seen),
        cmocka_unit_test(coarse_balls_are_round),
    };
    return cmocka_run_group_tests_name("normals", tests, NULL, NULL);
}
