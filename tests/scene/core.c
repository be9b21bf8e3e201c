// Filling a scene: ids, defaults, sharing, taking back, and refusals that change nothing.
#include "helpers.h"
#include "scene/vector.h"

static const float triangle[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };

static ag_mesh add_triangle(ag_scene *scene)
{
    ag_mesh mesh;
    ag_mesh_desc desc = { .positions = triangle, .vertex_count = 3 };
    assert_int_equal(ag_scene_add_mesh(scene, &desc, &mesh), AG_OK);
    return mesh;
}

static ag_image *make_image(ag_format format, uint32_t width, uint32_t height)
{
    ag_image *image;
    ag_image_desc desc = { .width = width, .height = height, .format = format };
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    return image;
}

static void test_empty_scene(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_scene_summary summary = ag_scene_summarize(scene), zero = { 0 };
    assert_memory_equal(&summary, &zero, sizeof zero);
    ag_extension_info info;
    ag_camera_desc camera;
    assert_false(ag_scene_extension(scene, 0, &info));
    assert_false(ag_scene_camera(scene, 0, &camera));
    ag_scene_destroy(scene);
    ag_scene_destroy(NULL);
}

static void test_scenes_are_told_apart(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *a = make_scene(&s), *b = make_scene(&s);
    uint64_t id = b->id;
    assert_true(a->id != b->id);
    ag_scene_destroy(b);
    b = make_scene(&s); // likely at the same address
    assert_true(b->id != id);
    ag_scene_destroy(a);
    ag_scene_destroy(b);
}

static void test_instances_are_counted_as_drawn(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_mesh mesh = add_triangle(scene);
    // Mirrored in x, turned a quarter about z, stretched, moved: (x, y) -> (3 - y, -2x + 1).
    const float world[16] = { 0, -2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 3, 1, 5, 1 };
    ag_instance instance;
    assert_int_equal(ag_scene_add_instance(scene, mesh, (ag_material) { 0 }, NULL, &instance),
                     AG_OK);
    assert_int_equal(instance.id, 1);
    assert_int_equal(ag_scene_add_instance(scene, mesh, (ag_material) { 0 }, world, &instance),
                     AG_OK);
    assert_int_equal(instance.id, 2);
    ag_scene_summary summary = ag_scene_summarize(scene);
    assert_int_equal(summary.triangles, 2);
    assert_int_equal(summary.vertices, 6);
    assert_int_equal(summary.materials, 0);
    const float min[3] = { 0, -1, 0 }, max[3] = { 3, 1, 5 };
    assert_memory_equal(summary.bounds_min, min, sizeof min);
    assert_memory_equal(summary.bounds_max, max, sizeof max);
    ag_scene_destroy(scene);
}

static void test_bad_instances(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_mesh mesh = add_triangle(scene);
    uint64_t revision = scene->revision;
    float world[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, NAN, 0, 0, 0, 0, 1 };
    ag_instance out = { 9 };
    assert_int_equal(ag_scene_add_instance(scene, (ag_mesh) { 0 }, (ag_material) { 0 }, NULL, &out),
                     AG_ERROR_ARGUMENT);
    assert_int_equal(out.id, 0);
    assert_int_equal(ag_scene_add_instance(scene, (ag_mesh) { 2 }, (ag_material) { 0 }, NULL, &out),
                     AG_ERROR_ARGUMENT);
    assert_int_equal(ag_scene_add_instance(scene, mesh, (ag_material) { 1 }, NULL, &out),
                     AG_ERROR_ARGUMENT);
    assert_int_equal(ag_scene_add_instance(scene, mesh, (ag_material) { 0 }, world, &out),
                     AG_ERROR_ARGUMENT);
    assert_int_equal(s.count, 4);
    assert_int_equal(scene->revision, revision);
    assert_int_equal(scene->instances_count, 0);
    ag_scene_destroy(scene);
}

static void test_material_defaults_are_gltfs(void **state)
{
    (void)state;
    ag_material_desc d = ag_material_default();
    for (int i = 0; i < 4; i++)
        assert_true(d.base_color[i] == 1.0f);
    assert_true(d.metallic == 1.0f && d.roughness == 1.0f && d.ior == 1.5f);
    assert_true(d.specular == 1.0f && d.specular_color[2] == 1.0f);
    assert_true(d.alpha_cutoff == 0.5f && d.alpha_mode == AG_ALPHA_OPAQUE);
    assert_true(d.normal_scale == 1.0f && d.occlusion_strength == 1.0f);
    assert_true(d.emissive[0] == 0.0f && !d.double_sided && !d.unlit);
}

