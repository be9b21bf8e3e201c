// Cases at the edge of what paths meet.
#include "stage.h"

enum { SIZE = 16 };

static estimate seen(const ag_scene *scene, const ag_camera_desc *camera,
                     const ag_render_options *picture, const ag_reference_options *options,
                     uint32_t samples)
{
    ag_image *image = stage_trace(scene, camera, picture, options, samples);
    estimate e = stage_estimate(image, 0);
    ag_image_destroy(image);
    return e;
}

// A white floor under a ceiling without end that is unlit white: it receives pi, sends back 1;
// what the floor sees straight is direct light.
static void unlit_surfaces_shine_at_the_last_bounce(void **state)
{
    (void)state;
    ag_scene *scene = stage_dark();
    const ag_material_desc floor = stage_matte(1);
    ag_material_desc ceiling = stage_matte(1);
    ceiling.unlit = ceiling.double_sided = true;
    stage_show(scene, stage_floor(scene, 0, 1), &floor, NULL);
    stage_show(scene, stage_ball(scene, 8, 50, true, false), &ceiling, NULL);
    const ag_camera_desc camera = stage_pinpoint();
    const ag_render_options picture = stage_linear(SIZE, SIZE);
    for (uint32_t bounces = 0; bounces < 3; bounces++) {
        const ag_reference_options options = { .direct_only = !bounces, .max_bounces = bounces };
        estimate e = seen(scene, &camera, &picture, &options, 16);
        assert_agrees("unlit ceiling", e, 1, 1e-4);
    }
    ag_scene_destroy(scene);
}

// More pixels than cells and no whole multiple of them; one line of pixels is bright.
static void skies_of_odd_sizes_lose_no_light(void **state)
{
    (void)state;
    enum { W = 1400, H = 700 };
    float(*pixels)[4] = calloc(W * H, sizeof *pixels);
    assert_non_null(pixels);
    for (int x = 0; x < W; x++)
        for (int c = 0; c < 4; c++)
            pixels[171 * W + x][c] = 100;
    ag_scene *scene = stage_dark();
    stage_surround_image(scene, W, H, (const float(*)[4])pixels, 0);
    free(pixels);
    const ag_material_desc floor = stage_matte(1);
    stage_show(scene, stage_floor(scene, 0, 1), &floor, NULL);
    const ag_camera_desc camera = stage_pinpoint();
    const ag_render_options picture = stage_linear(SIZE, SIZE);
    const ag_reference_options options = { .estimator = AG_ESTIMATOR_LIGHTS };
    // 2 int L cos sin dtheta of a bilinear line: its tent has the area of the pixel.
    double theta = 171.5 * pi / H, wanted = 100 * 2 * cos(theta) * sin(theta) * pi / H;
    assert_agrees("bright line", seen(scene, &camera, &picture, &options, 64), wanted, 1e-4);
    ag_scene_destroy(scene);
}

// Of two lights one alone is asked for: the other one's body is black, but stands where it is.
static void lights_that_are_not_asked_for_are_black(void **state)
{
    (void)state;
    ag_scene *scene = stage_dark();
    stage_surround(scene, 1);
    const ag_light_desc ball = { .kind = AG_LIGHT_SPHERE, .radius_m = 1, .intensity = 3 };
    const ag_light_desc far = {
        .kind = AG_LIGHT_SPHERE, .position = { 0, 0, -9 }, .radius_m = 1, .intensity = 3
    };
    ag_light light;
    OK(ag_scene_add_light(scene, &ball, &light));
    OK(ag_scene_add_light(scene, &far, &light));
    const ag_camera_desc camera = { .position = { 0, 0, 5 }, .height_m = 0.1f };
    ag_render_options picture = stage_linear(SIZE, SIZE);
    picture.background = AG_BACKGROUND_ENVIRONMENT;
    for (uint32_t only = 0; only < 3; only++) {
        picture.light.id = only;
        double wanted = only == 2 ? 0 : 3 / pi;
        assert_agrees("body", seen(scene, &camera, &picture, NULL, 4), wanted, 1e-5);
    }
    ag_scene_destroy(scene);
}

// Strengths at the end of what floats hold neither spread NaN nor put out what is beside them.
static void overflowing_light_is_alone(void **state)
{
    (void)state;
    ag_scene *scene = stage_dark();
    ag_material_desc floor = stage_matte(1), lamp = stage_matte(0);
    memcpy(floor.base_color, (float[4]) { 0, 1, 0, 1 }, sizeof floor.base_color);
    stage_show(scene, stage_floor(scene, 0, 1), &floor, NULL);
    lamp.double_sided = true;
    stage_glow(&lamp, 3e38f);
    stage_show(scene, stage_floor(scene, 1e4f, 1), &lamp, NULL);
    const ag_light_desc red = { .position = { 0, 0.5f, 0 },
                                .color = { 1, 0, 0 },
                                .intensity = 3e38f };
    const ag_light_desc green = { .position = { 0, 1, 0 }, .color = { 0, 1, 0 }, .intensity = 1 };
    ag_light light;
    OK(ag_scene_add_light(scene, &red, &light));
    OK(ag_scene_add_light(scene, &green, &light));
    const ag_camera_desc camera = stage_pinpoint();
    ag_image *image = stage_trace(
        scene, &camera,
        &(ag_render_options) { .width = SIZE, .height = SIZE, .format = AG_FORMAT_RGBA32F }, NULL,
        16);
    const float *pixels = ag_image_pixels(image);
    for (int i = 0; i < SIZE * SIZE * 4; i++)
        assert_true(isfinite(pixels[i]));
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unlit_surfaces_shine_at_the_last_bounce),
        cmocka_unit_test(skies_of_odd_sizes_lose_no_light),
        cmocka_unit_test(lights_that_are_not_asked_for_are_black),
        cmocka_unit_test(overflowing_light_is_alone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
