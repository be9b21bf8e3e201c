// Primitives: topologies, sharing, morph targets, skins; all against numbers by hand.
#include "gltf_kit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// Six vertices on a zigzag, indices of all three types behind them.
typedef struct zigzag {
    float positions[18];
    uint8_t bytes[8];
    uint16_t shorts[8];
    uint32_t words[8];
} zigzag;

static const zigzag zigzag_bin = {
    { 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0, 1, 2, 0 },
    { 5, 4, 3, 2, 1, 0, 0, 0 },
    { 5, 4, 3, 2, 1, 0, 0, 0 },
    { 5, 4, 3, 2, 1, 0, 0, 0 },
};

static const char *zigzag_json(const char *primitive)
{
    return kit_json(
        "{'asset':{'version':'2.0'},'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}],"
        "'buffers':[{'byteLength':128}],"
        "'bufferViews':[{'buffer':0,'byteLength':128}],"
        "'accessors':["
        "{'bufferView':0,'componentType':5126,'type':'VEC3','count':6},"
        "{'bufferView':0,'byteOffset':72,'componentType':5121,'type':'SCALAR','count':6},"
        "{'bufferView':0,'byteOffset':80,'componentType':5123,'type':'SCALAR','count':6},"
        "{'bufferView':0,'byteOffset':96,'componentType':5125,'type':'SCALAR','count':6},"
        "{'bufferView':0,'byteOffset':96,'componentType':5125,'type':'SCALAR','count':5},"
        "{'bufferView':0,'componentType':5126,'type':'VEC3','count':6}],"
        "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':5}%s}]}]}",
        primitive);
}

static void check_triangles(kit *k, const char *primitive, const uint32_t *expected, size_t count,
                            unsigned warnings)
{
    kit_loads(k, zigzag_json(primitive), &zigzag_bin, sizeof zigzag_bin, warnings);
    const scene_mesh *mesh = &k->scene->meshes[0];
    assert_int_equal(mesh->index_count, count);
    assert_memory_equal(mesh->indices, expected, count * sizeof *expected);
}

static void topologies(void **state)
{
    kit *k = *state;
    const uint32_t list[] = { 0, 1, 2, 3, 4, 5 }, reversed[] = { 5, 4, 3, 2, 1, 0 };
    const uint32_t strip[] = { 0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 5, 4 };
    const uint32_t fan[] = { 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 5, 0 };
    const uint32_t strip_reversed[] = { 5, 4, 3, 4, 2, 3, 3, 2, 1, 2, 0, 1 };
    check_triangles(k, "", list, 6, 0);
    check_triangles(k, ",'mode':4,'indices':1", reversed, 6, 0);
    check_triangles(k, ",'indices':2", reversed, 6, 0);
    check_triangles(k, ",'indices':3", reversed, 6, 0);
    check_triangles(k, ",'mode':5", strip, 12, 0);
    check_triangles(k, ",'mode':6", fan, 12, 0);
    check_triangles(k, ",'mode':5,'indices':2", strip_reversed, 12, 0);
    // 5 4 3 2 1: one triangle and two corners too many; vertex 3 is the lowest in use.
    const uint32_t rest[] = { 2, 1, 0 };
    check_triangles(k, ",'indices':4", rest, 3, 1);
    assert_int_equal(k->scene->meshes[0].vertex_count, 3);
    kit_near(k->scene->meshes[0].vertices[0].position[0], 1, 0); // vertex 3
    kit_near(k->scene->meshes[0].vertices[0].position[1], 1, 0);
}

// A strip through 0 0 1 2 2 holds one triangle with a surface.
static void strips_without_surface(void **state)
{
    kit *k = *state;
    zigzag bin = zigzag_bin;
    memcpy(bin.words, (uint32_t[]) { 0, 0, 1, 2, 2 }, 20);
    kit_loads(k, zigzag_json(",'mode':5,'indices':4"), &bin, sizeof bin, 0);
    const uint32_t expected[] = { 0, 2, 1 };
    assert_int_equal(k->scene->meshes[0].index_count, 3);
    assert_memory_equal(k->scene->meshes[0].indices, expected, sizeof expected);
}

