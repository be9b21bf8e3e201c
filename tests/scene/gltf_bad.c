// Broken containers and documents, files cut at every length, single bytes changed,
// and loads that are cancelled.
#include "gltf_kit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Something of everything, so that damage meets every reader.
static void *make_rich(size_t *size)
{
    struct {
        float positions[9], matrix[16];
        uint8_t joints[12], indices[4];
        float weights[12];
    } bin = { .positions = { 0, 0, 0, 1, 0, 0, 0, 1, 0 },
              .matrix = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 },
              .indices = { 0, 1, 2, 0 },
              .weights = { 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 } };
    const char *json = kit_json(
        "{'asset':{'version':'2.0'},'scene':0,'scenes':[{'nodes':[0,2]}],"
        "'nodes':[{'mesh':0,'children':[1],'weights':[0.5]},{'mesh':0,'skin':0},"
        "{'camera':0,'rotation':[0,0,0,1],'extensions':{'KHR_lights_punctual':{'light':0}}}],"
        "'cameras':[{'type':'perspective','perspective':{'yfov':1,'znear':0.1}}],"
        "'skins':[{'joints':[2],'inverseBindMatrices':1}],"
        "'extensionsUsed':['KHR_lights_punctual','KHR_texture_transform'],"
        "'extensions':{'KHR_lights_punctual':{'lights':[{'type':'spot','spot':{}}]}},"
        "'buffers':[{'byteLength':164}],'bufferViews':[{'buffer':0,'byteLength':164}],"
        "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3,"
        "'sparse':{'count':1,'indices':{'bufferView':0,'byteOffset':112,'componentType':5121},"
        "'values':{'bufferView':0}}},"
        "{'bufferView':0,'byteOffset':36,'componentType':5126,'type':'MAT4','count':1},"
        "{'bufferView':0,'byteOffset':100,'componentType':5121,'type':'VEC4','count':3},"
        "{'bufferView':0,'byteOffset':112,'componentType':5121,'type':'SCALAR','count':3},"
        "{'bufferView':0,'byteOffset':116,'componentType':5126,'type':'VEC4','count':3}],"
        "'materials':[{'emissiveFactor':[0,1,0],'alphaMode':'BLEND'}],"
        "'meshes':[{'primitives':[{'mode':5,'indices':3,'material':0,"
        "'attributes':{'POSITION':0,'JOINTS_0':2,'WEIGHTS_0':4,'COLOR_0':4},"
        "'targets':[{'POSITION':0}]}]}]}");
    return kit_make_glb(json, &bin, sizeof bin, size);
}

// Whatever happens to a file: it loads, or it fails with one sentence and leaves nothing.
static ag_status load_all_or_nothing(kit *k, const void *bytes, size_t size)
{
    ag_status status = kit_load_bytes(k, bytes, size);
    if (k->errors != (status != AG_OK))
        print_error("%s said: %s", ag_status_name(status), k->said);
    assert_int_equal(k->errors, status != AG_OK);
    if (status) {
        ag_scene_summary left = ag_scene_summarize(k->scene);
        assert_int_equal(left.meshes + left.materials + left.textures + left.instances +
                             left.lights + left.cameras,
                         0);
    }
    return status;
}

static void cut_at_every_length(void **state)
{
    kit *k = *state;
    size_t size;
    uint8_t *bytes = make_rich(&size);
    assert_int_equal(load_all_or_nothing(k, bytes, size), AG_OK);
    assert_int_equal(k->scene->instances_count, 2);
    for (size_t length = 0; length < size; length++)
        assert_int_not_equal(load_all_or_nothing(k, bytes, length), AG_OK);
    // Again with a header that agrees with the shorter length.
    for (size_t length = 20; length < size; length++) {
        bytes[8] = (uint8_t)length;
        bytes[9] = (uint8_t)(length >> 8);
        assert_int_not_equal(load_all_or_nothing(k, bytes, length), AG_OK);
    }
    free(bytes);
}

static void every_byte_changed(void **state)
{
    kit *k = *state;
    size_t size;
    uint8_t *bytes = make_rich(&size);
    static const uint8_t changes[] = { 0x01, 0x80, 0xFF };
    for (size_t i = 0; i < size; i++)
        for (size_t c = 0; c < sizeof changes; c++) {
            bytes[i] ^= changes[c];
            (void)load_all_or_nothing(k, bytes, size);
            bytes[i] ^= changes[c];
        }
    free(bytes);
}

