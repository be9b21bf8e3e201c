// One scene under light of half a million times the strength, in lux: what its cards reflect, and
// how they come out of cameras.  docs/real-units.md has the same lights.
#include "stage.h"

#include "scene/environment.h"

enum { WIDTH = 120, HEIGHT = 80, LIGHTS_MAX = 5 };

static const float pi = 3.14159265f;

typedef struct lighting {
    const char *name;
    double lux; // on the grey card; the panels give those beside it 1.4 % less
    float sky;  // of the environment
    ag_light_desc lights[LIGHTS_MAX];
    int count;
} lighting;

#define PANEL(x, z)                                                                                \
    {                                                                                              \
        .kind = AG_LIGHT_RECT, .position = { x, 2.8f, z }, .direction = { 0, -1, 0 },              \
        .up = { 0, 0, 1 }, .width_m = 0.6f, .height_m = 0.6f, .intensity = 2403                    \
    }

static const lighting lightings[] = {
    { "full sun",
      100000,
      8027,
      { { .kind = AG_LIGHT_SUN, .direction = { 0.3f, -0.866f, -0.4f }, .intensity = 92376 } },
      1 },
    { "office",
      500,
      0,
      { PANEL(-0.9f, -0.9f),
        PANEL(0.9f, -0.9f),
        PANEL(-0.9f, 0.9f),
        PANEL(0.9f, 0.9f),
        { .kind = AG_LIGHT_AMBIENT, .intensity = 31.83f } },
      5 },
    { "moonlight",
      0.2,
      0,
      { { .kind = AG_LIGHT_SUN,
          .direction = { 0.3f, -0.866f, -0.4f },
          .intensity = 0.2194f,
          .angular_radius_rad = 0.00452f },
        { .kind = AG_LIGHT_HEMISPHERIC, .intensity = 0.00318f, .color = { 0.8f, 1, 1.589f } } },
      2 },
};
enum { LIGHTINGS = sizeof lightings / sizeof *lightings };

static ag_scene *terrace(const lighting *l)
{
    ag_scene *scene;
    OK(ag_scene_create(NULL, &scene));
    OK(ag_scene_load_demo(scene, "terrace", AG_LOOK_TEXT));
    for (int i = 0; i < l->count; i++) {
        ag_light light;
        OK(ag_scene_add_light(scene, &l->lights[i], &light));
    }
    const ag_environment_desc sky = { .kind = AG_ENVIRONMENT_SKY, .intensity = l->sky };
    if (l->sky > 0)
        OK(ag_scene_set_environment(scene, &sky));
    return scene;
}

static ag_image *draw(ag_renderer *renderer, const ag_scene *scene, float exposure)
{
    const ag_render_options options = {
        .width = WIDTH,
        .height = HEIGHT,
        .format = AG_FORMAT_RGBA32F,
        .exposure = exposure,
    };
    ag_camera_desc camera;
    ag_image *image;
    assert_true(ag_scene_camera(scene, 0, &camera));
    OK(ag_renderer_render(renderer, scene, &camera, &options, &image, NULL));
    return image;
}

// White, grey and black, at their middles; the luminance in the picture.
static double card(const ag_image *image, int index)
{
    static const int at[3][2] = { { 36, 54 }, { 52, 53 }, { 68, 51 } };
    const float *p =
        (const float *)ag_image_pixels(image) + 4 * (at[index][1] * WIDTH + at[index][0]);
    return 0.2126 * (double)p[0] + 0.7152 * (double)p[1] + 0.0722 * (double)p[2];
}

static const double reflectances[3] = { 0.9, 0.18, 0.04 };

static void assert_within(double value, double wanted, double tolerance)
{
    if (!(fabs(value - wanted) <= tolerance * wanted))
        fail_msg("%.6g is not %.6g within %g of it", value, wanted, tolerance);
}