static void no_surface(void **state)
{
    kit *k = *state;
    for (int mode = 0; mode < 4; mode++) {
        kit_loads(k, zigzag_json(kit_json(",'mode':%d", mode)), &zigzag_bin, sizeof zigzag_bin, 2);
        assert_non_null(strstr(k->said, "points and lines are not drawn"));
        assert_int_equal(k->scene->instances_count, 0);
    }
    kit_fails(k, AG_ERROR_FORMAT, "meshes[0].primitives[0].mode: 7 is not between 0 and 6",
              zigzag_json(",'mode':7"), &zigzag_bin, sizeof zigzag_bin);
}

static void bad_indices(void **state)
{
    kit *k = *state;
    zigzag bin = zigzag_bin;
    bin.shorts[3] = 6;
    kit_fails(k, AG_ERROR_FORMAT, "primitives[0].indices: index 3 is 6, but there are only 6",
              zigzag_json(",'indices':2"), &bin, sizeof bin);
    bin.shorts[3] = 65535;
    kit_fails(k, AG_ERROR_FORMAT, "index 3 is 65535, which restarts", zigzag_json(",'indices':2"),
              &bin, sizeof bin);
    kit_fails(k, AG_ERROR_FORMAT, "accessors[0] does not hold unsigned integers",
              zigzag_json(",'indices':0"), &bin, sizeof bin);
    kit_fails(k, AG_ERROR_FORMAT, "indices: 6 is not one of the 6 accessors",
              zigzag_json(",'indices':6"), &bin, sizeof bin);
}

// The restart value stays forbidden where there are vertices enough.
static void restart_among_many_vertices(void **state)
{
    kit *k = *state;
    const uint8_t bin[4] = { 0, 1, 255, 0 };
    kit_fails(k, AG_ERROR_FORMAT, "index 2 is 255, which restarts",
              kit_json("{'asset':{'version':'2.0'},'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}],"
                       "'buffers':[{'byteLength':4}],'bufferViews':[{'buffer':0,'byteLength':4}],"
                       "'accessors':[{'componentType':5126,'type':'VEC3','count':300},"
                       "{'bufferView':0,'componentType':5121,'type':'SCALAR','count':3}],"
                       "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'indices':1}]}]}"),
              bin, sizeof bin);
}

static void missing_normals_are_flat(void **state)
{
    kit *k = *state;
    // A right angle of two triangles that share an edge: z = 0, then x = 0.
    const float bin[12] = { 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    kit_loads(
        k,
        kit_json("{'asset':{'version':'2.0'},'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}],"
                 "'buffers':[{'byteLength':48}],"
                 "'bufferViews':[{'buffer':0,'byteLength':48}],"
                 "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':4}],"
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'mode':6}]}]}"),
        bin, sizeof bin, 0);
    const scene_mesh *mesh = &k->scene->meshes[0];
    assert_int_equal(mesh->vertex_count, 6);
    for (uint32_t i = 0; i < 6; i++)
        for (int c = 0; c < 3; c++)
            kit_near(mesh->vertices[mesh->indices[i]].normal[c], c == (i < 3 ? 2 : 0), 1e-6);
}

