// What is seen at a place of a picture.
#include "helpers.h"

enum { WIDTH = 200, HEIGHT = 100 };

static const ag_camera_desc ahead = { .position = { 0, 0, 5 }, .fov_y_rad = 0.9f };
static const ag_camera_desc flat = { .position = { 1, 2, 5 },
                                     .target = { 1, 2, 0 },
                                     .height_m = 4 };

// ---- Rays and places -------------------------------------------------------------------

static void test_rays_are_those_of_a_pinhole(void **state)
{
    (void)state;
    // The right edge of the picture is as far aside as its shape says.
    ag_ray middle = ag_camera_ray(&ahead, WIDTH, HEIGHT, WIDTH / 2, HEIGHT / 2);
    ag_ray right = ag_camera_ray(&ahead, WIDTH, HEIGHT, WIDTH, HEIGHT / 2);
    ag_ray top = ag_camera_ray(&ahead, WIDTH, HEIGHT, WIDTH / 2, 0);
    assert_near(middle.direction[2], -1, 1e-7);
    assert_near(right.direction[0] / -right.direction[2], 2 * tan(0.45), 1e-6);
    assert_near(top.direction[1] / -top.direction[2], tan(0.45), 1e-6);
    assert_near(dot3(top.direction, top.direction), 1, 1e-6);
    assert_near(top.origin[2], 5, 0);
    ag_ray corner = ag_camera_ray(&flat, WIDTH, HEIGHT, 0, HEIGHT);
    const float origin[3] = { 1 - 4, 2 - 2, 5 }, along[3] = { 0, 0, -1 };
    for (int i = 0; i < 3; i++) {
        assert_near(corner.origin[i], origin[i], 1e-6);
        assert_near(corner.direction[i], along[i], 1e-7);
    }
}

static void test_points_are_where_their_rays_are(void **state)
{
    (void)state;
    const ag_camera_desc aslant = { .position = { 3, -2, 7 },
                                    .target = { -1, 1, 0.5f },
                                    .up = { 0.2f, 1, 0.1f } };
    const ag_camera_desc *cameras[] = { &ahead, &flat, &aslant };
    uint32_t seed = 1;
    for (int i = 0; i < 300; i++) {
        const ag_camera_desc *camera = cameras[i % 3];
        float x = WIDTH * noise(&seed), y = HEIGHT * noise(&seed), far = 0.1f + 20 * noise(&seed);
        ag_ray ray = ag_camera_ray(camera, WIDTH, HEIGHT, x, y);
        float point[3], place[2];
        for (int c = 0; c < 3; c++)
            point[c] = ray.origin[c] + far * ray.direction[c];
        assert_true(ag_camera_project(camera, WIDTH, HEIGHT, point, place));
        assert_near(place[0], x, 1e-2);
        assert_near(place[1], y, 1e-2);
    }
    const float behind[3] = { 0, 0, 6 };
    float place[2];
    assert_false(ag_camera_project(&ahead, WIDTH, HEIGHT, behind, place));
}

// ---- Surfaces -----------------------------------------------------------------------------

static const float square[4][3] = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } };
static const float square_uv[4][2] = { { 0, 1 }, { 1, 1 }, { 1, 0 }, { 0, 0 } };
static const uint32_t square_indices[6] = { 0, 1, 2, 0, 2, 3 };

// The square at depth z, mirrored or not.
static ag_instance show_square(ag_scene *scene, const ag_material_desc *desc, float z, bool mirror)
{
    const ag_mesh_desc mesh_desc = { .positions = square[0],
                                     .uvs = { square_uv[0] },
                                     .vertex_count = 4,
                                     .indices = square_indices,
                                     .index_count = 6 };
    const float world[16] = { mirror ? -1 : 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, z, 1 };
    ag_mesh mesh;
    ag_material material = { 0 };
    ag_instance instance;
    assert_int_equal(ag_scene_add_mesh(scene, &mesh_desc, &mesh), AG_OK);
    if (desc)
        assert_int_equal(ag_scene_add_material(scene, desc, &material), AG_OK);
    assert_int_equal(ag_scene_add_instance(scene, mesh, material, world, &instance), AG_OK);
    return instance;
}

static ag_pick pick_at(const ag_scene *scene, const ag_camera_desc *camera, float x, float y,
                       float reach)
{
    ag_pick pick;
    assert_int_equal(ag_scene_pick(scene, camera, WIDTH, HEIGHT, x, y, reach, &pick), AG_OK);
    return pick;
}

static ag_pick pick_middle(const ag_scene *scene)
{
    return pick_at(scene, &ahead, WIDTH / 2, HEIGHT / 2, 0);
}

