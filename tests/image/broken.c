// Broken files: an error that names the file, never a crash or a great deal of memory.
#include "files.h"

#include "base/file.h"

#include <dirent.h>
#include <stdlib.h>

static const char *const folders[] = { "png", "jpeg", "webp", "hdr", "exr" };

static void *read_file(const char *path, size_t *size)
{
    void *data;
    assert_int_equal(file_read(NULL, path, 1 << 20, &data, size), AG_OK);
    return data;
}

// An exact copy on the heap, so that a sanitizer sees what is read beyond it.
static ag_status load_copy(const void *data, size_t size, kept_log *kept)
{
    ag_log log = log_that_keeps(kept);
    void *copy = malloc(size ? size : 1);
    assert_non_null(copy);
    memcpy(copy, data, size);
    ag_image *image = (ag_image *)copy; // to see that it is set
    ag_status status = ag_image_load_memory(&log, "some.file", copy, size, &image);
    assert_true((image == NULL) == (status != AG_OK));
    if (status) {
        assert_int_equal(kept->count, 1);
        assert_memory_equal(kept->text, "some.file: ", 11);
        assert_true(strlen(kept->text) < 400);
    }
    ag_image_destroy(image);
    free(copy);
    return status;
}

static void for_each_file(void (*check)(const char *name, const uint8_t *data, size_t size))
{
    for (size_t f = 0; f < sizeof folders / sizeof *folders; f++) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", CORPUS, folders[f]);
        DIR *folder = opendir(path);
        assert_non_null(folder);
        unsigned count = 0;
        for (struct dirent *entry; (entry = readdir(folder));) {
            if (entry->d_name[0] == '.')
                continue;
            snprintf(path, sizeof path, "%s/%s/%s", CORPUS, folders[f], entry->d_name);
            size_t size;
            uint8_t *data = read_file(path, &size);
            check(entry->d_name, data, size);
            free(data);
            count++;
        }
        closedir(folder);
        assert_true(count >= 5);
    }
}

static void check_bad(const char *name, const uint8_t *data, size_t size)
{
    kept_log kept;
    if (strncmp(name, "bad-", 4) == 0)
        assert_int_not_equal(load_copy(data, size, &kept), AG_OK);
}

static void test_bad_files(void **state)
{
    (void)state;
    for_each_file(check_bad);
}

static void check_cut(const char *name, const uint8_t *data, size_t size)
{
    kept_log kept;
    // WebP's padding, the checksum of PNG's empty last chunk and the smaller levels may be missing
    size_t slack = strstr(name, ".webp")       ? 2
                   : strstr(name, ".png")      ? 4
                   : strstr(name, "mip-tiles") ? 240
                                               : 0;
    if (strncmp(name, "bad-", 4) == 0 || strncmp(name, "fuzz-", 5) == 0)
        return;
    assert_int_equal(load_copy(data, size, &kept), AG_OK);
    for (size_t length = 0; length + slack < size; length++)
        if (!load_copy(data, length, &kept))
            fail_msg("%s cut to %zu of %zu bytes was read", name, length, size);
}

static void test_cut_everywhere(void **state)
{
    (void)state;
    for_each_file(check_cut);
}

static uint32_t random_next(uint32_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

static void check_corrupt(const char *name, const uint8_t *data, size_t size)
{
    (void)name;
    uint32_t random = 2463534242u;
    uint8_t *copy = malloc(size);
    assert_non_null(copy);
    kept_log kept;
    for (int i = 0; i < 100; i++) {
        memcpy(copy, data, size);
        for (unsigned n = 1 + random_next(&random) % 4; n; n--)
            copy[random_next(&random) % size] = (uint8_t)random_next(&random);
        (void)load_copy(copy, size, &kept); // either way, but soundly
    }
    free(copy);
}

static void test_corrupt(void **state)
{
    (void)state;
    for_each_file(check_corrupt);
}

static void test_sentences(void **state)
{
    (void)state;
    kept_log kept;
    assert_int_equal(load_copy("", 0, &kept), AG_ERROR_FORMAT);
    assert_int_equal(load_copy("GIF89a", 6, &kept), AG_ERROR_UNSUPPORTED);
    assert_non_null(strstr(kept.text, "PNG, JPEG, WebP, Radiance HDR and OpenEXR"));
    static const struct {
        const char *file, *word;
        ag_status status;
    } cases[] = {
        { "png/bad-huge.png", "1048576 x 1048576", AG_ERROR_UNSUPPORTED },
        { "png/bad-bomb.png", "16384 x 16384", AG_ERROR_FORMAT },
        { "webp/bad-huge.webp", "16384 x 16384", AG_ERROR_FORMAT },
        { "webp/bad-animated.webp", "animated", AG_ERROR_UNSUPPORTED },
        { "hdr/bad-xyze.hdr", "32-bit_rle_xyze", AG_ERROR_UNSUPPORTED },
        { "hdr/bad-exposure.hdr", "EXPOSURE=-1", AG_ERROR_FORMAT },
        { "hdr/bad-axes.hdr", "-Y 7 +Y 9", AG_ERROR_FORMAT },
        { "hdr/bad-first-run.hdr", "scanline 1 of 1", AG_ERROR_FORMAT },
        { "exr/bad-channels.exr", "no channels", AG_ERROR_UNSUPPORTED },
        { "exr/bad-dwaa.exr", "DWAA", AG_ERROR_UNSUPPORTED },
        { "exr/bad-huge.exr", "100000 x 100000", AG_ERROR_UNSUPPORTED },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", CORPUS, cases[i].file);
        size_t size;
        void *data = read_file(path, &size);
        assert_int_equal(load_copy(data, size, &kept), cases[i].status);
        assert_non_null(strstr(kept.text, cases[i].word));
        free(data);
    }
}

// Scan upon scan over a large picture would take minutes.
static void test_many_scans(void **state)
{
    (void)state;
    size_t size, padded = 200000;
    uint8_t *data = read_file(CORPUS "/jpeg/gray.jpg", &size);
    uint8_t *scans = calloc(padded, 1);
    assert_non_null(scans);
    memcpy(scans, data, size);
    static const uint8_t frame[2] = { 0xff, 0xc0 };
    size_t at = 0;
    while (memcmp(scans + at, frame, 2) != 0)
        at++;
    memcpy(scans + at + 5, ((const uint8_t[]) { 0x3e, 0x80, 0x3e, 0x80 }), 4); // 16000 x 16000
    for (size_t i = size; i + 100 < padded; i += 1000)
        memcpy(scans + i, ((const uint8_t[]) { 0xff, 0xda }), 2);
    kept_log kept;
    assert_int_equal(load_copy(scans, padded, &kept), AG_ERROR_UNSUPPORTED);
    assert_non_null(strstr(kept.text, "scans"));
    free(scans);
    free(data);
}

static void test_missing_file(void **state)
{
    (void)state;
    kept_log kept;
    ag_log log = log_that_keeps(&kept);
    ag_image *image;
    assert_int_equal(ag_image_load(&log, CORPUS "/none.png", &image), AG_ERROR_FILE);
    assert_int_equal(ag_image_load(&log, CORPUS, &image), AG_ERROR_FILE);
    assert_null(image);
    assert_int_equal(kept.count, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bad_files),    cmocka_unit_test(test_cut_everywhere),
        cmocka_unit_test(test_corrupt),      cmocka_unit_test(test_sentences),
        cmocka_unit_test(test_missing_file), cmocka_unit_test(test_many_scans),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