static void morph_targets(void **state)
{
    kit *k = *state;
    struct {
        float positions[9], normals[9], tangents[12], move[9], turn[9];
    } bin = { .positions = { 0, 0, 0, 1, 0, 0, 0, 1, 0 },
              .normals = { 0, 0, 1, 0, 0, 1, 0, 0, 1 },
              .tangents = { 1, 0, 0, -1, 1, 0, 0, 1, 1, 0, 0, 1 },
              .move = { 1, 2, 3, 0, 0, 0, 0, 0, 8 },
              .turn = { 2, 0, 0, 0, 0, 0, 0, 4, -2 } };
    const char *frame =
        "{'asset':{'version':'2.0'},'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0%s}],"
        "'buffers':[{'byteLength':192}],'bufferViews':[{'buffer':0,'byteLength':192}],"
        "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3},"
        "{'bufferView':0,'byteOffset':36,'componentType':5126,'type':'VEC3','count':3},"
        "{'bufferView':0,'byteOffset':72,'componentType':5126,'type':'VEC4','count':3},"
        "{'bufferView':0,'byteOffset':120,'componentType':5126,'type':'VEC3','count':3},"
        "{'bufferView':0,'byteOffset':156,'componentType':5126,'type':'VEC3','count':3}],"
        "'meshes':[{%s'primitives':[{'attributes':{'POSITION':0,'NORMAL':1,'TANGENT':2},"
        "'targets':[{'POSITION':3},{'NORMAL':4,'TANGENT':3}]}]}]}";
    // Neither node nor mesh has weights: the base.
    kit_loads(k, kit_json(frame, "", ""), &bin, sizeof bin, 0);
    kit_near(k->scene->meshes[0].vertices[2].position[2], 0, 0);
    // The mesh's weights: half of the first.
    kit_loads(k, kit_json(frame, "", "'weights':[0.5,0],"), &bin, sizeof bin, 0);
    const scene_vertex *v = k->scene->meshes[0].vertices;
    kit_near(v[0].position[0], 0.5, 1e-6);
    kit_near(v[0].position[1], 1, 1e-6);
    kit_near(v[0].position[2], 1.5, 1e-6);
    kit_near(v[2].position[1], 1, 1e-6);
    kit_near(v[2].position[2], 4, 1e-6);
    // The node's weights instead: a quarter of the second.
    kit_loads(k, kit_json(frame, ",'weights':[0,0.25]", "'weights':[0.5,0],"), &bin, sizeof bin, 0);
    v = k->scene->meshes[0].vertices;
    kit_near(v[0].position[0], 0, 0);
    kit_near(v[0].normal[0], 0.5 / sqrt(1.25), 1e-6); // (0.5, 0, 1)
    kit_near(v[0].normal[2], 1.0 / sqrt(1.25), 1e-6);
    kit_near(v[2].normal[1], 1.0 / sqrt(1.25), 1e-6); // (0, 1, 0.5)
    kit_near(v[2].normal[2], 0.5 / sqrt(1.25), 1e-6);
    double length = sqrt(1.25 * 1.25 + 0.5 * 0.5 + 0.75 * 0.75); // (1.25, 0.5, 0.75)
    kit_near(v[0].tangent[0], 1.25 / length, 1e-6);
    kit_near(v[0].tangent[2], 0.75 / length, 1e-6);
    kit_near(v[0].tangent[3], -1, 0);
    kit_fails(k, AG_ERROR_FORMAT, "nodes[0].weights: has 3 numbers for 2 morph targets",
              kit_json(frame, ",'weights':[0,0,0]", ""), &bin, sizeof bin);
}

// Two joints: one moved by (10, 0, 0), one turned by 90 degrees about z, both bound at
// places of their own.  Five influences in two sets.
typedef struct skin_bin {
    float positions[9], normals[9];
    float inverse_binds[32];
    uint8_t joints[2][12];
    float weights[2][12];
} skin_bin;

static const char *skin_json(const char *joint, const char *skin)
{
    return kit_json(
        "{'asset':{'version':'2.0'},'scenes':[{'nodes':[0,1]}],"
        "'nodes':[{'mesh':0,'skin':0,'translation':[100,100,100]},"
        "{'children':[2],'translation':[10,0,0]},"
        "{'rotation':[0,0,0.70710678,0.70710678],'translation':[0,5,0]%s}],"
        "'skins':[{'joints':[1,2]%s}],"
        "'buffers':[{'byteLength':320}],'bufferViews':[{'buffer':0,'byteLength':320}],"
        "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3},"
        "{'bufferView':0,'byteOffset':36,'componentType':5126,'type':'VEC3','count':3},"
        "{'bufferView':0,'byteOffset':72,'componentType':5126,'type':'MAT4','count':2},"
        "{'bufferView':0,'byteOffset':200,'componentType':5121,'type':'VEC4','count':3},"
        "{'bufferView':0,'byteOffset':212,'componentType':5121,'type':'VEC4','count':3},"
        "{'bufferView':0,'byteOffset':224,'componentType':5126,'type':'VEC4','count':3},"
        "{'bufferView':0,'byteOffset':272,'componentType':5126,'type':'VEC4','count':3}],"
        "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':1,'JOINTS_0':3,"
        "'JOINTS_1':4,'WEIGHTS_0':5,'WEIGHTS_1':6}}]}]}",
        joint, skin);
}

static skin_bin make_skin_bin(void)
{
    skin_bin bin = {
        .positions = { 0, 0, 0, 1, 0, 0, 0, 1, 0 },
        .normals = { 0, 0, 1, 1, 0, 0, 0, 1, 0 },
        .inverse_binds = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,   // identity
                           1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1 }, // down by 1
        .joints = { { 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0 }, { 0, 0, 0, 0, 0, 0, 0, 0, 1 } },
        .weights = { { 1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.25f, 0, 0 }, { [8] = 0.25f } },
    };
    return bin;
}