static void test_the_nearest_surface_is_told(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    assert_int_equal(pick_middle(scene).kind, AG_PICK_NOTHING);
    const ag_material_desc desc = ag_material_default();
    show_square(scene, &desc, -1, false);
    ag_instance near = show_square(scene, &desc, 1, true);
    ag_pick pick = pick_middle(scene);
    assert_int_equal(pick.kind, AG_PICK_SURFACE);
    assert_int_equal(pick.instance.id, near.id);
    assert_int_equal(pick.material.id, 2);
    assert_near(pick.distance_m, 4, 1e-5);
    assert_near(pick.position[2], 1, 1e-5);
    assert_near(pick.normal[2], 1, 1e-6);
    // At 4 m the square's edge is 100 px / (2 tan .45) / 4 from the middle.
    float edge = 50 / (float)tan(0.45) / 4;
    assert_int_equal(pick_at(scene, &ahead, 100 + edge - 0.1f, 50, 0).kind, AG_PICK_SURFACE);
    assert_int_equal(pick_at(scene, &ahead, 100 + edge + 0.1f, 50, 0).kind, AG_PICK_NOTHING);
    // Between the camera's planes only.
    ag_camera_desc cut = ahead;
    cut.near_m = 4.5f;
    cut.far_m = 7;
    assert_int_equal(pick_at(scene, &cut, 100, 50, 0).instance.id, 1);
    ag_scene_destroy(scene);
}

static void test_backs_are_seen_where_they_are_shown(void **state)
{
    (void)state;
    const ag_camera_desc from_behind = { .position = { 0, 0, -5 }, .fov_y_rad = 0.9f };
    for (int i = 0; i < 4; i++) {
        sentences s = { 0 };
        ag_scene *scene = make_scene(&s);
        ag_material_desc desc = ag_material_default();
        desc.double_sided = i & 1;
        show_square(scene, &desc, 0, i & 2);
        ag_pick front = pick_middle(scene), back = pick_at(scene, &from_behind, 100, 50, 0);
        assert_int_equal(front.kind, AG_PICK_SURFACE);
        assert_int_equal(back.kind, i & 1 ? AG_PICK_SURFACE : AG_PICK_NOTHING);
        if (i & 1)
            assert_near(back.normal[2], -1, 1e-6);
        ag_scene_destroy(scene);
    }
}

static void test_holes_are_seen_through(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    // Solid above on the left and below on the right, turned by a transform to the other way.
    const uint8_t pixels[4][4] = {
        { 9, 9, 9, 200 }, { 9, 9, 9, 90 }, { 9, 9, 9, 90 }, { 9, 9, 9, 200 }
    };
    const ag_image_desc image_desc = { 2, 2, AG_FORMAT_RGBA8, pixels };
    ag_image *image;
    assert_int_equal(ag_image_create(NULL, &image_desc, &image), AG_OK);
    ag_material_desc desc = ag_material_default();
    const ag_texture_desc texture = { .image = image };
    ag_texture_use *use = &desc.base_color_texture;
    assert_int_equal(ag_scene_add_texture(scene, &texture, &use->texture), AG_OK);
    ag_image_destroy(image);
    desc.alpha_mode = AG_ALPHA_MASK;
    show_square(scene, &desc, 0, false);
    assert_int_equal(pick_at(scene, &ahead, 95, 45, 0).kind, AG_PICK_SURFACE);
    assert_int_equal(pick_at(scene, &ahead, 105, 45, 0).kind, AG_PICK_NOTHING);
    assert_int_equal(pick_at(scene, &ahead, 95, 55, 0).kind, AG_PICK_NOTHING);
    assert_int_equal(pick_at(scene, &ahead, 105, 55, 0).kind, AG_PICK_SURFACE);
    use->rotation_rad = 1.57079633f;
    assert_int_equal(ag_scene_set_material(scene, (ag_material) { 1 }, &desc), AG_OK);
    assert_int_equal(pick_at(scene, &ahead, 95, 45, 0).kind, AG_PICK_NOTHING);
    assert_int_equal(pick_at(scene, &ahead, 105, 45, 0).kind, AG_PICK_SURFACE);
    desc.alpha_cutoff = 0.2f;
    assert_int_equal(ag_scene_set_material(scene, (ag_material) { 1 }, &desc), AG_OK);
    assert_int_equal(pick_at(scene, &ahead, 95, 45, 0).kind, AG_PICK_SURFACE);
    desc = ag_material_default();
    desc.alpha_mode = AG_ALPHA_BLEND;
    for (int i = 0; i < 2; i++) {
        desc.base_color[3] = i ? 0.6f : 0.4f;
        assert_int_equal(ag_scene_set_material(scene, (ag_material) { 1 }, &desc), AG_OK);
        assert_int_equal(pick_middle(scene).kind, i ? AG_PICK_SURFACE : AG_PICK_NOTHING);
    }
    ag_scene_destroy(scene);
}

