// Metering on the device against metering of pictures that were read back, and against the
// reference.
#include "stage.h"

#include "render/renderer.h"

static ag_scene *demo(const char *name)
{
    ag_scene *scene;
    OK(ag_scene_create(NULL, &scene));
    OK(ag_scene_load_demo(scene, name, AG_LOOK_ARGAND));
    return scene;
}

static ag_renderer *open(void **state, bool forward)
{
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    renderer->forward_only = forward;
    return renderer;
}

static ag_scene *surrounded_by(float nit)
{
    const float pixel[4] = { 1, 1, 1, 1 };
    const ag_image_desc image_desc = { 1, 1, AG_FORMAT_RGBA32F, pixel };
    ag_scene *scene;
    ag_image *image;
    OK(ag_image_create(NULL, &image_desc, &image));
    const ag_environment_desc desc = { .kind = AG_ENVIRONMENT_IMAGE,
                                       .image = image,
                                       .intensity = nit };
    OK(ag_scene_create(NULL, &scene));
    OK(ag_scene_set_environment(scene, &desc));
    ag_image_destroy(image);
    return scene;
}

// A view of nothing but surroundings of one luminance, over all that the meter can see.
static void surroundings_are_metered(void **state)
{
    ag_renderer *renderer = open(state, false);
    for (float ev = -9; ev <= 21; ev += 6) {
        ag_scene *scene = surrounded_by(exp2f(ev) / 8);
        float found;
        OK(ag_renderer_meter(renderer, scene, NULL, NULL, NULL, &found));
        assert_close(found, ev, .02f);
        ag_scene_destroy(scene);
    }
    ag_renderer_destroy(renderer);
}

// The shader's histogram against the one in C, of the same picture read back.
static void check_scene(ag_renderer *renderer, const ag_scene *scene, ag_background background)
{
    const ag_metering meterings[] = {
        { .meter = AG_METER_CENTER },
        { .meter = AG_METER_AVERAGE, .low = 0, .high = 1 },
        { .meter = AG_METER_SPOT, .spot_x = .1f, .spot_y = -.05f, .compensation_ev = 2 },
    };
    const ag_render_options small = { .width = 160,
                                      .height = 100,
                                      .format = AG_FORMAT_RGBA32F,
                                      .quality = AG_QUALITY_FAST,
                                      .background = background,
                                      .exposure = 1 / 16.f };
    ag_image *image;
    OK(ag_renderer_render(renderer, scene, NULL, &small, &image, NULL));
    for (int i = 0; i < 3; i++) {
        float found, wanted;
        OK(ag_image_meter(NULL, image, small.exposure, &meterings[i], &wanted));
        OK(ag_renderer_meter(renderer, scene, NULL, &small, &meterings[i], &found));
        assert_close(found, wanted, 1e-3f);
        assert_true(wanted > -7 && wanted < 20);
    }
    ag_image_destroy(image);
}

static void the_device_counts_as_the_host(void **state)
{
    for (int forward = 0; forward < 2; forward++) {
        ag_renderer *renderer = open(state, forward);
        ag_scene *scene = demo("lights"), *blended = demo("materials");
        check_scene(renderer, scene, AG_BACKGROUND_ENVIRONMENT);
        check_scene(renderer, scene, AG_BACKGROUND_TRANSPARENT);
        check_scene(renderer, blended, AG_BACKGROUND_TRANSPARENT);
        ag_scene_destroy(scene);
        ag_scene_destroy(blended);
        ag_renderer_destroy(renderer);
    }
}

// The same at any size and after anything else; what a picture of full size needs stays.
static void it_depends_on_nothing_else(void **state)
{
    ag_renderer *renderer = open(state, false);
    ag_scene *scene = demo("lights");
    ag_render_options options = { .width = 320, .height = 180 };
    ag_image *image;
    float first, again;
    OK(ag_renderer_meter(renderer, scene, NULL, &options, NULL, &first));
    OK(ag_renderer_render(renderer, scene, NULL, &options, &image, NULL));
    VkBuffer kept = renderer->targets.pixels.buffer, small = renderer->metered.pixels.buffer;
    const ag_render_options others[] = {
        { .width = 3840, .height = 2160, .quality = AG_QUALITY_BEST },
        { .width = 32, .height = 18, .exposure = 1000, .tonemap = AG_TONEMAP_AGX },
        { .width = 1280, .height = 720, .format = AG_FORMAT_RGBA32F, .white_balance_k = 2000 },
        { .width = 640, .height = 360, .transfer = AG_TRANSFER_GAMMA_22 },
    };
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        OK(ag_renderer_meter(renderer, scene, NULL, &others[i], NULL, &again));
        assert_true(again == first);
    }
    assert_true(renderer->targets.pixels.buffer == kept);
    assert_true(renderer->metered.pixels.buffer == small);
    ag_image *later;
    OK(ag_renderer_render(renderer, scene, NULL, &options, &later, NULL));
    assert_memory_equal(ag_image_pixels(image), ag_image_pixels(later), 320 * 180 * 4);
    ag_image_destroy(image);
    ag_image_destroy(later);
    ag_scene_destroy(scene);
    ag_renderer_destroy(renderer);
}

// Light straight from its source, which both have.
static void the_reference_meters_the_same(void **state)
{
    const ag_reference_options straight = { .unshadowed = true, .direct_only = true };
    const ag_render_options options = { .width = 64, .height = 48 };
    ag_renderer *renderer = open(state, false);
    const char *names[] = { "spheres", "metals" };
    for (size_t i = 0; i < 2; i++) {
        ag_scene *scene = demo(names[i]);
        float drawn, traced;
        OK(ag_renderer_meter(renderer, scene, NULL, &options, NULL, &drawn));
        OK(ag_reference_meter(scene, NULL, &options, &straight, NULL, &traced));
        assert_close(drawn, traced, .1f);
        ag_scene_destroy(scene);
    }
    ag_renderer_destroy(renderer);
}

static void wrong_ones_are_refused(void **state)
{
    ag_renderer *renderer = open(state, false);
    ag_scene *scene = stage_dark();
    const ag_metering wrong = { .low = 2 };
    const ag_render_options unsound = { .width = 0, .height = 3 };
    float ev = 7;
    assert_int_equal(ag_renderer_meter(renderer, scene, NULL, NULL, &wrong, &ev),
                     AG_ERROR_ARGUMENT);
    assert_int_equal(ag_renderer_meter(renderer, scene, NULL, &unsound, NULL, &ev),
                     AG_ERROR_ARGUMENT);
    assert_int_equal(ag_reference_meter(scene, NULL, NULL, NULL, &wrong, &ev), AG_ERROR_ARGUMENT);
    assert_int_equal(ag_reference_meter(scene, NULL, &unsound, NULL, NULL, &ev), AG_ERROR_ARGUMENT);
    assert_true(ev == 0);
    OK(ag_renderer_meter(renderer, scene, NULL, NULL, NULL, &ev)); // all is black
    assert_close(ev, -10, 0);
    ag_scene_destroy(scene);
    ag_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        KIT_TEST(surroundings_are_metered),   KIT_TEST(the_device_counts_as_the_host),
        KIT_TEST(it_depends_on_nothing_else), KIT_TEST(the_reference_meters_the_same),
        KIT_TEST(wrong_ones_are_refused),
    };
    return cmocka_run_group_tests(tests, kit_open, kit_close);
}
