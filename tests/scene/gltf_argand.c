// Argand's own extensions: ARGAND_materials, ARGAND_cameras, the environment of ARGAND_lights.
#include "gltf_kit.h"

#include "image/image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- ARGAND_materials --------------------------------------------------------------------

static const char *with_material(const char *words)
{
    return kit_document(36, "", ",'material':0", "",
                        kit_json(",'materials':[{'extensions':{'ARGAND_materials':{%s}}}]", words));
}

static const ag_material_desc *material(kit *k, const char *words, unsigned warnings)
{
    kit_loads(k, with_material(words), kit_triangle, 36, warnings);
    return &k->scene->materials[1];
}

static void choices(void **state)
{
    kit *k = *state;
    const ag_material_desc *m = material(k, "", 0);
    const ag_material_desc assumed = ag_material_default();
    assert_memory_equal(m->conductor_n, assumed.conductor_n, sizeof m->conductor_n);
    assert_int_equal(m->diffuse, AG_DIFFUSE_LAMBERT);
    kit_near(m->shininess, 100, 0);
    m = material(k,
                 "'diffuse':'orenNayar','diffuseRoughness':1.5,'distribution':'blinn',"
                 "'shininess':7,'shadowing':'schlick','fresnel':'conductor',"
                 "'conductorN':[0.1,0.2,0.3],'conductorK':[1,2,3],'layering':'blend',"
                 "'reflectiveness':0.25,'singleBounce':true",
                 0);
    assert_int_equal(m->diffuse, AG_DIFFUSE_OREN_NAYAR);
    kit_near(m->diffuse_roughness, 1.5, 0);
    assert_int_equal(m->distribution, AG_DISTRIBUTION_BLINN);
    kit_near(m->shininess, 7, 0);
    assert_int_equal(m->shadowing, AG_SHADOWING_SCHLICK);
    assert_int_equal(m->fresnel, AG_FRESNEL_CONDUCTOR);
    kit_near(m->conductor_n[2], 0.3, 1e-7);
    kit_near(m->conductor_k[1], 2, 0);
    assert_int_equal(m->layering, AG_LAYERING_BLEND);
    kit_near(m->reflectiveness, 0.25, 0);
    assert_true(m->single_bounce);
    m = material(k, "'diffuse':'eon','fresnel':'f82','f82Tint':[0,0.5,1],'layering':'gltf'", 0);
    assert_int_equal(m->diffuse, AG_DIFFUSE_EON);
    assert_int_equal(m->fresnel, AG_FRESNEL_F82);
    kit_near(m->f82_tint[1], 0.5, 0);
    assert_int_equal(m->layering, AG_LAYERING_GLTF);
    assert_int_equal(material(k, "'layering':'fresnel'", 0)->layering, AG_LAYERING_FRESNEL);
}

static void bad_choices(void **state)
{
    static const struct {
        const char *words, *says;
    } cases[] = {
        { "'diffuse':'velvet'", "diffuse: \"velvet\" is not known; the default is \"lambert\"" },
        { "'fresnel':1", "fresnel: is not a string" },
        { "'shininess':[1]", "shininess: is not a number" },
        { "'conductorN':1", "conductorN: is not an array" },
        { "'conductorK':[1,2]", "conductorK: has 2 numbers instead of 3" },
        { "'singleBounce':'yes'", "singleBounce: is neither true nor false" },
    };
    kit *k = *state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        kit_fails(k, AG_ERROR_FORMAT, cases[i].says, with_material(cases[i].words), kit_triangle,
                  36);
    kit_near(material(k, "'conductorN':[0,1,1],'fresnel':'conductor'", 1)->conductor_n[0], 1e-3,
             1e-9);
    assert_non_null(strstr(k->said, "conductorN: 0 is taken as 0.001"));
}

