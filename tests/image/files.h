// What make_files.py put into the files of fuzz/corpus, and help to read them.
#ifndef TESTS_IMAGE_FILES_H
#define TESTS_IMAGE_FILES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "image/image.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { FILE_WIDTH = 9, FILE_HEIGHT = 7 };

// Sample `c` of pixel (x, y) in `depth` bits.
static inline unsigned file_sample(int x, int y, int c, int depth)
{
    return (unsigned)((x * 7919 + y * 10007 + c * 20011 + 1234) % 65536) >> (16 - depth);
}

static inline void assert_close(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.12g is not %.12g to within %g", value, expected, tolerance);
}

// A log that keeps the last sentence.
typedef struct kept_log {
    char text[1024];
    int count;
} kept_log;

static inline void keep_sentence(void *user, ag_log_level level, const char *sentence)
{
    (void)level;
    kept_log *kept = user;
    snprintf(kept->text, sizeof kept->text, "%s", sentence);
    kept->count++;
}

static inline ag_log log_that_keeps(kept_log *kept)
{
    *kept = (kept_log) { .count = 0 };
    return (ag_log) { .write = keep_sentence, .user = kept };
}

static inline ag_image *load_file(const char *name)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", CORPUS, name);
    ag_image *image;
    assert_int_equal(ag_image_load(NULL, path, &image), AG_OK);
    return image;
}

static inline const uint8_t *byte_pixel(const ag_image *image, uint32_t x, uint32_t y)
{
    assert_int_equal(image->format, AG_FORMAT_RGBA8);
    return (const uint8_t *)image->pixels + ((size_t)y * image->width + x) * 4;
}

static inline const float *float_pixel(const ag_image *image, uint32_t x, uint32_t y)
{
    assert_int_equal(image->format, AG_FORMAT_RGBA32F);
    return (const float *)image->pixels + ((size_t)y * image->width + x) * 4;
}

#endif
