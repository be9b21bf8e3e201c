// Layers of OpenEXR files, read by OpenEXR itself.
#include "files.h"

#include "image/half.h"

#include <openexr.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

enum { WIDTH = 37, HEIGHT = 41, PIXELS = WIDTH * HEIGHT }; // three chunks of 16 rows

// The state is the file's path.
static int make_folder(void **state)
{
    char *path = *state = calloc(64, 1);
    if (!path || !mkdtemp(strcpy(path, "/tmp/argand-layers-XXXXXX")))
        return -1;
    strcat(path, "/a.exr");
    return 0;
}

static int remove_folder(void **state)
{
    char *path = *state;
    unlink(path);
    *strrchr(path, '/') = 0;
    int failed = rmdir(path); // where a temporary file was left
    free(path);
    return failed;
}

// Values that only floats hold, or halves as well.
static ag_image *make(bool half, bool opaque)
{
    ag_image_desc desc = { WIDTH, HEIGHT, AG_FORMAT_RGBA32F, NULL };
    ag_image *image;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    float *p = image->pixels;
    for (int i = 0; i < PIXELS * 4; i++) {
        float v = (float)(i % 1009) / 64 - 2;
        p[i] = i % 4 == 3 ? (opaque ? 1 : (float)(i / 4 % 8) / 7) : half ? v : v * 1.1f;
    }
    return image;
}

typedef struct channels {
    exr_context_t exr;
    int count;
    char names[20][32];
    exr_pixel_type_t types[20];
    float *values[20];
} channels;

static void point_at_rows(exr_decode_pipeline_t *pipeline, const channels *c, int y)
{
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[i];
        channel->decode_to_ptr = (uint8_t *)(c->values[i] + (ptrdiff_t)y * WIDTH);
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = 4;
        channel->user_pixel_stride = 4;
        channel->user_line_stride = 4 * WIDTH;
    }
}

static void read_values(channels *c)
{
    for (int y = 0; y < HEIGHT; y += 16) {
        exr_chunk_info_t chunk;
        exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
        assert_int_equal(exr_read_scanline_chunk_info(c->exr, 0, y, &chunk), 0);
        assert_int_equal(exr_decoding_initialize(c->exr, 0, &chunk, &pipeline), 0);
        assert_int_equal(pipeline.channel_count, c->count);
        point_at_rows(&pipeline, c, y);
        assert_int_equal(exr_decoding_choose_default_routines(c->exr, 0, &pipeline), 0);
        assert_int_equal(exr_decoding_run(c->exr, 0, &pipeline), 0);
        exr_decoding_destroy(c->exr, &pipeline);
    }
}

static channels open_channels(const char *path)
{
    channels c = { .exr = NULL };
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    int parts;
    const exr_attr_chlist_t *list;
    assert_int_equal(exr_start_read(&c.exr, path, &settings), 0);
    assert_int_equal(exr_get_count(c.exr, &parts), 0);
    assert_int_equal(parts, 1);
    assert_int_equal(exr_get_channels(c.exr, 0, &list), 0);
    c.count = list->num_channels;
    assert_in_range(c.count, 1, 20);
    for (int i = 0; i < c.count; i++) {
        snprintf(c.names[i], sizeof c.names[i], "%s", list->entries[i].name.str);
        c.types[i] = list->entries[i].pixel_type;
        c.values[i] = calloc(PIXELS, sizeof(float));
        assert_non_null(c.values[i]);
    }
    read_values(&c);
    return c;
}

static void close_channels(channels *c)
{
    exr_finish(&c->exr);
    for (int i = 0; i < c->count; i++)
        free(c->values[i]);
}

static void check_names(const channels *c, const char *const *names, int count)
{
    assert_int_equal(c->count, count);
    for (int i = 0; i < count; i++)
        assert_string_equal(c->names[i], names[i]);
}

// Channel `name` is component `component` of the image, times its alpha where `multiplied`.
static void check_channel(const channels *c, const char *name, exr_pixel_type_t type,
                          const ag_image *image, int component, bool multiplied)
{
    int at = 0;
    while (at < c->count && strcmp(c->names[at], name) != 0)
        at++;
    assert_true(at < c->count);
    assert_int_equal(c->types[at], type);
    const float *p = image->pixels;
    for (int i = 0; i < PIXELS; i++)
        assert_true(c->values[at][i] == p[4 * i + component] * (multiplied ? p[4 * i + 3] : 1));
}

