// White balance in pictures: after exposure, before the tone curve, the same in renderer and
// reference.
#include "stage.h"

#include "physics/color.glsl"
#include "physics/tonemap.glsl"
#include "physics/white_balance.glsl"
#include "render/renderer.h"

enum { SIZE = 24 };

// Four unlit colours, one light enough to be seen, all in one picture.
static ag_scene *colors(void)
{
    const float corners[4][4] = { { 1, 0.5f, 0.25f, 1 },
                                  { 0.2f, 0.3f, 0.9f, 1 },
                                  { 0.6f, 0.6f, 0.6f, 1 },
                                  { 0.05f, 0.2f, 0.1f, 1 } };
    const ag_material_desc unlit = stage_unlit(1, 1, 1, 1);
    ag_scene *scene = stage_dark();
    stage_show(scene, stage_quad(scene, -2, -2, 2, 2, 0, corners), &unlit);
    return scene;
}

static ag_render_options warm(ag_format format, bool balanced)
{
    return (ag_render_options) { .width = SIZE,
                                 .height = SIZE,
                                 .format = format,
                                 .quality = AG_QUALITY_FAST,
                                 .exposure = 0.7f,
                                 .white_balance_k = balanced ? 3200 : 0,
                                 .white_balance_tint = balanced ? 12 : 0 };
}

// What it should have become.
static vec3 wanted(const ag_image *before, uint32_t i)
{
    const float *c = (const float *)ag_image_pixels(before) + 4 * i;
    const rgb_matrix m = white_balance(3200, 12);
    return c[0] * m.red + c[1] * m.green + c[2] * m.blue;
}

static void check_picture(const ag_image *before, const ag_image *linear, const ag_image *coded)
{
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        vec3 light = wanted(before, i);
        vec3 code = color_srgb_encode(tonemap(TONEMAP_NEUTRAL, light));
        for (int c = 0; c < 3; c++) {
            float found = ((const float *)ag_image_pixels(linear))[4 * i + (uint32_t)c];
            assert_close(found, light[c], 2e-3f);
            assert_close(((const uint8_t *)ag_image_pixels(coded))[4 * i + (uint32_t)c],
                         255 * code[c], 1.1f);
        }
    }
}

static void pictures_are_balanced_light(void **state)
{
    const ag_camera_desc camera = stage_flat_camera();
    ag_scene *scene = colors();
    const ag_render_options plain = warm(AG_FORMAT_RGBA32F, false),
                            linear = warm(AG_FORMAT_RGBA32F, true),
                            coded = warm(AG_FORMAT_RGBA8, true);
    ag_image *before = stage_render(*state, scene, &camera, &plain);
    ag_image *after = stage_render(*state, scene, &camera, &linear);
    ag_image *shown = stage_render(*state, scene, &camera, &coded);
    check_picture(before, after, shown);
    ag_image_destroy(before);
    ag_image_destroy(after);
    ag_image_destroy(shown);
    ag_scene_destroy(scene);
}

static ag_image *trace(const ag_scene *scene, const ag_camera_desc *camera,
                       const ag_render_options *options)
{
    ag_reference *reference;
    ag_image *image;
    OK(ag_reference_create(scene, camera, options, NULL, &reference));
    OK(ag_reference_trace(reference, &(ag_reference_goal) { .samples = 4 }));
    OK(ag_reference_picture(reference, &image));
    ag_reference_destroy(reference);
    return image;
}

// The same samples, so that there is no noise between them.
static void the_reference_balances_as_well(void **state)
{
    (void)state;
    const ag_camera_desc camera = stage_flat_camera();
    ag_scene *scene = colors();
    const ag_render_options plain = warm(AG_FORMAT_RGBA32F, false),
                            linear = warm(AG_FORMAT_RGBA32F, true),
                            coded = warm(AG_FORMAT_RGBA8, true);
    ag_image *before = trace(scene, &camera, &plain), *after = trace(scene, &camera, &linear),
             *shown = trace(scene, &camera, &coded);
    check_picture(before, after, shown);
    ag_image_destroy(before);
    ag_image_destroy(after);
    ag_image_destroy(shown);
    ag_scene_destroy(scene);
}

static ag_image *draw(ag_device *device, bool forward, const ag_scene *scene,
                      const ag_render_options *options)
{
    const ag_camera_desc camera = stage_flat_camera();
    ag_renderer *renderer;
    ag_image *image;
    OK(ag_renderer_create(device, &renderer));
    renderer->forward_only = forward;
    OK(ag_renderer_render(renderer, scene, &camera, options, &image, NULL));
    ag_renderer_destroy(renderer);
    return image;
}

// A lamp's body and the surroundings are light too; a background of a given colour is not.
static void check_all_light(ag_device *device, bool forward)
{
    const ag_light_desc lamp = { .kind = AG_LIGHT_SPHERE, .radius_m = 0.5f, .intensity = 0.3f };
    const rgb_matrix m = white_balance(3200, 12);
    const vec3 white = m.red + m.green + m.blue;
    ag_light light;
    ag_scene *scene = stage_dark();
    stage_surround(scene, 0.4f, 0.4f, 0.4f);
    OK(ag_scene_add_light(scene, &lamp, &light));
    ag_render_options options = warm(AG_FORMAT_RGBA32F, true);
    ag_image *image = draw(device, forward, scene, &options);
    float body = 0.7f * 0.3f / (3.14159265f * 0.25f);
    for (int c = 0; c < 3; c++) {
        assert_close(stage_float(image, 1, 1)[c], 0.7f * 0.4f * white[c], 1e-3f);
        assert_close(stage_float(image, SIZE / 2, SIZE / 2)[c], body * white[c], 1e-3f);
    }
    ag_image_destroy(image);
    options.background = AG_BACKGROUND_COLOR;
    options.background_color[2] = 1;
    image = draw(device, forward, scene, &options);
    assert_close(stage_float(image, 1, 1)[0], 0, 0);
    assert_close(stage_float(image, 1, 1)[2], 1, 0);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

static void all_light_is_balanced(void **state)
{
    check_all_light(*state, false);
    check_all_light(*state, true);
}

static void wrong_ones_are_refused(void **state)
{
    const float wrong[][2] = { { 1000, 0 },   { 30000, 0 },  { -5000, 0 },  { NAN, 0 },
                               { 5000, NAN }, { 5000, 151 }, { 5000, -151 } };
    ag_scene *scene = stage_dark();
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        ag_render_options options = warm(AG_FORMAT_RGBA8, false);
        ag_image *image;
        options.white_balance_k = wrong[i][0];
        options.white_balance_tint = wrong[i][1];
        assert_int_equal(ag_renderer_render(renderer, scene, NULL, &options, &image, NULL),
                         AG_ERROR_ARGUMENT);
    }
    ag_renderer_destroy(renderer);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        KIT_TEST(pictures_are_balanced_light),
        KIT_TEST(the_reference_balances_as_well),
        KIT_TEST(all_light_is_balanced),
        KIT_TEST(wrong_ones_are_refused),
    };
    return cmocka_run_group_tests(tests, kit_open, kit_close);
}
