// A renderer over its life: other scenes, changed scenes, other sizes, wrong options.
#include "stage.h"

static const ag_render_options small = { .width = 48, .height = 32 };

static ag_scene *demo(const char *name)
{
    ag_scene *scene;
    OK(ag_scene_create(NULL, &scene));
    OK(ag_scene_load_demo(scene, name, AG_LOOK_TEXT));
    return scene;
}

static ag_image *draw(ag_renderer *renderer, const ag_scene *scene,
                      const ag_render_options *options)
{
    ag_image *image;
    ag_render_stats stats;
    OK(ag_renderer_render(renderer, scene, NULL, options, &image, &stats));
    assert_true(stats.frame_ms >= 0);
    return image;
}

static bool same(const ag_image *a, const ag_image *b)
{
    size_t size = (size_t)ag_image_width(a) * ag_image_height(a) * 4;
    return ag_image_width(a) == ag_image_width(b) && ag_image_height(a) == ag_image_height(b) &&
           memcmp(ag_image_pixels(a), ag_image_pixels(b), size) == 0;
}

// The same picture byte for byte, whatever was drawn in between.
static void pictures_do_not_depend_on_history(void **state)
{
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    ag_scene *materials = demo("materials"), *lights = demo("lights");
    ag_image *first = draw(renderer, materials, &small);
    ag_render_options other = { .width = 20, .height = 70, .quality = AG_QUALITY_BEST };
    ag_image_destroy(draw(renderer, lights, &other));
    other.format = AG_FORMAT_RGBA32F;
    ag_image_destroy(draw(renderer, materials, &other));
    ag_image *again = draw(renderer, materials, &small);
    assert_true(same(first, again));
    ag_image_destroy(first);
    ag_image_destroy(again);
    ag_scene_destroy(materials);
    ag_scene_destroy(lights);
    ag_renderer_destroy(renderer);
}

static void changes_are_seen(void **state)
{
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    ag_scene *scene = demo("lights");
    ag_image *before = draw(renderer, scene, &small);
    const ag_light_desc desc = { .kind = AG_LIGHT_DIRECTIONAL,
                                 .direction = { 0, -1, 0 },
                                 .intensity = 5 };
    ag_light light;
    OK(ag_scene_add_light(scene, &desc, &light));
    ag_image *lit = draw(renderer, scene, &small);
    assert_false(same(before, lit));
    const ag_environment_desc sky = { .kind = AG_ENVIRONMENT_SKY };
    OK(ag_scene_set_environment(scene, &sky));
    ag_image *under_sky = draw(renderer, scene, &small);
    assert_false(same(lit, under_sky));
    ag_image_destroy(before);
    ag_image_destroy(lit);
    ag_image_destroy(under_sky);
    ag_scene_destroy(scene);
    ag_renderer_destroy(renderer);
}

static void an_empty_scene_is_its_environment(void **state)
{
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    ag_scene *scene;
    OK(ag_scene_create(NULL, &scene));
    ag_image *image = draw(renderer, scene, NULL);
    assert_int_equal(ag_image_width(image), 1024);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
    ag_renderer_destroy(renderer);
}

// A texture that the device cannot have, found when half of the scene is there: the renderer
// goes on with other scenes.
static void a_failed_upload_leaves_nothing(void **state)
{
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    ag_scene *scene = stage_dark();
    const ag_image_desc wide = { ag_device_describe(*state)->max_size + 1, 1, AG_FORMAT_RGBA8,
                                 NULL };
    ag_image *image;
    OK(ag_image_create(NULL, &wide, &image));
    const ag_texture_desc texture = { .image = image };
    ag_material_desc material = ag_material_default();
    OK(ag_scene_add_texture(scene, &texture, &material.base_color_texture.texture));
    ag_image_destroy(image);
    stage_show(scene, stage_quad(scene, -1, -1, 1, 1, 0, NULL), &material);
    assert_int_equal(ag_renderer_render(renderer, scene, NULL, &small, &image, NULL),
                     AG_ERROR_UNSUPPORTED);
    assert_null(image);
    ag_scene *other = demo("lights");
    ag_image_destroy(draw(renderer, other, &small));
    ag_scene_destroy(other);
    ag_scene_destroy(scene);
    ag_renderer_destroy(renderer);
}

static bool stop(void *user, const char *stage, double fraction)
{
    (void)stage;
    (void)fraction;
    return --*(int *)user > 0;
}

static void wrong_options_are_refused(void **state)
{
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    ag_scene *scene = stage_dark();
    const ag_render_options wrong[] = {
        { .width = 5 },
        { .width = 1 << 20, .height = 4 },
        { .width = 4, .height = 4, .exposure = -1 },
        { .width = 4, .height = 4, .exposure = NAN },
        { .width = 4, .height = 4, .tonemap = (ag_tonemap)99 },
        { .width = 4, .height = 4, .quality = (ag_quality)99 },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        ag_image *image = (ag_image *)scene;
        assert_int_equal(ag_renderer_render(renderer, scene, NULL, &wrong[i], &image, NULL),
                         AG_ERROR_ARGUMENT);
        assert_null(image);
    }
    const ag_camera_desc nowhere = { .position = { NAN, 0, 0 } };
    ag_image *none = (ag_image *)scene;
    assert_int_equal(ag_renderer_render(renderer, scene, &nowhere, NULL, &none, NULL),
                     AG_ERROR_ARGUMENT);
    assert_null(none);
    int calls = 3;
    ag_image *image;
    const ag_render_options cancelled = {
        .width = 32, .height = 32, .quality = AG_QUALITY_BEST, .progress = { stop, &calls }
    };
    assert_int_equal(ag_renderer_render(renderer, scene, NULL, &cancelled, &image, NULL),
                     AG_ERROR_CANCELLED);
    assert_null(image);
    ag_scene_destroy(scene);
    ag_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        KIT_TEST(pictures_do_not_depend_on_history), KIT_TEST(changes_are_seen),
        KIT_TEST(an_empty_scene_is_its_environment), KIT_TEST(a_failed_upload_leaves_nothing),
        KIT_TEST(wrong_options_are_refused),
    };
    return cmocka_run_group_tests(tests, kit_open, kit_close);
}