static void test_materials_are_clamped(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_material_desc d = ag_material_default();
    d.metallic = 2.0f;
    d.roughness = -1.0f;
    d.ior = 0.5f;
    d.emissive[1] = 500.0f;
    ag_material material;
    assert_int_equal(ag_scene_add_material(scene, &d, &material), AG_OK);
    assert_int_equal(material.id, 1);
    const ag_material_desc *made = &scene->materials[material.id];
    assert_true(made->metallic == 1.0f && made->roughness == 0.0f && made->ior == 1.0f);
    assert_true(made->emissive[1] == 500.0f);
    assert_true(made->normal_texture.scale[0] == 1.0f && made->normal_texture.scale[1] == 1.0f);
    d.ior = 0.0f; // KHR_materials_ior's special value stays
    assert_int_equal(ag_scene_add_material(scene, &d, &material), AG_OK);
    assert_true(scene->materials[material.id].ior == 0.0f);
    ag_scene_destroy(scene);
}

static void test_bad_materials(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    enum { BAD = 13 };
    ag_material_desc d[BAD];
    for (int i = 0; i < BAD; i++)
        d[i] = ag_material_default();
    d[0].roughness = NAN;
    d[1].emissive_texture.texture.id = 1; // none there
    d[2].occlusion_texture.uv_set = 2;
    d[3].alpha_mode = (ag_alpha_mode)3;
    d[4].diffuse = (ag_diffuse)3;
    d[5].distribution = (ag_distribution)-1;
    d[6].shadowing = (ag_shadowing)2;
    d[7].fresnel = (ag_fresnel)3;
    d[8].layering = (ag_layering)4;
    d[9].fresnel = AG_FRESNEL_CONDUCTOR;
    d[9].conductor_n[2] = 0.0f;
    d[10].f82_tint[1] = INFINITY;
    d[11].conductor_k[0] = NAN;
    d[12].anisotropy = NAN;
    for (int i = 0; i < BAD; i++) {
        ag_material material = { 7 };
        assert_int_equal(ag_scene_add_material(scene, &d[i], &material), AG_ERROR_ARGUMENT);
        assert_int_equal(material.id, 0);
    }
    assert_int_equal(scene->materials_count, 1);
    assert_int_equal(s.count, BAD);
    ag_scene_destroy(scene);
}

static void test_choices_are_clamped(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_material_desc d = ag_material_default();
    d.diffuse = AG_DIFFUSE_EON;
    d.diffuse_roughness = 1.5f;
    d.anisotropy = 2.0f;
    d.reflectiveness = -1.0f;
    d.shininess = -3.0f;
    d.f82_tint[2] = 7.0f;
    d.conductor_k[1] = -1.0f;
    ag_material material;
    assert_int_equal(ag_scene_add_material(scene, &d, &material), AG_OK);
    const ag_material_desc *made = &scene->materials[material.id];
    assert_true(made->diffuse_roughness == 1.0f && made->anisotropy == 1.0f);
    assert_true(made->reflectiveness == 0.0f && made->shininess == 0.0f);
    assert_true(made->f82_tint[2] == 1.0f && made->conductor_k[1] == 0.0f);
    d.diffuse = AG_DIFFUSE_OREN_NAYAR; // radians here
    assert_int_equal(ag_scene_add_material(scene, &d, &material), AG_OK);
    assert_true(scene->materials[material.id].diffuse_roughness == 1.5f);
    ag_scene_destroy(scene);
}

static void test_lights_get_defaults(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_light light;
    ag_light_desc spot = { .kind = AG_LIGHT_SPOT, .intensity = 3, .direction = { 0, -2, 0 } };
    assert_int_equal(ag_scene_add_light(scene, &spot, &light), AG_OK);
    assert_int_equal(ag_scene_add_light(scene, &(ag_light_desc) { .intensity = 1 }, &light), AG_OK);
    assert_int_equal(light.id, 2);
    const ag_light_desc *a = &scene->lights[0], *b = &scene->lights[1];
    assert_true(a->direction[1] == -1.0f && b->direction[2] == -1.0f);
    assert_true(a->color[0] == 1.0f && a->color[1] == 1.0f && a->color[2] == 1.0f);
    assert_near(a->cone_outer_rad, 0.78539816, 1e-6);
    const ag_light_desc lights[] = {
        { .kind = AG_LIGHT_SUN },
        { .kind = AG_LIGHT_HEMISPHERIC },
        { .kind = AG_LIGHT_TUBE },
        { .kind = AG_LIGHT_RECT, .direction = { 0, -3, 0 } },
        { .kind = AG_LIGHT_RECT, .direction = { 1, 0, 0 }, .up = { 5, 0, 2 } },
    };
    for (size_t i = 0; i < 5; i++)
        assert_int_equal(ag_scene_add_light(scene, &lights[i], &light), AG_OK);
    const ag_light_desc *l = &scene->lights[2];
    assert_near(l[0].angular_radius_rad, 0.00465, 1e-7);
    assert_true(l[1].direction[1] == 1.0f && l[2].direction[0] == 1.0f);
    for (int i = 3; i < 5; i++)
        assert_near(vec3_dot(vec3_from(l[i].up), vec3_from(l[i].direction)), 0, 1e-6);
    assert_near(vec3_dot(vec3_from(l[3].up), vec3_from(l[3].up)), 1, 1e-6);
    assert_near(l[4].up[2], 1, 1e-6);
    ag_scene_destroy(scene);
}

