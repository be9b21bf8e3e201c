// Named metals: their reflectance against published colours.
#include "helpers.h"

#include <argand/metal.h>

#include <string.h>

// Linear Rec. 709 at normal incidence: Unity's shader graph, "Metal Reflectance Node"
// (chromium, aluminium, gold, copper, nickel, platinum, cobalt, silver); Filament's "Material
// properties" (iron, titanium, brass: of measured films as ours; there are others); Adobe's
// "Metal material references" (palladium).  Other authors integrate other samples.
static const struct published {
    const char *name;
    float f0[3], tolerance;
} published[] = {
    { "chromium", { 0.550f, 0.556f, 0.554f }, 0.005f },
    { "aluminum", { 0.913f, 0.921f, 0.925f }, 0.01f },
    { "gold", { 1.000f, 0.766f, 0.336f }, 0.04f },
    { "copper", { 0.955f, 0.637f, 0.538f }, 0.03f },
    { "nickel", { 0.660f, 0.609f, 0.526f }, 0.04f },
    { "platinum", { 0.672f, 0.637f, 0.585f }, 0.01f },
    { "cobalt", { 0.662f, 0.655f, 0.634f }, 0.03f },
    { "silver", { 0.972f, 0.960f, 0.915f }, 0.07f },
    { "iron", { 0.527f, 0.509f, 0.491f }, 0.01f },
    { "titanium", { 0.617f, 0.578f, 0.539f }, 0.01f },
    { "brass", { 0.905f, 0.776f, 0.418f }, 0.01f },
    { "palladium", { 0.736f, 0.702f, 0.660f }, 0.01f },
};

static void test_reflectances_are_the_published_ones(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof published / sizeof published[0]; i++) {
        ag_metal metal;
        assert_true(ag_metal_by_name(published[i].name, &metal));
        ag_material_desc m = ag_material_metal(metal, 0.3f);
        for (int c = 0; c < 3; c++)
            assert_near(m.base_color[c], (double)published[i].f0[c],
                        (double)published[i].tolerance);
    }
}

// Adobe's "Metal material references", F82 tint.
static void test_tints_are_the_published_ones(void **state)
{
    (void)state;
    const struct {
        ag_metal metal;
        float tint[3];
    } tints[] = {
        { AG_METAL_CHROMIUM, { 0.7372f, 0.7511f, 0.8170f } },
        { AG_METAL_NICKEL, { 0.8134f, 0.8352f, 0.8725f } },
        { AG_METAL_COPPER, { 0.9755f, 0.9349f, 0.9301f } },
        { AG_METAL_SILVER, { 0.9929f, 0.9961f, 1.0000f } },
    };
    for (int i = 0; i < 4; i++) {
        ag_material_desc m = ag_material_metal(tints[i].metal, 0);
        for (int c = 0; c < 3; c++)
            assert_near(m.f82_tint[c], (double)tints[i].tint[c], 0.02);
    }
}

static void test_metals_are_found_by_name(void **state)
{
    (void)state;
    const char *name, *source;
    ag_metal metal;
    size_t count = 0;
    for (; ag_metal_info(count, &name, &source); count++) {
        assert_true(ag_metal_by_name(name, &metal));
        assert_int_equal(metal, count);
        assert_non_null(strstr(source, "19"));
    }
    assert_true(count >= 10);
    metal = AG_METAL_IRON;
    assert_false(ag_metal_by_name("unobtainium", &metal));
    assert_int_equal(metal, AG_METAL_IRON);
}

static void test_metals_are_materials(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    ag_material material;
    ag_material_desc gold = ag_material_metal(AG_METAL_GOLD, 0.25f);
    assert_int_equal(ag_scene_add_material(scene, &gold, &material), AG_OK);
    const ag_material_desc *m = &scene->materials[material.id];
    assert_true(m->metallic == 1.0f && m->roughness == 0.25f && m->fresnel == AG_FRESNEL_F82);
    ag_material_desc odd = ag_material_metal((ag_metal)99, 0);
    ag_material_desc aluminium = ag_material_metal(AG_METAL_ALUMINIUM, 0);
    assert_memory_equal(odd.base_color, aluminium.base_color, sizeof odd.base_color);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reflectances_are_the_published_ones),
        cmocka_unit_test(test_tints_are_the_published_ones),
        cmocka_unit_test(test_metals_are_found_by_name),
        cmocka_unit_test(test_metals_are_materials),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