// Primitives of the same accessors are one mesh, unless only one of them needs tangents.
static void shared_tangents(void **state)
{
    kit *k = *state;
    const char *two = ",'materials':[{},{'extensions':{'KHR_materials_anisotropy':"
                      "{'anisotropyStrength':0.5}}}],'nodes':[{'mesh':0},{'mesh':1}],"
                      "'scenes':[{'nodes':[0,1]}],'meshes':["
                      "{'primitives':[{'attributes':{'POSITION':0%s},'material':0}]},"
                      "{'primitives':[{'attributes':{'POSITION':0%s},'material':1}]}]";
    const char *given = ",'NORMAL':0,'TANGENT':1";
    const char *rest = "{'asset':{'version':'2.0'},'buffers':[{'byteLength':84}],'bufferViews':["
                       "{'buffer':0,'byteLength':36},{'buffer':0,'byteOffset':36,'byteLength':48}],"
                       "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3},"
                       "{'bufferView':1,'componentType':5126,'type':'VEC4','count':3}]%s}";
    float bytes[21] = { 0 };
    memcpy(bytes, kit_triangle, 36);
    for (int i = 0; i < 3; i++)
        bytes[9 + 4 * i] = bytes[12 + 4 * i] = 1;
    kit_loads(k, kit_json(rest, kit_json(two, "", "")), bytes, sizeof bytes, 0);
    assert_int_equal(k->scene->meshes_count, 2);
    kit_loads(k, kit_json(rest, kit_json(two, given, given)), bytes, sizeof bytes, 0);
    assert_int_equal(k->scene->meshes_count, 1);
}

// ---- ARGAND_cameras ----------------------------------------------------------------------

// Of a node at (0, 0, 5) that looks along -Z.
static const ag_camera_desc *camera(kit *k, const char *words, const char *node)
{
    const char *json = kit_json(
        "{'asset':{'version':'2.0'},'scenes':[{'nodes':[0,1]}],'nodes':[{'mesh':0},"
        "{'camera':0,'translation':[0,0,5]%s}],'cameras':[{'type':'perspective','perspective':"
        "{'yfov':0.5,'znear':0.1,'zfar':10},'extensions':{'ARGAND_cameras':{%s}}}],"
        "'buffers':[{'byteLength':36}],'bufferViews':[{'buffer':0,'byteLength':36}],"
        "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3}],"
        "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}]}",
        node, words);
    kit_loads(k, json, kit_triangle, 36, 0);
    return k->scene->cameras;
}

static void is(const float vector[3], double x, double y, double z)
{
    kit_near(vector[0], x, 1e-6);
    kit_near(vector[1], y, 1e-6);
    kit_near(vector[2], z, 1e-6);
}

static void targets(void **state)
{
    const char *words = "'target':[0,0,1],'up':[0,2,7],'fitNear':true,'fitFar':true";
    kit *k = *state;
    const ag_camera_desc *c = camera(k, "", "");
    is(c->target, 0, 0, 4);
    kit_near(c->near_m, 0.1, 1e-8);
    c = camera(k, words, "");
    is(c->target, 0, 0, 1);
    is(c->up, 0, 2, 7);
    kit_near(c->near_m, 0, 0);
    kit_near(c->far_m, 0, 0);
    // Turned since by another program: about X, about its line of sight, and half round.
    is(camera(k, words, ",'rotation':[0.1,0,0,1]")->up, 0, 0.980198, 0.19802);
    is(camera(k, words, ",'rotation':[0,0,0.1,1]")->up, -0.19802, 0.980198, 0);
    is(camera(k, words, ",'rotation':[0,0,1,0]")->up, 0, -1, 0);
    is(camera(k, words, ",'rotation':[0,1,0,0]")->target, 0, 0, 6);
    c = camera(k, "'target':[0,0,1]", "");
    is(c->target, 0, 0, 1);
    is(c->up, 0, 1, 0);
}

// ---- The environment ---------------------------------------------------------------------

static const char *with_environment(const char *words)
{
    return kit_document(36, "", "", "",
                        kit_json(",'extensions':{'ARGAND_lights':{'environment':{%s}}}", words));
}

static void environment_kinds(void **state)
{
    static const char *const words[] = { "studio", "sky", "none" };
    static const ag_environment_kind kinds[] = { AG_ENVIRONMENT_STUDIO, AG_ENVIRONMENT_SKY,
                                                 AG_ENVIRONMENT_NONE };
    kit *k = *state;
    for (int i = 0; i < 3; i++) {
        char json[200];
        strcpy(json, kit_json("'type':'%s','rotation':-0.5,'intensity':3", words[i]));
        kit_loads(k, with_environment(json), kit_triangle, 36, 0);
        assert_int_equal(k->scene->environment_kind, kinds[i]);
        kit_near(k->scene->environment_rotation_rad, -0.5, 0);
        kit_near(k->scene->environment_intensity, 3, 0);
    }
}

