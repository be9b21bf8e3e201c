// Navigation: what stays where it is while the camera moves, seen through the camera that it
// gives; and that only time matters, not the number of steps.
#include "viewer/navigation.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { wide = 1280, high = 720 };

// ---- An independent look at a camera ---------------------------------------

typedef struct sight {
    double eye[3], right[3], up[3], forward[3];
    double half_y; // tangent, or m if orthographic
    bool orthographic;
} sight;

static void cross(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void unit(double a[3])
{
    double length = sqrt(dot(a, a));
    for (int i = 0; i < 3; i++)
        a[i] /= length;
}

static double distance(const double a[3], const double b[3])
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

static sight look_through(const ag_camera_desc *c)
{
    sight s = { .orthographic = c->height_m > 0 };
    double up[3];
    for (int i = 0; i < 3; i++) {
        s.eye[i] = (double)c->position[i];
        s.forward[i] = (double)c->target[i] - (double)c->position[i];
        up[i] = (double)c->up[i];
    }
    unit(s.forward);
    cross(s.forward, up, s.right);
    unit(s.right);
    cross(s.right, s.forward, s.up);
    s.half_y = s.orthographic ? 0.5 * (double)c->height_m : tan(0.5 * (double)c->fov_y_rad);
    return s;
}

static sight sight_of(const navigation *n)
{
    ag_camera_desc camera = navigation_camera(n);
    return look_through(&camera);
}

// px from the top left at which a point is seen
static void project(const sight *s, const double p[3], double out[2])
{
    const double d[3] = { p[0] - s->eye[0], p[1] - s->eye[1], p[2] - s->eye[2] };
    double depth = s->orthographic ? 1 : dot(d, s->forward);
    out[0] = 0.5 * wide + 0.5 * high * dot(d, s->right) / (depth * s->half_y);
    out[1] = 0.5 * high - 0.5 * high * dot(d, s->up) / (depth * s->half_y);
}

// The point seen at a pixel, as deep as the target.
static void unproject(const navigation *n, const double pixel[2], double out[3])
{
    sight s = sight_of(n);
    double x = (pixel[0] - 0.5 * wide) / (0.5 * high), y = (0.5 * high - pixel[1]) / (0.5 * high);
    const double d[3] = { n->now.target[0] - s.eye[0], n->now.target[1] - s.eye[1],
                          n->now.target[2] - s.eye[2] };
    double depth = dot(d, s.forward), spread = s.half_y * (s.orthographic ? 1 : depth);
    for (int i = 0; i < 3; i++)
        out[i] = s.eye[i] + depth * s.forward[i] + spread * (x * s.right[i] + y * s.up[i]);
}

static navigation start(void)
{
    navigation n;
    navigation_init(&n);
    navigation_resize(&n, wide, high);
    const ag_scene_summary scene = { .bounds_min = { -2, -1, -3 }, .bounds_max = { 4, 3, 1 } };
    navigation_measure(&n, &scene);
    const ag_camera_desc camera = {
        .position = { 5, 4, 7 }, .target = { 1, 1, -1 }, .up = { 0, 1, 0 }, .fov_y_rad = 0.8f
    };
    navigation_take(&n, &camera);
    return n;
}

static void settle(navigation *n)
{
    for (int i = 0; i < 1000 && navigation_moves(n); i++)
        navigation_step(n, 0.01);
    assert_false(navigation_moves(n));
}

static void assert_same_camera(const ag_camera_desc *a, const ag_camera_desc *b, double within)
{
    sight s = look_through(a), t = look_through(b);
    assert_true(distance(s.eye, t.eye) <= within);
    assert_true(distance(s.forward, t.forward) <= within);
    assert_true(distance(s.up, t.up) <= within);
    assert_true(fabs(s.half_y - t.half_y) <= within);
    assert_true(s.orthographic == t.orthographic);
}

// ---- By the pointer --------------------------------------------------------

static void test_panning_keeps_the_point_under_the_pointer(void **state)
{
    (void)state;
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        navigation n = start();
        navigation_set_orthographic(&n, orthographic);
        const double from[2] = { 200, 600 }, to[2] = { 1100, 50 };
        double point[3], seen[2];
        unproject(&n, from, point);
        navigation_pan(&n, from, to);
        sight s = sight_of(&n);
        project(&s, point, seen);
        assert_true(hypot(seen[0] - to[0], seen[1] - to[1]) < 1e-2);
    }
}