static void test_layers(void **state)
{
    const char *path = *state;
    ag_image *picture = make(true, true), *normal = make(false, false), *depth = make(true, false);
    const ag_image_layer layers[] = { { NULL, picture, NULL },
                                      { "normal", normal, "XYZ" },
                                      { "depth", depth, "Z" },
                                      { "cut", normal, NULL },
                                      { "albedo", depth, "RGB" } };
    assert_int_equal(ag_image_save_layers(NULL, layers, 5, path, NULL), AG_OK);
    channels c = open_channels(path);
    // As OpenEXR wants them: in the order of their bytes.
    static const char *const names[] = { "B",        "G",        "R",        "albedo.B", "albedo.G",
                                         "albedo.R", "cut.A",    "cut.B",    "cut.G",    "cut.R",
                                         "depth.Z",  "normal.X", "normal.Y", "normal.Z" };
    check_names(&c, names, 14);
    check_channel(&c, "G", EXR_PIXEL_HALF, picture, 1, false);
    check_channel(&c, "normal.X", EXR_PIXEL_FLOAT, normal, 0, false);
    check_channel(&c, "normal.Z", EXR_PIXEL_FLOAT, normal, 2, false);
    check_channel(&c, "depth.Z", EXR_PIXEL_HALF, depth, 0, false);
    check_channel(&c, "cut.R", EXR_PIXEL_FLOAT, normal, 0, true);
    check_channel(&c, "cut.A", EXR_PIXEL_FLOAT, normal, 3, false);
    check_channel(&c, "albedo.B", EXR_PIXEL_HALF, depth, 2, false);
    close_channels(&c);

    ag_image *back; // what has no name is the picture
    assert_int_equal(ag_image_load(NULL, path, &back), AG_OK);
    assert_memory_equal(back->pixels, picture->pixels, PIXELS * 16);
    ag_image_destroy(back);
    ag_image_destroy(picture);
    ag_image_destroy(normal);
    ag_image_destroy(depth);
}

// A picture with alpha among them: out and in again.
static void test_transparent(void **state)
{
    const char *path = *state;
    ag_image *picture = make(false, false);
    const ag_image_layer layers[] = { { "z", picture, "Z" }, { "", picture, "RGBA" } };
    assert_int_equal(ag_image_save_layers(NULL, layers, 2, path, NULL), AG_OK);
    ag_image *back;
    assert_int_equal(ag_image_load(NULL, path, &back), AG_OK);
    const float *p = picture->pixels, *q = back->pixels;
    for (int i = 0; i < PIXELS * 4; i++) {
        float alpha = p[i | 3], expected = i % 4 == 3 || alpha > 0 ? p[i] : 0;
        assert_close((double)q[i], (double)expected, 3e-7 * fabs((double)expected));
    }
    ag_image_destroy(back);
    ag_image_destroy(picture);
}

static void refused(const ag_image_layer *layers, size_t count, const char *to, const char *text)
{
    kept_log kept;
    ag_log log = log_that_keeps(&kept);
    assert_int_equal(ag_image_save_layers(&log, layers, count, to, NULL), AG_ERROR_ARGUMENT);
    assert_int_equal(kept.count, 1);
    assert_non_null(strstr(kept.text, text));
    assert_int_equal(access(to, F_OK), -1);
}

static void test_refused(void **state)
{
    const char *path = *state;
    unlink(path);
    ag_image *floats = make(true, true), *bytes, *small;
    ag_image_desc desc = { WIDTH, HEIGHT, AG_FORMAT_RGBA8, NULL };
    assert_int_equal(ag_image_create(NULL, &desc, &bytes), AG_OK);
    desc = (ag_image_desc) { WIDTH - 1, HEIGHT, AG_FORMAT_RGBA32F, NULL };
    assert_int_equal(ag_image_create(NULL, &desc, &small), AG_OK);
    const ag_image_layer good = { "a", floats, "RGB" };
    refused(&good, 1, "/tmp/argand-layers.hdr", "only .exr has layers");
    refused(&good, 0, path, "there are no layers");
    refused((ag_image_layer[]) { good, good }, 2, path, "layer 'a' is there twice");
    refused((ag_image_layer[]) { { NULL, floats, "R" }, { "", floats, "G" } }, 2, path, "twice");
    refused((ag_image_layer[]) { good, { "b", small, "RGB" } }, 2, path,
            "layer 'b' is not as large as the first");
    refused((ag_image_layer[]) { good, { "b", bytes, "RGB" } }, 2, path, "layer 'b' is of bytes");
    refused((ag_image_layer[]) { { "abcdefghijklmnopqrstuvwxyz1234", floats, "Z" } }, 1, path,
            "has a name above 29 bytes");
    static const char *const wrong[] = { "", "RGBAZ", "RR", "R.", "R G" };
    for (int i = 0; i < 5; i++)
        refused((ag_image_layer[]) { { "b", floats, wrong[i] } }, 1, path,
                "not one to four different letters");
    ag_image_layer longest = { "abcdefghijklmnopqrstuvwxyz123", floats, "Z" };
    assert_int_equal(ag_image_save_layers(NULL, &longest, 1, path, NULL), AG_OK);
    ag_image_destroy(floats);
    ag_image_destroy(bytes);
    ag_image_destroy(small);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_layers),
        cmocka_unit_test(test_transparent),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
