// What a reference is asked for, and when it stops.
#define _GNU_SOURCE
#include "stage.h"

#include <sched.h>

enum { SIZE = 24, LARGE = 80 }; // px; a large one is many tasks

static const float moved[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -0.5f, 0.5f, -0.5f, 1 };

// Light of each kind on a floor, a wall behind it and a ball.
static ag_scene *everything_with(const ag_log *log)
{
    ag_scene *scene;
    OK(ag_scene_create(log, &scene)); // in the studio
    ag_material_desc glossy = stage_matte(0.6f), glowing = stage_matte(0.4f);
    glossy.specular = 1;
    glossy.roughness = 0.5f;
    stage_glow(&glowing, 0.5f);
    stage_show(scene, stage_floor(scene, 0, 3), &glossy, NULL);
    stage_show(
        scene,
        stage_quad(scene, (float[3]) { -3, 0, -2 }, (float[3]) { 6, 0, 0 }, (float[3]) { 0, 4, 0 }),
        &glossy, NULL);
    stage_show(scene, stage_ball(scene, 8, 0.4f, false, true), &glowing, moved);
    const ag_light_desc lights[] = {
        { .kind = AG_LIGHT_POINT, .position = { 0.8f, 1, 0.5f }, .intensity = 1 },
        { .kind = AG_LIGHT_SUN, .direction = { 1, -2, -1 }, .intensity = 2 },
        { .kind = AG_LIGHT_SPHERE, .position = { 1, 1.5f, -1 }, .radius_m = 0.3f, .intensity = 1 },
        { .kind = AG_LIGHT_HEMISPHERIC, .intensity = 0.4f, .ground_color = { 1, 0.2f, 0.2f } },
    };
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++)
        stage_light(scene, &lights[i]);
    return scene;
}

static ag_scene *everything(void)
{
    return everything_with(NULL);
}

static const ag_camera_desc over = { .position = { 2, 3, 4 }, .fov_y_rad = 0.7f };

static bool are_same(const ag_image *a, const ag_image *b)
{
    size_t size = sizeof(float[4]) * ag_image_width(a) * ag_image_height(a);
    return memcmp(ag_image_pixels(a), ag_image_pixels(b), size) == 0;
}

static void assert_sound(const ag_image *image)
{
    for (uint32_t i = 0; i < LARGE * LARGE; i++)
        for (int c = 0; c < 4; c++) {
            float value = stage_pixel(image, i % LARGE, i / LARGE)[c];
            assert_true(isfinite(value) && value >= 0 && value < 100);
        }
}

// ---- Seeds and threads ---------------------------------------------------------------------

static ag_image *seeded(const ag_scene *scene, uint32_t seed, uint32_t samples)
{
    const ag_render_options picture = stage_linear(LARGE, LARGE);
    return stage_trace(scene, &over, &picture, &(ag_reference_options) { .seed = seed }, samples);
}

static void a_seed_is_a_picture(void **state)
{
    (void)state;
    ag_scene *scene = everything();
    cpu_set_t all, one;
    ag_image *many = seeded(scene, 1, 6), *other = seeded(scene, 2, 6);
    CPU_ZERO(&one);
    assert_int_equal(sched_getaffinity(0, sizeof all, &all), 0);
    for (size_t i = 0; i < CPU_SETSIZE && !CPU_COUNT(&one); i++)
        if (CPU_ISSET(i, &all))
            CPU_SET(i, &one);
    assert_int_equal(sched_setaffinity(0, sizeof one, &one), 0);
    ag_image *alone = seeded(scene, 1, 6);
    assert_int_equal(sched_setaffinity(0, sizeof all, &all), 0);
    assert_true(are_same(many, alone));
    assert_false(are_same(many, other));
    assert_sound(many);
    ag_image_destroy(many);
    ag_image_destroy(alone);
    ag_image_destroy(other);
    ag_scene_destroy(scene);
}

// ---- When it stops -------------------------------------------------------------------------

static void quiet(void *user, ag_log_level level, const char *sentence)
{
    (void)user, (void)level, (void)sentence;
}

