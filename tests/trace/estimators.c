// Lights alone, surfaces alone, both weighted: the same mean; and how fast noise falls.
#include "stage.h"

// ---- Estimator against estimator ---------------------------------------------------------

typedef void adder(ag_scene *scene);

static void add_light(ag_scene *scene, const ag_light_desc *light)
{
    stage_light(scene, light);
}

static void sphere(ag_scene *scene)
{
    add_light(scene, &(ag_light_desc) { .kind = AG_LIGHT_SPHERE,
                                        .position = { -1.5f, 2, -0.5f },
                                        .radius_m = 0.8f,
                                        .intensity = 10 });
}

static void rectangle(ag_scene *scene)
{
    add_light(scene, &(ag_light_desc) { .kind = AG_LIGHT_RECT,
                                        .position = { -1.5f, 2, -0.5f },
                                        .direction = { 1, -1, 0.3f },
                                        .width_m = 1.5f,
                                        .height_m = 2,
                                        .intensity = 4 });
}

// Cut by the horizon.
static void disk(ag_scene *scene)
{
    add_light(scene, &(ag_light_desc) { .kind = AG_LIGHT_DISK,
                                        .position = { -1.8f, 0.3f, -0.9f },
                                        .direction = { 1, -0.1f, 0.3f },
                                        .radius_m = 0.9f,
                                        .intensity = 4 });
}

static void tube(ag_scene *scene)
{
    add_light(scene, &(ag_light_desc) { .kind = AG_LIGHT_TUBE,
                                        .position = { -1.5f, 1.5f, -0.5f },
                                        .direction = { 0.3f, 0.2f, 1 },
                                        .length_m = 1.5f,
                                        .radius_m = 0.3f,
                                        .intensity = 4 });
}

static void sun(ag_scene *scene)
{
    add_light(scene, &(ag_light_desc) { .kind = AG_LIGHT_SUN,
                                        .direction = { 2, -3, 1.2f },
                                        .angular_radius_rad = 0.25f,
                                        .intensity = 5 });
}

// A dim slope from end to end, and a sun of one pixel about where a mirror would look.
static void sky(ag_scene *scene)
{
    enum { WIDE = 64, HIGH = 32 };
    float(*pixels)[4] = malloc(sizeof(float[4]) * WIDE * HIGH);
    for (int i = 0; i < WIDE * HIGH; i++) {
        float light = 0.2f + (float)(i % WIDE) / WIDE;
        memcpy(pixels[i], (float[4]) { light, light, light, 1 }, sizeof *pixels);
    }
    for (int c = 0; c < 3; c++)
        pixels[6 * WIDE + 5][c] = 100;
    stage_surround_image(scene, WIDE, HIGH, (const float(*)[4])pixels, 0);
    free(pixels);
}

static void mesh(ag_scene *scene)
{
    ag_material_desc glowing = stage_matte(0.3f);
    stage_glow(&glowing, 4);
    stage_show(scene, stage_ball(scene, 12, 0.8f, false, true), &glowing,
               (float[16]) { 1, 0, 0, 0, 0, 1.5f, 0, 0, 0, 0, 1, 0, -1.5f, 2, -0.5f, 1 });
}

// Where a sky outshines it, and it is sought in one sample of four.
static void mesh_by_day(ag_scene *scene)
{
    const float even[2][4] = { { 2, 2, 2, 1 }, { 2, 2, 2, 1 } };
    mesh(scene);
    stage_surround_image(scene, 2, 1, even, 0);
}

// Glass and holes, that shine where they are.
static void show_panes(ag_scene *scene, const ag_material_desc *pane)
{
    stage_show(scene,
               stage_quad(scene, (float[3]) { -2.5f, 1.5f, -1.5f }, (float[3]) { 2, 0, 0 },
                          (float[3]) { 0, 0, 2 }),
               pane, NULL);
}

static void thin_mesh(ag_scene *scene)
{
    ag_material_desc glowing = stage_matte(0.3f);
    stage_glow(&glowing, 4);
    glowing.alpha_mode = AG_ALPHA_BLEND;
    glowing.base_color[3] = 0.3f;
    show_panes(scene, &glowing);
}

static void cut_mesh(ag_scene *scene)
{
    enum { SIZE = 4 };
    uint8_t pixels[SIZE * SIZE][4];
    for (int i = 0; i < SIZE * SIZE; i++)
        memcpy(pixels[i], (uint8_t[4]) { 255, 255, 255, (i + i / SIZE) % 2 ? 255 : 0 }, 4);
    const ag_image_desc image_desc = { SIZE, SIZE, AG_FORMAT_RGBA8, pixels };
    ag_material_desc glowing = stage_matte(0.3f);
    stage_glow(&glowing, 4);
    glowing.alpha_mode = AG_ALPHA_MASK;
    glowing.alpha_cutoff = 0.5f;
    ag_image *image;
    OK(ag_image_create(NULL, &image_desc, &image));
    const ag_texture_desc desc = { .image = image, .mag = AG_FILTER_NEAREST };
    OK(ag_scene_add_texture(scene, &desc, &glowing.base_color_texture.texture));
    ag_image_destroy(image);
    show_panes(scene, &glowing);
}