static void test_zooming_keeps_the_point_under_the_pointer(void **state)
{
    (void)state;
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        navigation n = start();
        navigation_set_orthographic(&n, orthographic);
        const double at[2] = { 1000, 100 };
        double point[3], seen[2], before = n.now.distance;
        unproject(&n, at, point);
        navigation_zoom(&n, 3, at);
        for (int step = 0; step < 30; step++) { // all the way, not only at its end
            navigation_step(&n, 0.004);
            if (step == 10)
                navigation_zoom(&n, 2, at); // and when the wheel turns on
            sight s = sight_of(&n);
            project(&s, point, seen);
            assert_true(hypot(seen[0] - at[0], seen[1] - at[1]) < 1e-2);
        }
        settle(&n);
        assert_true(fabs(n.now.distance - before * pow(1.1, -5)) < 1e-9);
    }
}

static void test_turning_keeps_the_distance(void **state)
{
    (void)state;
    navigation n = start();
    const double target[3] = { n.now.target[0], n.now.target[1], n.now.target[2] };
    double far = distance(sight_of(&n).eye, target);
    const double from[2] = { 300, 300 };
    for (int i = 0; i < 40; i++) {
        const double to[2] = { 300 + 37 * i, 300 - 11 * i };
        navigation_turn(&n, from, to);
        sight s = sight_of(&n);
        assert_true(fabs(distance(s.eye, target) - far) < 1e-5);
        double seen[2];
        project(&s, target, seen);
        assert_true(hypot(seen[0] - 0.5 * wide, seen[1] - 0.5 * high) < 1e-2);
    }
}

// What is nearer than the target follows the pointer.
static void test_turning_follows_the_pointer(void **state)
{
    (void)state;
    navigation n = start();
    sight s = sight_of(&n);
    double near[3], seen[2];
    for (int i = 0; i < 3; i++)
        near[i] = n.now.target[i] - s.forward[i];
    const double from[2] = { 0, 0 }, to[2] = { 20, 10 };
    navigation_turn(&n, from, to);
    s = sight_of(&n);
    project(&s, near, seen);
    assert_true(seen[0] > 0.5 * wide + 2 && seen[1] > 0.5 * high + 1);
}

static void test_the_poles_stop_it(void **state)
{
    (void)state;
    const double from[2] = { 0, 0 };
    for (int way = -1; way <= 1; way += 2) {
        navigation n = start();
        const double to[2] = { 0, way * 5000 };
        navigation_turn(&n, from, to);
        sight s = sight_of(&n);
        assert_true(fabs(s.forward[1] + way) < 1e-6);
        assert_true(isfinite(s.right[0] + s.up[0]));
        const double back[2] = { 100, -way * 100 }; // and it comes away from them again
        navigation_turn(&n, from, back);
        s = sight_of(&n);
        assert_true(fabs(s.forward[1]) < 0.99 && s.up[1] > 0);
    }
}

static void test_looking_keeps_the_eye(void **state)
{
    (void)state;
    navigation n = start();
    sight before = sight_of(&n);
    const double from[2] = { 100, 100 }, to[2] = { 180, 60 };
    navigation_look(&n, from, to);
    sight after = sight_of(&n);
    assert_true(distance(before.eye, after.eye) < 1e-5);
    assert_true(dot(after.forward, before.right) > 0.1); // to the right
    assert_true(dot(after.forward, before.up) > 0.1);    // and up
}

static void test_distances_have_limits(void **state)
{
    (void)state;
    navigation n = start();
    const double at[2] = { 3, 3 };
    for (int way = -1; way <= 1; way += 2) {
        for (int i = 0; i < 50; i++)
            navigation_zoom(&n, way * 100, at);
        settle(&n);
        sight s = sight_of(&n);
        assert_true(isfinite(s.eye[0]) && n.now.distance > 0 && isfinite(s.right[0]));
    }
}

// ---- Cameras ---------------------------------------------------------------