// Irradiance over pi by summing radiance over the sphere, in even steps of height and azimuth.
static void test_harmonics_from_radiance(void **state)
{
    (void)state;
    const float L[9][3] = { { 1.0f },  { .5f },  { -.3f }, { .2f }, { .15f },
                            { -.25f }, { .35f }, { .1f },  { -.2f } };
    float h[9][3];
    ag_light_harmonics(L, h);
    const double n[3] = { 0.48, -0.6, 0.64 };
    double sum = 0;
    const int rows = 400, columns = 800;
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < columns; i++) {
            double z = 2 * (j + .5) / rows - 1, r = sqrt(1 - z * z);
            double phi = 6.283185307179586 * (i + .5) / columns;
            double d[3] = { r * cos(phi), r * sin(phi), z };
            double x = d[0], y = d[1];
            const double Y[9] = { .282095,
                                  .488603 * y,
                                  .488603 * z,
                                  .488603 * x,
                                  1.092548 * x * y,
                                  1.092548 * y * z,
                                  .315392 * (3 * z * z - 1),
                                  1.092548 * x * z,
                                  .546274 * (x * x - y * y) };
            double radiance = 0;
            for (int k = 0; k < 9; k++)
                radiance += (double)L[k][0] * Y[k];
            sum += radiance * fmax(0, n[0] * x + n[1] * y + n[2] * z);
        }
    sum *= 4 / (double)(rows * columns); // 4 pi / pi
    double x = n[0], y = n[1], z = n[2];
    const double basis[9] = { 1, x, y, z, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y };
    double got = 0;
    for (int k = 0; k < 9; k++)
        got += (double)h[k][0] * basis[k];
    assert_near(got, sum, 2e-4);
    assert_true(h[0][1] == 0 && h[8][2] == 0);
}

static void test_exposure(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    assert_true(ag_scene_exposure(scene) == 1.0f);
    assert_int_equal(ag_scene_set_exposure(scene, 0.25f), AG_OK);
    assert_int_equal(ag_scene_set_exposure(scene, 0.0f), AG_ERROR_ARGUMENT);
    assert_int_equal(ag_scene_set_exposure(scene, NAN), AG_ERROR_ARGUMENT);
    assert_int_equal(ag_scene_set_exposure(scene, INFINITY), AG_ERROR_ARGUMENT);
    assert_true(ag_scene_exposure(scene) == 0.25f);
    ag_scene_destroy(scene);
}

static void test_bad_lights(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const ag_light_desc bad[] = {
        { .kind = (ag_light_kind)11 },
        { .intensity = -1 },
        { .intensity = NAN },
        { .range_m = -1 },
        { .position = { INFINITY, 0, 0 } },
        { .color = { 1, -1, 1 } },
        { .kind = AG_LIGHT_SPOT, .cone_inner_rad = 0.5f, .cone_outer_rad = 0.5f },
        { .kind = AG_LIGHT_SPOT, .cone_inner_rad = -0.1f, .cone_outer_rad = 0.5f },
        { .kind = AG_LIGHT_SPOT, .cone_outer_rad = 1.6f },
        { .kind = AG_LIGHT_SUN, .angular_radius_rad = 1.6f },
        { .kind = AG_LIGHT_SPHERE, .radius_m = -1 },
        { .kind = AG_LIGHT_RECT, .width_m = NAN },
        { .kind = AG_LIGHT_RECT, .up = { NAN, 0, 0 } },
        { .kind = AG_LIGHT_TUBE, .length_m = INFINITY },
        { .kind = AG_LIGHT_HEMISPHERIC, .ground_color = { -1, 0, 0 } },
        { .kind = AG_LIGHT_HARMONICS, .harmonics = { [8] = { 0, 0, NAN } } },
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        ag_light light = { 7 };
        assert_int_equal(ag_scene_add_light(scene, &bad[i], &light), AG_ERROR_ARGUMENT);
        assert_int_equal(light.id, 0);
    }
    assert_int_equal(scene->lights_count, 0);
    ag_scene_destroy(scene);
}