static void skins(void **state)
{
    kit *k = *state;
    skin_bin bin = make_skin_bin();
    kit_loads(k, skin_json("", ",'inverseBindMatrices':2"), &bin, sizeof bin, 0);
    const scene_vertex *v = k->scene->meshes[0].vertices;
    // Vertex 0 follows joint 0: + (10, 0, 0).  The node's own transform does not count.
    kit_near(v[0].position[0], 10, 1e-5);
    kit_near(v[0].position[1], 0, 1e-5);
    kit_near(k->scene->instances[0].world[12], 0, 0);
    // Vertex 1 follows joint 1: (1, 0) -> bound (1, -1) -> turned (1, 1) -> (11, 6).
    kit_near(v[1].position[0], 11, 1e-5);
    kit_near(v[1].position[1], 6, 1e-5);
    kit_near(v[1].normal[0], 0, 1e-5);
    kit_near(v[1].normal[1], 1, 1e-5);
    // Vertex 2: half joint 0 (10, 1), half joint 1: (0, 1) -> (0, 0) -> (10, 5).
    kit_near(v[2].position[0], 10, 1e-5);
    kit_near(v[2].position[1], 3, 1e-5);
    kit_near(v[2].normal[0], -sqrt(0.5), 1e-5); // (0, 1) and (-1, 0)
    kit_near(v[2].normal[1], sqrt(0.5), 1e-5);
    // Without inverse bind matrices they are the identity: joint 1 gives (10, 6).
    kit_loads(k, skin_json("", ""), &bin, sizeof bin, 0);
    kit_near(k->scene->meshes[0].vertices[1].position[1], 6, 1e-5);
    kit_near(k->scene->meshes[0].vertices[1].position[0], 10, 1e-5);
}

// Scaling by (2, 1, 1) turns the normal (1, 1, 0) to (1/2, 1, 0).
static void skins_turn_normals_by_the_inverse_transpose(void **state)
{
    kit *k = *state;
    skin_bin bin = make_skin_bin();
    bin.normals[3] = bin.normals[4] = (float)sqrt(0.5);
    kit_loads(k, skin_json(",'scale':[1,2,1]", ""), &bin, sizeof bin, 0);
    // Scale y by 2, then turn by 90 degrees: (1, 1/2) -> (-1/2, 1).
    const float *n = k->scene->meshes[0].vertices[1].normal;
    kit_near(n[0], -0.5 / sqrt(1.25), 1e-5);
    kit_near(n[1], 1.0 / sqrt(1.25), 1e-5);
}

// Joints that mirror turn the triangles around too, so that fronts stay in front.
static void mirroring_skins(void **state)
{
    kit *k = *state;
    skin_bin bin = make_skin_bin();
    memset(bin.joints, 0, sizeof bin.joints);
    const char *json = skin_json("", "");
    char mirrored[16384];
    const char *place = strstr(json, "\"translation\":[10,0,0]");
    snprintf(mirrored, sizeof mirrored, "%.*s\"scale\":[-1,1,1]%s", (int)(place - json), json,
             place + strlen("\"translation\":[10,0,0]"));
    kit_loads(k, mirrored, &bin, sizeof bin, 0);
    const scene_mesh *mesh = &k->scene->meshes[0];
    const scene_vertex *a = &mesh->vertices[mesh->indices[0]],
                       *b = &mesh->vertices[mesh->indices[1]],
                       *c = &mesh->vertices[mesh->indices[2]];
    float z = (b->position[0] - a->position[0]) * (c->position[1] - a->position[1]) -
              (b->position[1] - a->position[1]) * (c->position[0] - a->position[0]);
    kit_near(z, 1, 1e-5); // as the file's triangle: facing +z, like its normal
    kit_near(mesh->vertices[0].normal[2], 1, 1e-5);
}