static bool until_half(void *user, const char *stage, double fraction)
{
    assert_string_equal(stage, "trace");
    assert_true(fraction >= *(double *)user && fraction <= 1);
    *(double *)user = fraction;
    return fraction < 0.5;
}

// Asked to stop half-way; what is there is sound, and goes on to what it would have been.
static void what_is_cancelled_is_sound(void **state)
{
    (void)state;
    ag_scene *scene = everything_with(&(ag_log) { .write = quiet });
    ag_reference *r;
    ag_image *half, *whole, *straight = seeded(scene, 1, 12);
    double fraction = 0;
    const ag_render_options picture = stage_linear(LARGE, LARGE);
    OK(ag_reference_create(scene, &over, &picture, &(ag_reference_options) { .seed = 1 }, &r));
    ag_reference_goal goal = { .samples = 12, .progress = { until_half, &fraction } };
    assert_int_equal(ag_reference_trace(r, &goal), AG_ERROR_CANCELLED);
    uint32_t samples = ag_reference_describe(r).samples;
    assert_in_range(samples, 1, 11);
    OK(ag_reference_picture(r, &half));
    assert_sound(half);
    assert_false(are_same(half, straight));
    goal.progress.update = NULL;
    OK(ag_reference_trace(r, &goal));
    assert_int_equal(ag_reference_describe(r).samples, 12);
    OK(ag_reference_picture(r, &whole));
    assert_true(are_same(whole, straight));
    ag_image_destroy(half);
    ag_image_destroy(whole);
    ag_image_destroy(straight);
    ag_reference_destroy(r);
    ag_scene_destroy(scene);
}

static void goals_are_kept(void **state)
{
    (void)state;
    ag_scene *scene = everything();
    const ag_render_options picture = stage_linear(SIZE, SIZE);
    ag_reference *r;
    OK(ag_reference_create(scene, &over, &picture, NULL, &r));
    OK(ag_reference_trace(r, &(ag_reference_goal) { .noise = 0.1f, .samples = 100000 }));
    ag_reference_state s = ag_reference_describe(r);
    assert_true(s.noise > 0 && s.noise <= 0.1f && s.samples > 1 && s.samples < 10000);
    assert_true(s.rays >= (uint64_t)s.samples * SIZE * SIZE);
    OK(ag_reference_trace(r, &(ag_reference_goal) { .seconds = 0.2 }));
    ag_reference_state later = ag_reference_describe(r);
    double spent = later.trace_ms - s.trace_ms;
    assert_true(later.samples > s.samples && spent >= 200 && spent < 5000);
    // Already there.
    OK(ag_reference_trace(r, &(ag_reference_goal) { .samples = 1 }));
    assert_int_equal(ag_reference_describe(r).samples, later.samples);
    ag_reference_destroy(r);
    ag_scene_destroy(scene);
}

// The noise that it tells is the error that it has, where all pixels see the same.
static void noise_is_the_error(void **state)
{
    (void)state;
    ag_scene *scene = everything();
    const ag_camera_desc camera = stage_pinpoint();
    const ag_render_options picture = stage_linear(SIZE, SIZE);
    ag_image *image;
    ag_reference *r = stage_traced(scene, &camera, &picture, NULL, 64);
    OK(ag_reference_picture(r, &image));
    estimate e = stage_estimate(image, 1);
    double noise = (double)ag_reference_describe(r).noise, spread = e.error / e.mean * SIZE;
    // It is one of independent samples: these are better.
    assert_true(noise > 0.9 * spread && noise < 2.5 * spread);
    ag_image_destroy(image);
    ag_reference_destroy(r);
    ag_scene_destroy(scene);
}

// ---- Parts -----------------------------------------------------------------------------------

static estimate part_of(const ag_scene *scene, uint32_t parts, uint32_t light, bool direct)
{
    const ag_camera_desc camera = stage_pinpoint();
    ag_render_options picture = stage_linear(SIZE, SIZE);
    picture.parts = parts;
    picture.light.id = light;
    const ag_reference_options options = { .seed = parts + 32 * light, .direct_only = direct };
    ag_image *image = stage_trace(scene, &camera, &picture, &options, 64);
    estimate e = stage_estimate(image, 0);
    ag_image_destroy(image);
    return e;
}

