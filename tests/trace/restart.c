// A reference that begins again, and how soon it stops.
#define _GNU_SOURCE
#include "stage.h"

#include <sched.h>

enum { SIZE = 32, SAMPLES = 3 };

static const ag_camera_desc front = { .position = { 2, 3, 4 }, .fov_y_rad = 0.7f };
static const ag_camera_desc aside = { .position = { -3, 1.5f, 2 }, .height_m = 3 };

static void quiet(void *user, ag_log_level level, const char *sentence)
{
    (void)user, (void)level, (void)sentence;
}

// ---- What there is to change -----------------------------------------------------------

typedef struct room {
    ag_scene *scene;
    ag_mesh quad;
    ag_material floor, glass;
    ag_light lamp;
} room;

// A floor, two panes of one mesh, a ball that shines; a lamp and the studio.
static room room_make(void)
{
    room r;
    OK(ag_scene_create(&(ag_log) { .write = quiet }, &r.scene));
    ag_material_desc floor = stage_matte(0.6f), glass = stage_matte(0.3f), ball = stage_matte(0.2f);
    floor.specular = 1;
    floor.roughness = 0.4f;
    stage_glow(&ball, 2);
    OK(ag_scene_add_material(r.scene, &floor, &r.floor));
    OK(ag_scene_add_material(r.scene, &glass, &r.glass));
    ag_instance instance;
    OK(ag_scene_add_instance(r.scene, stage_floor(r.scene, 0, 3), r.floor, NULL, &instance));
    r.quad = stage_quad(r.scene, (float[3]) { -1, 0, 0 }, (float[3]) { 1, 0, 0 },
                        (float[3]) { 0, 1.5f, 0 });
    const float behind[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.5f, 0, -1, 1 };
    OK(ag_scene_add_instance(r.scene, r.quad, r.glass, NULL, &instance));
    OK(ag_scene_add_instance(r.scene, r.quad, r.floor, behind, &instance));
    const float moved[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.7f, 0.4f, 0.7f, 1 };
    stage_show(r.scene, stage_ball(r.scene, 8, 0.4f, false, true), &ball, moved);
    r.lamp = stage_light(r.scene, &(ag_light_desc) { .position = { 1, 2, 1 }, .intensity = 2 });
    return r;
}

static void nothing(room *r)
{
    (void)r;
}

static void move_the_lamp(room *r)
{
    const ag_light_desc lamp = { .kind = AG_LIGHT_SPHERE,
                                 .position = { -1, 1, 1.5f },
                                 .radius_m = 0.2f,
                                 .color = { 1, 0.5f, 0.2f },
                                 .intensity = 3 };
    OK(ag_scene_set_light(r->scene, r->lamp, &lamp));
}

static void set_glass(room *r, ag_alpha_mode mode, float alpha, bool double_sided)
{
    ag_material_desc m;
    assert_true(ag_scene_material(r->scene, r->glass.id - 1, &m));
    m.alpha_mode = mode;
    m.base_color[3] = alpha;
    m.double_sided = double_sided;
    OK(ag_scene_set_material(r->scene, r->glass, &m));
}

static void polish_the_floor(room *r)
{
    ag_material_desc m;
    assert_true(ag_scene_material(r->scene, r->floor.id - 1, &m));
    m.roughness = 0.1f;
    m.metallic = 1;
    stage_glow(&m, 0.3f);
    OK(ag_scene_set_material(r->scene, r->floor, &m));
}

static void open_the_glass(room *r)
{
    set_glass(r, AG_ALPHA_BLEND, 0.3f, false);
}

static void close_the_glass(room *r)
{
    set_glass(r, AG_ALPHA_OPAQUE, 1, true);
}

static void turn_the_studio(room *r)
{
    const ag_environment_desc desc = { .rotation_rad = 2, .intensity = 0.5f };
    OK(ag_scene_set_environment(r->scene, &desc));
}

static void surround_by_an_image(room *r)
{
    stage_surround(r->scene, 0.5f);
}

static void surround_by_another(room *r)
{
    stage_surround(r->scene, 1.5f);
}

static void surround_by_nothing(room *r)
{
    const ag_environment_desc none = { .kind = AG_ENVIRONMENT_NONE };
    OK(ag_scene_set_environment(r->scene, &none));
}

static void add_a_pane(room *r)
{
    const float turned[16] = { 0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, -1, 0, 0, 1 };
    ag_instance instance;
    OK(ag_scene_add_instance(r->scene, r->quad, r->floor, turned, &instance));
}

// ---- Beginning again ---------------------------------------------------------------------

static bool count(void *user, const char *stage, double fraction)
{
    assert_string_equal(stage, "prepare");
    assert_true(fraction >= 0 && fraction <= 1);
    ++*(int *)user;
    return true;
}

static ag_image *traced(ag_reference *reference)
{
    ag_image *image;
    OK(ag_reference_trace(reference, &(ag_reference_goal) { .samples = SAMPLES }));
    OK(ag_reference_picture(reference, &image));
    return image;
}

static bool are_same(const ag_image *a, const ag_image *b)
{
    size_t size = sizeof(float[4]) * ag_image_width(a) * ag_image_height(a);
    return ag_image_width(a) == ag_image_width(b) && ag_image_height(a) == ag_image_height(b) &&
           memcmp(ag_image_pixels(a), ag_image_pixels(b), size) == 0;
}

