// Accessors: every type, normalised or not, strided, sparse, and their bounds.
#include "gltf_kit.h"

#include <string.h>

// Three triangle corners, then 64 bytes for what is tested.
typedef struct payload {
    float triangle[9];
    uint8_t bytes[64];
} payload;

static payload make_payload(const void *bytes, size_t size)
{
    payload p = { .bytes = { 0 } };
    memcpy(p.triangle, kit_triangle, sizeof p.triangle);
    memcpy(p.bytes, bytes, size);
    return p;
}

// Load three texture coordinates of a component type and compare the first two pairs.
static void check_uvs(kit *k, int component, bool normalized, const void *bytes, size_t size,
                      const double expected[4])
{
    payload p = make_payload(bytes, size);
    kit_loads(k,
              kit_document(sizeof p, ",'TEXCOORD_0':1", "",
                           kit_json(",{'bufferView':0,'byteOffset':36,'componentType':%d,"
                                    "'type':'VEC2','count':3,'normalized':%s}",
                                    component, normalized ? "true" : "false"),
                           ""),
              &p, sizeof p, 0);
    const scene_mesh *mesh = &k->scene->meshes[0];
    for (int i = 0; i < 4; i++)
        kit_near(mesh->vertices[i / 2].uv[0][i % 2], expected[i], 1e-6);
}

static void component_types(void **state)
{
    kit *k = *state;
    const int8_t bytes[6] = { -128, -127, 0, 127 };
    check_uvs(k, 5120, false, bytes, sizeof bytes, (double[]) { -128, -127, 0, 127 });
    check_uvs(k, 5120, true, bytes, sizeof bytes, (double[]) { -1, -1, 0, 1 });
    const uint8_t ubytes[6] = { 0, 51, 102, 255 };
    check_uvs(k, 5121, false, ubytes, sizeof ubytes, (double[]) { 0, 51, 102, 255 });
    check_uvs(k, 5121, true, ubytes, sizeof ubytes, (double[]) { 0, 0.2, 0.4, 1 });
    const int16_t shorts[6] = { -32768, -32767, 16384, 32767 };
    check_uvs(k, 5122, false, shorts, sizeof shorts, (double[]) { -32768, -32767, 16384, 32767 });
    check_uvs(k, 5122, true, shorts, sizeof shorts, (double[]) { -1, -1, 16384.0 / 32767.0, 1 });
    const uint16_t ushorts[6] = { 0, 13107, 26214, 65535 };
    check_uvs(k, 5123, false, ushorts, sizeof ushorts, (double[]) { 0, 13107, 26214, 65535 });
    check_uvs(k, 5123, true, ushorts, sizeof ushorts, (double[]) { 0, 0.2, 0.4, 1 });
    const uint32_t uints[6] = { 0, 7, 1u << 31, UINT32_MAX };
    check_uvs(k, 5125, false, uints, sizeof uints, (double[]) { 0, 7, 2147483648.0, 4294967296.0 });
    check_uvs(k, 5125, true, uints, sizeof uints, (double[]) { 0, 7 / 4294967295.0, 0.5, 1 });
    const float floats[6] = { -0.25f, 1e-3f, 2.0f, 3.5f };
    check_uvs(k, 5126, false, floats, sizeof floats, (double[]) { -0.25, 1e-3, 2, 3.5 });
}

// Colours of all types, with and without alpha, come out as 16-bit fractions.
static void check_colors(kit *k, int component, const char *type, const void *bytes, size_t size,
                         const uint16_t expected[4])
{
    payload p = make_payload(bytes, size);
    kit_loads(k,
              kit_document(sizeof p, ",'COLOR_0':1", "",
                           kit_json(",{'bufferView':0,'byteOffset':36,'componentType':%d,"
                                    "'type':'%s','count':3,'normalized':%s}",
                                    component, type, component == 5126 ? "false" : "true"),
                           ""),
              &p, sizeof p, 0);
    for (int i = 0; i < 4; i++)
        assert_int_equal(k->scene->meshes[0].vertices[0].color[i], expected[i]);
}