static void containers(void **state)
{
    kit *k = *state;
    size_t size;
    const char *json = kit_document(36, "", "", "", "");
    uint8_t *bytes = kit_make_glb(json, kit_triangle, 36, &size);
    bytes[4] = 1;
    assert_int_equal(load_all_or_nothing(k, bytes, size), AG_ERROR_UNSUPPORTED);
    assert_non_null(strstr(k->said, "is binary glTF 1; only 2 is read"));
    bytes[4] = 2;
    bytes[16] = 'X';
    assert_int_equal(load_all_or_nothing(k, bytes, size), AG_ERROR_FORMAT);
    assert_non_null(strstr(k->said, "its first chunk is not JSON"));
    bytes[16] = 'J';
    size_t chunk = 20 + (strlen(json) + 3) / 4 * 4;
    bytes[chunk + 4] = 'X'; // another kind of chunk: to be ignored, so there is no data
    assert_int_equal(load_all_or_nothing(k, bytes, size), AG_ERROR_FORMAT);
    assert_non_null(strstr(k->said, "bufferViews[0]: its buffers[0] has no uri"));
    bytes[chunk + 4] = 'B';
    assert_int_equal(load_all_or_nothing(k, bytes, size), AG_OK);
    free(bytes);
    assert_int_equal(load_all_or_nothing(k, "", 0), AG_ERROR_FORMAT);
    assert_non_null(strstr(k->said, "is empty"));
    assert_int_equal(load_all_or_nothing(k, "solid stl", 9), AG_ERROR_FORMAT);
    assert_non_null(strstr(k->said, "is neither .gltf nor .glb"));
}

static void documents(void **state)
{
    static const struct {
        ag_status status;
        const char *json, *says;
    } cases[] = {
        { AG_ERROR_FORMAT, "{", "its JSON is broken in line 1" },
        { AG_ERROR_FORMAT, "[]", "is neither .gltf nor .glb" },
        { AG_ERROR_FORMAT, "{}", "asset: is missing" },
        { AG_ERROR_FORMAT, "{'asset':{}}", "asset.version: is missing" },
        { AG_ERROR_FORMAT, "{'asset':7}", "asset: is not an object" },
        { AG_ERROR_FORMAT, "{'asset':{'version':2.0}}", "asset.version: is not a string" },
        { AG_ERROR_UNSUPPORTED, "{'asset':{'version':'1.0'}}", "asset: is glTF 1.0; only" },
        { AG_ERROR_UNSUPPORTED, "{'asset':{'version':'2.0','minVersion':'2.7'}}",
          "needs glTF 2.7" },
        { AG_ERROR_FORMAT, "{'asset':{'version':'2.0'},'asset':{}}", "duplicate object key" },
        { AG_ERROR_FORMAT, "{'asset':{'version':'2.0'},'nodes':{}}", "nodes: is not an array" },
        { AG_ERROR_FORMAT, "{'asset':{'version':'2.0'},'nodes':[1]}", "nodes[0]: is not an" },
        { AG_ERROR_FORMAT, "{'asset':{'version':'2.0'},'nodes':[1e999]}", "real number overflow" },
        { AG_ERROR_FORMAT, "{'asset':{'version':'2.0'},'nodes':[NaN]}", "its JSON is broken" },
        { AG_ERROR_FORMAT, "{'asset':{'version':'2.0'},'buffers':[{}]}",
          "buffers[0].byteLength: is missing" },
        { AG_ERROR_FORMAT, "{'asset':{'version':'2.0'},'bufferViews':[{'buffer':0}]}",
          "bufferViews[0].buffer: 0 is not one of the 0 buffers" },
    };
    kit *k = *state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        kit_fails(k, cases[i].status, cases[i].says, kit_json("%s", cases[i].json), NULL, 0);
    kit_loads(k, kit_json("{'asset':{'version':'2.0'}}"), NULL, 0, 2); // no scene, no surface
}

static void buffer_views(void **state)
{
    static const struct {
        const char *view, *says;
    } cases[] = {
        { "'byteLength':4", "bufferViews[0].buffer: is missing" },
        { "'buffer':0", "bufferViews[0].byteLength: is missing" },
        { "'buffer':0,'byteLength':37", "bufferViews[0]: reaches beyond the 36 bytes" },
        { "'buffer':0,'byteLength':36,'byteOffset':1", "bufferViews[0]: reaches beyond" },
        { "'buffer':0,'byteLength':9007199254740992,'byteOffset':9007199254740992", "beyond" },
        { "'buffer':0,'byteLength':36,'byteStride':253", "byteStride: 253 is not between" },
        { "'buffer':0,'byteLength':36,'byteStride':8", "byteStride is 8" },
    };
    kit *k = *state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        kit_fails(k, AG_ERROR_FORMAT, cases[i].says,
                  kit_json("{'asset':{'version':'2.0'},'buffers':[{'byteLength':36}],"
                           "'bufferViews':[{%s}],'accessors':[{'bufferView':0,'type':'VEC3',"
                           "'componentType':5126,'count':1}]}",
                           cases[i].view),
                  kit_triangle, 36);
}