// Each card's luminance is its reflectance times E / pi, over six decades of E.
static void cards_reflect_the_stated_lux(void **state)
{
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    for (int i = 0; i < LIGHTINGS; i++) {
        float exposure = (float)(1 / lightings[i].lux);
        ag_scene *scene = terrace(&lightings[i]);
        ag_image *image = draw(renderer, scene, exposure);
        for (int c = 0; c < 3; c++)
            assert_within(card(image, c) / (double)exposure * (double)pi / reflectances[c],
                          lightings[i].lux, c == 1 ? 0.01 : 0.02);
        ag_image_destroy(image);
        ag_scene_destroy(scene);
    }
    ag_renderer_destroy(renderer);
}

// By quadrature over the sky's image: what 8027 times it sends to the ground.
static void sky_is_20000_lux(void **state)
{
    (void)state;
    ag_image *sky;
    OK(sky_create(NULL, &sky));
    uint32_t w = ag_image_width(sky), h = ag_image_height(sky);
    const float(*p)[4] = ag_image_pixels(sky);
    double sum = 0;
    for (uint32_t i = 0; i < w * h / 2; i++) {
        double theta = (double)pi * (i / w + 0.5) / h;
        double area = 2 * (double)(pi * pi) / ((double)w * h) * sin(theta);
        double y = 0.2126 * (double)p[i][0] + 0.7152 * (double)p[i][1] + 0.0722 * (double)p[i][2];
        sum += y * cos(theta) * area;
    }
    assert_within(sum * (double)lightings[0].sky, 20000, 0.01);
    ag_image_destroy(sky);
}

// A camera at f/16 and 1/100 s with ISO 100 in full sun: grey is shown as grey, white as white.
static void sunny_16_is_right(void **state)
{
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    ag_scene *scene = terrace(&lightings[0]);
    float ev100 = ag_ev100_from_camera(16, 1 / 100.0f, 100);
    ag_image *image = draw(renderer, scene, ag_exposure_from_ev100(ev100));
    assert_true(fabs(log2(card(image, 1) / 0.18)) < 0.15);
    assert_true(card(image, 0) > 0.8 && card(image, 0) < 1);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
    ag_renderer_destroy(renderer);
}

static double metered(ag_renderer *renderer, const ag_scene *scene, const ag_metering *metering,
                      float *ev100)
{
    const ag_render_options options = { .width = WIDTH, .height = HEIGHT };
    ag_camera_desc camera;
    assert_true(ag_scene_camera(scene, 0, &camera));
    OK(ag_renderer_meter(renderer, scene, &camera, &options, metering, ev100));
    ag_image *image = draw(renderer, scene, ag_exposure_from_ev100(*ev100));
    double grey = card(image, 1);
    ag_image_destroy(image);
    return grey;
}

// EV100 has what is metered at 1 / 9.6 of white.  A meter that looks at the grey card alone has it
// there, and says its lux; the one that weighs all of the picture has it near.
static void meters_need_no_help(void **state)
{
    const ag_metering spot = {
        .meter = AG_METER_SPOT, .spot_x = -0.07f, .spot_y = 0.16f, .spot_radius = 0.02f
    };
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    for (int i = 0; i < LIGHTINGS; i++) {
        float ev100;
        ag_scene *scene = terrace(&lightings[i]);
        assert_true(fabs(log2(metered(renderer, scene, &spot, &ev100) * 9.6)) < 0.02);
        double lux = 12.5 / 100 * exp2((double)ev100) * (double)pi / 0.18;
        assert_within(lux, lightings[i].lux, 0.02);
        assert_true(fabs(log2(metered(renderer, scene, NULL, &ev100) * 9.6)) < 0.15);
        ag_scene_destroy(scene);
    }
    ag_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        KIT_TEST(cards_reflect_the_stated_lux),
        KIT_TEST(sky_is_20000_lux),
        KIT_TEST(sunny_16_is_right),
        KIT_TEST(meters_need_no_help),
    };
    return cmocka_run_group_tests_name("real units", tests, kit_open, kit_close);
}