static estimate plus(estimate a, estimate b)
{
    return (estimate) { a.mean + b.mean, hypot(a.error, b.error) };
}

static void parts_are_the_whole(void **state)
{
    (void)state;
    ag_scene *scene = everything();
    for (int direct = 0; direct < 2; direct++) {
        estimate whole = part_of(scene, 0, 0, direct), sum = { 0 };
        for (uint32_t part = AG_PART_SEEN; part <= AG_PART_EMITTED; part *= 2) {
            estimate e = part_of(scene, part, 0, direct);
            assert_true(part == AG_PART_SEEN ? e.mean == 0 : e.mean > 0.001);
            sum = plus(sum, e);
        }
        sum.error = hypot(sum.error, whole.error);
        assert_agrees("parts", sum, whole.mean, 1e-6);
    }
    ag_scene_destroy(scene);
}

static void lights_are_their_part(void **state)
{
    (void)state;
    ag_scene *scene = everything();
    estimate whole = part_of(scene, AG_PART_LIGHTS, 0, false), sum = { 0 };
    for (uint32_t i = 1; i <= ag_scene_summarize(scene).lights; i++) {
        estimate e = part_of(scene, AG_PART_LIGHTS, i, false);
        assert_true(e.mean > 0.001);
        sum = plus(sum, e);
    }
    sum.error = hypot(sum.error, whole.error);
    assert_agrees("lights", sum, whole.mean, 1e-6);
    ag_scene_destroy(scene);
}

// ---- What else is known ------------------------------------------------------------------------

static void direct_and_indirect_are_the_picture(void **state)
{
    (void)state;
    ag_scene *scene = everything();
    ag_render_options picture = stage_linear(SIZE, SIZE);
    picture.background = AG_BACKGROUND_ENVIRONMENT;
    picture.exposure = 2;
    ag_image *whole, *direct, *indirect;
    ag_reference *r =
        stage_traced(scene, &over, &picture, &(ag_reference_options) { .keep_aovs = true }, 8);
    OK(ag_reference_picture(r, &whole));
    OK(ag_reference_aov(r, AG_AOV_DIRECT, &direct));
    OK(ag_reference_aov(r, AG_AOV_INDIRECT, &indirect));
    double by_two = 0;
    for (uint32_t i = 0; i < SIZE * SIZE; i++)
        for (int c = 0; c < 3; c++) {
            uint32_t x = i % SIZE, y = i / SIZE;
            float a = stage_pixel(direct, x, y)[c], b = stage_pixel(indirect, x, y)[c];
            float wanted = stage_pixel(whole, x, y)[c];
            assert_true(a >= 0 && b >= 0 && fabsf(a + b - wanted) <= 1e-5f * (1 + wanted));
            by_two += (double)b;
        }
    assert_true(by_two > 1);
    ag_image_destroy(whole);
    ag_image_destroy(direct);
    ag_image_destroy(indirect);
    ag_reference_destroy(r);
    ag_scene_destroy(scene);
}

static void direct_light_is_of_one_surface(void **state)
{
    (void)state;
    ag_scene *scene = everything();
    const ag_camera_desc camera = stage_pinpoint();
    const ag_render_options picture = stage_linear(SIZE, SIZE);
    ag_image *direct;
    ag_reference *r =
        stage_traced(scene, &camera, &picture, &(ag_reference_options) { .keep_aovs = true }, 64);
    OK(ag_reference_aov(r, AG_AOV_DIRECT, &direct));
    estimate e = stage_estimate(direct, 0), alone = part_of(scene, 0, 0, true);
    e.error = hypot(e.error, alone.error);
    assert_agrees("direct", e, alone.mean, 1e-6);
    ag_image_destroy(direct);
    ag_reference_destroy(r);
    ag_scene_destroy(scene);
}

