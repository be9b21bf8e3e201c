// Cameras, tiles and the order of drawing, without a device.
#include "stage.h"

#include "render/draws.h"
#include "render/view.h"

static void clip(const gpu_frame *frame, const float p[3], float out[4])
{
    for (int r = 0; r < 4; r++) {
        const float(*m)[4] = frame->clip_from_world.m;
        out[r] = m[0][r] * p[0] + m[1][r] * p[1] + m[2][r] * p[2] + m[3][r];
    }
}

static const float low[3] = { -1, -1, -1 }, high[3] = { 1, 1, 1 };

// A point's place in the picture by plain trigonometry.
static void perspective_is_trigonometry(void **state)
{
    (void)state;
    const ag_camera_desc camera = { .position = { 0, 0, 4 }, .fov_y_rad = 0.8f };
    view v = view_make(&camera, 400, 200, low, high);
    gpu_frame frame;
    view_frame(&v, (view_rect) { 0, 0, 400, 200 }, (float[2]) { 0, 0 }, &frame);
    const float p[3] = { 0.7f, 0.3f, 1 };
    float c[4];
    clip(&frame, p, c);
    assert_close(c[0] / c[3], 0.7f / 3 / (2 * tanf(0.4f)), 1e-6f);
    assert_close(c[1] / c[3], -0.3f / 3 / tanf(0.4f), 1e-6f); // Vulkan: y down
    assert_true(c[2] / c[3] > 0 && c[2] / c[3] < 1);
    float nearer[4];
    clip(&frame, (float[3]) { 0.7f, 0.3f, 1.1f }, nearer);
    assert_true(nearer[2] / nearer[3] > c[2] / c[3]); // reversed depth
}

// The ray of the background through a point's place meets the point.
static void rays_meet_what_is_projected(void **state)
{
    (void)state;
    const ag_camera_desc camera = { .position = { 3, 2, 4 }, .target = { 0.2f, 0.1f, 0 } };
    view v = view_make(&camera, 300, 500, low, high);
    const view_rect tiles[] = { { 0, 0, 300, 500 }, { 150, 250, 150, 250 }, { 17, 33, 64, 32 } };
    for (int t = 0; t < 3; t++) {
        gpu_frame frame;
        view_frame(&v, tiles[t], (float[2]) { 0.3f, -0.4f }, &frame);
        const float p[3] = { 0.3f, -0.5f, 0.8f };
        float c[4], ray[3], to[3], cross = 0, length = 0;
        clip(&frame, p, c);
        const float x = c[0] / c[3], y = c[1] / c[3];
        const float *center = &frame.ray_center.x, *dx = &frame.ray_x.x, *dy = &frame.ray_y.x;
        for (int i = 0; i < 3; i++) {
            ray[i] = center[i] + x * dx[i] + y * dy[i];
            to[i] = p[i] - (&frame.eye.x)[i];
        }
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3, k = (i + 2) % 3;
            cross += powf(ray[j] * to[k] - ray[k] * to[j], 2);
            length += ray[i] * ray[i] * (to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
        }
        assert_true(cross < 1e-9f * length);
    }
}

// A tile sees its part of the whole picture.
static void tiles_are_cut_from_the_whole(void **state)
{
    (void)state;
    const ag_camera_desc cameras[] = { { .position = { 1, 2, 4 } },
                                       { .position = { 1, 2, 4 }, .height_m = 3 } };
    for (int i = 0; i < 2; i++) {
        view v = view_make(&cameras[i], 640, 480, low, high);
        gpu_frame whole, part;
        view_frame(&v, (view_rect) { 0, 0, 640, 480 }, (float[2]) { 0, 0 }, &whole);
        view_frame(&v, (view_rect) { 320, 120, 160, 240 }, (float[2]) { 0, 0 }, &part);
        const float p[3] = { 0.6f, 0.1f, -0.2f };
        float a[4], b[4];
        clip(&whole, p, a);
        clip(&part, p, b);
        float x = (a[0] / a[3] + 1) / 2 * 640, y = (a[1] / a[3] + 1) / 2 * 480;
        assert_close((b[0] / b[3] + 1) / 2 * 160 + 320, x, 2e-3f);
        assert_close((b[1] / b[3] + 1) / 2 * 240 + 120, y, 2e-3f);
    }
}

static void jitter_moves_by_pixels(void **state)
{
    (void)state;
    const ag_camera_desc camera = { .position = { 0, 0, 4 } };
    view v = view_make(&camera, 100, 100, low, high);
    gpu_frame still, moved;
    float a[4], b[4];
    view_frame(&v, (view_rect) { 0, 0, 100, 100 }, (float[2]) { 0, 0 }, &still);
    view_frame(&v, (view_rect) { 0, 0, 100, 100 }, (float[2]) { 1, 2 }, &moved);
    clip(&still, (float[3]) { 0, 0, 0 }, a);
    clip(&moved, (float[3]) { 0, 0, 0 }, b);
    // The samples move right and down, so what they see moves left and up.
    assert_close((b[0] / b[3] - a[0] / a[3]) * 50, -1, 1e-4f);
    assert_close((b[1] / b[3] - a[1] / a[3]) * 50, -2, 1e-4f);
}

