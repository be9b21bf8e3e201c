// The parts of a picture, whose sum is the whole.
#include "stage.h"

enum { SIZE = 64 };

static const uint32_t part[] = { AG_PART_SEEN, AG_PART_LIGHTS, AG_PART_DIFFUSE, AG_PART_SPECULAR,
                                 AG_PART_EMITTED };

static ag_render_options linear(void)
{
    return (ag_render_options) { .width = SIZE, .height = SIZE, .format = AG_FORMAT_RGBA32F };
}

// Light of each kind, and each way for a surface to send it to the eye: a glossy wall, one that
// glows, one that is unlit, and a pane before them (which is only drawn forward).
static ag_scene *everything(bool pane)
{
    ag_scene *scene;
    OK(ag_scene_create(NULL, &scene));
    ag_material_desc glossy = stage_matte(0.6f), glowing = glossy, glass = glossy;
    glossy.specular = glowing.specular = 1;
    glossy.roughness = 0.4f;
    memcpy(glowing.emissive, (float[3]) { 0.3f, 0.2f, 0.1f }, sizeof glowing.emissive);
    glass.base_color[3] = 0.3f;
    glass.alpha_mode = AG_ALPHA_BLEND;
    const ag_material_desc unlit = stage_unlit(0.1f, 0.5f, 0.2f, 1);
    stage_show(scene, stage_quad(scene, -1, -1, 0, 0.8f, 0, NULL), &glossy);
    stage_show(scene, stage_quad(scene, 0, -1, 1, 0, 0, NULL), &glowing);
    stage_show(scene, stage_quad(scene, 0, 0, 0.5f, 0.5f, 0, NULL), &unlit);
    if (pane)
        stage_show(scene, stage_quad(scene, -0.5f, -0.5f, 0.7f, 0.9f, 1, NULL), &glass);
    const ag_light_desc lights[] = {
        { .kind = AG_LIGHT_POINT, .position = { -0.5f, 0, 0.5f }, .intensity = 1 },
        { .kind = AG_LIGHT_SUN, .direction = { 0.3f, -0.5f, -1 }, .intensity = 2 },
        { .kind = AG_LIGHT_SPHERE, .position = { 0, 0, 0.5f }, .radius_m = 0.2f, .intensity = 1 },
        { .kind = AG_LIGHT_RECT,
          .position = { 0.7f, 0.7f, 0.6f },
          .width_m = 0.3f,
          .height_m = 0.3f,
          .intensity = 5,
          .hidden = true },
        { .kind = AG_LIGHT_HEMISPHERIC, .intensity = 0.4f, .ground_color = { 1, 0.2f, 0.2f } },
    };
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++) {
        ag_light light;
        OK(ag_scene_add_light(scene, &lights[i], &light));
    }
    return scene;
}

static ag_image *draw(ag_renderer *renderer, const ag_scene *scene,
                      const ag_render_options *options)
{
    const ag_camera_desc camera = { .position = { 0.4f, 0.3f, 3 } };
    ag_image *image;
    OK(ag_renderer_render(renderer, scene, &camera, options, &image, NULL));
    return image;
}

static void add(float sum[SIZE * SIZE][4], ag_image *image)
{
    for (int i = 0; i < SIZE * SIZE; i++)
        for (int c = 0; c < 4; c++)
            sum[i][c] += ((const float *)ag_image_pixels(image))[i * 4 + c];
    ag_image_destroy(image);
}

// The picture's colours pass through half floats, which round by 2^-11.
static void assert_sum(const float sum[SIZE * SIZE][4], float covers, ag_image *whole)
{
    for (int i = 0; i < SIZE * SIZE; i++) {
        const float *wanted = (const float *)ag_image_pixels(whole) + i * 4;
        for (int c = 0; c < 3; c++)
            assert_close(sum[i][c], wanted[c], 2e-3f * wanted[c] + 1e-5f);
        assert_close(sum[i][3], covers * wanted[3], 1e-3f);
    }
    ag_image_destroy(whole);
}

static void sum_parts(ag_renderer *renderer, const ag_scene *scene, const ag_render_options *look)
{
    static float sum[SIZE * SIZE][4];
    ag_render_options options = *look;
    memset(sum, 0, sizeof sum);
    for (int i = 0; i < 5; i++) {
        options.parts = part[i];
        add(sum, draw(renderer, scene, &options));
    }
    assert_sum(sum, 5, draw(renderer, scene, look));
}

