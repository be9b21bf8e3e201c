// Nodes, scenes and cameras.
#include "gltf_kit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A document of nodes over one mesh, the triangle.
static const char *with_nodes(const char *nodes, const char *more)
{
    return kit_json("{'asset':{'version':'2.0'},"
                    "'nodes':[%s],'buffers':[{'byteLength':36}],"
                    "'bufferViews':[{'buffer':0,'byteLength':36}],"
                    "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3}],"
                    "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}]%s}",
                    nodes, more);
}

static void loads(kit *k, const char *nodes, const char *more, unsigned warnings)
{
    kit_loads(k, with_nodes(nodes, more), kit_triangle, 36, warnings);
}

static void fails(kit *k, const char *part, const char *nodes, const char *more)
{
    kit_fails(k, AG_ERROR_FORMAT, part, with_nodes(nodes, more), kit_triangle, 36);
}

static void check_world(const kit *k, size_t instance, const double expected[16])
{
    for (int i = 0; i < 16; i++)
        kit_near(k->scene->instances[instance].world[i], expected[i], 1e-6);
}

static void hierarchy(void **state)
{
    kit *k = *state;
    // Turn x to y about z, scale by (2, 3, 4), move; then a child moved along its x.
    loads(k,
          "{'mesh':0,'children':[1],'rotation':[0,0,0.70710678118,0.70710678118],"
          "'scale':[2,3,4],'translation':[10,20,30]},{'mesh':0,'translation':[1,0,0]}",
          ",'scenes':[{'nodes':[0]}]", 0);
    check_world(k, 0, (double[]) { 0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 10, 20, 30, 1 });
    check_world(k, 1, (double[]) { 0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 10, 22, 30, 1 });
    // A matrix goes as it is; the child's comes first in the list.
    loads(k,
          "{'mesh':0,'scale':[1,1,-1]},"
          "{'children':[0],'matrix':[1,2,3,0, 4,5,6,0, 7,8,10,0, 11,12,13,1]}",
          ",'scenes':[{'nodes':[1]}]", 0);
    check_world(k, 0, (double[]) { 1, 2, 3, 0, 4, 5, 6, 0, -7, -8, -10, 0, 11, 12, 13, 1 });
}

static void scenes(void **state)
{
    kit *k = *state;
    const char *nodes = "{'mesh':0},{'mesh':0,'translation':[1,0,0]},{'children':[1]}";
    const char *two = ",'scenes':[{'nodes':[0,0]},{'nodes':[2,2]}]%s";
    loads(k, nodes, kit_json(two, ""), 0);
    assert_int_equal(k->scene->instances_count, 1);
    kit_near(k->scene->instances[0].world[12], 0, 0);
    loads(k, nodes, kit_json(two, ",'scene':1"), 0);
    assert_int_equal(k->scene->instances_count, 1);
    kit_near(k->scene->instances[0].world[12], 1, 0);
    // No scene at all: every root, and a warning.
    loads(k, nodes, "", 1);
    assert_non_null(strstr(k->said, "the file has no scene"));
    assert_int_equal(k->scene->instances_count, 2);
    // The caller's choice counts from 1 and goes before the file's.
    loads(k, nodes, kit_json(two, ",'scene':1"), 0);
    ag_load_options options = { .scene = 1 };
    assert_int_equal(kit_load_path(k, kit_path(k, "model.glb"), &options), AG_OK);
    kit_near(k->scene->instances[0].world[12], 0, 0);
    options.scene = 3;
    assert_int_equal(kit_load_path(k, kit_path(k, "model.glb"), &options), AG_ERROR_ARGUMENT);
    assert_non_null(strstr(k->said, "there is no scene 3 among 2"));
    fails(k, "scene: 2 is not one of the 2 scenes", nodes, kit_json(two, ",'scene':2"));
    fails(k, "scenes[0].nodes[0]: 3 is not one of the 3 nodes", nodes, ",'scenes':[{'nodes':[3]}]");
    loads(k, nodes, ",'scenes':[{}]", 1); // a scene of nothing
    assert_non_null(strstr(k->said, "no surface in it"));
}

static void two_loads_append(void **state)
{
    kit *k = *state;
    loads(k, "{'mesh':0}", ",'scenes':[{'nodes':[0]}]", 0);
    assert_int_equal(ag_scene_load(k->scene, kit_path(k, "model.glb"), NULL), AG_OK);
    assert_int_equal(k->scene->instances_count, 2);
    assert_int_equal(k->scene->instances[1].mesh, 1);
    kit_write_text(k, "broken.gltf", "{}");
    assert_int_equal(ag_scene_load(k->scene, kit_path(k, "broken.gltf"), NULL), AG_ERROR_FORMAT);
    assert_int_equal(k->scene->instances_count, 2);
}

