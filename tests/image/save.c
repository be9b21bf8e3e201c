// Written files: read back the same, in the format of the name's ending, whole or not at all.
#include "files.h"

#include "base/file.h"
#include "image/deflate.h"
#include "image/half.h"

#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct folder {
    char path[64];
} folder;

static int make_folder(void **state)
{
    folder *f = malloc(sizeof *f);
    snprintf(f->path, sizeof f->path, "/tmp/argand-image-XXXXXX");
    *state = f;
    return f && mkdtemp(f->path) ? 0 : -1;
}

static unsigned count_files(const folder *f)
{
    DIR *d = opendir(f->path);
    assert_non_null(d);
    unsigned count = 0;
    for (struct dirent *e; (e = readdir(d));)
        count += e->d_name[0] != '.';
    closedir(d);
    return count;
}

static int remove_folder(void **state)
{
    folder *f = *state;
    DIR *d = opendir(f->path);
    for (struct dirent *e; d && (e = readdir(d));) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", f->path, e->d_name);
        if (e->d_name[0] != '.')
            unlink(path);
    }
    closedir(d);
    int failed = rmdir(f->path);
    free(f);
    return failed;
}

static ag_image *make(uint32_t width, uint32_t height, ag_format format)
{
    ag_image_desc desc = { width, height, format, NULL };
    ag_image *image;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    return image;
}

// Smooth colours; alpha from 255 down where that is wanted.
static ag_image *make_bytes(uint32_t width, uint32_t height, bool alpha)
{
    ag_image *image = make(width, height, AG_FORMAT_RGBA8);
    uint8_t *p = image->pixels;
    for (uint32_t i = 0; i < width * height; i++, p += 4) {
        uint32_t x = i % width, y = i / width;
        p[0] = (uint8_t)(x * 255 / width);
        p[1] = (uint8_t)(y * 255 / height);
        p[2] = (uint8_t)((x + y) * 255 / (width + height));
        p[3] = alpha ? (uint8_t)(255 - i % 256) : 255;
    }
    return image;
}

static ag_image *make_floats(uint32_t width, uint32_t height, bool alpha)
{
    ag_image *image = make(width, height, AG_FORMAT_RGBA32F);
    float *p = image->pixels;
    for (uint32_t i = 0; i < width * height; i++, p += 4) {
        for (int c = 0; c < 3; c++)
            p[c] = ldexpf(1 + (float)((i * 7 + (uint32_t)c * 31) % 97) / 97, (int)(i % 40) - 20);
        p[3] = alpha ? (float)(i % 8 + 1) / 8 : 1;
    }
    return image;
}

static ag_image *save_and_load(const folder *f, const ag_image *image, const char *name,
                               const ag_image_save_options *options)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", f->path, name);
    assert_int_equal(ag_image_save(NULL, image, path, options), AG_OK);
    ag_image *back;
    assert_int_equal(ag_image_load(NULL, path, &back), AG_OK);
    assert_int_equal(back->width, image->width);
    assert_int_equal(back->height, image->height);
    return back;
}

static size_t byte_count(const ag_image *image)
{
    return (size_t)image->width * image->height * image_pixel_size(image->format);
}

static void test_png(void **state)
{
    static const uint32_t sizes[][2] = {
        { 1, 1 }, { 1, 300 }, { 300, 1 }, { 77, 51 }, { 256, 256 }
    };
    for (int i = 0; i < 5; i++)
        for (int alpha = 0; alpha < 2; alpha++)
            for (int compression = 0; compression <= 9; compression += 1) {
                ag_image *image = make_bytes(sizes[i][0], sizes[i][1], alpha);
                ag_image_save_options options = { .compression = compression };
                ag_image *back = save_and_load(*state, image, "a.png", &options);
                assert_memory_equal(back->pixels, image->pixels, byte_count(image));
                ag_image_destroy(back);
                ag_image_destroy(image);
            }
}