static void save_image(const kit *k, const char *name, ag_format format)
{
    const ag_image_desc desc = { 4, 2, format, NULL };
    ag_image *image;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    assert_int_equal(ag_image_save(NULL, image, kit_path(k, name), NULL), AG_OK);
    ag_image_destroy(image);
}

static void environment_images(void **state)
{
    kit *k = *state;
    save_image(k, "sky.exr", AG_FORMAT_RGBA32F);
    save_image(k, "sky.hdr", AG_FORMAT_RGBA32F);
    save_image(k, "sky.png", AG_FORMAT_RGBA8);
    kit_loads(k, with_environment("'type':'image','uri':'sky.exr'"), kit_triangle, 36, 0);
    assert_int_equal(ag_image_width(k->scene->environment), 4);
    kit_loads(k, with_environment("'type':'image','uri':'sky.hdr'"), kit_triangle, 36, 0);
    kit_fails(k, AG_ERROR_UNSUPPORTED, "environment: its image is neither Radiance HDR nor OpenEXR",
              with_environment("'type':'image','uri':'sky.png'"), kit_triangle, 36);
    assert_int_equal(k->scene->environment_kind, AG_ENVIRONMENT_STUDIO);
}

static void bad_environments(void **state)
{
    static const struct {
        const char *words, *says;
    } cases[] = {
        { "", "environment.type: is missing" },
        { "'type':'fog'", "type: \"fog\" is not a kind of environment" },
        { "'type':'image'", "environment: has neither a uri nor a bufferView" },
        { "'type':'image','bufferView':9", "bufferView: 9 is not one of the 1 buffer views" },
        { "'type':'image','bufferView':0", "environment" },
        { "'type':'sky','rotation':'east'", "rotation: is not a number" },
    };
    kit *k = *state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_int_not_equal(kit_load_glb(k, with_environment(cases[i].words), kit_triangle, 36),
                             AG_OK);
        if (k->errors != 1 || !strstr(k->said, cases[i].says))
            fail_msg("wanted \"%s\", said: %s", cases[i].says, k->said);
    }
    assert_int_equal(
        kit_load_glb(k, with_environment("'type':'image','uri':'../x.exr'"), kit_triangle, 36),
        AG_ERROR_FORMAT);
    // Of a file that cannot be read nothing stays.
    kit_fails(k, AG_ERROR_FORMAT, "must have either ev100 or factor",
              kit_document(36, "", "", "",
                           ",'extensions':{'ARGAND_lights':{'exposure':{},'environment':"
                           "{'type':'sky'}}}"),
              kit_triangle, 36);
    assert_int_equal(k->scene->environment_kind, AG_ENVIRONMENT_STUDIO);
}

static bool stop_at_the_end(void *user, const char *stage, double fraction)
{
    (void)user;
    return strcmp(stage, "load") != 0 || fraction < 1;
}

// Cancelled at the last moment the scene is what it was.
static void cancelled(void **state)
{
    kit *k = *state;
    kit_loads(k,
              kit_document(36, "", "", "",
                           ",'extensions':{'ARGAND_lights':{'exposure':{'factor':5},"
                           "'environment':{'type':'sky'}}}"),
              kit_triangle, 36, 0);
    const ag_load_options options = { .progress = { .update = stop_at_the_end } };
    assert_int_equal(kit_load_path(k, kit_path(k, "model.glb"), &options), AG_ERROR_CANCELLED);
    assert_int_equal(k->scene->environment_kind, AG_ENVIRONMENT_STUDIO);
    kit_near(ag_scene_exposure(k->scene), 1, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(choices),           cmocka_unit_test(bad_choices),
        cmocka_unit_test(shared_tangents),   cmocka_unit_test(targets),
        cmocka_unit_test(environment_kinds), cmocka_unit_test(environment_images),
        cmocka_unit_test(bad_environments),  cmocka_unit_test(cancelled),
    };
    return cmocka_run_group_tests(tests, kit_setup, kit_teardown);
}
