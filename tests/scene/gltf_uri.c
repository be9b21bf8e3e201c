// Files beside the .gltf, data URIs, and what may not be read.
#include "gltf_kit.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *with_uri(const char *uri)
{
    return kit_json("{'asset':{'version':'2.0'},'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}],"
                    "'buffers':[{'byteLength':36,'uri':'%s'}],"
                    "'bufferViews':[{'buffer':0,'byteLength':36}],"
                    "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3}],"
                    "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}]}",
                    uri);
}

static ag_status load(kit *k, const char *uri)
{
    kit_write_text(k, "model.gltf", with_uri(uri));
    char path[1024];
    snprintf(path, sizeof path, "%s", kit_path(k, "model.gltf"));
    return kit_load_path(k, path, NULL);
}

static void loads(kit *k, const char *uri)
{
    ag_status status = load(k, uri);
    if (status)
        print_error("said: %s", k->said);
    assert_int_equal(status, AG_OK);
    assert_int_equal(k->errors + k->warnings, 0);
    kit_near(k->scene->meshes[0].vertices[1].position[0], 1, 0);
    kit_near(k->scene->meshes[0].vertices[2].position[1], 1, 0);
}

static void fails(kit *k, ag_status status, const char *part, const char *uri)
{
    ag_status got = load(k, uri);
    if (got != status || k->errors != 1 || !strstr(k->said, part))
        print_error("wanted \"%s\", said: %s", part, k->said);
    assert_int_equal(got, status);
    assert_int_equal(k->errors, 1);
    assert_non_null(strstr(k->said, part));
    assert_int_equal(k->scene->meshes_count, 0);
}

static void files(void **state)
{
    kit *k = *state;
    kit_write(k, "data.bin", kit_triangle, 36);
    kit_write(k, "two words+ä%.bin", kit_triangle, 36);
    mkdir(kit_path(k, "inner"), 0700);
    kit_write(k, "inner/inside.bin", kit_triangle, 36);
    loads(k, "data.bin");
    loads(k, "./data.bin");
    loads(k, "%64ata.bin");
    loads(k, "two%20words+%C3%a4%25.bin");
    loads(k, "inner/inside.bin");
    loads(k, "inner/../data.bin"); // does not leave the folder
}

// The folder is the file's, wherever the program stands.
static void relative_paths(void **state)
{
    kit *k = *state;
    char before[1024];
    assert_non_null(getcwd(before, sizeof before));
    kit_write(k, "data.bin", kit_triangle, 36);
    kit_write_text(k, "model.gltf", with_uri("data.bin"));
    assert_int_equal(chdir(k->folder), 0);
    ag_status status = kit_load_path(k, "model.gltf", NULL);
    assert_int_equal(chdir(before), 0);
    assert_int_equal(status, AG_OK);
}

static void forbidden(void **state)
{
    kit *k = *state;
    kit_write(k, "data.bin", kit_triangle, 36);
    char absolute[1200], out[1200];
    snprintf(absolute, sizeof absolute, "%s/data.bin", k->folder);
    snprintf(out, sizeof out, "../%s/data.bin", strrchr(k->folder, '/') + 1);
    fails(k, AG_ERROR_FORMAT, "buffers[0].uri: \"../", out);
    fails(k, AG_ERROR_FORMAT, "climbs out of the file's folder", "../no-such-file");
    fails(k, AG_ERROR_FORMAT, "climbs out", "%2e%2e%2fetc/passwd");
    fails(k, AG_ERROR_FORMAT, "climbs out", "a/../../b");
    fails(k, AG_ERROR_FORMAT, "climbs out", "..");
    fails(k, AG_ERROR_FORMAT, "is absolute", absolute);
    fails(k, AG_ERROR_FORMAT, "is absolute", "%2fetc/passwd");
    fails(k, AG_ERROR_UNSUPPORTED, "\"http://example.org/a.bin\" names a scheme",
          "http://example.org/a.bin");
    fails(k, AG_ERROR_UNSUPPORTED, "names a scheme", "file:///etc/passwd");
    fails(k, AG_ERROR_UNSUPPORTED, "names a scheme", "DATA:,x");
    fails(k, AG_ERROR_FORMAT, "is not a file's name", "a%00b");
    fails(k, AG_ERROR_FORMAT, "is not a file's name", "a%2");
    fails(k, AG_ERROR_FORMAT, "is not a file's name", "a%zz");
    fails(k, AG_ERROR_FORMAT, "is not a file's name", "");
    fails(k, AG_ERROR_FILE, "\"missing.bin\" cannot be opened", "missing.bin");
    fails(k, AG_ERROR_FORMAT, "does not lie in", ".");
    fails(k, AG_ERROR_FILE, "is a folder", "inner");
}

static void links(void **state)
{
    kit *k = *state;
    char outside[] = "/tmp/argand-outside-XXXXXX", link[1024];
    int fd = mkstemp(outside);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, kit_triangle, 36), 36);
    close(fd);
    kit_write(k, "data.bin", kit_triangle, 36);
    snprintf(link, sizeof link, "%s", kit_path(k, "in.bin"));
    assert_int_equal(symlink("data.bin", link), 0);
    loads(k, "in.bin");
    snprintf(link, sizeof link, "%s", kit_path(k, "out.bin"));
    assert_int_equal(symlink(outside, link), 0);
    fails(k, AG_ERROR_FORMAT, "does not lie in the file", "out.bin");
    unlink(outside);
}