// JSON nested without end is refused, not followed down the stack.
static void deep_json(void **state)
{
    kit *k = *state;
    enum { DEPTH = 1 << 20 };
    char *text = malloc(DEPTH + 100);
    int head = sprintf(text, "{\"asset\":{\"version\":\"2.0\"},\"extras\":");
    memset(text + head, '[', DEPTH);
    text[head + DEPTH] = 0;
    kit_fails(k, AG_ERROR_FORMAT, "maximum parsing depth reached", text, NULL, 0);
    free(text);
}

// A small file that names the same bytes again and again.
static void expansion_is_bounded(void **state)
{
    kit *k = *state;
    enum { PRIMITIVES = 200, SIZE = PRIMITIVES * 64 + 1000 };
    char *text = malloc(SIZE);
    int used = sprintf(text, "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],"
                             "\"scenes\":[{\"nodes\":[0]}],\"accessors\":[{\"type\":\"VEC3\","
                             "\"componentType\":5126,\"count\":300000}],\"meshes\":[{"
                             "\"primitives\":[");
    for (int i = 0; i < PRIMITIVES; i++) // the unknown attribute keeps them apart
        used +=
            sprintf(text + used, "%s{\"attributes\":{\"POSITION\":0,\"_X%d\":0}}", i ? "," : "", i);
    sprintf(text + used, "]}]}");
    kit_fails(k, AG_ERROR_FORMAT, "the meshes need more memory or work than", text, NULL, 0);
    free(text);
}

// Many nodes that each show a mesh of many parts.
static void instances_are_bounded(void **state)
{
    kit *k = *state;
    enum { COUNT = 2000 };
    char *text = malloc(COUNT * 64 + 1000);
    int used = sprintf(text, "{\"asset\":{\"version\":\"2.0\"},\"meshes\":[{\"primitives\":[");
    for (int i = 0; i < COUNT; i++)
        used += sprintf(text + used, "%s{\"attributes\":{}}", i ? "," : "");
    used += sprintf(text + used, "]}],\"nodes\":[");
    for (int i = 0; i < COUNT; i++)
        used += sprintf(text + used, "%s{\"mesh\":0}", i ? "," : "");
    sprintf(text + used, "]}");
    kit_fails(k, AG_ERROR_FORMAT, "the meshes need more memory or work than", text, NULL, 0);
    free(text);
}

// ---- Progress ------------------------------------------------------------------------

typedef struct heard {
    char stages[256];
    double last; // in the stage heard last
    bool rising; // from 0 to 1, never back but where a stage changes
    unsigned calls, stop_at;
} heard;

static bool hear_progress(void *user, const char *stage, double fraction)
{
    heard *h = user;
    size_t used = strlen(h->stages), length = strlen(stage);
    if (used < length || strcmp(h->stages + used - length, stage) != 0) {
        snprintf(h->stages + used, sizeof h->stages - used, " %s", stage);
        h->last = 0.0;
    }
    h->rising &= fraction >= h->last && fraction <= 1.0;
    h->last = fraction;
    return ++h->calls != h->stop_at;
}

static void progress(void **state)
{
    kit *k = *state;
    kit_loads(k, kit_document(36, "", "", "", ""), kit_triangle, 36, 0);
    heard h = { .rising = true };
    ag_load_options options = { .progress = { hear_progress, &h } };
    assert_int_equal(kit_load_path(k, kit_path(k, "model.glb"), &options), AG_OK);
    assert_true(h.rising);
    assert_string_equal(h.stages, " load decode load");
    ag_scene_summary summary = ag_scene_summarize(k->scene);
    assert_true(summary.load_ms > 0.0 && summary.decode_ms >= 0.0);
    for (unsigned stop = 1; stop <= h.calls; stop++) {
        heard again = { .stop_at = stop };
        options.progress.user = &again;
        assert_int_equal(kit_load_path(k, kit_path(k, "model.glb"), &options), AG_ERROR_CANCELLED);
        assert_int_equal(k->errors, 1);
        assert_int_equal(k->scene->meshes_count + k->scene->instances_count, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cut_at_every_length),
        cmocka_unit_test(every_byte_changed),
        cmocka_unit_test(containers),
        cmocka_unit_test(documents),
        cmocka_unit_test(buffer_views),
        cmocka_unit_test(deep_json),
        cmocka_unit_test(expansion_is_bounded),
        cmocka_unit_test(instances_are_bounded),
        cmocka_unit_test(progress),
    };
    return cmocka_run_group_tests(tests, kit_setup, kit_teardown);
}