static const ag_camera_desc cameras[] = {
    { .position = { 5, 4, 7 }, .target = { 1, 1, -1 }, .up = { 0, 1, 0 }, .fov_y_rad = 0.6f },
    { .position = { 5, 4, 7 }, .target = { 1, 1, -1 }, .up = { .5f, .7f, .2f }, .fov_y_rad = 1 },
    { .position = { 0, 9, 0 }, .target = { 0, 0, 0 }, .up = { .6f, 0, -.8f }, .fov_y_rad = 1 },
    { .position = { 0, -9, 0 }, .target = { 0, 0, 0 }, .up = { .6f, 0, .8f }, .fov_y_rad = 1 },
    { .position = { 1, 0, 90 }, .target = { 1, 0, 91 }, .up = { 0, -1, 0 }, .fov_y_rad = 1 },
    { .position = { 5, 4, 7 }, .target = { 4, 4, 7 }, .up = { 0, 1, 0 }, .height_m = 3 },
};
enum { camera_count = sizeof cameras / sizeof *cameras };

static void test_a_camera_comes_back_as_it_was(void **state)
{
    (void)state;
    for (int i = 0; i < camera_count; i++) {
        navigation n = start();
        navigation_take(&n, &cameras[i]);
        ag_camera_desc back = navigation_camera(&n);
        assert_memory_equal(&back, &cameras[i], sizeof back);
    }
}

// A motion of nothing makes the camera anew from the state.
static void test_moving_on_from_a_camera_does_not_jump(void **state)
{
    (void)state;
    const double at[2] = { 7, 7 };
    for (int i = 0; i < camera_count; i++) {
        navigation n = start();
        navigation_take(&n, &cameras[i]);
        navigation_pan(&n, at, at);
        ag_camera_desc back = navigation_camera(&n);
        if (cameras[i].height_m > 0) // how far away it stands makes no difference
            memcpy(back.position, cameras[i].position, sizeof back.position);
        if (cameras[i].height_m > 0)
            for (int k = 0; k < 3; k++)
                back.target[k] = back.position[k] + (float)sight_of(&n).forward[k];
        assert_same_camera(&back, &cameras[i], 2e-5);
        navigation_turn(&n, at, at);
        navigation_look(&n, at, at);
        ag_camera_desc again = navigation_camera(&n);
        back = cameras[i];
        if (!(cameras[i].height_m > 0))
            assert_same_camera(&again, &back, 2e-5);
    }
}

// A camera that looks straight down has a heading, no roll: the horizon stays level.
static void test_from_a_pole_the_horizon_is_level(void **state)
{
    (void)state;
    for (int i = 2; i <= 3; i++) {
        navigation n = start();
        navigation_take(&n, &cameras[i]);
        const double from[2] = { 0, 0 }, to[2] = { 50, i == 2 ? -200 : 200 };
        navigation_turn(&n, from, to);
        sight s = sight_of(&n);
        assert_true(fabs(s.forward[1]) < 0.9 && s.up[1] > 0);
        assert_true(fabs(s.right[1]) < 1e-6);
    }
}

static void test_it_turns_about_the_scene(void **state)
{
    (void)state;
    navigation n = start();
    const ag_camera_desc camera = { .position = { 1, 1, 9 }, .target = { 1, 1, 8.9f } };
    navigation_take(&n, &camera);
    const double center[3] = { 1, 1, -1 };
    assert_true(distance(n.now.target, center) < 1e-5);
}

static void test_a_transition_arrives_exactly(void **state)
{
    (void)state;
    for (int i = 0; i < camera_count; i++) {
        navigation n = start();
        navigation_go(&n, &cameras[i]);
        assert_true(navigation_moves(&n));
        settle(&n);
        ag_camera_desc back = navigation_camera(&n);
        assert_memory_equal(&back, &cameras[i], sizeof back);
    }
}

static void test_sides(void **state)
{
    (void)state;
    static const double seen_from[][3] = { { 0, 0, 1 },  { 0, 0, -1 }, { 1, 0, 0 },
                                           { -1, 0, 0 }, { 0, 1, 0 },  { 0, -1, 0 } };
    static const double up[][3] = { { 0, 1, 0 }, { 0, 1, 0 },  { 0, 1, 0 },
                                    { 0, 1, 0 }, { 0, 0, -1 }, { 0, 0, 1 } };
    for (int side = NAVIGATION_FRONT; side <= NAVIGATION_BOTTOM; side++) {
        navigation n = start();
        double far = n.now.distance;
        navigation_take(&n, &cameras[1]); // a rolled one
        navigation_go_side(&n, (navigation_side)side);
        settle(&n);
        sight s = sight_of(&n);
        for (int i = 0; i < 3; i++)
            assert_true(fabs(s.forward[i] + seen_from[side][i]) < 1e-6);
        assert_true(distance(s.up, up[side]) < 1e-6);
        assert_true(fabs(n.now.distance - far) < 1e-5);
    }
}

