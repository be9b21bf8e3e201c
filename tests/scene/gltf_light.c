// Lights: KHR_lights_punctual with its extras, EXT_lights_area, ARGAND_lights.
#include "gltf_kit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// A document of nodes over one mesh, the triangle; the scene is node 0.
static const char *document(const char *nodes, const char *extensions)
{
    return kit_json("{'asset':{'version':'2.0'},'scenes':[{'nodes':[0]}],"
                    "'nodes':[%s],'buffers':[{'byteLength':36}],"
                    "'bufferViews':[{'buffer':0,'byteLength':36}],"
                    "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3}],"
                    "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],"
                    "'extensionsUsed':['KHR_lights_punctual','EXT_lights_area','ARGAND_lights'],"
                    "'extensions':{%s}}",
                    nodes, extensions);
}

static void loads(kit *k, const char *nodes, const char *extensions, unsigned warnings)
{
    kit_loads(k, document(nodes, extensions), kit_triangle, 36, warnings);
}

static void fails(kit *k, const char *part, const char *nodes, const char *extensions)
{
    kit_fails(k, AG_ERROR_FORMAT, part, document(nodes, extensions), kit_triangle, 36);
}

static const char *list(const char *extension, const char *lights)
{
    return kit_json("'%s':{'lights':[%s]}", extension, lights);
}

static const char *punctual(const char *lights)
{
    return list("KHR_lights_punctual", lights);
}

// A node with the mesh and light 0 of an extension, moved to (1, 2, 3).
static const char *node(const char *extension, const char *more)
{
    return kit_json("{'mesh':0,'translation':[1,2,3],'extensions':{'%s':{'light':0}}%s}", extension,
                    more);
}

static const ag_light_desc *only(const kit *k, ag_light_kind kind)
{
    assert_int_equal(k->scene->lights_count, 1);
    assert_int_equal(k->scene->lights[0].kind, kind);
    return k->scene->lights;
}

static void is(const float vector[3], double x, double y, double z)
{
    const double expected[3] = { x, y, z };
    for (int i = 0; i < 3; i++)
        kit_near(vector[i], expected[i], 1e-6);
}

static void kinds(void **state)
{
    kit *k = *state;
    const char *nodes = "{'mesh':0,'children':[1,2,3,4]},"
                        "{'translation':[1,2,3],'extensions':{'KHR_lights_punctual':{'light':0}}},"
                        "{'rotation':[-0.70710678118,0,0,0.70710678118],"
                        "'extensions':{'KHR_lights_punctual':{'light':1}}},"
                        "{'extensions':{'KHR_lights_punctual':{'light':2}}},"
                        "{'extensions':{'KHR_lights_punctual':{'light':3}}}";
    loads(k, nodes,
          punctual("{'type':'point','color':[1,0.5,0.25],'intensity':100,'range':7},"
                   "{'type':'directional','intensity':3},"
                   "{'type':'spot','spot':{'innerConeAngle':0.2,'outerConeAngle':0.4}},"
                   "{'type':'point','color':[0,0,0]}"),
          0);
    assert_int_equal(k->scene->lights_count, 3); // a black one gives no light
    const ag_light_desc *l = k->scene->lights;
    assert_int_equal(l[0].kind, AG_LIGHT_POINT);
    for (int i = 0; i < 3; i++)
        kit_near(l[0].position[i], i + 1, 0);
    kit_near(l[0].color[2], 0.25, 0);
    kit_near(l[0].intensity, 100, 0);
    kit_near(l[0].range_m, 7, 0);
    assert_int_equal(l[1].kind, AG_LIGHT_DIRECTIONAL);
    kit_near(l[1].direction[1], -1, 1e-6); // from above
    kit_near(l[1].intensity, 3, 0);
    kit_near(l[1].color[0], 1, 0);
    assert_int_equal(l[2].kind, AG_LIGHT_SPOT);
    kit_near(l[2].direction[2], -1, 1e-6);
    kit_near(l[2].cone_inner_rad, 0.2, 1e-6);
    kit_near(l[2].cone_outer_rad, 0.4, 1e-6);
    kit_near(l[2].intensity, 1, 0);
    kit_near(l[2].range_m, 0, 0);
    loads(k, "{'mesh':0,'extensions':{'KHR_lights_punctual':{'light':0}}}",
          punctual("{'type':'spot','spot':{}}"), 0);
    kit_near(k->scene->lights[0].cone_inner_rad, 0, 0);
    kit_near(k->scene->lights[0].cone_outer_rad, 0.78539816, 1e-6);
}