static void test_textures_are_copied_or_shared(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_image *image = make_image(AG_FORMAT_RGBA8, 2, 2);
    ag_texture a, b, c;
    ag_texture_desc desc = { .image = image, .wrap_u = AG_WRAP_CLAMP };
    assert_int_equal(ag_scene_add_texture(scene, &desc, &a), AG_OK);
    assert_ptr_not_equal(scene->textures[0].image, image);
    assert_int_equal(scene->textures[0].desc.wrap_u, AG_WRAP_CLAMP);
    assert_int_equal(scene_adopt_texture(scene, image, &(ag_texture_desc) { 0 }, &b), AG_OK);
    assert_int_equal(scene_adopt_texture(scene, image, &(ag_texture_desc) { 0 }, &c), AG_OK);
    assert_ptr_equal(scene->textures[b.id - 1].image, image);
    assert_ptr_equal(scene->textures[c.id - 1].image, image);
    assert_int_equal(scene->images_count, 2);
    assert_int_equal(scene->textures_count, 3);
    ag_scene_destroy(scene); // frees each image once
}

static void test_bad_textures(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_image *floats = make_image(AG_FORMAT_RGBA32F, 1, 1);
    ag_image *bytes = make_image(AG_FORMAT_RGBA8, 1, 1);
    ag_texture out;
    ag_texture_desc desc = { .image = floats };
    assert_int_equal(ag_scene_add_texture(scene, &desc, &out), AG_ERROR_ARGUMENT);
    desc.image = NULL;
    assert_int_equal(ag_scene_add_texture(scene, &desc, &out), AG_ERROR_ARGUMENT);
    desc.image = bytes;
    desc.mip = (ag_filter)5;
    assert_int_equal(ag_scene_add_texture(scene, &desc, &out), AG_ERROR_ARGUMENT);
    // Adopting takes the image over on failure as well.
    assert_int_equal(scene_adopt_texture(scene, bytes, &desc, &out), AG_ERROR_ARGUMENT);
    assert_int_equal(scene->textures_count + scene->images_count, 0);
    ag_image_destroy(floats);
    ag_scene_destroy(scene);
}

// One of each thing.
static void add_everything(ag_scene *scene)
{
    ag_mesh mesh = add_triangle(scene);
    ag_image *image = make_image(AG_FORMAT_RGBA8, 1, 1);
    ag_texture texture;
    assert_int_equal(scene_adopt_texture(scene, image, &(ag_texture_desc) { 0 }, &texture), AG_OK);
    ag_light light;
    assert_int_equal(ag_scene_add_light(scene, &(ag_light_desc) { 0 }, &light), AG_OK);
    ag_camera camera;
    ag_camera_desc view = { .position = { 0, 0, 5 }, .name = "front" };
    assert_int_equal(ag_scene_add_camera(scene, &view, &camera), AG_OK);
    ag_material_desc desc = ag_material_default();
    desc.base_color_texture.texture = texture;
    ag_material material;
    assert_int_equal(ag_scene_add_material(scene, &desc, &material), AG_OK);
    ag_instance instance;
    assert_int_equal(ag_scene_add_instance(scene, mesh, material, NULL, &instance), AG_OK);
}

static void test_rollback_takes_all_back(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    add_everything(scene);
    ag_scene_summary before = ag_scene_summarize(scene);
    scene_mark mark = scene_mark_now(scene);
    uint64_t revision = scene->revision;
    add_everything(scene);
    assert_int_equal(scene->images_count, 2);
    scene_rollback(scene, mark);
    ag_scene_summary after = ag_scene_summarize(scene);
    assert_memory_equal(&before, &after, sizeof before);
    assert_int_equal(scene->images_count, 1);
    assert_true(scene->revision > revision + 5); // a light alone changes nothing on a device
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_empty_scene),
        cmocka_unit_test(test_scenes_are_told_apart),
        cmocka_unit_test(test_instances_are_counted_as_drawn),
        cmocka_unit_test(test_bad_instances),
        cmocka_unit_test(test_material_defaults_are_gltfs),
        cmocka_unit_test(test_materials_are_clamped),
        cmocka_unit_test(test_bad_materials),
        cmocka_unit_test(test_choices_are_clamped),
        cmocka_unit_test(test_lights_get_defaults),
        cmocka_unit_test(test_bad_lights),
        cmocka_unit_test(test_harmonics_from_radiance),
        cmocka_unit_test(test_exposure),
        cmocka_unit_test(test_textures_are_copied_or_shared),
        cmocka_unit_test(test_bad_textures),
        cmocka_unit_test(test_rollback_takes_all_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