static void bad_skins(void **state)
{
    kit *k = *state;
    skin_bin bin = make_skin_bin();
    bin.joints[0][4] = 2;
    kit_fails(k, AG_ERROR_FORMAT, "JOINTS_0: names joint 2, but its skin has only 2",
              skin_json("", ""), &bin, sizeof bin);
    bin = make_skin_bin();
    kit_fails(k, AG_ERROR_FORMAT, "skins[0].inverseBindMatrices: accessors[0] does not hold MAT4",
              skin_json("", ",'inverseBindMatrices':0"), &bin, sizeof bin);
    const char *empty =
        kit_json("{'asset':{'version':'2.0'},'scenes':[{'nodes':[0]}],"
                 "'nodes':[{'mesh':0,'skin':0}],'skins':[{'joints':[]}],"
                 "'buffers':[{'byteLength':36}],'bufferViews':[{'buffer':0,'byteLength':36}],"
                 "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3}],"
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'JOINTS_0':0}}]}]}");
    kit_fails(k, AG_ERROR_FORMAT, "skins[0].joints: must have at least one", empty, kit_triangle,
              36);
}

static void sharing(void **state)
{
    kit *k = *state;
    // Two meshes of the same accessors and a third with other normals, on five nodes.
    kit_loads(
        k,
        kit_json("{'asset':{'version':'2.0'},'scenes':[{'nodes':[0,1,2,3,4]}],"
                 "'nodes':[{'mesh':0},{'mesh':0},{'mesh':1},{'mesh':1},{'mesh':2}],"
                 "'buffers':[{'byteLength':36}],"
                 "'bufferViews':[{'buffer':0,'byteLength':36}],"
                 "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3}],"
                 "'materials':[{},{'doubleSided':true}],"
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]},"
                 "{'primitives':[{'attributes':{'POSITION':0},'material':1}]},"
                 "{'primitives':[{'attributes':{'POSITION':0,'NORMAL':0}}]}]}"),
        kit_triangle, 36, 0);
    assert_int_equal(k->scene->meshes_count, 2);
    assert_int_equal(k->scene->instances_count, 5);
    assert_int_equal(k->scene->instances[2].mesh, k->scene->instances[0].mesh);
    assert_true(k->scene->materials[k->scene->instances[2].material].double_sided);
    assert_false(k->scene->materials[k->scene->instances[0].material].double_sided);
    assert_int_equal(k->scene->instances[4].mesh, 1);
}

static void bad_meshes(void **state)
{
    kit *k = *state;
    const char *spare = ",{'componentType':5126,'type':'VEC3','count':4}";
    kit_fails(k, AG_ERROR_FORMAT, "NORMAL: accessors[1] has 4 elements, POSITION has 3",
              kit_document(36, ",'NORMAL':1", "", spare, ""), kit_triangle, 36);
    kit_fails(k, AG_ERROR_FORMAT, "TEXCOORD_0: accessors[0] is not of the type VEC2",
              kit_document(36, ",'TEXCOORD_0':0", "", "", ""), kit_triangle, 36);
    kit_fails(k, AG_ERROR_FORMAT, "material: 0 is not one of the 0 materials",
              kit_document(36, "", ",'material':0", "", ""), kit_triangle, 36);
    const char *frame = "{'asset':{'version':'2.0'},'scenes':[{'nodes':[0]}],"
                        "'nodes':[{'mesh':0}],'meshes':[%s]}";
    kit_fails(k, AG_ERROR_FORMAT, "meshes[0].primitives: is missing", kit_json(frame, "{}"), NULL,
              0);
    kit_fails(k, AG_ERROR_FORMAT, "meshes[0].primitives: must have at least one",
              kit_json(frame, "{'primitives':[]}"), NULL, 0);
    kit_fails(k, AG_ERROR_FORMAT, "meshes[0]: is not an object", kit_json(frame, "3"), NULL, 0);
    kit_loads(k, kit_json(frame, "{'primitives':[{'attributes':{}}]}"), NULL, 0, 2);
    assert_non_null(strstr(k->said, "meshes[0].primitives[0]: has no POSITION"));
    assert_non_null(strstr(k->said, "no surface in it to show"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(topologies),
        cmocka_unit_test(strips_without_surface),
        cmocka_unit_test(no_surface),
        cmocka_unit_test(bad_indices),
        cmocka_unit_test(restart_among_many_vertices),
        cmocka_unit_test(missing_normals_are_flat),
        cmocka_unit_test(morph_targets),
        cmocka_unit_test(skins),
        cmocka_unit_test(skins_turn_normals_by_the_inverse_transpose),
        cmocka_unit_test(mirroring_skins),
        cmocka_unit_test(bad_skins),
        cmocka_unit_test(sharing),
        cmocka_unit_test(bad_meshes),
    };
    return cmocka_run_group_tests(tests, kit_setup, kit_teardown);
}