static void bad_kinds(void **state)
{
    kit *k = *state;
    const char *node = "{'mesh':0,'extensions':{'KHR_lights_punctual':{'light':0}}}";
    fails(k, "KHR_lights_punctual.light: 0 is not one of the 0 lights", node, punctual(""));
    fails(k, "lights[0].type: is missing", node, punctual("{}"));
    fails(k, "lights[0].type: \"area\" is not a kind", node, punctual("{'type':'area'}"));
    fails(k, "color: has 2 numbers instead of 3", node, punctual("{'type':'point','color':[1,1]}"));
    // Out of range: kept within, and said so.
    loads(k, node, punctual("{'type':'point','intensity':-5}"), 1);
    assert_non_null(strstr(k->said, "lights[0].intensity: -5 is taken as 0"));
}

// A point light with a radius is a sphere, a directional one with an angle a sun.
static void extras(void **state)
{
    kit *k = *state;
    char at[256];
    strcpy(at, node("KHR_lights_punctual", ",'scale':[3,3,3]"));
    loads(k, at, punctual("{'type':'point','intensity':7,'range':9,'extras':{'radius':0.25}}"), 0);
    const ag_light_desc *l = only(k, AG_LIGHT_SPHERE);
    kit_near(l->radius_m, 0.25, 0); // whatever the scale
    kit_near(l->intensity, 7, 0);
    kit_near(l->range_m, 9, 0);
    is(l->position, 1, 2, 3);
    loads(k, at, punctual("{'type':'directional','extras':{'angularRadius':0.1,'radius':5}}"), 0);
    l = only(k, AG_LIGHT_SUN);
    kit_near(l->angular_radius_rad, 0.1, 1e-7);
    is(l->direction, 0, 0, -1);
    loads(k, at, punctual("{'type':'point','extras':{'radius':0,'angularRadius':'x'}}"), 0);
    only(k, AG_LIGHT_POINT);
    loads(k, at, punctual("{'type':'spot','extras':{'radius':0.5}}"), 1);
    only(k, AG_LIGHT_SPOT);
    assert_non_null(strstr(k->said, "lights[0]: a spot light has no radius; it is ignored"));
    loads(k, at, punctual("{'type':'point','extras':[1,2]}"), 0);
    only(k, AG_LIGHT_POINT);
}

// Extras are free for all: what cannot be meant leaves the light as it was.
static void silly_extras(void **state)
{
    static const char *const radii[] = { "'big'", "-1", "1e39", "[1]", "null", "true" };
    static const char *const angles[] = { "1.6", "-0.1", "{}" };
    kit *k = *state;
    const char *says = "extras.%s: is no size that a light can have; it is ignored";
    for (size_t i = 0; i < sizeof radii / sizeof *radii; i++) {
        loads(k, node("KHR_lights_punctual", ""),
              punctual(kit_json("{'type':'point','extras':{'radius':%s}}", radii[i])), 1);
        only(k, AG_LIGHT_POINT);
        assert_non_null(strstr(k->said, kit_json(says, "radius")));
    }
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        loads(k, node("KHR_lights_punctual", ""),
              punctual(kit_json("{'type':'directional','extras':{'angularRadius':%s}}", angles[i])),
              1);
        only(k, AG_LIGHT_DIRECTIONAL);
        assert_non_null(strstr(k->said, kit_json(says, "angularRadius")));
    }
}

static void area(void **state)
{
    kit *k = *state;
    // The draft: width = world scale * size * aspect, height = world scale * size; the scale is
    // the largest.  A quarter turn about x takes -z to y and y to z.
    const char *turned = ",'rotation':[0.70710678118,0,0,0.70710678118],'scale':[1,-4,2]";
    loads(k, node("EXT_lights_area", turned),
          list("EXT_lights_area", "{'type':'rect','size':0.5,'rect':{'aspect':3},'intensity':20,"
                                  "'color':[1,0.5,0]}"),
          0);
    const ag_light_desc *l = only(k, AG_LIGHT_RECT);
    kit_near(l->width_m, 6, 1e-6);
    kit_near(l->height_m, 2, 1e-6);
    kit_near(l->intensity, 20, 0);
    is(l->position, 1, 2, 3);
    is(l->direction, 0, 1, 0);
    is(l->up, 0, 0, -1); // mirrored; a rectangle is the same either way
    is(l->color, 1, 0.5, 0);
    loads(k, node("EXT_lights_area", ",'scale':[2,1,1]"),
          list("EXT_lights_area", "{'type':'disk','size':3}"), 0);
    l = only(k, AG_LIGHT_DISK);
    kit_near(l->radius_m, 3, 1e-6); // size is the diameter
    kit_near(l->intensity, 1000, 0);
    is(l->direction, 0, 0, -1);
    is(l->color, 1, 1, 1);
    loads(k, node("EXT_lights_area", ""), list("EXT_lights_area", "{'type':'rect'}"), 0);
    l = only(k, AG_LIGHT_RECT);
    kit_near(l->width_m, 1, 0);
    kit_near(l->height_m, 1, 0);
    char at[256];
    strcpy(at, node("EXT_lights_area", ""));
    fails(k, "EXT_lights_area.lights[0].type: is missing", at, list("EXT_lights_area", "{}"));
    fails(k, "type: \"sphere\" is not a kind", at, list("EXT_lights_area", "{'type':'sphere'}"));
    fails(k, "size: is not a number", at, list("EXT_lights_area", "{'type':'disk','size':[1]}"));
    fails(k, "rect: is not an object", at, list("EXT_lights_area", "{'type':'rect','rect':2}"));
    fails(k, "EXT_lights_area.light: 0 is not one of the 0 lights", at,
          list("EXT_lights_area", ""));
    // The sizes of a huge one stay finite.
    loads(k, node("EXT_lights_area", ",'scale':[1e17,1,1]"),
          list("EXT_lights_area", "{'type':'rect','size':3e38,'rect':{'aspect':3e38}}"), 0);
    assert_true(isfinite(only(k, AG_LIGHT_RECT)->width_m));
}