// A closed sheet of uneven triangles, seen through its corners and along its edges: no gap.
static void test_no_ray_slips_through(void **state)
{
    (void)state;
    enum { N = 24 };
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    float positions[(N + 1) * (N + 1)][3];
    uint32_t indices[6 * N * N], *out = indices, seed = 3;
    for (uint32_t y = 0; y <= N; y++)
        for (uint32_t x = 0; x <= N; x++) {
            float *p = positions[y * (N + 1) + x];
            p[0] = ((float)x + 0.7f * noise(&seed)) / N * 8 - 4;
            p[1] = ((float)y + 0.7f * noise(&seed)) / N * 8 - 4;
            p[2] = noise(&seed) / 5;
        }
    for (uint32_t y = 0; y < N; y++)
        for (uint32_t x = 0; x < N; x++) {
            uint32_t a = y * (N + 1) + x, b = a + N + 1;
            memcpy(out, (uint32_t[6]) { a, a + 1, b + 1, a, b + 1, b }, 6 * sizeof *out);
            out += 6;
        }
    const ag_mesh_desc desc = { .positions = positions[0],
                                .vertex_count = (N + 1) * (N + 1),
                                .indices = indices,
                                .index_count = 6 * N * N };
    const float world[16] = { 0.8f, 0.6f, 0, 0, -0.6f, 0.8f, 0, 0, 0, 0, 1, 0, 0.1f, 0, 0.3f, 1 };
    ag_mesh mesh;
    ag_instance instance;
    assert_int_equal(ag_scene_add_mesh(scene, &desc, &mesh), AG_OK);
    assert_int_equal(ag_scene_add_instance(scene, mesh, (ag_material) { 0 }, world, &instance),
                     AG_OK);
    for (int i = 0; i < 6000; i++) {
        uint32_t a = (uint32_t)((N + 1) * (5 + i % 14) + 5 + i / 14 % 14),
                 b = a + (i % 2 ? 1 : N + 1);
        float t = (float)(i % 7) / 6, p[3], q[3], place[2];
        for (int c = 0; c < 3; c++)
            q[c] = positions[a][c] + t * (positions[b][c] - positions[a][c]);
        for (int c = 0; c < 3; c++)
            p[c] = world[c] * q[0] + world[4 + c] * q[1] + world[8 + c] * q[2] + world[12 + c];
        assert_true(ag_camera_project(&ahead, WIDTH, HEIGHT, p, place));
        ag_pick pick = pick_at(scene, &ahead, place[0], place[1], 0);
        assert_int_equal(pick.kind, AG_PICK_SURFACE);
        for (int c = 0; c < 3; c++)
            assert_near(pick.position[c], p[c], 0.02);
    }
    ag_scene_destroy(scene);
}

// ---- Lights ---------------------------------------------------------------------------------

