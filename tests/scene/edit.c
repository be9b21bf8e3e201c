// Changing what a scene holds: lights, materials, names.
#include "helpers.h"

static ag_light add_light(ag_scene *scene, const ag_light_desc *desc)
{
    ag_light light;
    assert_int_equal(ag_scene_add_light(scene, desc, &light), AG_OK);
    return light;
}

static ag_material add_material(ag_scene *scene, const ag_material_desc *desc)
{
    ag_material material;
    assert_int_equal(ag_scene_add_material(scene, desc, &material), AG_OK);
    return material;
}

// As if it had been added anew, and its neighbours stay.
static void test_a_light_is_set(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const ag_light_desc sphere = { .kind = AG_LIGHT_SPHERE, .radius_m = 1, .name = "lamp" };
    const ag_light_desc spot = { .kind = AG_LIGHT_SPOT, .direction = { 0, -2, 0 }, .intensity = 3 };
    add_light(scene, &sphere);
    ag_light second = add_light(scene, &sphere);
    assert_int_equal(ag_scene_set_light(scene, second, &spot), AG_OK);
    ag_light_desc first, changed, added;
    add_light(scene, &spot);
    assert_true(ag_scene_light(scene, 0, &first) && ag_scene_light(scene, second.id - 1, &changed));
    assert_true(ag_scene_light(scene, 2, &added));
    assert_memory_equal(&changed, &added, sizeof added);
    assert_true(first.kind == AG_LIGHT_SPHERE && first.radius_m == 1);
    assert_string_equal(first.name, "lamp");
    ag_scene_destroy(scene);
}

static void test_a_refused_light_changes_nothing(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_light light = add_light(scene, &(ag_light_desc) { .intensity = 2, .name = "lamp" });
    const ag_light_desc before = scene->lights[0];
    const ag_light_desc bad[] = {
        { .intensity = -1, .name = "x" },
        { .kind = (ag_light_kind)99 },
        { .kind = AG_LIGHT_SPOT, .cone_outer_rad = 2 },
        { .kind = AG_LIGHT_SUN, .angular_radius_rad = 2 },
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_int_equal(ag_scene_set_light(scene, light, &bad[i]), AG_ERROR_ARGUMENT);
    const ag_light_desc good = { .intensity = 1 };
    assert_int_equal(ag_scene_set_light(scene, (ag_light) { 0 }, &good), AG_ERROR_ARGUMENT);
    assert_int_equal(ag_scene_set_light(scene, (ag_light) { 2 }, &good), AG_ERROR_ARGUMENT);
    assert_memory_equal(&scene->lights[0], &before, sizeof before);
    assert_int_equal(s.count, 6);
    ag_scene_destroy(scene);
}

static void test_a_material_is_set(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_material_desc desc = ag_material_default(), out;
    assert_false(ag_scene_material(scene, 0, &out));
    desc.name = "steel";
    ag_material material = add_material(scene, &desc);
    desc.roughness = 7;
    desc.alpha_mode = AG_ALPHA_BLEND;
    assert_int_equal(ag_scene_set_material(scene, material, &desc), AG_OK);
    assert_true(ag_scene_material(scene, material.id - 1, &out));
    assert_true(out.roughness == 1.0f && out.alpha_mode == AG_ALPHA_BLEND); // clamped
    assert_string_equal(out.name, "steel");
    assert_false(ag_scene_material(scene, material.id, &out));
    desc.roughness = NAN;
    assert_int_equal(ag_scene_set_material(scene, material, &desc), AG_ERROR_ARGUMENT);
    desc.roughness = 0;
    desc.normal_texture.texture.id = 1; // none there
    assert_int_equal(ag_scene_set_material(scene, material, &desc), AG_ERROR_ARGUMENT);
    desc.normal_texture.texture.id = 0;
    assert_int_equal(ag_scene_set_material(scene, (ag_material) { 0 }, &desc), AG_ERROR_ARGUMENT);
    assert_int_equal(ag_scene_set_material(scene, (ag_material) { 2 }, &desc), AG_ERROR_ARGUMENT);
    assert_true(scene->materials[1].roughness == 1.0f && scene->materials[0].roughness == 1.0f);
    ag_scene_destroy(scene);
}

// What came out with a borrowed name may go in again, with the same name or another.
static void test_names_are_copied_and_kept(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    char text[] = "lamp";
    ag_light light = add_light(scene, &(ag_light_desc) { .name = text });
    text[0] = 'd';
    ag_light_desc desc, again;
    assert_true(ag_scene_light(scene, 0, &desc));
    assert_string_equal(desc.name, "lamp");
    desc.intensity = 4;
    assert_int_equal(ag_scene_set_light(scene, light, &desc), AG_OK);
    assert_true(ag_scene_light(scene, 0, &again));
    assert_ptr_equal(again.name, desc.name);
    desc.name++; // a part of itself
    assert_int_equal(ag_scene_set_light(scene, light, &desc), AG_OK);
    assert_true(ag_scene_light(scene, 0, &again));
    assert_string_equal(again.name, "amp");
    again.name = NULL;
    assert_int_equal(ag_scene_set_light(scene, light, &again), AG_OK);
    assert_null(scene->lights[0].name);
    ag_scene_destroy(scene);
}

static void test_instances_tell_about_themselves(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const float triangle[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    const float world[16] = { 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1 };
    const ag_mesh_desc mesh_desc = { .positions = triangle, .vertex_count = 3 };
    ag_material_desc desc = ag_material_default();
    ag_material material = add_material(scene, &desc);
    ag_mesh mesh;
    ag_instance instance;
    assert_int_equal(ag_scene_add_mesh(scene, &mesh_desc, &mesh), AG_OK);
    assert_int_equal(ag_scene_add_instance(scene, mesh, material, world, &instance), AG_OK);
    assert_int_equal(ag_scene_name_instance(scene, instance, "wheel"), AG_OK);
    assert_int_equal(ag_scene_name_instance(scene, (ag_instance) { 2 }, "x"), AG_ERROR_ARGUMENT);
    ag_instance_info info;
    assert_true(ag_scene_instance(scene, instance.id - 1, &info));
    assert_int_equal(info.mesh.id, mesh.id);
    assert_int_equal(info.material.id, material.id);
    assert_memory_equal(info.world, world, sizeof world);
    assert_string_equal(info.name, "wheel");
    const float min[3] = { 5, 6, 7 }, max[3] = { 7, 8, 7 };
    assert_memory_equal(info.bounds_min, min, sizeof min);
    assert_memory_equal(info.bounds_max, max, sizeof max);
    assert_false(ag_scene_instance(scene, 1, &info));
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_light_is_set),
        cmocka_unit_test(test_a_refused_light_changes_nothing),
        cmocka_unit_test(test_a_material_is_set),
        cmocka_unit_test(test_names_are_copied_and_kept),
        cmocka_unit_test(test_instances_tell_about_themselves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