// Where only some of a mesh shines.
static void painted_mesh(ag_scene *scene)
{
    uint8_t pixels[4][4] = { { 255, 255, 255, 255 }, { 0 }, { 0 }, { 128, 128, 128, 255 } };
    const ag_image_desc image_desc = { 2, 2, AG_FORMAT_RGBA8, pixels };
    ag_material_desc glowing = stage_matte(0.3f);
    stage_glow(&glowing, 4);
    ag_image *image;
    OK(ag_image_create(NULL, &image_desc, &image));
    const ag_texture_desc desc = { .image = image };
    OK(ag_scene_add_texture(scene, &desc, &glowing.emissive_texture.texture));
    ag_image_destroy(image);
    show_panes(scene, &glowing);
}

// A floor and, behind it, a wall, so that light also comes by two surfaces.
static ag_scene *corner(const ag_material_desc *material, adder *add)
{
    ag_scene *scene = stage_dark();
    stage_show(scene, stage_floor(scene, 0, 3), material, NULL);
    stage_show(
        scene,
        stage_quad(scene, (float[3]) { -3, 0, -3 }, (float[3]) { 6, 0, 0 }, (float[3]) { 0, 4, 0 }),
        material, NULL);
    add(scene);
    return scene;
}

static estimate by(const ag_scene *scene, ag_estimator estimator)
{
    const ag_reference_options options = { .estimator = estimator, .max_bounces = 2, .seed = 3 };
    const ag_camera_desc camera = stage_pinpoint();
    const ag_render_options picture = stage_linear(24, 24);
    ag_image *image = stage_trace(scene, &camera, &picture, &options, 64);
    estimate e = stage_estimate(image, 0);
    ag_image_destroy(image);
    return e;
}

static void assert_estimators_agree(const char *what, adder *add)
{
    const ag_material_desc materials[] = { stage_matte(0.8f), stage_metal(0.9f, 1),
                                           stage_metal(0.9f, 0.4f) };
    for (int i = 0; i < 3; i++) {
        ag_scene *scene = corner(&materials[i], add);
        estimate both = by(scene, AG_ESTIMATOR_BOTH);
        for (ag_estimator k = AG_ESTIMATOR_LIGHTS; k <= AG_ESTIMATOR_SURFACE; k++) {
            estimate e = by(scene, k);
            double error = hypot(e.error, both.error);
            // One that sees too little to know its error would agree with all.
            assert_true(error < 0.03 * both.mean);
            assert_agrees(what, ((estimate) { e.mean, error }), both.mean, 1e-6);
        }
        assert_true(both.mean > 0.05 && both.error < 0.01 * both.mean);
        ag_scene_destroy(scene);
    }
}

static void lights_and_surfaces_agree(void **state)
{
    (void)state;
    assert_estimators_agree("sphere", sphere);
    assert_estimators_agree("rectangle", rectangle);
    assert_estimators_agree("disk", disk);
    assert_estimators_agree("tube", tube);
    assert_estimators_agree("sun", sun);
}

static void skies_and_surfaces_agree(void **state)
{
    (void)state;
    assert_estimators_agree("sky", sky);
}

static void glowing_and_surfaces_agree(void **state)
{
    (void)state;
    assert_estimators_agree("mesh", mesh);
    assert_estimators_agree("painted mesh", painted_mesh);
    assert_estimators_agree("mesh by day", mesh_by_day);
}

static void what_is_partly_there_shines_so_far(void **state)
{
    (void)state;
    assert_estimators_agree("thin mesh", thin_mesh);
    assert_estimators_agree("cut mesh", cut_mesh);
}

// ---- Convergence -------------------------------------------------------------------------

enum { SIZE = 16 };

static double rms(const ag_image *a, const ag_image *b)
{
    double square = 0;
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        square += pow((double)stage_pixel(a, i % SIZE, i / SIZE)[1] -
                          (double)stage_pixel(b, i % SIZE, i / SIZE)[1],
                      2);
    return sqrt(square / (SIZE * SIZE));
}

// Noise falls as the root of the samples or faster, on a floor with soft shadows, a sky, a lobe
// and light by two surfaces.
static void noise_falls_as_the_root(void **state)
{
    (void)state;
    const ag_material_desc metal = stage_metal(0.9f, 0.6f), matte = stage_matte(0.7f);
    ag_scene *scene = corner(&matte, sky);
    sphere(scene);
    stage_show(scene, stage_ball(scene, 12, 0.6f, false, true), &metal,
               (float[16]) { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.6f, 0, 1 });
    const ag_camera_desc camera = { .position = { 2, 3, 4 }, .fov_y_rad = 0.4f };
    const ag_render_options picture = stage_linear(SIZE, SIZE);
    ag_image *truth =
        stage_trace(scene, &camera, &picture, &(ag_reference_options) { .seed = 17 }, 2048);
    double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0, count = 0;
    for (uint32_t n = 4; n <= 256; n *= 4) {
        ag_image *image =
            stage_trace(scene, &camera, &picture, &(ag_reference_options) { .seed = 18 }, n);
        double x = log(n), y = log(rms(image, truth));
        ag_image_destroy(image);
        sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y, count++;
    }
    double slope = (count * sum_xy - sum_x * sum_y) / (count * sum_xx - sum_x * sum_x);
    if (!(slope <= -0.45))
        print_error("noise falls as the power %g\n", slope);
    assert_true(slope <= -0.45);
    ag_image_destroy(truth);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_and_surfaces_agree),
        cmocka_unit_test(skies_and_surfaces_agree),
        cmocka_unit_test(glowing_and_surfaces_agree),
        cmocka_unit_test(what_is_partly_there_shines_so_far),
        cmocka_unit_test(noise_falls_as_the_root),
    };
    return cmocka_run_group_tests_name("estimators", tests, NULL, NULL);
}