// Noise, and rows that only repeat: what compression finds hard and easy.
static void test_png_noise(void **state)
{
    for (int kind = 0; kind < 3; kind++) {
        ag_image *image = make(301, 203, AG_FORMAT_RGBA8);
        uint32_t random = 1;
        uint8_t *p = image->pixels;
        for (size_t i = 0; i < byte_count(image); i++) {
            random = random * 1664525 + 1013904223;
            p[i] = kind == 0 ? (uint8_t)(random >> 24) : kind == 1 ? 7 : (uint8_t)(random >> 31);
        }
        for (int compression = 1; compression <= 3; compression++) {
            ag_image_save_options options = { .compression = compression };
            ag_image *back = save_and_load(*state, image, "a.png", &options);
            assert_memory_equal(back->pixels, image->pixels, byte_count(image));
            ag_image_destroy(back);
        }
        ag_image_destroy(image);
    }
}

// Fibonacci's numbers are the frequencies that make Huffman's codes the longest: here 22
// bits, where deflate has 15.
static void test_png_long_codes(void **state)
{
    enum { WIDTH = 256, HEIGHT = 159, COUNT = WIDTH * 3 * HEIGHT };
    uint8_t *differences = calloc(COUNT, 1);
    assert_non_null(differences);
    size_t n = 0;
    for (unsigned k = 0, now = 1, next = 1; k < 24; k++) {
        for (unsigned i = 0; i < now && n < COUNT; i++)
            differences[n++] = (uint8_t)(10 + k);
        next += now;
        now = next - now;
    }
    uint32_t random = 1;
    for (size_t i = COUNT - 1; i > 0; i--) {
        random = random * 1664525 + 1013904223;
        size_t j = (random >> 4) % (i + 1);
        uint8_t swap = differences[i];
        differences[i] = differences[j];
        differences[j] = swap;
    }
    ag_image *image = make(WIDTH, HEIGHT, AG_FORMAT_RGBA8);
    uint8_t *p = image->pixels;
    for (size_t y = 0; y < HEIGHT; y++)
        for (size_t x = 0; x < WIDTH * 4; x++) {
            size_t at = y * WIDTH * 4 + x;
            unsigned above = y ? p[at - WIDTH * 4] : 0;
            unsigned d = differences[(y * WIDTH + x / 4) * 3 + x % 4 % 3];
            p[at] = x % 4 == 3 ? 255 : (uint8_t)(above + d);
        }
    ag_image_save_options up = { .compression = 1 };
    ag_image *back = save_and_load(*state, image, "a.png", &up);
    assert_memory_equal(back->pixels, image->pixels, byte_count(image));
    ag_image_destroy(back);
    ag_image_destroy(image);
    free(differences);
}

// Adler-32, by its definition: two sums modulo 65521.
static uint32_t adler_of(const uint8_t *data, size_t size)
{
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < size; i++) {
        a = (a + data[i]) % 65521;
        b = (b + a) % 65521;
    }
    return b << 16 | a;
}

static void test_adler(void **state)
{
    assert_int_equal(deflate_adler(1, (const uint8_t *)"123456789", 9), 0x091e01de);
    enum { SIZE = 300000 };
    uint8_t *data = malloc(SIZE);
    assert_non_null(data);
    for (size_t i = 0; i < SIZE; i++)
        data[i] = i < SIZE / 2 ? 255 : (uint8_t)(i * 31);
    uint32_t whole = adler_of(data, SIZE);
    assert_int_equal(deflate_adler(1, data, SIZE), whole);
    for (size_t cut = 0; cut <= SIZE; cut += 29999) {
        uint32_t first = deflate_adler(1, data, cut);
        uint32_t second = deflate_adler(1, data + cut, SIZE - cut);
        assert_int_equal(deflate_adler_join(first, second, SIZE - cut), whole);
    }
    free(data);
    // ... and in a file, where readers may not look at it: last but the checksum and IEND
    const folder *f = *state;
    char path[128];
    snprintf(path, sizeof path, "%s/a.png", f->path);
    ag_image_desc desc = { 1, 2, AG_FORMAT_RGBA8,
                           (const uint8_t[]) { 9, 8, 7, 6, 19, 28, 37, 46 } };
    ag_image *image;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    assert_int_equal(ag_image_save(NULL, image, path, NULL), AG_OK);
    ag_image_destroy(image);
    void *file;
    size_t size;
    assert_int_equal(file_read(NULL, path, 1000, &file, &size), AG_OK);
    const uint8_t filtered[10] = { 4, 9, 8, 7, 6, 4, 10, 20, 30, 40 }, *p = file;
    uint32_t expected = adler_of(filtered, 10);
    for (size_t i = 0; i < 4; i++)
        assert_int_equal(p[size - 20 + i], expected >> (24 - 8 * i) & 255);
    free(file);
}