// Half a turn away, it goes the short way round.
static void test_a_transition_takes_the_short_way(void **state)
{
    (void)state;
    navigation n = start();
    navigation_go_side(&n, NAVIGATION_BACK);
    settle(&n);
    n.now.theta = -3.0; // just beyond the back
    navigation_go_side(&n, NAVIGATION_BACK);
    navigation_step(&n, 0.1);
    assert_true(cos(n.now.theta) < cos(3.0));
}

static void test_a_ball_fills_the_view(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = { { 1280, 720 }, { 300, 900 } };
    for (int i = 0; i < 2; i++) {
        navigation n = start();
        navigation_resize(&n, sizes[i][0], sizes[i][1]);
        const float center[3] = { 1, 2, 0.5f };
        navigation_go_ball(&n, center, 0.25f);
        settle(&n);
        sight s = sight_of(&n);
        const double middle[3] = { 1, 2, 0.5 };
        // The angle under which its edge is seen, against the narrower half angle.
        double edge = asin(0.25 / distance(s.eye, middle));
        double aspect = (double)sizes[i][0] / (double)sizes[i][1];
        double room = atan(s.half_y * fmin(1, aspect));
        assert_true(edge < room && edge > 0.9 * room);
    }
}

static void test_all_is_framed(void **state)
{
    (void)state;
    ag_scene *scene;
    ag_mesh mesh;
    ag_instance instance;
    assert_int_equal(ag_scene_create(NULL, &scene), AG_OK);
    const float corners[] = { -2, -1, -3, 4, 3, 1, 4, -1, 1 };
    const ag_mesh_desc desc = { .positions = corners, .vertex_count = 3 };
    assert_int_equal(ag_scene_add_mesh(scene, &desc, &mesh), AG_OK);
    assert_int_equal(ag_scene_add_instance(scene, mesh, (ag_material) { 0 }, NULL, &instance),
                     AG_OK);
    navigation n = start();
    const double at[2] = { 0, 0 }, far[2] = { 5000, 3000 };
    navigation_pan(&n, at, far);
    sight before = sight_of(&n);
    navigation_go_all(&n, scene);
    settle(&n);
    sight after = sight_of(&n);
    assert_true(distance(before.forward, after.forward) < 1e-5);
    double reach = 0;
    for (int i = 0; i < 3; i++) {
        const double p[3] = { (double)corners[3 * i], (double)corners[3 * i + 1],
                              (double)corners[3 * i + 2] };
        double seen[2];
        project(&after, p, seen);
        reach = fmax(reach, fmax(fabs(2 * seen[0] / wide - 1), fabs(2 * seen[1] / high - 1)));
    }
    assert_true(reach < 1 && reach > 0.9);
    ag_scene_destroy(scene);
}

static void test_orthographic_shows_the_target_as_large(void **state)
{
    (void)state;
    navigation n = start();
    const double at[2] = { 900, 200 };
    double point[3], seen[2];
    unproject(&n, at, point);
    navigation_set_orthographic(&n, true);
    sight s = sight_of(&n);
    assert_true(s.orthographic);
    project(&s, point, seen);
    assert_true(hypot(seen[0] - at[0], seen[1] - at[1]) < 1e-2);
    // The whole scene is before the eye, however near one has come.
    navigation_zoom(&n, 40, at);
    settle(&n);
    s = sight_of(&n);
    const double center[3] = { 1, 1, -1 };
    double depth = 0;
    for (int i = 0; i < 3; i++)
        depth += (center[i] - s.eye[i]) * s.forward[i];
    assert_true(depth > n.radius);
}

// ---- In time ---------------------------------------------------------------

static void step_by(navigation *n, double seconds, int steps)
{
    for (int i = 0; i < steps; i++)
        navigation_step(n, seconds / steps);
}

static void test_only_time_matters(void **state)
{
    (void)state;
    static const int counts[] = { 1, 2, 7, 60 };
    for (int what = 0; what < 3; what++) {
        navigation first = start();
        for (int c = 0; c < 4; c++) {
            navigation n = start();
            if (what == 0)
                navigation_fly(&n, 0.5, 1, 1);
            if (what == 1)
                navigation_go(&n, &cameras[1]);
            if (what == 2)
                navigation_zoom(&n, 4, (const double[]) { 100, 100 });
            step_by(&n, 0.07, counts[c]);
            if (what == 0)
                navigation_fly(&n, 0, 0, 0); // and while it glides to rest
            step_by(&n, 0.05, counts[c]);
            if (c == 0)
                first = n;
            ag_camera_desc a = navigation_camera(&first), b = navigation_camera(&n);
            assert_same_camera(&a, &b, 1e-5);
        }
    }
}