static void odd_cameras_are_finite(void **state)
{
    (void)state;
    const ag_camera_desc cameras[] = {
        { .position = { 0, 5, 0 } },                          // straight down
        { .position = { 0, 0, 0 } },                          // on its target
        { .position = { 0, 0, 9 }, .target = { 0, 0, 20 } },  // looking away
        { .position = { 0, 0, 5 }, .near_m = 3, .far_m = 3 }, // no depth
        { .position = { 1e6f, 0, 0 }, .up = { 1, 0, 0 } },    // far, up along the ray
    };
    for (size_t i = 0; i < sizeof cameras / sizeof *cameras; i++) {
        view v = view_make(&cameras[i], 64, 64, low, high);
        gpu_frame frame;
        view_frame(&v, (view_rect) { 0, 0, 64, 64 }, (float[2]) { 0, 0 }, &frame);
        for (int k = 0; k < 16; k++)
            assert_true(isfinite((&frame.clip_from_world.m[0][0])[k]));
        assert_true(isfinite(frame.ray_x.x) && isfinite(frame.ray_y.y));
    }
}

// ---- Order ---------------------------------------------------------------------

static void place(ag_scene *scene, ag_mesh mesh, ag_material material, float x, float z)
{
    ag_instance instance;
    const float world[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, 0, z, 1 };
    OK(ag_scene_add_instance(scene, mesh, material, world, &instance));
}

static void order_and_culling(void **state)
{
    (void)state;
    ag_scene *scene = stage_dark();
    ag_mesh mesh = stage_quad(scene, -1, -1, 1, 1, 0, NULL);
    ag_material_desc desc = stage_unlit(1, 1, 1, 0.5f);
    ag_material opaque, blend, both;
    OK(ag_scene_add_material(scene, &desc, &opaque));
    desc.alpha_mode = AG_ALPHA_BLEND;
    OK(ag_scene_add_material(scene, &desc, &blend));
    desc.double_sided = true;
    OK(ag_scene_add_material(scene, &desc, &both));
    place(scene, mesh, blend, 0, 0);
    place(scene, mesh, blend, 0, -10);
    place(scene, mesh, opaque, 0, -5);
    place(scene, mesh, opaque, 0, 2);
    place(scene, mesh, opaque, 0, -60);
    place(scene, mesh, opaque, 500, 0); // outside, to the right
    place(scene, mesh, opaque, 0, 30);  // behind the eye
    place(scene, mesh, both, 0, -4);

    const ag_camera_desc camera = { .position = { 0, 0, 10 } };
    float min[3] = { -1, -1, -60 }, max[3] = { 501, 1, 30 };
    view v = view_make(&camera, 100, 100, min, max);
    draws d;
    OK(draws_make(scene, &v, &d));
    float last = 0;
    for (uint32_t i = 0; i < d.opaque_count; i++)
        for (uint32_t k = 0; k < d.items[i].instance_count; k++) {
            float depth = 10 - d.instances[d.items[i].first_instance + k].rows[2].w;
            assert_true(depth >= last);
            last = depth;
        }
    assert_int_equal(d.instance_count, 3 + 2 + 2); // the double-sided pane counts twice
    last = 1e9f;
    for (uint32_t i = d.opaque_count; i < d.count; i++) {
        float depth = 10 - d.instances[d.items[i].first_instance].rows[2].w;
        assert_true(depth <= last);
        last = depth;
    }
    draws_finish(&d);
    ag_scene_destroy(scene);
}

static void crowds_become_one_draw(void **state)
{
    (void)state;
    ag_scene *scene = stage_dark();
    ag_mesh mesh = stage_quad(scene, -1, -1, 1, 1, 0, NULL);
    for (int i = 0; i < 1000; i++)
        place(scene, mesh, (ag_material) { 0 }, (float)(i % 10) - 5, -(float)(i % 7) * 1e-3f);
    const ag_camera_desc camera = { .position = { 0, 0, 20 } };
    float min[3] = { -6, -1, -1 }, max[3] = { 6, 1, 0 };
    view v = view_make(&camera, 100, 100, min, max);
    draws d;
    OK(draws_make(scene, &v, &d));
    assert_int_equal(d.instance_count, 1000);
    assert_true(d.count <= 2);
    assert_int_equal(d.triangles, 2000);
    draws_finish(&d);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(perspective_is_trigonometry),
        cmocka_unit_test(rays_meet_what_is_projected),
        cmocka_unit_test(tiles_are_cut_from_the_whole),
        cmocka_unit_test(jitter_moves_by_pixels),
        cmocka_unit_test(odd_cameras_are_finite),
        cmocka_unit_test(order_and_culling),
        cmocka_unit_test(crowds_become_one_draw),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