// More bands than are made at a time.
static void test_png_large(void **state)
{
    ag_image *image = make_bytes(1500, 1800, true);
    ag_image *back = save_and_load(*state, image, "a.png", NULL);
    assert_memory_equal(back->pixels, image->pixels, byte_count(image));
    ag_image_destroy(back);
    ag_image_destroy(image);
}

static double rms(const ag_image *a, const ag_image *b)
{
    double sum = 0;
    size_t count = (size_t)a->width * a->height;
    const uint8_t *p = a->pixels, *q = b->pixels;
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < 3; c++)
            sum += (p[4 * i + c] - q[4 * i + c]) * (p[4 * i + c] - q[4 * i + c]);
    return sqrt(sum / (double)(3 * count));
}

static void test_lossy(void **state)
{
    ag_image *image = make_bytes(120, 90, false);
    const char *const names[] = { "a.jpg", "a.JPEG", "a.webp" };
    for (int i = 0; i < 3; i++) {
        ag_image_save_options low = { .quality = 10 };
        ag_image *back = save_and_load(*state, image, names[i], NULL);
        ag_image *coarse = save_and_load(*state, image, names[i], &low);
        assert_true(rms(image, back) < 3);
        assert_true(rms(image, coarse) > rms(image, back));
        ag_image_destroy(back);
        ag_image_destroy(coarse);
    }
    ag_image_destroy(image);
}

static void test_webp_alpha(void **state)
{
    ag_image *image = make_bytes(64, 64, true);
    ag_image *back = save_and_load(*state, image, "a.webp", NULL);
    for (uint32_t y = 0; y < 64; y++)
        for (uint32_t x = 0; x < 64; x++)
            assert_int_equal(byte_pixel(back, x, y)[3], byte_pixel(image, x, y)[3]);
    ag_image_destroy(back);
    ag_image_destroy(image);
}

// Half transparent red over white, as a browser shows it.
static void test_jpeg_over_white(void **state)
{
    ag_image *image = make(16, 16, AG_FORMAT_RGBA8);
    uint8_t *p = image->pixels;
    for (int i = 0; i < 256; i++)
        memcpy(p + 4 * i, (const uint8_t[]) { 255, 0, 51, 102 }, 4);
    ag_image *back = save_and_load(*state, image, "a.jpg", NULL);
    const uint8_t *q = byte_pixel(back, 8, 8);
    assert_in_range(q[0], 253, 255);
    assert_in_range(q[1], 151, 155); // 255 * 0.6
    assert_in_range(q[2], 171, 175); // 51 * 0.4 + 255 * 0.6
    ag_image_destroy(back);
    ag_image_destroy(image);
}

// The shared exponent leaves at least 1/256 of the largest channel, rounded: 1/512 + slack.
static void check_hdr(const folder *f, uint32_t width, uint32_t height)
{
    ag_image *image = make_floats(width, height, false);
    ag_image *back = save_and_load(f, image, "a.hdr", NULL);
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            const float *p = float_pixel(image, x, y), *q = float_pixel(back, x, y);
            double most = (double)fmaxf(p[0], fmaxf(p[1], p[2]));
            for (int c = 0; c < 3; c++)
                assert_close((double)q[c], (double)p[c], most / 255);
        }
    ag_image_destroy(back);
    ag_image_destroy(image);
}

