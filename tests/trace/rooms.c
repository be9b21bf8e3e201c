// Closed rooms: walls of emission 1/2 and albedo 1/2 shine with 1 everywhere.
//
// A path of up to N bounces sees 1/2 + 1/4 + ... + 2^-(N + 2) = 1 - 2^-(N + 2) of it.
#include "stage.h"

typedef ag_mesh room_maker(ag_scene *scene);

static ag_mesh ball(ag_scene *scene)
{
    return stage_ball(scene, 12, 2, true, false);
}

// A box from -2 to 2, its triangles facing inwards.
static ag_mesh box(ag_scene *scene)
{
    float positions[8][3];
    static const uint32_t quads[6][4] = { { 0, 2, 6, 4 }, { 1, 5, 7, 3 }, { 0, 4, 5, 1 },
                                          { 2, 3, 7, 6 }, { 0, 1, 3, 2 }, { 4, 6, 7, 5 } };
    uint32_t indices[36];
    for (int i = 0; i < 8; i++)
        for (int c = 0; c < 3; c++)
            positions[i][c] = i >> c & 1 ? 2 : -2;
    for (int i = 0; i < 36; i++)
        indices[i] = quads[i / 6][(int[]) { 0, 1, 2, 0, 2, 3 }[i % 6]];
    const ag_mesh_desc desc = {
        .positions = &positions[0][0], .vertex_count = 8, .indices = indices, .index_count = 36
    };
    ag_mesh mesh;
    OK(ag_scene_add_mesh(scene, &desc, &mesh));
    return mesh;
}

static ag_scene *room(room_maker *make)
{
    ag_scene *scene = stage_dark();
    ag_material_desc half = stage_matte(0.5f);
    stage_glow(&half, 0.5f);
    stage_show(scene, make(scene), &half, NULL);
    return scene;
}

// Off the middle, so that no symmetry helps.
static ag_image *look(const ag_scene *scene, const ag_reference_options *options, uint32_t samples)
{
    const ag_camera_desc camera = { .position = { 0.3f, -0.4f, 0.2f },
                                    .target = { 1, 0.1f, -0.3f },
                                    .fov_y_rad = 1.5f };
    const ag_render_options picture = stage_linear(16, 16);
    return stage_trace(scene, &camera, &picture, options, samples);
}

static void assert_series(const ag_scene *scene, const ag_reference_options *options, double wanted)
{
    ag_image *image = look(scene, options, 16);
    for (int c = 0; c < 3; c++)
        assert_agrees("room", stage_estimate(image, c), wanted, 1e-4);
    ag_image_destroy(image);
}

static void bounces_are_a_series(room_maker *make, ag_estimator estimator)
{
    ag_scene *scene = room(make);
    ag_reference_options options = { .seed = 1, .estimator = estimator, .direct_only = true };
    assert_series(scene, &options, 0.75);
    options.direct_only = false;
    for (options.max_bounces = 1; options.max_bounces <= 5; options.max_bounces += 2)
        assert_series(scene, &options, 1 - exp2(-(double)options.max_bounces - 2));
    options.max_bounces = 0;
    assert_series(scene, &options, 1);
    ag_scene_destroy(scene);
}

static void a_ball_is_a_series(void **state)
{
    (void)state;
    bounces_are_a_series(ball, AG_ESTIMATOR_BOTH);
    bounces_are_a_series(ball, AG_ESTIMATOR_LIGHTS);
    bounces_are_a_series(ball, AG_ESTIMATOR_SURFACE);
}

// Its edges give areas of light close by an unbounded variance: not by the lights alone.
static void a_box_is_a_series(void **state)
{
    (void)state;
    bounces_are_a_series(box, AG_ESTIMATOR_BOTH);
    bounces_are_a_series(box, AG_ESTIMATOR_SURFACE);
}

// What returns all light cannot be seen in a room that shines with 1.
static void a_white_thing_is_not_seen(const ag_material_desc *material, double slack)
{
    ag_scene *scene = room(box);
    stage_show(scene, stage_ball(scene, 16, 0.5f, false, false), material,
               (float[16]) { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0.1f, -0.3f, 1 });
    ag_image *image = look(scene, &(ag_reference_options) { .seed = 2 }, 32);
    assert_agrees("white thing", stage_estimate(image, 1), 1, slack);
    assert_agrees("its middle", stage_estimate_in(image, 1, 5, 5, 11, 11), 1, slack);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

static void white_things_are_not_seen(void **state)
{
    (void)state;
    const ag_material_desc matte = stage_matte(1), metal = stage_metal(1, 0.5f);
    ag_material_desc glossy = stage_matte(1);
    glossy.specular = 1;
    glossy.roughness = 0.3f;
    a_white_thing_is_not_seen(&matte, 1e-4);
    a_white_thing_is_not_seen(&metal, 0.005);
    a_white_thing_is_not_seen(&glossy, 0.005);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_is_a_series),
        cmocka_unit_test(a_box_is_a_series),
        cmocka_unit_test(white_things_are_not_seen),
    };
    return cmocka_run_group_tests_name("rooms", tests, NULL, NULL);
}