// In the long run: half a radius a second, less what the start took.
static void test_flying_has_its_speed(void **state)
{
    (void)state;
    navigation n = start();
    sight before = sight_of(&n);
    navigation_fly(&n, 0, 0, 1);
    step_by(&n, 1, 10);
    sight middle = sight_of(&n);
    step_by(&n, 1, 10);
    sight after = sight_of(&n);
    double speed = distance(after.eye, middle.eye);
    assert_true(fabs(speed - 0.5 * n.radius) < 1e-4);
    assert_true(distance(middle.eye, before.eye) < speed);
    assert_true(distance(middle.eye, before.eye) > 0.85 * speed);
    double ahead = 0;
    for (int i = 0; i < 3; i++)
        ahead += (after.eye[i] - before.eye[i]) * before.forward[i];
    assert_true(fabs(ahead - distance(after.eye, before.eye)) < 1e-4);
    assert_true(distance(after.forward, before.forward) < 1e-5);

    navigation_hurry(&n, 2);
    step_by(&n, 1, 1);
    middle = sight_of(&n);
    step_by(&n, 1, 1);
    assert_true(fabs(distance(sight_of(&n).eye, middle.eye) - 1.5625 * speed) < 1e-4);
    navigation_fly(&n, 0, 0, 0);
    settle(&n);
}

static void test_up_is_up(void **state)
{
    (void)state;
    navigation n = start();
    sight before = sight_of(&n);
    navigation_fly(&n, 0, 1, 0);
    step_by(&n, 1, 3);
    sight after = sight_of(&n);
    assert_true(after.eye[1] > before.eye[1] + 1);
    assert_true(hypot(after.eye[0] - before.eye[0], after.eye[2] - before.eye[2]) < 1e-5);
}

static void test_the_hand_interrupts_a_transition(void **state)
{
    (void)state;
    const double from[2] = { 5, 5 }, to[2] = { 6, 5 };
    navigation n = start();
    navigation_go_side(&n, NAVIGATION_TOP);
    navigation_step(&n, 0.1);
    pose half = n.now;
    navigation_pan(&n, from, to);
    assert_false(navigation_moves(&n));
    assert_true(n.now.phi == half.phi);
}

static void test_at_rest_nothing_moves(void **state)
{
    (void)state;
    navigation n = start();
    const double at[2] = { 9, 9 };
    navigation_pan(&n, at, at);
    ag_camera_desc before = navigation_camera(&n);
    assert_false(navigation_moves(&n));
    navigation_step(&n, 1);
    navigation_step(&n, 0);
    navigation_step(&n, -1);
    navigation_step(&n, (double)NAN);
    ag_camera_desc after = navigation_camera(&n);
    assert_memory_equal(&before, &after, sizeof before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_panning_keeps_the_point_under_the_pointer),
        cmocka_unit_test(test_zooming_keeps_the_point_under_the_pointer),
        cmocka_unit_test(test_turning_keeps_the_distance),
        cmocka_unit_test(test_turning_follows_the_pointer),
        cmocka_unit_test(test_the_poles_stop_it),
        cmocka_unit_test(test_looking_keeps_the_eye),
        cmocka_unit_test(test_distances_have_limits),
        cmocka_unit_test(test_a_camera_comes_back_as_it_was),
        cmocka_unit_test(test_moving_on_from_a_camera_does_not_jump),
        cmocka_unit_test(test_from_a_pole_the_horizon_is_level),
        cmocka_unit_test(test_it_turns_about_the_scene),
        cmocka_unit_test(test_a_transition_arrives_exactly),
        cmocka_unit_test(test_sides),
        cmocka_unit_test(test_a_transition_takes_the_short_way),
        cmocka_unit_test(test_a_ball_fills_the_view),
        cmocka_unit_test(test_all_is_framed),
        cmocka_unit_test(test_orthographic_shows_the_target_as_large),
        cmocka_unit_test(test_only_time_matters),
        cmocka_unit_test(test_flying_has_its_speed),
        cmocka_unit_test(test_up_is_up),
        cmocka_unit_test(test_the_hand_interrupts_a_transition),
        cmocka_unit_test(test_at_rest_nothing_moves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