static void colors(void **state)
{
    kit *k = *state;
    const uint8_t ubytes[12] = { 255, 0, 51, 102 };
    check_colors(k, 5121, "VEC4", ubytes, 12, (uint16_t[]) { 65535, 0, 13107, 26214 });
    check_colors(k, 5121, "VEC3", ubytes, 12, (uint16_t[]) { 65535, 0, 13107, 65535 });
    const uint16_t ushorts[12] = { 1, 65535, 2, 3 };
    check_colors(k, 5123, "VEC4", ushorts, 24, (uint16_t[]) { 1, 65535, 2, 3 });
    check_colors(k, 5123, "VEC3", ushorts, 24, (uint16_t[]) { 1, 65535, 2, 65535 });
    const float floats[12] = { 0.2f, 0.4f, 1.0f, 0.0f };
    check_colors(k, 5126, "VEC4", floats, 48, (uint16_t[]) { 13107, 26214, 65535, 0 });
    check_colors(k, 5126, "VEC3", floats, 48, (uint16_t[]) { 13107, 26214, 65535, 65535 });
}

static void strided(void **state)
{
    // Position and texture coordinates interleaved, 20 bytes a vertex.
    const float bin[15] = { 0, 0, 0, 0.1f, 0.2f, 1, 0, 0, 0.3f, 0.4f, 0, 1, 0, 0.5f, 0.6f };
    const char *json =
        kit_json("{'asset':{'version':'2.0'},'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}],"
                 "'buffers':[{'byteLength':60}],"
                 "'bufferViews':[{'buffer':0,'byteLength':60,'byteStride':20}],"
                 "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3},"
                 "{'bufferView':0,'byteOffset':12,'componentType':5126,'type':'VEC2','count':3}],"
                 "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'TEXCOORD_1':1}}]}]}");
    kit *k = *state;
    kit_loads(k, json, bin, sizeof bin, 0);
    const scene_vertex *v = k->scene->meshes[0].vertices;
    kit_near(v[1].position[0], 1, 0);
    kit_near(v[2].position[1], 1, 0);
    for (int i = 0; i < 6; i++)
        kit_near(v[i / 2].uv[1][i % 2], 0.1 * (i + 1), 1e-6);
}

