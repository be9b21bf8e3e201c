// Linear pictures as they are shown, against pictures that were coded by the renderer.
#include "stage.h"

enum { SIZE = 32 };

// Steps of 8 bits, the greatest in any channel; over black, as straight colours of what is hardly
// there are rounded twice.
static int apart(const ag_image *a, const ag_image *b)
{
    int most = 0;
    for (uint32_t i = 0; i < SIZE * SIZE; i++) {
        const uint8_t *p = stage_byte(a, i % SIZE, i / SIZE),
                      *q = stage_byte(b, i % SIZE, i / SIZE);
        for (int c = 0; c < 4; c++) {
            int d = abs(p[c] - q[c]) * (c < 3 ? q[3] : 255) / 255;
            most = d > most ? d : most;
        }
    }
    return most;
}

static ag_image *draw(ag_renderer *renderer, const ag_scene *scene, ag_render_options options)
{
    ag_image *image;
    OK(ag_renderer_render(renderer, scene, NULL, &options, &image, NULL));
    return image;
}

static void check(ag_renderer *renderer, const ag_scene *scene, ag_render_options look)
{
    ag_image *wanted = draw(renderer, scene, look), *shown;
    ag_render_options linear = look;
    linear.format = AG_FORMAT_RGBA32F;
    if (linear.background == AG_BACKGROUND_COLOR)
        linear.background = AG_BACKGROUND_TRANSPARENT;
    ag_image *light = draw(renderer, scene, linear);
    OK(ag_image_display(NULL, light, &look, &shown));
    assert_in_range(apart(shown, wanted), 0, 1);
    ag_image_destroy(shown);
    ag_image_destroy(light);
    ag_image_destroy(wanted);
}

static void shown_as_the_renderer_shows(void **state)
{
    ag_scene *scene;
    ag_renderer *renderer;
    OK(ag_scene_create(NULL, &scene));
    OK(ag_scene_load_demo(scene, "lights", AG_LOOK_TEXT));
    OK(ag_renderer_create(*state, &renderer));
    // Frames that are summed are coded last, as edges must be.
    ag_render_options look = { .width = SIZE, .height = SIZE, .quality = AG_QUALITY_BEST };
    for (int curve = 0; curve <= AG_TONEMAP_AGX; curve++) {
        look.tonemap = (ag_tonemap)curve;
        check(renderer, scene, look);
    }
    look.transfer = AG_TRANSFER_GAMMA_22;
    check(renderer, scene, look);
    look.background = AG_BACKGROUND_TRANSPARENT;
    check(renderer, scene, look);
    look.background = AG_BACKGROUND_COLOR;
    look.background_color[0] = 0.3f;
    look.background_color[1] = 0.9f;
    check(renderer, scene, look);
    ag_renderer_destroy(renderer);
    ag_scene_destroy(scene);
}

// A renderer scatters what it would give as linear light, in tiles or not, and shows it then.
static void bloom_is_before_the_curve(void **state)
{
    ag_scene *scene;
    ag_renderer *renderer;
    OK(ag_scene_create(NULL, &scene));
    OK(ag_scene_load_demo(scene, "lights", AG_LOOK_TEXT));
    OK(ag_renderer_create(*state, &renderer));
    for (int background = 0; background <= AG_BACKGROUND_COLOR; background++) {
        ag_render_options look = { .width = SIZE,
                                   .height = SIZE,
                                   .tonemap = AG_TONEMAP_AGX,
                                   .background = (ag_background)background,
                                   .bloom = 0.4f };
        ag_render_options linear = look;
        linear.bloom = 0;
        linear.format = AG_FORMAT_RGBA32F;
        if (background == AG_BACKGROUND_COLOR)
            linear.background = AG_BACKGROUND_TRANSPARENT;
        ag_image *got = draw(renderer, scene, look), *light = draw(renderer, scene, linear);
        ag_image *scattered, *wanted;
        OK(ag_image_bloom(NULL, light, 0.4f, &scattered));
        OK(ag_image_display(NULL, scattered, &look, &wanted));
        assert_memory_equal(ag_image_pixels(got), ag_image_pixels(wanted), SIZE * SIZE * 4);
        ag_image_destroy(got);
        ag_image_destroy(light);
        ag_image_destroy(scattered);
        ag_image_destroy(wanted);
    }
    ag_renderer_destroy(renderer);
    ag_scene_destroy(scene);
}

static void quiet(void *user, ag_log_level level, const char *text)
{
    (void)user, (void)level, (void)text;
}

static void bytes_are_shown_already(void **state)
{
    (void)state;
    const ag_log log = { .write = quiet };
    const ag_image_desc desc = { .width = 2, .height = 2 };
    const ag_render_options look = { 0 };
    ag_image *bytes, *shown;
    OK(ag_image_create(NULL, &desc, &bytes));
    assert_int_equal(ag_image_display(&log, bytes, &look, &shown), AG_ERROR_ARGUMENT);
    ag_image_destroy(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        KIT_TEST(shown_as_the_renderer_shows),
        KIT_TEST(bloom_is_before_the_curve),
        KIT_TEST(bytes_are_shown_already),
    };
    return cmocka_run_group_tests_name("display", tests, kit_open, kit_close);
}
