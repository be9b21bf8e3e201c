// Cameras: the orbit's formula, and that what is framed fits, and fits tightly.
#include "helpers.h"

#include "scene/primitive.h"

static const double margin = 1.05;

static void add_box(ag_scene *scene, const float half[3], const float world[16])
{
    ag_mesh mesh;
    ag_instance instance;
    assert_int_equal(primitive_box(scene, half, 0.0f, 0, &mesh), AG_OK);
    assert_int_equal(ag_scene_add_instance(scene, mesh, (ag_material) { 0 }, world, &instance),
                     AG_OK);
}

// Where a point falls in a picture: -1 .. 1 inside, and its depth.
static void project(const ag_camera_desc *camera, double aspect, const double p[3], double out[3])
{
    double z[3], x[3], y[3], d[3], length = 0, t = tan(0.5 * (double)camera->fov_y_rad);
    for (int i = 0; i < 3; i++) {
        z[i] = (double)camera->position[i] - (double)camera->target[i];
        d[i] = p[i] - (double)camera->position[i];
        length += z[i] * z[i];
    }
    for (int i = 0; i < 3; i++)
        z[i] /= sqrt(length);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        x[i] = (double)camera->up[j] * z[k] - (double)camera->up[k] * z[j];
    }
    length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    for (int i = 0; i < 3; i++)
        x[i] /= length;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        y[i] = z[j] * x[k] - z[k] * x[j];
    }
    out[2] = -(z[0] * d[0] + z[1] * d[1] + z[2] * d[2]);
    out[0] = (x[0] * d[0] + x[1] * d[1] + x[2] * d[2]) / (out[2] * t * aspect);
    out[1] = (y[0] * d[0] + y[1] * d[1] + y[2] * d[2]) / (out[2] * t);
}

// The largest |coordinate| of any vertex of the scene in the picture.
static double reach(const ag_scene *scene, const ag_camera_desc *camera, double aspect)
{
    double largest = 0;
    for (size_t i = 0; i < scene->instances_count; i++) {
        const scene_instance *instance = &scene->instances[i];
        const scene_mesh *mesh = &scene->meshes[instance->mesh];
        for (uint32_t v = 0; v < mesh->vertex_count; v++) {
            double p[3], seen[3];
            for (int r = 0; r < 3; r++) {
                p[r] = (double)instance->world[12 + r];
                for (int c = 0; c < 3; c++)
                    p[r] +=
                        (double)instance->world[4 * c + r] * (double)mesh->vertices[v].position[c];
            }
            project(camera, aspect, p, seen);
            assert_true(seen[2] > 0);
            largest = fmax(largest, fmax(fabs(seen[0]), fabs(seen[1])));
        }
    }
    return largest;
}

static void test_orbit_formula(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_orbit orbit = { 0.7f, 1.1f, 4.0f, { 1, 2, 3 }, 0.5f };
    ag_camera_desc camera = ag_scene_frame(scene, &orbit, 1.5f);
    assert_near(camera.position[0], 1 + 4 * sin(1.1) * sin(0.7), 1e-5);
    assert_near(camera.position[1], 2 + 4 * cos(1.1), 1e-5);
    assert_near(camera.position[2], 3 + 4 * sin(1.1) * cos(0.7), 1e-5);
    assert_true(camera.target[0] == 1 && camera.target[1] == 2 && camera.target[2] == 3);
    assert_true(camera.fov_y_rad == 0.5f && camera.height_m == 0.0f);
    const float y[3] = { 0, 1, 0 };
    assert_true(dot3(camera.up, y) > 0); // upright
    orbit.radius_m = 0;                  // on the target, looking the same way
    camera = ag_scene_frame(scene, &orbit, 1.5f);
    assert_true(camera.position[0] == 1 && camera.position[1] == 2 && camera.position[2] == 3);
    assert_near(camera.position[1] - camera.target[1], cos(1.1), 1e-5);
    orbit.fov_y_rad = 0;
    assert_near(ag_scene_frame(scene, &orbit, 1.5f).fov_y_rad, 0.78539816, 1e-6);
    ag_scene_destroy(scene);
}

static void test_everything_fits_tightly(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const float flat[3] = { 3, 0.2f, 1 }, tall[3] = { 0.3f, 5, 0.4f };
    const float turned[16] = { 0.8f, 0, -0.6f, 0, 0, 1, 0, 0, 0.6f, 0, 0.8f, 0, 4, 1, -2, 1 };
    add_box(scene, flat, NULL);
    add_box(scene, tall, turned);
    const float aspects[] = { 0.25f, 1.0f, 4.0f };
    const float phis[] = { NAN, 0.0f, 0.3f, 1.57f, 2.8f, 3.14159265f };
    for (size_t a = 0; a < 3; a++) {
        for (size_t p = 0; p < sizeof phis / sizeof *phis; p++) {
            ag_orbit orbit = ag_orbit_auto();
            orbit.phi_rad = phis[p];
            ag_camera_desc camera = ag_scene_frame(scene, &orbit, aspects[a]);
            assert_near(reach(scene, &camera, (double)aspects[a]), 1.0 / margin, 1e-4);
        }
    }
    ag_scene_destroy(scene);
}