static void test_bodies_are_met_where_they_are(void **state)
{
    (void)state;
    static const struct {
        ag_light_desc light;
        float distance; // of its middle's nearest place; 0: not seen
    } cases[] = {
        { { .kind = AG_LIGHT_SPHERE, .position = { 0, 0, 1 }, .radius_m = 0.5f }, 3.5f },
        { { .kind = AG_LIGHT_SPHERE, .radius_m = 0.5f, .hidden = true }, 0 },
        { { .kind = AG_LIGHT_DISK, .direction = { 0, 0, 1 }, .radius_m = 0.5f }, 5 },
        { { .kind = AG_LIGHT_DISK, .direction = { 0, 0, -1 }, .radius_m = 0.5f }, 0 },
        { { .kind = AG_LIGHT_RECT, .direction = { 0, 0, 1 }, .width_m = 1, .height_m = 1 }, 5 },
        { { .kind = AG_LIGHT_RECT, .direction = { 0, 1, -1 }, .width_m = 1, .height_m = 1 }, 0 },
        { { .kind = AG_LIGHT_TUBE, .length_m = 2, .radius_m = 0.25f }, 4.75f },
        { { .kind = AG_LIGHT_POINT }, 0 },
        { { .kind = AG_LIGHT_AMBIENT }, 0 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sentences s = { 0 };
        ag_scene *scene = make_scene(&s);
        ag_light light;
        show_square(scene, NULL, -2, false);
        assert_int_equal(ag_scene_add_light(scene, &cases[i].light, &light), AG_OK);
        ag_pick pick = pick_middle(scene);
        assert_int_equal(pick.kind, cases[i].distance > 0 ? AG_PICK_LIGHT : AG_PICK_SURFACE);
        if (pick.kind == AG_PICK_LIGHT) {
            assert_int_equal(pick.light.id, light.id);
            assert_near(pick.distance_m, cases[i].distance, 1e-4);
            assert_near(pick.position[2], 5 - cases[i].distance, 1e-4);
        }
        ag_scene_destroy(scene);
    }
}

static void test_suns_are_behind_all(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_light light;
    const ag_light_desc sun = { .kind = AG_LIGHT_SUN, .direction = { 0, 0.004f, 1 } };
    assert_int_equal(ag_scene_add_light(scene, &sun, &light), AG_OK);
    ag_pick pick = pick_middle(scene);
    assert_int_equal(pick.kind, AG_PICK_LIGHT);
    assert_true(isinf(pick.distance_m));
    assert_int_equal(pick_at(scene, &ahead, 103, 50, 0).kind, AG_PICK_NOTHING);
    show_square(scene, NULL, -2, false);
    assert_int_equal(pick_middle(scene).kind, AG_PICK_SURFACE);
    ag_scene_destroy(scene);
}

static void test_marks_are_found_near_their_place(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const ag_light_desc lights[] = {
        { .position = { 0, 0, -3 } }, // behind the square
        { .kind = AG_LIGHT_SPHERE, .position = { 0.2f, 0, 1 }, .radius_m = 0.01f, .hidden = true },
        { .kind = AG_LIGHT_SPOT, .position = { 0, 0, 9 } }, // behind the eye
    };
    ag_light light;
    show_square(scene, NULL, 0, false);
    for (size_t i = 0; i < 3; i++)
        assert_int_equal(ag_scene_add_light(scene, &lights[i], &light), AG_OK);
    float place[2];
    assert_true(ag_camera_project(&ahead, WIDTH, HEIGHT, lights[1].position, place));
    float middle = (100 + place[0]) / 2;
    assert_int_equal(pick_at(scene, &ahead, 100, 50, 0).kind, AG_PICK_SURFACE);
    assert_int_equal(pick_at(scene, &ahead, middle - 0.5f, 50, 9).light.id, 1);
    assert_int_equal(pick_at(scene, &ahead, middle + 0.5f, 50, 9).light.id, 2);
    ag_pick pick = pick_at(scene, &ahead, place[0] + 3, 54, 5.1f);
    assert_int_equal(pick.light.id, 2);
    assert_memory_equal(pick.position, lights[1].position, sizeof pick.position);
    assert_int_equal(pick_at(scene, &ahead, place[0] + 3, 54, 4.9f).kind, AG_PICK_SURFACE);
    ag_scene_destroy(scene);
}

static void test_refusals(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_pick pick = { .kind = AG_PICK_LIGHT };
    const ag_camera_desc nowhere = { .position = { NAN, 0, 0 } };
    assert_int_equal(ag_scene_pick(scene, &ahead, 0, 9, 1, 1, 0, &pick), AG_ERROR_ARGUMENT);
    assert_int_equal(pick.kind, AG_PICK_NOTHING);
    assert_int_equal(ag_scene_pick(scene, &ahead, 9, 9, NAN, 1, 0, &pick), AG_ERROR_ARGUMENT);
    assert_int_equal(ag_scene_pick(scene, &ahead, 9, 9, 1, 1, -1, &pick), AG_ERROR_ARGUMENT);
    assert_int_equal(ag_scene_pick(scene, &nowhere, 9, 9, 1, 1, 0, &pick), AG_ERROR_ARGUMENT);
    assert_int_equal(s.count, 4);
    assert_int_equal(ag_scene_pick(scene, NULL, 9, 9, 1, 1, 0, &pick), AG_OK);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rays_are_those_of_a_pinhole),
        cmocka_unit_test(test_points_are_where_their_rays_are),
        cmocka_unit_test(test_the_nearest_surface_is_told),
        cmocka_unit_test(test_backs_are_seen_where_they_are_shown),
        cmocka_unit_test(test_holes_are_seen_through),
        cmocka_unit_test(test_no_ray_slips_through),
        cmocka_unit_test(test_bodies_are_met_where_they_are),
        cmocka_unit_test(test_suns_are_behind_all),
        cmocka_unit_test(test_marks_are_found_near_their_place),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