// After every change the picture is, byte for byte, that of a reference made anew; trees are built
// again only where that cannot be without.
static void what_begins_again_is_as_new(void **state)
{
    (void)state;
    const struct {
        void (*change)(room *);
        bool builds;
    } steps[] = {
        { nothing, false },
        { move_the_lamp, false },
        { polish_the_floor, false },
        { open_the_glass, true }, // where rays had nothing to look at
        { close_the_glass, false },
        { open_the_glass, false },
        { close_the_glass, false },
        { turn_the_studio, false },
        { surround_by_an_image, false },
        { surround_by_another, false },
        { surround_by_nothing, false },
        { add_a_pane, true },
    };
    room r = room_make();
    const ag_render_options first = stage_linear(SIZE, SIZE);
    ag_reference *reference;
    OK(ag_reference_create(r.scene, &front, &first, NULL, &reference));
    ag_image *last = traced(reference);
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
        int built = 0;
        ag_render_options picture = stage_linear(SIZE + (uint32_t)i, SIZE);
        picture.background = AG_BACKGROUND_ENVIRONMENT;
        const ag_camera_desc *camera = i % 2 ? &front : &aside;
        ag_reference_options options = { .seed = (uint32_t)i, .progress = { count, &built } };
        steps[i].change(&r);
        OK(ag_reference_restart(reference, camera, &picture, &options));
        if ((built > 0) != steps[i].builds)
            print_error("built %d times after change %zu\n", built, i);
        assert_int_equal(built > 0, steps[i].builds);
        assert_int_equal(ag_reference_describe(reference).samples, 0);
        assert_true(ag_reference_describe(reference).rays == 0);
        ag_image *image = traced(reference);
        ag_image *fresh = stage_trace(r.scene, camera, &picture, &options, SAMPLES);
        assert_true(built > 0);
        if (!are_same(image, fresh))
            print_error("after change %zu\n", i);
        assert_true(are_same(image, fresh));
        assert_false(are_same(image, last));
        ag_image_destroy(last);
        ag_image_destroy(fresh);
        last = image;
    }
    ag_image_destroy(last);
    ag_reference_destroy(reference);
    ag_scene_destroy(r.scene);
}

static bool refuse(void *user, const char *stage, double fraction)
{
    (void)user, (void)stage, (void)fraction;
    return false;
}

// A restart that fails leaves what there was.
static void a_failed_restart_changes_nothing(void **state)
{
    (void)state;
    room r = room_make();
    const ag_render_options picture = stage_linear(SIZE, SIZE);
    const ag_render_options wrong = { .width = 1 };
    const ag_reference_options stopped = { .progress = { refuse, NULL } };
    ag_reference *reference, *none = (ag_reference *)&r;
    assert_int_equal(ag_reference_create(r.scene, &front, &picture, &stopped, &none),
                     AG_ERROR_CANCELLED);
    assert_null(none);
    OK(ag_reference_create(r.scene, &front, &picture, NULL, &reference));
    ag_image *before = traced(reference), *after;
    assert_int_equal(ag_reference_restart(reference, &aside, &wrong, NULL), AG_ERROR_ARGUMENT);
    OK(ag_reference_picture(reference, &after));
    assert_true(are_same(before, after));
    ag_image_destroy(after);
    add_a_pane(&r);
    assert_int_equal(ag_reference_restart(reference, &front, &picture, &stopped),
                     AG_ERROR_CANCELLED);
    assert_int_equal(ag_reference_describe(reference).samples, SAMPLES);
    OK(ag_reference_restart(reference, &front, &picture, NULL));
    after = traced(reference);
    assert_false(are_same(before, after));
    ag_image_destroy(before);
    ag_image_destroy(after);
    ag_reference_destroy(reference);
    ag_scene_destroy(r.scene);
}

// ---- Stopping -------------------------------------------------------------------------------

typedef struct asked {
    int times, most;
} asked;

static bool until(void *user, const char *stage, double fraction)
{
    (void)stage, (void)fraction;
    asked *a = user;
    return ++a->times < a->most;
}

// On one thread: asked before every 1024 paths, and not once after it said stop.
static void it_is_asked_often(void **state)
{
    (void)state;
    enum { WIDE = 200, HIGH = 50, PATHS = WIDE * HIGH * 64 };
    ag_scene *scene;
    OK(ag_scene_create(&(ag_log) { .write = quiet }, &scene));
    cpu_set_t all, one;
    CPU_ZERO(&one);
    assert_int_equal(sched_getaffinity(0, sizeof all, &all), 0);
    for (size_t i = 0; i < CPU_SETSIZE && !CPU_COUNT(&one); i++)
        if (CPU_ISSET(i, &all))
            CPU_SET(i, &one);
    const ag_render_options picture = stage_linear(WIDE, HIGH);
    ag_reference *reference;
    OK(ag_reference_create(scene, &front, &picture, NULL, &reference));
    assert_int_equal(sched_setaffinity(0, sizeof one, &one), 0);
    asked a = { .most = 100 };
    ag_reference_goal goal = { .samples = 64, .progress = { until, &a } };
    assert_int_equal(ag_reference_trace(reference, &goal), AG_ERROR_CANCELLED);
    assert_int_equal(a.times, 100);
    // Nothing is there: each path is one ray.
    uint64_t rays = ag_reference_describe(reference).rays;
    assert_true(rays > 0 && rays <= 99 * 1024);
    a = (asked) { .most = INT32_MAX };
    OK(ag_reference_trace(reference, &goal));
    assert_true(a.times >= (int)((PATHS - rays) / 1024));
    assert_true(ag_reference_describe(reference).rays == PATHS);
    assert_int_equal(sched_setaffinity(0, sizeof all, &all), 0);
    ag_reference_destroy(reference);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_begins_again_is_as_new),
        cmocka_unit_test(a_failed_restart_changes_nothing),
        cmocka_unit_test(it_is_asked_often),
    };
    return cmocka_run_group_tests_name("restart", tests, NULL, NULL);
}