static const char *own(const char *light)
{
    return list("ARGAND_lights", light);
}

static void own_kinds(void **state)
{
    kit *k = *state;
    // A quarter turn about z takes x to y and y to -x.
    char at[256];
    strcpy(at,
           node("ARGAND_lights", ",'rotation':[0,0,0.70710678118,0.70710678118],'scale':[5,5,5]"));
    loads(k, at,
          own("{'type':'sphere','radius':0.5,'intensity':8,'range':3,'color':[0,1,0],"
              "'hidden':true}"),
          0);
    const ag_light_desc *l = only(k, AG_LIGHT_SPHERE);
    kit_near(l->radius_m, 0.5, 0);
    kit_near(l->intensity, 8, 0);
    kit_near(l->range_m, 3, 0);
    assert_true(l->hidden);
    is(l->position, 1, 2, 3);
    is(l->color, 0, 1, 0);
    loads(k, at, own("{'type':'tube','radius':0.1,'length':2}"), 0);
    l = only(k, AG_LIGHT_TUBE);
    kit_near(l->length_m, 2, 0);
    kit_near(l->radius_m, 0.1, 1e-7);
    kit_near(l->intensity, 1, 0);
    assert_false(l->hidden);
    is(l->direction, 0, 1, 0);
    loads(k, at, own("{'type':'rect','width':3,'height':2,'range':9,'hidden':true}"), 0);
    l = only(k, AG_LIGHT_RECT);
    kit_near(l->width_m, 3, 0); // whatever the scale
    kit_near(l->height_m, 2, 0);
    kit_near(l->range_m, 9, 0);
    assert_true(l->hidden);
    is(l->up, -1, 0, 0);
    loads(k, at, own("{'type':'disk','radius':3}"), 0);
    kit_near(only(k, AG_LIGHT_DISK)->radius_m, 3, 0);
    loads(k, at, own("{'type':'sun','angularRadius':0.2}"), 0);
    kit_near(only(k, AG_LIGHT_SUN)->angular_radius_rad, 0.2, 1e-7);
    is(k->scene->lights[0].direction, 0, 0, -1);
    loads(k, at, own("{'type':'sun'}"), 0);
    kit_near(only(k, AG_LIGHT_SUN)->angular_radius_rad, 0.00465, 1e-7);
    loads(k, at, own("{'type':'ambient','intensity':4}"), 0);
    kit_near(only(k, AG_LIGHT_AMBIENT)->intensity, 4, 0);
    loads(k, at, own("{'type':'hemispheric','color':[0,0,0],'groundColor':[1,0.5,0.25]}"), 0);
    l = only(k, AG_LIGHT_HEMISPHERIC);
    is(l->direction, -1, 0, 0);
    is(l->color, 0, 0, 0); // black, not white
    is(l->ground_color, 1, 0.5, 0.25);
    loads(k, at, own("{'type':'harmonics','terms':[[1,2,3],[4,5,6],[7,8,9],[-1,-2,-3]]}"), 0);
    l = only(k, AG_LIGHT_HARMONICS);
    is(l->harmonics[0], 1, 2, 3);
    is(l->harmonics[3], -1, -2, -3);
    is(l->harmonics[4], 0, 0, 0);
}

