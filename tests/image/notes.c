// Notes in PNG and OpenEXR files, found by walking through the bytes as the standards lay them out.
#include "files.h"

#include <stdlib.h>

typedef struct file {
    uint8_t *bytes;
    size_t size;
} file;

static const ag_image_note notes[] = {
    { "Software", "a test", 0 },
    { "Title", "gr\xc3\xbc\xc3\x9f", 0 }, // UTF-8
    { "ev100", NULL, 14.875 },
    { "comments", "", 0 },
};

static file save(const char *name, int compression)
{
    ag_image_desc desc = { 19, 5, AG_FORMAT_RGBA32F, NULL };
    ag_image_save_options options = {
        .compression = compression,
        .notes = notes,
        .note_count = sizeof notes / sizeof *notes,
    };
    ag_image *image;
    void *bytes;
    file f;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    assert_int_equal(ag_image_save_memory(NULL, image, name, &options, &bytes, &f.size), AG_OK);
    f.bytes = bytes;
    ag_image_destroy(image);
    assert_int_equal(ag_image_load_memory(NULL, name, f.bytes, f.size, &image), AG_OK);
    ag_image_destroy(image);
    return f;
}

static size_t big_endian(const uint8_t *p)
{
    return (size_t)p[0] << 24 | (size_t)p[1] << 16 | (size_t)p[2] << 8 | p[3];
}

// A chunk of this type whose data begin with `data`, before the pixels.
static bool png_has(const file *f, const char *type, const void *data, size_t size)
{
    for (size_t at = 8; memcmp(f->bytes + at + 4, "IDAT", 4) != 0;) {
        size_t length = big_endian(f->bytes + at);
        if (memcmp(f->bytes + at + 4, type, 4) == 0 && length == size &&
            memcmp(f->bytes + at + 8, data, size) == 0)
            return true;
        at += length + 12;
    }
    return false;
}

static void test_png(void **state)
{
    (void)state;
    for (int compression = 1; compression <= 9; compression++) {
        file f = save("a.png", compression);
        assert_true(png_has(&f, "tEXt", "Software\0a test", 15));
        assert_true(png_has(&f, "iTXt", "Title\0\0\0\0\0gr\xc3\xbc\xc3\x9f", 16));
        assert_true(png_has(&f, "tEXt", "ev100\00014.875", 12));
        assert_true(png_has(&f, "tEXt", "comments\0", 9));
        free(f.bytes);
    }
}

// The attribute's value, of this type and size; NULL where there is none.
static const uint8_t *exr_find(const file *f, const char *name, const char *type, uint32_t size)
{
    const uint8_t *p = f->bytes + 8;
    while (*p) {
        const char *key = (const char *)p, *kind = key + strlen(key) + 1;
        uint32_t length;
        memcpy(&length, kind + strlen(kind) + 1, 4);
        p = (const uint8_t *)kind + strlen(kind) + 5;
        if (strcmp(key, name) == 0 && strcmp(kind, type) == 0 && length == size)
            return p;
        p += length;
    }
    return NULL;
}

static void check_exr(const file *f)
{
    assert_memory_equal(exr_find(f, "Software", "string", 6), "a test", 6);
    assert_memory_equal(exr_find(f, "Title", "string", 6), "gr\xc3\xbc\xc3\x9f", 6);
    assert_non_null(exr_find(f, "comments", "string", 0));
    float ev;
    memcpy(&ev, exr_find(f, "ev100", "float", 4), 4);
    assert_true(ev == 14.875f);
}

static void test_exr(void **state)
{
    (void)state;
    file f = save("a.exr", 0);
    check_exr(&f);
    free(f.bytes);
}

static void test_exr_layers(void **state)
{
    (void)state;
    char folder[] = "/tmp/argand-notes-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/a.exr", folder);
    ag_image_desc desc = { 4, 4, AG_FORMAT_RGBA32F, NULL };
    ag_image *image;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    ag_image_layer layers[] = { { NULL, image, NULL }, { "depth", image, "Z" } };
    ag_image_save_options options = { .notes = notes, .note_count = 4 };
    assert_int_equal(ag_image_save_layers(NULL, layers, 2, path, &options), AG_OK);
    uint8_t bytes[4096] = { 0 };
    FILE *stream = fopen(path, "rb");
    assert_true(fread(bytes, 1, sizeof bytes - 1, stream) > 0);
    fclose(stream);
    check_exr(&(file) { .bytes = bytes });
    remove(path);
    remove(folder);
    ag_image_destroy(image);
}

// The other formats have no place for them.
static void test_others(void **state)
{
    (void)state;
    static const char *const names[] = { "a.jpg", "a.webp", "a.hdr" };
    for (int i = 0; i < 3; i++)
        free(save(names[i], 0).bytes);
}

static void refused(const char *name, const ag_image_note *list, size_t count, const char *text)
{
    kept_log kept;
    ag_log log = log_that_keeps(&kept);
    ag_image_desc desc = { 4, 4, AG_FORMAT_RGBA32F, NULL };
    ag_image_save_options options = { .notes = list, .note_count = count };
    ag_image *image;
    void *bytes;
    size_t size;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    assert_int_equal(ag_image_save_memory(&log, image, name, &options, &bytes, &size),
                     AG_ERROR_ARGUMENT);
    assert_null(bytes);
    assert_int_equal(kept.count, 1);
    assert_non_null(strstr(kept.text, text));
    ag_image_destroy(image);
}

static void test_refused(void **state)
{
    (void)state;
    static const char *const wrong[] = {
        NULL, "", " a", "a ", "a  b", "a\n", "\xc3\xbc", "abcdefghijklmnopqrstuvwxyz123456",
    };
    for (int i = 0; i < 8; i++)
        refused("a.png", (ag_image_note[]) { { wrong[i], "text", 0 } }, 1, "note 0 has no key");
    ag_image_note twice[] = { { "a", "x", 0 }, { "b", "y", 0 }, { "a", "z", 0 } };
    refused("a.exr", twice, 3, "note 'a' is there twice");
    refused("a.exr", (ag_image_note[]) { { "channels", "x", 0 } }, 1, "every OpenEXR file has");
    char *endless = malloc((1 << 24) + 2);
    memset(endless, 'x', (1 << 24) + 1);
    endless[(1 << 24) + 1] = 0;
    refused("a.png", (ag_image_note[]) { { "a", endless, 0 } }, 1, "longer than 2^24 bytes");
    free(endless);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_png),        cmocka_unit_test(test_exr),
        cmocka_unit_test(test_exr_layers), cmocka_unit_test(test_others),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