static void sparse(void **state)
{
    kit *k = *state;
    struct {
        float triangle[9];
        uint16_t indices[2];
        float values[6];
    } bin = { { 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { 0, 2 }, { 5, 6, 7, 8, 9, 10 } };
    const char *parts = "'sparse':{'count':2,"
                        "'indices':{'bufferView':0,'byteOffset':36,'componentType':5123},"
                        "'values':{'bufferView':0,'byteOffset':40}}";
    const char *frame = "{'asset':{'version':'2.0'},'scenes':[{'nodes':[0]}],"
                        "'nodes':[{'mesh':0}],'buffers':[{'byteLength':64}],"
                        "'bufferViews':[{'buffer':0,'byteLength':64}],"
                        "'accessors':[{%s'componentType':5126,'type':'VEC3','count':3,%s}],"
                        "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}]}";
    for (int over_zeros = 0; over_zeros < 2; over_zeros++) {
        kit_loads(k, kit_json(frame, over_zeros ? "" : "'bufferView':0,", parts), &bin, sizeof bin,
                  0);
        const scene_vertex *v = k->scene->meshes[0].vertices;
        for (int i = 0; i < 3; i++) {
            kit_near(v[0].position[i], 5 + i, 0);
            kit_near(v[1].position[i], !over_zeros && i == 0, 0);
            kit_near(v[2].position[i], 8 + i, 0);
        }
    }
    bin.indices[1] = 3;
    kit_fails(k, AG_ERROR_FORMAT, "accessors[0].sparse.indices: number 1 is 3",
              kit_json(frame, "", parts), &bin, sizeof bin);
    bin.indices[1] = 0;
    kit_fails(k, AG_ERROR_FORMAT, "accessors[0].sparse.indices: number 1 is 0",
              kit_json(frame, "", parts), &bin, sizeof bin);
}

// A primitive that uses only the end of a sparse accessor.
static void sparse_from_the_middle(void **state)
{
    kit *k = *state;
    struct {
        uint8_t indices[8], replaced[8];
        float values[21];
    } bin = { .indices = { 4, 5, 6 }, .replaced = { 0, 1, 2, 3, 4, 6, 7 } };
    for (int i = 0; i < 21; i++)
        bin.values[i] = (float)(i + 1);
    kit_loads(k,
              kit_json("{'asset':{'version':'2.0'},'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}],"
                       "'buffers':[{'byteLength':100}],"
                       "'bufferViews':[{'buffer':0,'byteLength':100}],"
                       "'accessors':[{'componentType':5126,'type':'VEC3','count':8,"
                       "'sparse':{'count':7,"
                       "'indices':{'bufferView':0,'byteOffset':8,'componentType':5121},"
                       "'values':{'bufferView':0,'byteOffset':16}}},"
                       "{'bufferView':0,'componentType':5121,'type':'SCALAR','count':3}],"
                       "'meshes':[{'primitives':[{'attributes':{'POSITION':0,'NORMAL':0},"
                       "'indices':1}]}]}"),
              &bin, sizeof bin, 0);
    const scene_vertex *v = k->scene->meshes[0].vertices;
    assert_int_equal(k->scene->meshes[0].vertex_count, 3);
    for (int c = 0; c < 3; c++) {
        kit_near(v[0].position[c], 13 + c, 0); // element 4
        kit_near(v[1].position[c], 0, 0);
        kit_near(v[2].position[c], 16 + c, 0); // element 6
    }
}

static void no_buffer_view_is_zeros(void **state)
{
    kit *k = *state;
    payload p = make_payload("", 0);
    kit_loads(k,
              kit_document(sizeof p, ",'TEXCOORD_0':1", "",
                           ",{'componentType':5126,'type':'VEC2','count':3}", ""),
              &p, sizeof p, 0);
    for (int i = 0; i < 3; i++)
        kit_near(k->scene->meshes[0].vertices[i].uv[0][0], 0, 0);
    kit_fails(k, AG_ERROR_FORMAT, "accessors[1].count: 4000000000 zeros are more than",
              kit_document(sizeof p, "", "",
                           ",{'componentType':5126,'type':'VEC2','count':4000000000}", ""),
              &p, sizeof p);
}

// Columns of matrices start at multiples of four bytes.
static void matrices_are_padded(void **state)
{
    static const struct {
        const char *type;
        int component, size;
    } kinds[] = { { "MAT2", 5121, 8 },  { "MAT2", 5123, 8 },  { "MAT2", 5126, 16 },
                  { "MAT3", 5121, 12 }, { "MAT3", 5123, 24 }, { "MAT3", 5126, 36 },
                  { "MAT4", 5121, 16 }, { "MAT4", 5123, 32 }, { "MAT4", 5126, 64 } };
    kit *k = *state;
    payload p = make_payload("", 0);
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        for (int beyond = 0; beyond < 2; beyond++) {
            const char *json = kit_document(
                sizeof p, "", "",
                kit_json(",{'bufferView':0,'byteOffset':%d,'componentType':%d,'type':'%s',"
                         "'count':1}",
                         (int)sizeof p - kinds[i].size + beyond, kinds[i].component, kinds[i].type),
                "");
            if (beyond)
                kit_fails(k, AG_ERROR_FORMAT, "accessors[1]: 1 elements reach beyond", json, &p,
                          sizeof p);
            else
                kit_loads(k, json, &p, sizeof p, 0);
        }
}

static void bad_accessors(void **state)
{
    static const struct {
        const char *accessor, *says;
    } cases[] = {
        { "'type':'VEC2','count':3", "accessors[1].componentType: is missing" },
        { "'componentType':5124,'type':'VEC2','count':3", "accessors[1].componentType: 5124" },
        { "'componentType':5126,'count':3", "accessors[1].type: is missing" },
        { "'componentType':5126,'type':'VEC5','count':3", "accessors[1].type: \"VEC5\"" },
        { "'componentType':5126,'type':7,'count':3", "accessors[1].type: is not a string" },
        { "'componentType':5126,'type':'VEC2'", "accessors[1].count: is missing" },
        { "'componentType':5126,'type':'VEC2','count':0", "accessors[1].count: must be" },
        { "'componentType':5126,'type':'VEC2','count':-1", "accessors[1].count: -1 is not" },
        { "'componentType':5126,'type':'VEC2','count':1.5", "accessors[1].count: is not a whole" },
        { "'componentType':5126,'type':'VEC2','count':4294967295", "accessors[1].count: 4294" },
        { "'componentType':5126,'type':'VEC2','count':1e300", "accessors[1].count: is not a" },
        { "'bufferView':0,'componentType':5126,'type':'VEC2','count':13", "reach beyond the 100" },
        { "'bufferView':0,'componentType':5126,'type':'VEC2','count':4294967294", "reach beyond" },
        { "'bufferView':0,'byteOffset':9007199254740992,'componentType':5126,'type':'VEC2',"
          "'count':1",
          "reach beyond" },
        { "'bufferView':0,'byteOffset':9223372036854775807,'componentType':5126,'type':'VEC2',"
          "'count':1",
          "accessors[1].byteOffset: 9223372036854775807" },
        { "'bufferView':1,'componentType':5126,'type':'VEC2','count':1",
          "accessors[1].bufferView: 1 is not one of the 1 buffer views" },
        { "'componentType':5126,'type':'VEC2','count':3,'sparse':{'count':4}",
          "accessors[1].sparse.count: 4 is not between 0 and 3" },
        { "'componentType':5126,'type':'VEC2','count':3,'sparse':{'count':1}",
          "accessors[1].sparse.indices.bufferView: is missing" },
        { "'componentType':5126,'type':'VEC2','count':3,'sparse':7",
          "accessors[1].sparse: is not an object" },
    };
    kit *k = *state;
    payload p = make_payload("", 0);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        kit_fails(k, AG_ERROR_FORMAT, cases[i].says,
                  kit_document(sizeof p, "", "", kit_json(",{%s}", cases[i].accessor), ""), &p,
                  sizeof p);
}

static void whole_numbers_may_be_written_as_reals(void **state)
{
    kit *k = *state;
    payload p = make_payload("", 0);
    kit_loads(k,
              kit_document(sizeof p, ",'TEXCOORD_0':1.0", "",
                           ",{'componentType':5126.0,'type':'VEC2','count':3e0}", ""),
              &p, sizeof p, 0);
}

static void numbers_that_are_not_finite(void **state)
{
    kit *k = *state;
    const uint32_t patterns[] = { 0x7F800000u, 0xFF800000u, 0x7FC00000u, 0x7F800001u };
    for (int i = 0; i < 4; i++) {
        payload p = make_payload("", 0);
        memcpy(&p.triangle[4], &patterns[i], 4);
        assert_int_equal(kit_load_glb(k, kit_document(sizeof p, "", "", "", ""), &p, sizeof p),
                         AG_ERROR_FORMAT);
        assert_non_null(strstr(k->said, "POSITION: vertex 1 is not finite or lies beyond 1e18"));
        // Elsewhere it is mended, and said so.
        p = make_payload(&patterns[i], 4);
        kit_loads(k,
                  kit_document(sizeof p, ",'NORMAL':1,'TEXCOORD_0':2,'COLOR_0':1", "",
                               ",{'bufferView':0,'byteOffset':36,'componentType':5126,"
                               "'type':'VEC3','count':3},{'bufferView':0,'byteOffset':36,"
                               "'componentType':5126,'type':'VEC2','count':3}",
                               ""),
                  &p, sizeof p, 1);
        assert_non_null(strstr(k->said, "NORMAL: accessors[1] holds a value that is not finite"));
        const scene_vertex *v = &k->scene->meshes[0].vertices[0];
        for (int c = 0; c < 3; c++)
            kit_near(v->normal[c], c == 2, 1e-6);
        kit_near(v->uv[0][0], 0, 0);
    }
    payload p = make_payload("", 0);
    p.triangle[4] = 2e18f;
    kit_fails(k, AG_ERROR_FORMAT, "POSITION: vertex 1 is not finite or lies beyond",
              kit_document(sizeof p, "", "", "", ""), &p, sizeof p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(component_types),
        cmocka_unit_test(colors),
        cmocka_unit_test(strided),
        cmocka_unit_test(sparse),
        cmocka_unit_test(sparse_from_the_middle),
        cmocka_unit_test(no_buffer_view_is_zeros),
        cmocka_unit_test(matrices_are_padded),
        cmocka_unit_test(bad_accessors),
        cmocka_unit_test(whole_numbers_may_be_written_as_reals),
        cmocka_unit_test(numbers_that_are_not_finite),
    };
    return cmocka_run_group_tests(tests, kit_setup, kit_teardown);
}