static void bad_own_kinds(void **state)
{
    static const struct {
        const char *light, *says;
    } cases[] = {
        { "{}", "ARGAND_lights.lights[0].type: is missing" },
        { "{'type':'point'}", "type: \"point\" is not a kind of light" },
        { "{'type':'sphere'}", "radius: is missing" },
        { "{'type':'tube','radius':1}", "length: is missing" },
        { "{'type':'rect','width':1}", "height: is missing" },
        { "{'type':'disk'}", "radius: is missing" },
        { "{'type':'sphere','radius':'1'}", "radius: is not a number" },
        { "{'type':'sphere','radius':1,'hidden':1}", "hidden: is neither true nor false" },
        { "{'type':'harmonics'}", "terms: is missing" },
        { "{'type':'harmonics','terms':[]}", "terms: has 0 items instead of 4 or 9" },
        { "{'type':'harmonics','terms':[1,2,3,4]}", "terms[0]: is not an array of 3 numbers" },
        { "{'type':'harmonics','terms':[[1,2],0,0,0]}", "terms[0]: is not an array of 3 numbers" },
        { "{'type':'harmonics','terms':[[1,2,{}],0,0,0]}", "terms[0][2]: is not a number" },
    };
    kit *k = *state;
    char at[256];
    strcpy(at, node("ARGAND_lights", ""));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        fails(k, cases[i].says, at, own(cases[i].light));
    loads(k, at, own("{'type':'sun','angularRadius':2}"), 1); // the whole sky
    assert_non_null(strstr(k->said, "angularRadius: 2 is taken as 1.57064"));
}

// Beside one of Argand's own KHR_lights_punctual is for those who cannot read it.
static void own_goes_before(void **state)
{
    kit *k = *state;
    const char *lists =
        kit_json("%s,%s,%s", punctual("{'type':'point'}"),
                 list("EXT_lights_area", "{'type':'disk'}"), own("{'type':'sphere','radius':1}"));
    loads(k,
          "{'mesh':0,'extensions':{'ARGAND_lights':{'light':0},'KHR_lights_punctual':{'light':0},"
          "'EXT_lights_area':{'light':0}}}",
          lists, 0);
    only(k, AG_LIGHT_SPHERE);
    loads(k,
          "{'mesh':0,'extensions':{'KHR_lights_punctual':{'light':0},"
          "'EXT_lights_area':{'light':0}}}",
          lists, 0);
    assert_int_equal(k->scene->lights_count, 2);
}

static void exposure(void **state)
{
    kit *k = *state;
    const char *of = "'ARGAND_lights':{'exposure':{%s}}";
    loads(k, "{'mesh':0}", kit_json(of, "'factor':0.25"), 0);
    kit_near(ag_scene_exposure(k->scene), 0.25, 0);
    loads(k, "{'mesh':0}", kit_json(of, "'ev100':3"), 0);
    kit_near(ag_scene_exposure(k->scene), 1 / 9.6, 1e-8); // 1 / (1.2 * 2^3)
    loads(k, "{'mesh':0}", own(""), 0);
    kit_near(ag_scene_exposure(k->scene), 1, 0);
    loads(k, "{'mesh':0}", kit_json(of, "'ev100':-99"), 1);
    kit_near(ag_scene_exposure(k->scene), exp2(32) / 1.2, 1e3);
    loads(k, "{'mesh':0}", kit_json(of, "'factor':0"), 1);
    assert_true(ag_scene_exposure(k->scene) > 0);
    fails(k, "ARGAND_lights.exposure: must have either ev100 or factor", "{'mesh':0}",
          kit_json(of, ""));
    fails(k, "exposure: must have either", "{'mesh':0}", kit_json(of, "'ev100':1,'factor':1"));
    fails(k, "exposure.ev100: is not a number", "{'mesh':0}", kit_json(of, "'ev100':'1'"));
    // Of a file that cannot be read nothing stays.
    fails(k, "lights[0].type: is missing", "{'mesh':0,'extensions':{'ARGAND_lights':{'light':0}}}",
          "'ARGAND_lights':{'lights':[{}],'exposure':{'factor':5}}");
    kit_near(ag_scene_exposure(k->scene), 1, 0);
}

static void extensions_are_known(void **state)
{
    kit *k = *state;
    loads(k, "{'mesh':0}", "", 0);
    ag_extension_info e;
    for (size_t i = 0; i < 3; i++) {
        assert_true(ag_scene_extension(k->scene, i, &e));
        assert_true(e.supported);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kinds),         cmocka_unit_test(bad_kinds),
        cmocka_unit_test(extras),        cmocka_unit_test(silly_extras),
        cmocka_unit_test(area),          cmocka_unit_test(own_kinds),
        cmocka_unit_test(bad_own_kinds), cmocka_unit_test(own_goes_before),
        cmocka_unit_test(exposure),      cmocka_unit_test(extensions_are_known),
    };
    return cmocka_run_group_tests(tests, kit_setup, kit_teardown);
}
