// The built-in scenes: each loads, is sound, and is seen by its camera.
#include "helpers.h"

static void check_mesh(const scene_mesh *mesh)
{
    assert_true(mesh->index_count > 0 && mesh->index_count % 3 == 0);
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        const scene_vertex *v[3];
        float a[3], b[3], mean[3];
        for (int c = 0; c < 3; c++) {
            assert_true(mesh->indices[i + (uint32_t)c] < mesh->vertex_count);
            v[c] = &mesh->vertices[mesh->indices[i + (uint32_t)c]];
            assert_near(dot3(v[c]->normal, v[c]->normal), 1, 1e-5);
            assert_near(dot3(v[c]->tangent, v[c]->normal), 0, 1e-5);
        }
        for (int k = 0; k < 3; k++) {
            a[k] = v[1]->position[k] - v[0]->position[k];
            b[k] = v[2]->position[k] - v[0]->position[k];
            mean[k] = v[0]->normal[k] + v[1]->normal[k] + v[2]->normal[k];
        }
        // Triangles face the way their normals do.
        const float face[3] = { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                a[0] * b[1] - a[1] * b[0] };
        assert_true(dot3(face, mean) > 0);
    }
}

static ag_scene *load(const char *name)
{
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    assert_int_equal(ag_scene_load_demo(scene, name), AG_OK);
    assert_int_equal(s.count, 0);
    return scene;
}

static void test_every_demo_is_sound(void **state)
{
    (void)state;
    const char *name, *about;
    size_t count = 0;
    for (; ag_scene_demo(count, &name, &about); count++) {
        assert_true(strlen(about) > 5 && strlen(about) < 80);
        ag_scene *scene = load(name);
        ag_scene_summary summary = ag_scene_summarize(scene);
        assert_true(summary.instances > 0 && summary.cameras == 1);
        for (size_t i = 0; i < scene->meshes_count; i++)
            check_mesh(&scene->meshes[i]);
        ag_scene_destroy(scene);
    }
    assert_int_equal(count, 7);
    assert_false(ag_scene_demo(count, &name, &about));
}

static void test_grid(void **state)
{
    (void)state;
    ag_scene *scene = load("grid");
    assert_int_equal(scene->instances_count, 49);
    assert_int_equal(scene->lights_count, 4);
    assert_int_equal(scene->environment_kind, AG_ENVIRONMENT_NONE);
    for (size_t i = 0; i < 4; i++)
        assert_true(scene->lights[i].kind == AG_LIGHT_POINT && scene->lights[i].intensity == 300);
    // Bottom left: no metal, and as smooth as it gets; top right: the other end.
    const ag_material_desc *first = &scene->materials[scene->instances[0].material];
    const ag_material_desc *last = &scene->materials[scene->instances[48].material];
    assert_true(first->metallic == 0.0f && first->roughness == 0.05f);
    assert_near(last->metallic, 6.0 / 7, 1e-6);
    assert_near(last->roughness, 6.0 / 7, 1e-6);
    ag_scene_destroy(scene);
}

static void test_sizes(void **state)
{
    (void)state;
    ag_scene *scene = load("million");
    uint64_t triangles = ag_scene_summarize(scene).triangles;
    assert_true(triangles > 990000 && triangles < 1010000);
    ag_scene_destroy(scene);
    scene = load("nodes");
    assert_int_equal(scene->instances_count, 10000);
    ag_scene_destroy(scene);
}

static void test_furnace_is_white(void **state)
{
    (void)state;
    ag_scene *scene = load("furnace");
    assert_int_equal(scene->environment_kind, AG_ENVIRONMENT_IMAGE);
    const float *p = ag_image_pixels(scene->environment);
    assert_true(p[0] == 1 && p[1] == 1 && p[2] == 1);
    for (size_t i = 1; i < scene->materials_count; i++)
        assert_true(scene->materials[i].base_color[0] == 1 &&
                    scene->materials[i].base_color[2] == 1);
    ag_scene_destroy(scene);
}

static void test_unknown_name(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    uint64_t revision = scene->revision;
    assert_int_equal(ag_scene_load_demo(scene, "teapots"), AG_ERROR_ARGUMENT);
    assert_int_equal(s.count, 1);
    assert_non_null(strstr(s.last, "teapots"));
    assert_non_null(strstr(s.last, "spheres, grid, materials"));
    assert_int_equal(scene->revision, revision);
    ag_scene_destroy(scene);
}

static void test_demos_append(void **state)
{
    (void)state;
    ag_scene *scene = load("lights");
    ag_scene_summary one = ag_scene_summarize(scene);
    assert_int_equal(one.lights, 3);
    assert_int_equal(ag_scene_load_demo(scene, "lights"), AG_OK);
    ag_scene_summary two = ag_scene_summarize(scene);
    assert_int_equal(two.instances, 2 * one.instances);
    assert_int_equal(two.lights, 6);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_demo_is_sound),
        cmocka_unit_test(test_grid),
        cmocka_unit_test(test_sizes),
        cmocka_unit_test(test_furnace_is_white),
        cmocka_unit_test(test_unknown_name),
        cmocka_unit_test(test_demos_append),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