static void test_hdr(void **state)
{
    check_hdr(*state, 7, 3); // too narrow for run lengths
    check_hdr(*state, 8, 3);
    check_hdr(*state, 129, 5);
    check_hdr(*state, 1000, 2);
    check_hdr(*state, 32768, 1); // too wide for them
    check_hdr(*state, 13094, 3); // a scanline is just all that is written at once
    check_hdr(*state, 200, 200);
}

static void test_hdr_extremes(void **state)
{
    static const float in[][4] = {
        { NAN, -1, 0, 1 },  { INFINITY, 1, 1, 1 }, { 1e-39f, 0, 0, 1 }, { 1, 1, 1, 0.5f },
        { 3e38f, 1, 1, 1 }, { 255.9f, 0, 0, 1 },   { 9, 9, 9, 0 },      { 1, 2, 3, 1 },
        { 1, 2, 3, 1 },     { 1, 2, 3, 1 },        { 1, 2, 3, 1 },      { 1, 2, 3, 1 },
    };
    ag_image_desc desc = { 12, 1, AG_FORMAT_RGBA32F, in };
    ag_image *image;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    ag_image *back = save_and_load(*state, image, "a.hdr", NULL);
    for (uint32_t x = 0; x < 12; x++)
        for (int c = 0; c < 3; c++)
            assert_true(isfinite(float_pixel(back, x, 0)[c]));
    assert_true(float_pixel(back, 0, 0)[0] == 0 && float_pixel(back, 0, 0)[1] == 0);
    assert_true(float_pixel(back, 1, 0)[0] > 1e38f && float_pixel(back, 4, 0)[0] > 1e38f);
    assert_true(float_pixel(back, 2, 0)[0] == 0);
    assert_true(float_pixel(back, 3, 0)[1] == 1); // 1 * 0.5 + 0.5
    assert_true(float_pixel(back, 5, 0)[0] == 256);
    assert_true(float_pixel(back, 6, 0)[0] == 1); // white
    assert_true(float_pixel(back, 11, 0)[2] == 3);
    ag_image_destroy(back);
    ag_image_destroy(image);
}

static void test_exr(void **state)
{
    for (int kind = 0; kind < 4; kind++) {
        bool alpha = kind & 1, halves = kind & 2;
        ag_image *image = make_floats(133, 37, alpha);
        float *p = image->pixels;
        for (size_t i = 0; halves && i < byte_count(image) / 4; i++)
            p[i] = half_to_float(half_from_float_clamped(p[i]));
        ag_image *back = save_and_load(*state, image, "a.exr", NULL);
        for (uint32_t i = 0; i < 133 * 37; i++) {
            const float *a = float_pixel(image, i % 133, i / 133);
            const float *b = float_pixel(back, i % 133, i / 133);
            assert_true(a[3] == b[3]);
            for (int c = 0; c < 3; c++) // by alpha and back again: two roundings
                assert_close((double)b[c], (double)a[c], alpha ? 2e-7 * (double)a[c] : 0);
        }
        ag_image_destroy(back);
        ag_image_destroy(image);
    }
}

static long file_size(const folder *f, const char *name)
{
    char path[128];
    struct stat st;
    snprintf(path, sizeof path, "%s/%s", f->path, name);
    assert_int_equal(stat(path, &st), 0);
    return (long)st.st_size;
}

