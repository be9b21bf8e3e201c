// The built-in scenes: each loads, is sound, and is seen by its camera.
#include "helpers.h"

#include <argand/metal.h>
#include <argand/renderer.h>

#include <math.h>

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

static ag_scene *load_as(const char *name, ag_look look)
{
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    assert_int_equal(ag_scene_load_demo(scene, name, look), AG_OK);
    assert_int_equal(s.count, 0);
    return scene;
}

static ag_scene *load(const char *name)
{
    return load_as(name, AG_LOOK_TEXT);
}

static void test_every_demo_is_sound(void **state)
{
    (void)state;
    const char *name, *about;
    size_t count = 0;
    for (; ag_scene_demo(count, &name, &about); count++) {
        assert_true(strlen(about) > 5 && strlen(about) < 80);
        for (int look = AG_LOOK_TEXT; look <= AG_LOOK_ARGAND; look++) {
            ag_scene *scene = load_as(name, (ag_look)look);
            ag_scene_summary summary = ag_scene_summarize(scene);
            assert_true(summary.instances > 0 && summary.cameras == 1);
            for (size_t i = 0; i < scene->meshes_count; i++)
                check_mesh(&scene->meshes[i]);
            ag_scene_destroy(scene);
        }
    }
    assert_int_equal(count, 16);
    assert_false(ag_scene_demo(count, &name, &about));
}

static void test_grid(void **state)
{
    (void)state;
    ag_scene *scene = load("grid");
    assert_int_equal(scene->instances_count, 49);
    assert_int_equal(scene->lights_count, 5);
    ag_light_desc ambient;
    assert_true(ag_scene_light(scene, 4, &ambient) && ambient.kind == AG_LIGHT_AMBIENT);
    assert_near(ambient.intensity, 0.03, 1e-8);
    assert_int_equal(scene->environment_kind, AG_ENVIRONMENT_NONE);
    for (size_t i = 0; i < 4; i++)
        assert_true(scene->lights[i].kind == AG_LIGHT_POINT && scene->lights[i].intensity == 300);
    // Bottom left: no metal, and as smooth as it gets; top right: the other end.
    const ag_material_desc *first = &scene->materials[scene->instances[0].material];
    const ag_material_desc *last = &scene->materials[scene->instances[48].material];
    assert_true(first->metallic == 0.0f && first->roughness == 0.05f);
    assert_near(last->metallic, 6.0 / 7, 1e-6);
    assert_near(last->roughness, 6.0 / 7, 1e-6);
    assert_true(last->shadowing == AG_SHADOWING_SCHLICK && last->single_bounce);
    assert_int_equal(last->layering, AG_LAYERING_FRESNEL);
    ag_scene_destroy(scene);
}

// A material as ag_material_default() has it, but for colour, metal and roughness.
static void assert_conserving(const ag_material_desc *m)
{
    assert_int_equal(m->layering, AG_LAYERING_ALBEDO);
    assert_int_equal(m->shadowing, AG_SHADOWING_SMITH);
    assert_int_equal(m->distribution, AG_DISTRIBUTION_GGX);
    assert_false(m->single_bounce);
    assert_near(m->ior, 1.5, 1e-6);
}

static void test_corrected_looks_conserve_energy(void **state)
{
    (void)state;
    const char *name, *about;
    ag_render_options unused;
    for (size_t i = 0; ag_scene_demo(i, &name, &about); i++) {
        if (!ag_demo_look(name, &unused))
            continue;
        ag_scene *scene = load_as(name, AG_LOOK_ARGAND);
        for (size_t m = 0; m < scene->materials_count; m++)
            assert_conserving(&scene->materials[m]);
        ag_scene_destroy(scene);
    }
}

// Of instance i: where it stands, and half the height of its mesh.
static void assert_at(const ag_scene *scene, size_t i, double x, double y, double z, double size)
{
    const scene_instance *instance = &scene->instances[i];
    const scene_mesh *mesh = &scene->meshes[instance->mesh];
    float top = 0;
    for (uint32_t v = 0; v < mesh->vertex_count; v++)
        top = fmaxf(top, mesh->vertices[v].position[1]);
    assert_near(instance->world[12], x, 1e-6);
    assert_near(instance->world[13], y, 1e-6);
    assert_near(instance->world[14], z, 1e-6);
    assert_near(top, size, 1e-6);
}