static void bad_hierarchies(void **state)
{
    kit *k = *state;
    const char *scene = ",'scenes':[{'nodes':[0]}]";
    fails(k, "nodes[0]: is its own ancestor", "{'mesh':0,'children':[0]}", scene);
    fails(k, "nodes[1]: is its own ancestor", "{},{'children':[2]},{'children':[1]}", scene);
    fails(k, "nodes[1].children[0]: nodes[2] is a child of nodes[0] already",
          "{'children':[2]},{'children':[2]},{}", scene);
    fails(k, "nodes[0].children[1]: nodes[1] is a child of nodes[0] already",
          "{'children':[1,1]},{}", scene);
    fails(k, "nodes[0].children[0]: 7 is not one of the 1 nodes", "{'children':[7]}", scene);
    fails(k, "nodes[0].children: is not an array", "{'children':{}}", scene);
    fails(k, "nodes[0].mesh: 1 is not one of the 1 meshes", "{'mesh':1}", scene);
    fails(k, "nodes[0].matrix: has 3 numbers instead of 16", "{'matrix':[1,2,3]}", scene);
    fails(k, "nodes[0].matrix[2]: is not a number",
          "{'matrix':[1,2,'x',0,0,1,0,0,0,0,1,0,0,0,0,1]}", scene);
    fails(k, "nodes[0].matrix: its last row", "{'matrix':[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]}",
          scene);
    fails(k, "nodes[0].translation[1]: 1e+300 is too large", "{'translation':[0,1e300,0]}", scene);
    fails(k, "nodes[1]: its place in the world is beyond",
          "{'children':[1],'scale':[1e12,1e12,1e12]},{'scale':[1e12,1e12,1e12]}", scene);
    fails(k, "nodes[0].skin: 0 is not one of the 0 skins", "{'skin':0}", scene);
}

static void degenerate_transforms(void **state)
{
    kit *k = *state;
    const char *scene = ",'scenes':[{'nodes':[0,1]}]";
    loads(k, "{'mesh':0,'scale':[0,0,0]},{'mesh':0}", scene, 0); // scale 0 hides
    assert_int_equal(k->scene->instances_count, 1);
    loads(k, "{'mesh':0,'scale':[1,1,0]},{'mesh':0}", scene, 0); // flat, but there
    assert_int_equal(k->scene->instances_count, 2);
    loads(k, "{'mesh':0,'rotation':[0,0,0,0]},{'mesh':0}", scene, 1);
    check_world(k, 0, (double[]) { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 });
    loads(k, "{'mesh':0,'rotation':[0,0,5,5]},{'mesh':0}", scene, 0); // not unit
    check_world(k, 0, (double[]) { 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 });
}

// Each node the child of the one before, and all side by side, each 10,000.
static void ten_thousand_nodes(void **state)
{
    kit *k = *state;
    enum { COUNT = 10000 };
    char *text = malloc(COUNT * 80 + 1000);
    for (int deep = 0; deep < 2; deep++) {
        size_t used = (size_t)sprintf(
            text, "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":36}],"
                  "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"accessors\":[{"
                  "\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\",\"count\":3}],"
                  "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
                  "\"scenes\":[{\"nodes\":[0");
        for (int i = 1; !deep && i < COUNT; i++)
            used += (size_t)sprintf(text + used, ",%d", i);
        used += (size_t)sprintf(text + used, "]}],\"nodes\":[");
        for (int i = 0; i < COUNT; i++) {
            used +=
                (size_t)sprintf(text + used, "%s{\"mesh\":0,\"translation\":[1,0,0]", i ? "," : "");
            if (deep && i + 1 < COUNT)
                used += (size_t)sprintf(text + used, ",\"children\":[%d]", i + 1);
            used += (size_t)sprintf(text + used, "}");
        }
        sprintf(text + used, "]}");
        kit_loads(k, text, kit_triangle, 36, 0);
        assert_int_equal(k->scene->instances_count, COUNT);
        assert_int_equal(k->scene->meshes_count, 1);
        kit_near(k->scene->instances[COUNT - 1].world[12], deep ? COUNT : 1, 0);
    }
    free(text);
}