static void test_exr_sizes(void **state)
{
    const folder *f = *state;
    ag_image *image = make_floats(256, 64, false);
    ag_image_destroy(save_and_load(f, image, "float.exr", NULL));
    float *p = image->pixels;
    for (size_t i = 0; i < byte_count(image) / 4; i++)
        p[i] = half_to_float(half_from_float_clamped(p[i]));
    ag_image_destroy(save_and_load(f, image, "half.exr", NULL));
    assert_true(file_size(f, "half.exr") < file_size(f, "float.exr"));
    ag_image_destroy(image);
}

static void test_endings(void **state)
{
    const folder *f = *state;
    ag_image *image = make_bytes(4, 4, false);
    kept_log kept;
    ag_log log = log_that_keeps(&kept);
    static const char *const names[] = { "a", "a.gif", "a.png/b", ".png.d/x", "a.png ", "" };
    for (int i = 0; i < 6; i++) {
        char path[128];
        snprintf(path, sizeof path, "%s/%s", f->path, names[i]);
        assert_int_equal(ag_image_save(&log, image, path, NULL), AG_ERROR_ARGUMENT);
        assert_memory_equal(kept.text, path, strlen(path));
    }
    ag_image_save_options options = { .quality = 101 };
    assert_int_equal(ag_image_save(&log, image, "a.jpg", &options), AG_ERROR_ARGUMENT);
    options = (ag_image_save_options) { .compression = -1 };
    assert_int_equal(ag_image_save(&log, image, "a.png", &options), AG_ERROR_ARGUMENT);
    assert_int_equal(count_files(f), 0);
    ag_image_destroy(image);
}

// The same bytes, wherever they go.
static void test_memory(void **state)
{
    const folder *f = *state;
    ag_image *image = make_bytes(40, 30, true);
    static const char *const names[] = { "a.png", "a.jpg", "a.webp", "a.hdr", "a.exr" };
    for (int i = 0; i < 5; i++) {
        char path[128];
        snprintf(path, sizeof path, "%s/%s", f->path, names[i]);
        assert_int_equal(ag_image_save(NULL, image, path, NULL), AG_OK);
        void *kept, *wanted;
        size_t size, wanted_size;
        assert_int_equal(ag_image_save_memory(NULL, image, names[i], NULL, &kept, &size), AG_OK);
        assert_int_equal(file_read(NULL, path, 1 << 20, &wanted, &wanted_size), AG_OK);
        assert_int_equal(size, wanted_size);
        assert_memory_equal(kept, wanted, size);
        free(kept);
        free(wanted);
    }
    kept_log kept;
    ag_log log = log_that_keeps(&kept);
    void *data;
    size_t size;
    assert_int_equal(ag_image_save_memory(&log, image, "a", NULL, &data, &size), AG_ERROR_ARGUMENT);
    assert_null(data);
    ag_image_destroy(image);
}

static void test_too_large(void **state)
{
    const folder *f = *state;
    ag_image *image = make(70000, 1, AG_FORMAT_RGBA8);
    kept_log kept;
    ag_log log = log_that_keeps(&kept);
    static const char *const names[] = { "a.jpg", "a.webp" };
    for (int i = 0; i < 2; i++) {
        char path[128];
        snprintf(path, sizeof path, "%s/%s", f->path, names[i]);
        assert_int_equal(ag_image_save(&log, image, path, NULL), AG_ERROR_UNSUPPORTED);
        assert_non_null(strstr(kept.text, "70000 x 1"));
    }
    assert_int_equal(count_files(f), 0);
    ag_image_destroy(image);
    image = make_bytes((1 << 20) + 5, 1, true); // PNG's other way
    ag_image *back = save_and_load(f, image, "a.png", NULL);
    assert_memory_equal(back->pixels, image->pixels, byte_count(image));
    ag_image_destroy(back);
    ag_image_destroy(image);
}

static const char *const endings[] = { "png", "jpg", "webp", "hdr", "exr" };