// A sphere of radius 1 touches the edges of the view from 1 / sin(half the angle).
static void test_a_sphere_fits_tightly(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_mesh mesh;
    ag_instance instance;
    assert_int_equal(primitive_sphere(scene, 1.0f, 400, 200, &mesh), AG_OK);
    assert_int_equal(ag_scene_add_instance(scene, mesh, (ag_material) { 0 }, NULL, &instance),
                     AG_OK);
    const float fovs[] = { 0.2f, 0.8f, 2.0f };
    for (int i = 0; i < 3; i++) {
        ag_orbit orbit = ag_orbit_auto();
        orbit.fov_y_rad = fovs[i];
        ag_camera_desc camera = ag_scene_frame(scene, &orbit, 1.3f);
        double wanted = 1 / sin(atan(tan(0.5 * (double)fovs[i]) / margin));
        assert_near(sqrt(dot3(camera.position, camera.position)) / wanted, 1, 1e-3);
    }
    ag_scene_destroy(scene);
}

static void test_automatic_view(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const float half[3] = { 1, 2, 3 };
    const float moved[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 20, 30, 1 };
    add_box(scene, half, moved);
    ag_camera_desc camera = ag_scene_frame(scene, NULL, 1.0f);
    assert_true(camera.target[0] == 10 && camera.target[1] == 20 && camera.target[2] == 30);
    double d[3], r = 0;
    for (int i = 0; i < 3; i++) {
        d[i] = (double)camera.position[i] - (double)camera.target[i];
        r += d[i] * d[i];
    }
    assert_near(atan2(d[0], d[2]), 0.6, 1e-5);
    assert_near(acos(d[1] / sqrt(r)), 1.25, 1e-5);
    ag_scene_destroy(scene);
}

static void test_nothing_to_frame(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    for (int pass = 0; pass < 2; pass++) { // an empty scene, then one that is a point
        ag_camera_desc camera = ag_scene_frame(scene, NULL, NAN);
        float away = 0;
        for (int i = 0; i < 3; i++) {
            assert_true(isfinite(camera.position[i]) && isfinite(camera.target[i]));
            away += fabsf(camera.position[i] - camera.target[i]);
        }
        assert_true(away > 0.1f);
        const float half[3] = { 1, 1, 1 };
        const float zero[16] = { [13] = 7, [15] = 1 };
        add_box(scene, half, zero);
    }
    ag_scene_destroy(scene);
}

static void test_a_huge_scene_stays_finite(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const float half[3] = { 1e38f, 1e38f, 1e38f };
    const float grown[16] = { 1e30f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
    add_box(scene, half, grown);
    ag_scene_summary summary = ag_scene_summarize(scene);
    ag_camera_desc camera = ag_scene_frame(scene, NULL, 1.0f);
    for (int i = 0; i < 3; i++)
        assert_true(isfinite(summary.bounds_max[i]) && isfinite(camera.position[i]));
    ag_scene_destroy(scene);
}

static void test_added_cameras(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    char name[] = "side";
    ag_camera_desc desc = { .position = { 5, 0, 0 }, .name = name }, back;
    ag_camera camera;
    assert_int_equal(ag_scene_add_camera(scene, &desc, &camera), AG_OK);
    name[0] = 'x';
    assert_true(ag_scene_camera(scene, 0, &back));
    assert_string_equal(back.name, "side");
    assert_true(back.up[1] == 1.0f);
    assert_near(back.fov_y_rad, 0.78539816, 1e-6);
    assert_false(ag_scene_camera(scene, 1, &back));

    const ag_camera_desc bad[] = {
        { .position = { 0 } }, // nowhere to look
        { .position = { NAN, 0, 1 } },
        { .position = { 0, 0, 1 }, .fov_y_rad = 3.2f },
        { .position = { 0, 0, 1 }, .fov_y_rad = -1.0f },
        { .position = { 0, 0, 1 }, .near_m = 2, .far_m = 1 },
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(ag_scene_add_camera(scene, &bad[i], &camera), AG_ERROR_ARGUMENT);
        assert_int_equal(camera.id, 0);
    }
    assert_int_equal(scene->cameras_count, 1);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_orbit_formula),
        cmocka_unit_test(test_everything_fits_tightly),
        cmocka_unit_test(test_a_sphere_fits_tightly),
        cmocka_unit_test(test_automatic_view),
        cmocka_unit_test(test_nothing_to_frame),
        cmocka_unit_test(test_a_huge_scene_stays_finite),
        cmocka_unit_test(test_added_cameras),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
