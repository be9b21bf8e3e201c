// Small glTF files made in a folder of their own.
#include "gltf_kit.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const float kit_triangle[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };

int kit_setup(void **state)
{
    kit *k = calloc(1, sizeof *k);
    strcpy(k->folder, "/tmp/argand-gltf-XXXXXX");
    if (!mkdtemp(k->folder))
        return -1;
    *state = k;
    return 0;
}

int kit_teardown(void **state)
{
    kit *k = *state;
    ag_scene_destroy(k->scene);
    DIR *folder = opendir(k->folder);
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        if (entry->d_name[0] == '.')
            continue;
        const char *path = kit_path(k, entry->d_name);
        if (unlink(path) != 0) { // a folder of a test's: one level
            char inner[1024];
            snprintf(inner, sizeof inner, "%s/inside.bin", path);
            unlink(inner);
            rmdir(path);
        }
    }
    closedir(folder);
    rmdir(k->folder);
    free(k);
    return 0;
}

const char *kit_json(const char *format, ...)
{
    static char texts[8][16384];
    static unsigned turn;
    char *text = texts[turn++ % 8];
    va_list args;
    va_start(args, format);
    int length = vsnprintf(text, sizeof texts[0], format, args);
    va_end(args);
    assert_in_range(length, 0, sizeof texts[0] - 1);
    for (char *c = text; *c; c++)
        if (*c == '\'')
            *c = '"';
    return text;
}

const char *kit_path(const kit *k, const char *name)
{
    static char path[1024];
    snprintf(path, sizeof path, "%s/%s", k->folder, name);
    return path;
}

void kit_write(const kit *k, const char *name, const void *data, size_t size)
{
    FILE *file = fopen(kit_path(k, name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

void kit_write_text(const kit *k, const char *name, const char *text)
{
    kit_write(k, name, text, strlen(text));
}

static void put_u32(uint8_t *to, size_t value)
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(value >> 8 * i);
}

void *kit_make_glb(const char *json, const void *bin, size_t bin_size, size_t *size)
{
    size_t length = strlen(json), json_size = (length + 3) / 4 * 4, padded = (bin_size + 3) / 4 * 4;
    *size = 20 + json_size + (bin ? 8 + padded : 0);
    uint8_t *bytes = calloc(1, *size);
    memcpy(bytes, "glTF\2\0\0\0", 8);
    put_u32(bytes + 8, *size);
    put_u32(bytes + 12, json_size);
    memcpy(bytes + 16, "JSON", 4);
    memset(bytes + 20, ' ', json_size);
    memcpy(bytes + 20, json, length);
    if (bin) {
        put_u32(bytes + 20 + json_size, padded);
        memcpy(bytes + 24 + json_size, "BIN", 4);
        memcpy(bytes + 28 + json_size, bin, bin_size);
    }
    return bytes;
}

static void hear(void *user, ag_log_level level, const char *sentence)
{
    kit *k = user;
    k->errors += level == AG_LOG_ERROR;
    k->warnings += level == AG_LOG_WARNING;
    size_t used = strlen(k->said);
    snprintf(k->said + used, sizeof k->said - used, "%s\n", sentence);
}

ag_status kit_load_path(kit *k, const char *path, const ag_load_options *options)
{
    ag_log log = { .write = hear, .user = k };
    ag_scene_destroy(k->scene);
    k->said[0] = 0;
    k->errors = k->warnings = 0;
    assert_int_equal(ag_scene_create(&log, &k->scene), AG_OK);
    return ag_scene_load(k->scene, path, options);
}

ag_status kit_load_bytes(kit *k, const void *bytes, size_t size)
{
    kit_write(k, "model.glb", bytes, size);
    return kit_load_path(k, kit_path(k, "model.glb"), NULL);
}

ag_status kit_load_glb(kit *k, const char *json, const void *bin, size_t size)
{
    size_t total;
    void *bytes = kit_make_glb(json, bin, size, &total);
    ag_status status = kit_load_bytes(k, bytes, total);
    free(bytes);
    return status;
}

void kit_loads(kit *k, const char *json, const void *bin, size_t size, unsigned warnings)
{
    ag_status status = kit_load_glb(k, json, bin, size);
    if (status || k->warnings != warnings)
        print_error("said: %s", k->said);
    assert_int_equal(status, AG_OK);
    assert_int_equal(k->errors, 0);
    assert_int_equal(k->warnings, warnings);
}

void kit_fails(kit *k, ag_status status, const char *part, const char *json, const void *bin,
               size_t size)
{
    ag_status got = kit_load_glb(k, json, bin, size);
    if (got != status || k->errors != 1 || !strstr(k->said, part))
        print_error("wanted \"%s\", said: %s", part, k->said);
    assert_int_equal(got, status);
    assert_int_equal(k->errors, 1);
    assert_non_null(strstr(k->said, "model.glb: "));
    assert_non_null(strstr(k->said, part));
    ag_scene_summary left = ag_scene_summarize(k->scene);
    assert_int_equal(left.meshes + left.materials + left.textures + left.instances + left.lights +
                         left.cameras,
                     0);
    ag_extension_info extension;
    assert_false(ag_scene_extension(k->scene, 0, &extension));
}

const char *kit_document(size_t size, const char *attributes, const char *primitive,
                         const char *accessors, const char *more)
{
    return kit_json("{'asset':{'version':'2.0'},'scene':0,'scenes':[{'nodes':[0]}],"
                    "'nodes':[{'mesh':0}],'buffers':[{'byteLength':%zu}],"
                    "'bufferViews':[{'buffer':0,'byteLength':%zu}],"
                    "'meshes':[{'primitives':[{'attributes':{'POSITION':0%s}%s}]}],"
                    "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3}"
                    "%s]%s}",
                    size, size, attributes, primitive, accessors, more);
}

void kit_near(float value, double expected, double tolerance)
{
    if (!(fabs((double)value - expected) <= tolerance))
        fail_msg("%.9g is not %.9g", (double)value, expected);
}