// What stands in both texts' scene: 13 meshes, then columns of 5 spheres.
static void check_specular(const ag_scene *scene, double least_roughness)
{
    assert_at(scene, 0, 0.25, 0, -1.25, 0.25);
    assert_at(scene, 3, 1.5, 0, -2.6, 0.25);
    assert_at(scene, 12, -2, -0.5, -2.5, 0.25);
    assert_at(scene, 13, 0.5, 0.5, -0.75, 0.125);
    assert_at(scene, 42, -0.75, -0.5, -0.75, 0.125);
    const ag_material_desc *second = &scene->materials[scene->instances[1].material];
    assert_near(second->base_color[0], 0.75, 1e-6);
    assert_near(second->base_color[1], 0.5, 1e-6);
    assert_near(second->roughness, 0.1, 1e-6);
    assert_near(second->reflectiveness, 0.25, 1e-6);
    assert_int_equal(second->layering, AG_LAYERING_BLEND);
    double f0 = ((double)second->ior - 1) / ((double)second->ior + 1);
    assert_near(f0 * f0, 0.5, 1e-6);
    // Copper, at the smooth end.
    const ag_material_desc *last = &scene->materials[scene->instances[42].material];
    const ag_material_desc *rough = &scene->materials[scene->instances[17].material];
    assert_near(last->roughness, least_roughness, 1e-6);
    assert_near(rough->roughness, 1, 1e-6);
    assert_true(last->metallic == 1 && last->reflectiveness == 1);
    for (int i = 0; i < 3; i++) {
        const double n[] = { 0.28046, 0.85418, 1.3284 }, k[] = { 3.5587, 2.4518, 2.2949 };
        double above = hypot(n[i] - 1, k[i]), below = hypot(n[i] + 1, k[i]);
        assert_near(last->base_color[i], pow(above / below, 2), 1e-6);
    }
}

static void test_specular(void **state)
{
    (void)state;
    ag_scene *scene = load("specular");
    check_specular(scene, 0.01);
    assert_int_equal(scene->instances_count, 13 + 30 + 7); // and 7 glowing bulbs
    assert_int_equal(scene->lights_count, 7);
    ag_light_desc light;
    assert_true(ag_scene_light(scene, 3, &light) && light.kind == AG_LIGHT_POINT);
    // A bulb's light, radiance times the area that it shows, is that of its lamp.
    const ag_material_desc *bulb = &scene->materials[scene->instances[46].material];
    for (int i = 0; i < 3; i++)
        assert_near((double)bulb->emissive[i] * 3.14159265 * 0.0125 * 0.0125, light.color[i], 1e-6);
    ag_scene_destroy(scene);
}

static void test_sphere_lights(void **state)
{
    (void)state;
    static const double lamps[7][6] = {
        { 0, 0, 0, 0.5, 0.5, 0.5 },
        { 0.25, -0.25, -1.9, 0.025, 0.025, 0.025 },
        { -0.25, 0.25, -2.9, 0.025, 0.025, 0.025 },
        { 1.5, 0, -2.5, 0.125, 0.125, 0.025 },
        { -1.5, 0, -2.5, 0.125, 0.025, 0.025 },
        { -1, 0, -2.9, 0.25, 0.25, 0.25 },
        { 1, 0, -2.9, 0.25, 0.25, 0.25 },
    };
    ag_scene *scene = load("sphere-lights");
    check_specular(scene, 0.1);
    assert_int_equal(scene->instances_count, 13 + 30);
    assert_int_equal(scene->lights_count, 7);
    for (size_t i = 0; i < 7; i++) {
        ag_light_desc light;
        assert_true(ag_scene_light(scene, i, &light) && light.kind == AG_LIGHT_SPHERE);
        assert_near(light.radius_m, i == 0 ? 0.075 : 0.0125, 1e-7);
        for (int c = 0; c < 3; c++) {
            assert_near(light.position[c], lamps[i][c], 1e-6);
            assert_near(light.color[c] * light.intensity, lamps[i][3 + c], 1e-6);
        }
    }
    ag_scene_destroy(scene);
}

static void test_sun(void **state)
{
    (void)state;
    ag_scene *small = load("sun"), *large = load("sun-large");
    ag_light_desc light;
    assert_true(ag_scene_light(small, 0, &light) && light.kind == AG_LIGHT_SUN);
    assert_near(sin((double)light.angular_radius_rad), 0.00465, 1e-8); // the text's ratio
    assert_true(ag_scene_light(large, 0, &light) && light.angular_radius_rad > 0.05f);
    ag_scene_destroy(small);
    ag_scene_destroy(large);
}