// A plane aslant: depth is along the camera's axis, normals face the eye, from behind too.
static void a_plane_is_where_it_is(void **state)
{
    (void)state;
    ag_scene *scene = stage_dark();
    ag_material_desc matte = stage_matte(0.25f);
    matte.double_sided = true;
    stage_show(scene, stage_floor(scene, 0, 50), &matte, NULL);
    for (int below = 0; below < 2; below++) {
        float side = below ? -1 : 1;
        const ag_camera_desc camera = { .position = { 0, 4 * side, 3 }, .height_m = 2 };
        const ag_render_options picture = stage_linear(SIZE, SIZE);
        ag_image *depth, *normal, *albedo;
        ag_reference *r = stage_traced(scene, &camera, &picture,
                                       &(ag_reference_options) { .keep_aovs = true }, 64);
        OK(ag_reference_aov(r, AG_AOV_DEPTH, &depth));
        OK(ag_reference_aov(r, AG_AOV_NORMAL, &normal));
        OK(ag_reference_aov(r, AG_AOV_ALBEDO, &albedo));
        for (uint32_t i = 0; i < SIZE * SIZE; i++) {
            uint32_t x = i % SIZE, y = i / SIZE;
            // A step up the picture is 3/4 of it farther away.
            double up = 1 - 2 * (y + 0.5) / SIZE, wanted = 5 + 0.75 * up * (double)side;
            const float *n = stage_pixel(normal, x, y);
            assert_true(fabs((double)stage_pixel(depth, x, y)[0] - wanted) < 0.04);
            assert_true(fabsf(n[0]) < 1e-6f && fabsf(n[1] - side) < 1e-6f && fabsf(n[2]) < 1e-6f);
            assert_true(fabsf(stage_pixel(albedo, x, y)[1] - 0.25f) < 1e-6f);
        }
        double mean = stage_estimate(depth, 0).mean;
        assert_true(fabs(mean - 5) < 2e-4);
        ag_image_destroy(depth);
        ag_image_destroy(normal);
        ag_image_destroy(albedo);
        ag_reference_destroy(r);
    }
    ag_scene_destroy(scene);
}

// ---- Coverage --------------------------------------------------------------------------------

static ag_material_desc unlit(float value, float alpha)
{
    ag_material_desc m = stage_matte(value);
    m.unlit = true;
    m.base_color[3] = alpha;
    return m;
}

static const ag_camera_desc down = { .position = { 0, 5, 0 }, .height_m = 2 };