static void data_uris(void **state)
{
    kit *k = *state;
    // 9 floats, written out by hand: 1.0f is 00 00 80 3F.
    const char *base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    loads(k, kit_json("data:application/octet-stream;base64,%s", base64));
    loads(k, kit_json("data:;base64,%s", base64));
    loads(k, kit_json("data:a/b;charset=x;base64,%sAA==", base64)); // one byte more
    loads(k, kit_json("data:a/b;base64,%sAAA=", base64));
    fails(k, AG_ERROR_FORMAT, "buffers[0].byteLength: 36 bytes, but there are only 35",
          "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAA=");
    fails(k, AG_ERROR_FORMAT, "is a data URI that is not base64", "data:text/plain,hello");
    fails(k, AG_ERROR_FORMAT, "is a data URI that is not base64", "data:base64");
    fails(k, AG_ERROR_FORMAT, "its base64 is broken", "data:;base64,AAA");
    fails(k, AG_ERROR_FORMAT, "its base64 is broken", "data:;base64,AA=A");
    fails(k, AG_ERROR_FORMAT, "its base64 is broken", "data:;base64,A===");
    fails(k, AG_ERROR_FORMAT, "its base64 is broken", "data:;base64,AA A");
    fails(k, AG_ERROR_FORMAT, "its base64 is broken", "data:;base64,AA-_");
    fails(k, AG_ERROR_FORMAT, "there are only 0", "data:;base64,");
}

static void short_files(void **state)
{
    kit *k = *state;
    kit_write(k, "data.bin", kit_triangle, 35);
    fails(k, AG_ERROR_FORMAT, "buffers[0].byteLength: 36 bytes, but there are only 35", "data.bin");
}

static const char *with_image(const char *image)
{
    return kit_json("{'asset':{'version':'2.0'},'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}],"
                    "'buffers':[{'byteLength':36,'uri':'data.bin'}],"
                    "'bufferViews':[{'buffer':0,'byteLength':36}],"
                    "'accessors':[{'bufferView':0,'componentType':5126,'type':'VEC3','count':3}],"
                    "'images':[{'uri':'unused.png'},{'uri':'pixel.png'},{'uri':'%s'}],"
                    "'textures':[{'source':1},{'source':2}],"
                    "'materials':[{'normalTexture':{'index':0},'emissiveTexture':{'index':1}}],"
                    "'meshes':[{'primitives':[{'attributes':{'POSITION':0},'material':0}]}]}",
                    image);
}

static ag_status load_image(kit *k, const char *uri)
{
    char path[1024];
    kit_write_text(k, "model.gltf", with_image(uri));
    snprintf(path, sizeof path, "%s", kit_path(k, "model.gltf"));
    return kit_load_path(k, path, NULL);
}

static void images(void **state)
{
    kit *k = *state;
    const uint8_t pixel[4] = { 1, 2, 3, 255 };
    const ag_image_desc desc = { 1, 1, AG_FORMAT_RGBA8, pixel };
    ag_image *image;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    assert_int_equal(ag_image_save(NULL, image, kit_path(k, "pixel.png"), NULL), AG_OK);
    ag_image_destroy(image);
    kit_write(k, "data.bin", kit_triangle, 36);
    assert_int_equal(load_image(k, "./pixel.png"), AG_OK);
    assert_int_equal(k->scene->images_count, 2);
    assert_memory_equal(ag_image_pixels(k->scene->images[1]), pixel, 4);
    assert_int_equal(load_image(k, "pixel.png"), AG_OK);
    assert_int_equal(k->scene->images_count, 1); // one file
    assert_int_equal(load_image(k, "no.png"), AG_ERROR_FILE);
    assert_int_equal(k->errors, 1);
    assert_non_null(strstr(k->said, "model.gltf: images[2]: \"no.png\" cannot be opened"));
    assert_int_equal(load_image(k, "../pixel.png"), AG_ERROR_FORMAT);
    assert_non_null(strstr(k->said, "model.gltf: images[2]: \"../pixel.png\" climbs out"));
    kit_write(k, "short.png", "\x89PNG\r\n\x1a\n", 8);
    assert_int_not_equal(load_image(k, "short.png"), AG_OK);
    assert_int_equal(k->errors, 1);
    assert_non_null(strstr(k->said, "model.gltf: images[2]"));
    assert_int_equal(k->scene->images_count + k->scene->textures_count, 0);
}

static void missing_model(void **state)
{
    kit *k = *state;
    assert_int_equal(kit_load_path(k, kit_path(k, "nothing.glb"), NULL), AG_ERROR_FILE);
    assert_int_equal(k->errors, 1);
    assert_int_equal(kit_load_path(k, k->folder, NULL), AG_ERROR_FILE);
    assert_int_equal(k->errors, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files),         cmocka_unit_test(relative_paths),
        cmocka_unit_test(forbidden),     cmocka_unit_test(links),
        cmocka_unit_test(data_uris),     cmocka_unit_test(short_files),
        cmocka_unit_test(missing_model), cmocka_unit_test(images),
    };
    return cmocka_run_group_tests(tests, kit_setup, kit_teardown);
}