static void parts_are_the_whole(void **state)
{
    ag_scene *opaque = everything(false), *blended = everything(true);
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    ag_render_options options = linear();
    sum_parts(renderer, opaque, &options);
    sum_parts(renderer, blended, &options);
    options.background = AG_BACKGROUND_TRANSPARENT;
    sum_parts(renderer, blended, &options);
    options.background = AG_BACKGROUND_COLOR;
    options.background_color[1] = 0.5f;
    sum_parts(renderer, blended, &options);
    ag_renderer_destroy(renderer);
    ag_scene_destroy(blended);
    ag_scene_destroy(opaque);
}

static void lights_are_their_part(void **state)
{
    static float sum[SIZE * SIZE][4];
    ag_renderer *renderer;
    ag_scene *scene = everything(false);
    uint32_t count = ag_scene_summarize(scene).lights;
    ag_render_options options = linear();
    options.parts = AG_PART_LIGHTS;
    memset(sum, 0, sizeof sum);
    OK(ag_renderer_create(*state, &renderer));
    for (uint32_t i = 1; i <= count; i++) {
        options.light.id = i;
        add(sum, draw(renderer, scene, &options));
    }
    options.light.id = 0;
    assert_sum(sum, (float)count, draw(renderer, scene, &options));
    ag_renderer_destroy(renderer);
    ag_scene_destroy(scene);
}

static double brightness(ag_renderer *renderer, const ag_scene *scene, uint32_t parts)
{
    ag_render_options options = linear();
    options.parts = parts;
    ag_image *image = draw(renderer, scene, &options);
    const float *pixels = ag_image_pixels(image);
    double sum = 0;
    for (int i = 0; i < SIZE * SIZE; i++)
        sum += (double)pixels[i * 4] + (double)pixels[i * 4 + 1] + (double)pixels[i * 4 + 2];
    ag_image_destroy(image);
    return sum;
}

// Each scene has light of one kind: it is in that part and in no other.
static void each_part_has_its_light(void **state)
{
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    for (int kind = 0; kind < 4; kind++) {
        ag_scene *scene = stage_dark();
        ag_material_desc wall = stage_matte(kind == 0 ? 0 : 0.5f);
        ag_light light;
        const ag_light_desc point = { .position = { 0, 0, 1 }, .intensity = 1 };
        if (kind == 0)
            wall.emissive[0] = 1;
        if (kind == 1)
            OK(ag_scene_add_light(scene, &point, &light));
        if (kind == 3) { // a mirror: nothing but its lobe
            wall.roughness = 0;
            memset(wall.base_color, 0, sizeof(float[3]));
            wall.specular = 1;
        }
        if (kind >= 2)
            stage_surround(scene, 1, 1, 1);
        stage_show(scene, stage_quad(scene, -4, -4, 4, 4, 0, NULL), &wall);
        for (int i = 0; i < 5; i++) {
            double seen = brightness(renderer, scene, part[i]);
            if (i == kind)
                assert_true(seen > 1);
            else
                assert_close((float)seen, 0, 1e-3f);
        }
        ag_scene_destroy(scene);
    }
    ag_renderer_destroy(renderer);
}

static void quiet(void *user, ag_log_level level, const char *text)
{
    (void)user, (void)level, (void)text;
}

static void what_is_not_there_is_refused(void **state)
{
    const ag_log log = { .write = quiet };
    ag_scene *scene;
    ag_renderer *renderer;
    ag_image *image;
    OK(ag_scene_create(&log, &scene));
    OK(ag_renderer_create(*state, &renderer));
    ag_render_options options = linear();
    options.parts = 1u << 5;
    assert_int_equal(ag_renderer_render(renderer, scene, NULL, &options, &image, NULL),
                     AG_ERROR_ARGUMENT);
    options = linear();
    options.light.id = 1;
    assert_int_equal(ag_renderer_render(renderer, scene, NULL, &options, &image, NULL),
                     AG_ERROR_ARGUMENT);
    ag_renderer_destroy(renderer);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        KIT_TEST(parts_are_the_whole),
        KIT_TEST(lights_are_their_part),
        KIT_TEST(each_part_has_its_light),
        KIT_TEST(what_is_not_there_is_refused),
    };
    return cmocka_run_group_tests_name("parts", tests, kit_open, kit_close);
}