// The edge is in the middle of a pixel.
static void half_a_picture_is_half_there(void **state)
{
    (void)state;
    enum { ODD = 25 };
    ag_scene *scene = stage_dark();
    const ag_material_desc grey = unlit(0.4f, 1);
    stage_show(scene,
               stage_quad(scene, (float[3]) { -9, 0, 9 }, (float[3]) { 9, 0, 0 },
                          (float[3]) { 0, 0, -18 }),
               &grey, NULL);
    const ag_render_options picture = stage_linear(ODD, ODD);
    ag_image *image = stage_trace(scene, &down, &picture, NULL, 64);
    for (uint32_t y = 0; y < ODD; y++)
        for (uint32_t x = 0; x < ODD; x++) {
            const float *p = stage_pixel(image, x, y);
            float wanted = x < ODD / 2 - 1 ? 1 : x > ODD / 2 + 1 ? 0 : p[3];
            assert_true(p[3] == wanted);
            assert_true(p[3] > 0 ? fabsf(p[0] - 0.4f) < 1e-5f : p[0] == 0);
        }
    estimate edge = stage_estimate_in(image, 3, ODD / 2, 0, ODD / 2 + 1, ODD);
    assert_true(edge.error < 0.01);
    assert_agrees("edge", edge, 0.5, 1e-6);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

static void panes_are_mixed(void **state)
{
    (void)state;
    for (int over_nothing = 0; over_nothing < 2; over_nothing++) {
        ag_scene *scene = stage_dark();
        const ag_material_desc back = unlit(0.2f, 1);
        ag_material_desc pane = unlit(0.9f, 0.3f);
        pane.alpha_mode = AG_ALPHA_BLEND;
        stage_show(scene, stage_floor(scene, 1, 9), &pane, NULL);
        if (!over_nothing)
            stage_show(scene, stage_floor(scene, 0, 9), &back, NULL);
        const ag_render_options picture = stage_linear(SIZE, SIZE);
        ag_image *image = stage_trace(scene, &down, &picture, NULL, 64);
        if (over_nothing) {
            assert_agrees("coverage", stage_estimate(image, 3), 0.3, 0);
            assert_agrees("its colour", stage_estimate(image, 0), 0.9, 1e-4);
        } else {
            assert_agrees("mix", stage_estimate(image, 0), 0.3 * 0.9 + 0.7 * 0.2, 0);
            assert_agrees("coverage", stage_estimate(image, 3), 1, 1e-6);
        }
        ag_image_destroy(image);
        ag_scene_destroy(scene);
    }
}

// ---- Without shadows, and clamped
// ----------------------------------------------------------------

static ag_scene *lit_by_a_lamp(bool hidden)
{
    ag_scene *scene = stage_dark();
    const ag_material_desc white = stage_matte(1);
    stage_show(scene, stage_floor(scene, 0, 1), &white, NULL);
    if (hidden) // from light, not from the eye
        stage_show(scene, stage_floor(scene, 1, 0.3f), &white, NULL);
    const ag_light_desc lamp = {
        .kind = AG_LIGHT_SPHERE, .position = { 0, 2, 0 }, .radius_m = 0.1f, .intensity = 4
    };
    stage_light(scene, &lamp);
    return scene;
}

static double floor_seen(bool hidden, float exposure, const ag_reference_options *options)
{
    ag_scene *scene = lit_by_a_lamp(hidden);
    const ag_camera_desc camera = stage_pinpoint();
    ag_render_options picture = stage_linear(SIZE, SIZE);
    picture.exposure = exposure;
    ag_image *image = stage_trace(scene, &camera, &picture, options, 64);
    double mean = stage_estimate(image, 0).mean;
    ag_image_destroy(image);
    ag_scene_destroy(scene);
    return mean;
}

static void shadows_are_left_out_when_asked(void **state)
{
    (void)state;
    double wanted = 4.0 / 4 / pi;
    const ag_reference_options plain = { .unshadowed = true, .direct_only = true };
    const ag_reference_options shadowed = { .direct_only = true };
    assert_true(fabs(floor_seen(true, 0, &plain) - wanted) < 0.002 * wanted);
    assert_true(fabs(floor_seen(false, 0, &plain) - wanted) < 0.002 * wanted);
    assert_true(floor_seen(true, 0, &shadowed) == 0);
    assert_true(fabs(floor_seen(false, 0, &shadowed) - wanted) < 0.002 * wanted);
}

static void exposed_light_is_clamped(void **state)
{
    (void)state;
    double wanted = 4.0 / 4 / pi;
    const ag_reference_options free = { .seed = 1 }, held = { .clamp = 0.01f };
    assert_true(fabs(floor_seen(false, 3, &free) - 3 * wanted) < 0.006 * wanted);
    assert_true(floor_seen(false, 3, &held) <= 0.0201); // by the light, and by the surface
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_seed_is_a_picture),
        cmocka_unit_test(what_is_cancelled_is_sound),
        cmocka_unit_test(goals_are_kept),
        cmocka_unit_test(noise_is_the_error),
        cmocka_unit_test(parts_are_the_whole),
        cmocka_unit_test(lights_are_their_part),
        cmocka_unit_test(direct_and_indirect_are_the_picture),
        cmocka_unit_test(direct_light_is_of_one_surface),
        cmocka_unit_test(a_plane_is_where_it_is),
        cmocka_unit_test(half_a_picture_is_half_there),
        cmocka_unit_test(panes_are_mixed),
        cmocka_unit_test(shadows_are_left_out_when_asked),
        cmocka_unit_test(exposed_light_is_clamped),
    };
    return cmocka_run_group_tests_name("picture", tests, NULL, NULL);
}