static void test_no_folder(void **state)
{
    const folder *f = *state;
    ag_image *image = make_bytes(40, 40, true);
    for (int i = 0; i < 5; i++) {
        kept_log kept;
        ag_log log = log_that_keeps(&kept);
        char path[128];
        snprintf(path, sizeof path, "%s/none/a.%s", f->path, endings[i]);
        assert_int_equal(ag_image_save(&log, image, path, NULL), AG_ERROR_FILE);
        assert_int_equal(kept.count, 1);
        assert_memory_equal(kept.text, path, strlen(path));
    }
    ag_image_destroy(image);
}

// A full disk, as the process sees it: the file that was there stays, nothing lies about.
static void test_full_disk(void **state)
{
    const folder *f = *state;
    ag_image *image = make(200, 200, AG_FORMAT_RGBA8);
    uint32_t random = 1;
    for (size_t i = 0; i < byte_count(image); i++)
        ((uint8_t *)image->pixels)[i] = (uint8_t)((random = random * 1664525 + 1013904223) >> 24);
    signal(SIGXFSZ, SIG_IGN);
    struct rlimit before, small;
    getrlimit(RLIMIT_FSIZE, &before);
    for (int i = 0; i < 5; i++) {
        char path[128];
        snprintf(path, sizeof path, "%s/a.%s", f->path, endings[i]);
        assert_int_equal(file_write(NULL, path, "before", 6), AG_OK);
        small = (struct rlimit) { 4096, before.rlim_max };
        setrlimit(RLIMIT_FSIZE, &small);
        kept_log kept;
        ag_log log = log_that_keeps(&kept);
        ag_status status = ag_image_save(&log, image, path, NULL);
        setrlimit(RLIMIT_FSIZE, &before);
        assert_int_equal(status, AG_ERROR_FILE);
        assert_int_equal(kept.count, 1);
        assert_memory_equal(kept.text, path, strlen(path));
        void *data;
        size_t size;
        assert_int_equal(file_read(NULL, path, 100, &data, &size), AG_OK);
        assert_int_equal(size, 6);
        free(data);
        assert_int_equal(count_files(f), i + 1);
    }
    ag_image_destroy(image);
}

static void test_create(void **state)
{
    (void)state;
    kept_log kept;
    ag_log log = log_that_keeps(&kept);
    static const uint32_t sizes[][2] = {
        { 0, 1 }, { 1, 0 }, { 1 << 15, (1 << 13) + 1 }, { UINT32_MAX, UINT32_MAX }
    };
    for (int i = 0; i < 4; i++) {
        ag_image *image;
        ag_image_desc desc = { sizes[i][0], sizes[i][1], AG_FORMAT_RGBA8, NULL };
        assert_int_equal(ag_image_create(&log, &desc, &image), AG_ERROR_ARGUMENT);
        assert_null(image);
    }
    assert_int_equal(kept.count, 4);
    ag_image *image = make(3, 2, AG_FORMAT_RGBA8);
    assert_memory_equal(ag_image_pixels(image), (const uint8_t[24]) { 0 }, 24);
    assert_int_equal(ag_image_width(image), 3);
    assert_int_equal(ag_image_height(image), 2);
    assert_int_equal(ag_image_format(image), AG_FORMAT_RGBA8);
    ag_image_destroy(image);
    ag_image_destroy(NULL);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(test_png),
        WITH_FOLDER(test_png_noise),
        WITH_FOLDER(test_png_long_codes),
        WITH_FOLDER(test_png_large),
        WITH_FOLDER(test_adler),
        WITH_FOLDER(test_lossy),
        WITH_FOLDER(test_webp_alpha),
        WITH_FOLDER(test_jpeg_over_white),
        WITH_FOLDER(test_hdr),
        WITH_FOLDER(test_hdr_extremes),
        WITH_FOLDER(test_exr),
        WITH_FOLDER(test_exr_sizes),
        WITH_FOLDER(test_memory),
        WITH_FOLDER(test_endings),
        WITH_FOLDER(test_too_large),
        WITH_FOLDER(test_no_folder),
        WITH_FOLDER(test_full_disk),
        cmocka_unit_test(test_create),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