static void cameras(void **state)
{
    kit *k = *state;
    loads(k,
          "{'camera':0,'name':'node','rotation':[0,0.70710678118,0,0.70710678118],"
          "'translation':[1,2,3],'scale':[4,4,4]},{'camera':1,'name':'above'},{'mesh':0}",
          ",'scenes':[{'nodes':[0,1,2]}],'cameras':["
          "{'type':'perspective','name':'front','perspective':"
          "{'yfov':0.8,'znear':0.1,'zfar':50,'aspectRatio':2}},"
          "{'type':'orthographic','orthographic':{'xmag':2,'ymag':3,'znear':0,'zfar':9}}]",
          0);
    ag_camera_desc c;
    assert_true(ag_scene_camera(k->scene, 0, &c));
    assert_string_equal(c.name, "front");
    // A quarter turn about y takes -z to -x.
    const double position[3] = { 1, 2, 3 }, direction[3] = { -1, 0, 0 }, up[3] = { 0, 1, 0 };
    for (int i = 0; i < 3; i++) {
        kit_near(c.position[i], position[i], 1e-6);
        kit_near(c.target[i] - c.position[i], direction[i], 1e-6);
        kit_near(c.up[i], up[i], 1e-6);
    }
    kit_near(c.fov_y_rad, 0.8, 1e-6);
    kit_near(c.near_m, 0.1, 1e-6);
    kit_near(c.far_m, 50, 1e-6);
    kit_near(c.height_m, 0, 0);
    assert_true(ag_scene_camera(k->scene, 1, &c));
    assert_string_equal(c.name, "above");
    kit_near(c.height_m, 6, 1e-6);
    kit_near(c.target[2], -1, 1e-6);
}

static void bad_cameras(void **state)
{
    static const struct {
        const char *camera, *says;
    } cases[] = {
        { "{}", "cameras[0].type: is missing" },
        { "{'type':'fisheye'}", "cameras[0].type: \"fisheye\" is not" },
        { "{'type':'perspective'}", "cameras[0].perspective.yfov: is missing" },
        { "{'type':'perspective','perspective':{'yfov':4}}", "yfov: 4 is not between" },
        { "{'type':'perspective','perspective':{'yfov':1,'znear':2,'zfar':1}}", "zfar: must be" },
        { "{'type':'orthographic','orthographic':{'ymag':0}}", "ymag: must not be zero" },
    };
    kit *k = *state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        fails(k, cases[i].says, "{'camera':0}",
              kit_json(",'scenes':[{'nodes':[0]}],'cameras':[%s]", cases[i].camera));
}

// The nearest name counts: a node's before its mesh's, a light's own before its node's.
static void names(void **state)
{
    kit *k = *state;
    kit_loads(
        k,
        kit_json("{'asset':{'version':'2.0'},'scenes':[{'nodes':[0,1,2,3]}],"
                 "'nodes':[{'mesh':0,'name':'wheel'},{'mesh':0},"
                 "{'name':'node','extensions':{'KHR_lights_punctual':{'light':0}}},"
                 "{'name':'node','extensions':{'KHR_lights_punctual':{'light':1}}}],"
                 "'buffers':[{'byteLength':36}],'bufferViews':[{'buffer':0,'byteLength':36}],"
                 "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3}],"
                 "'materials':[{'name':'rubber'}],'meshes':[{'name':'round',"
                 "'primitives':[{'attributes':{'POSITION':0},'material':0}]}],"
                 "'extensionsUsed':['KHR_lights_punctual'],'extensions':{'KHR_lights_punctual':"
                 "{'lights':[{'type':'point','name':'lamp'},{'type':'point'}]}}}"),
        kit_triangle, 36, 0);
    const char *const instances[] = { "wheel", "round" }, *const lights[] = { "lamp", "node" };
    for (size_t i = 0; i < 2; i++) {
        ag_instance_info instance;
        ag_light_desc light;
        assert_true(ag_scene_instance(k->scene, i, &instance));
        assert_true(ag_scene_light(k->scene, i, &light));
        assert_string_equal(instance.name, instances[i]);
        assert_string_equal(light.name, lights[i]);
    }
    ag_material_desc material;
    assert_true(ag_scene_material(k->scene, 0, &material));
    assert_string_equal(material.name, "rubber");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hierarchy),
        cmocka_unit_test(scenes),
        cmocka_unit_test(two_loads_append),
        cmocka_unit_test(bad_hierarchies),
        cmocka_unit_test(degenerate_transforms),
        cmocka_unit_test(ten_thousand_nodes),
        cmocka_unit_test(cameras),
        cmocka_unit_test(bad_cameras),
        cmocka_unit_test(names),
    };
    return cmocka_run_group_tests(tests, kit_setup, kit_teardown);
}