static const ag_material_desc *only_material(const ag_scene *scene)
{
    uint32_t material = scene->instances[0].material;
    for (size_t i = 1; i < scene->instances_count; i++)
        assert_int_equal(scene->instances[i].material, material);
    return &scene->materials[material];
}

// The light of each of the text's three cases, in its order.
static void assert_lights(const ag_scene *scene, uint32_t directional, ag_light_kind ambient)
{
    assert_int_equal(scene->lights_count, directional + 1);
    for (uint32_t i = 0; i < directional; i++)
        assert_int_equal(scene->lights[i].kind, AG_LIGHT_DIRECTIONAL);
    assert_int_equal(scene->lights[directional].kind, ambient);
}

static void test_ambient(void **state)
{
    (void)state;
    ag_scene *scene = load("ambient-oren-nayar");
    assert_lights(scene, 1, AG_LIGHT_AMBIENT);
    assert_int_equal(only_material(scene)->diffuse, AG_DIFFUSE_OREN_NAYAR);
    assert_true(only_material(scene)->specular == 0);
    ag_scene_destroy(scene);
    scene = load("ambient-hemispheric");
    assert_lights(scene, 1, AG_LIGHT_HEMISPHERIC);
    assert_int_equal(only_material(scene)->diffuse, AG_DIFFUSE_LAMBERT);
    assert_true(scene->lights[1].direction[1] == 1); // its own axis, not the lamp's
    assert_true(scene->lights[0].direction[1] != -1);
    ag_scene_destroy(scene);
    scene = load("ambient-sh-blinn");
    assert_lights(scene, 4, AG_LIGHT_HARMONICS);
    assert_int_equal(only_material(scene)->distribution, AG_DISTRIBUTION_BLINN);
    for (size_t i = 1; i < 4; i++) // each lamp has its own colour
        assert_true(scene->lights[i].color[0] != scene->lights[0].color[0]);
    for (int term = 0; term < 4; term++) // y as well
        assert_true(scene->lights[4].harmonics[term][2] != 0);
    ag_scene_destroy(scene);
}

static void test_metals(void **state)
{
    (void)state;
    ag_scene *scene = load("metals");
    const char *name, *source;
    size_t count = 0;
    for (; ag_metal_info(count, &name, &source); count++) {
        ag_material_desc metal = ag_material_metal((ag_metal)count, 0);
        const ag_material_desc *shown = &scene->materials[scene->instances[count].material];
        for (int c = 0; c < 3; c++)
            assert_true(shown->base_color[c] == metal.base_color[c]);
    }
    assert_int_equal(scene->instances_count, count);
    ag_scene_destroy(scene);
}

static void test_looks(void **state)
{
    (void)state;
    ag_render_options options = { .width = 7 };
    assert_false(ag_demo_look("spheres", &options));
    assert_false(ag_demo_look("teapots", &options));
    assert_int_equal(options.tonemap, AG_TONEMAP_NEUTRAL);
    assert_true(ag_demo_look("grid", &options));
    assert_int_equal(options.tonemap, AG_TONEMAP_REINHARD);
    assert_int_equal(options.transfer, AG_TRANSFER_GAMMA_22);
    assert_int_equal(options.width, 7);
    assert_true(ag_demo_look("sphere-lights", &options));
    assert_int_equal(options.tonemap, AG_TONEMAP_ACES_NARKOWICZ);
    assert_int_equal(options.transfer, AG_TRANSFER_SRGB);
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
    assert_int_equal(ag_scene_load_demo(scene, "teapots", AG_LOOK_TEXT), AG_ERROR_ARGUMENT);
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
    assert_int_equal(ag_scene_load_demo(scene, "lights", AG_LOOK_TEXT), AG_OK);
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
        cmocka_unit_test(test_specular),
        cmocka_unit_test(test_sphere_lights),
        cmocka_unit_test(test_sun),
        cmocka_unit_test(test_ambient),
        cmocka_unit_test(test_metals),
        cmocka_unit_test(test_looks),
        cmocka_unit_test(test_corrected_looks_conserve_energy),
        cmocka_unit_test(test_sizes),
        cmocka_unit_test(test_furnace_is_white),
        cmocka_unit_test(test_unknown_name),
        cmocka_unit_test(test_demos_append),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
