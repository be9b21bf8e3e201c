// Text: widths, lines, broken UTF-8, and where the ink falls.
#include "viewer/text.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

static const text_style style = { .size_px = 14 };
static const color white = { 255, 255, 255, 255 };

static int open_font(void **state)
{
    text *t;
    if (text_create(NULL, &t))
        return -1;
    *state = t;
    return 0;
}

static int close_font(void **state)
{
    text_destroy(*state);
    return 0;
}

static float width_of(text *t, const char *utf8)
{
    return text_width(t, style, utf8, SIZE_MAX);
}

// ---- Widths ----------------------------------------------------------------

static void test_digits_are_of_one_width(void **state)
{
    float one = width_of(*state, "1");
    assert_true(one > 5 && one < 12);
    for (const char *d = "0123456789"; *d; d++)
        assert_true(text_width(*state, style, d, 1) == one);
    assert_true(fabsf(width_of(*state, "1111.11") - width_of(*state, "8888.88")) < 1e-3f);
}

static void test_widths_scale_with_the_size(void **state)
{
    static const char sentence[] = "Roughness, metalness: AVATAR 0.35 \xc2\xb7 \xc3\xa9";
    float one = width_of(*state, sentence);
    for (float scale = 1.5f; scale < 5; scale += 0.5f) {
        text_style larger = { .size_px = 14 * scale };
        float wide = text_width(*state, larger, sentence, SIZE_MAX);
        assert_true(fabsf(wide - scale * one) < 0.005f * wide);
    }
}

static void test_neighbours_are_kerned(void **state)
{
    float apart = width_of(*state, "A") + width_of(*state, "V");
    assert_true(width_of(*state, "AV") < apart - 0.3f);
    assert_true(fabsf(width_of(*state, "HH") - 2 * width_of(*state, "H")) < 1e-3f);
}

static void test_sizes_and_styles_are_kept_apart(void **state)
{
    text_style bold = { .size_px = 14, .bold = true };
    float regular = width_of(*state, "mm"), wide = text_width(*state, bold, "mm", SIZE_MAX);
    assert_true(wide > regular + 0.5f);
    assert_true(width_of(*state, "mm") == regular);
}

// ---- UTF-8 -----------------------------------------------------------------

#define BAD "\xef\xbf\xbd" // U+FFFD

static void test_broken_utf8(void **state)
{
    static const char *const pairs[][2] = {
        { "a\xff"
          "b",
          "a" BAD "b" },
        { "\xc0\x80", BAD BAD },                 // overlong
        { "\xe0\x9f\xbf", BAD BAD BAD },         // overlong
        { "\xed\xa0\x80", BAD BAD BAD },         // a surrogate
        { "\xf4\x90\x80\x80", BAD BAD BAD BAD }, // above U+10FFFF
        { "\xe2\x82", BAD BAD },                 // cut short
        { "\xe2\x82"
          "A",
          BAD BAD "A" },
        { "\x80", BAD },
        { "\t\x7f\xc2\x85"
          "A",
          "A" }, // control characters
    };
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        assert_true(width_of(*state, pairs[i][0]) == width_of(*state, pairs[i][1]));
    assert_true(width_of(*state, "\xc3\xa9") != width_of(*state, BAD));
}

static void test_nothing_is_read_past_the_length(void **state)
{
    static const char two[] = "A\xf0\x9f\x98\x80";
    assert_true(text_width(*state, style, two, 3) == width_of(*state, "A" BAD BAD));
    assert_true(text_width(*state, style, two, 1) == width_of(*state, "A"));
    assert_true(text_width(*state, style, two, 0) == 0);
}

static void test_any_bytes_are_survived(void **state)
{
    uint8_t pixels[64 * 32 * 4] = { 0 };
    canvas c = { pixels, 64, 32 };
    uint32_t random = 1;
    for (int i = 0; i < 2000; i++) {
        char bytes[9] = { 0 };
        for (int j = 0; j < 8; j++)
            bytes[j] = (char)((random = random * 1664525u + 1013904223u) >> 24);
        float end = text_draw(*state, &c, 3, 20, style, white, bytes, SIZE_MAX);
        assert_true(isfinite(end) && end >= 0 && text_fit(*state, style, bytes, 20) <= 8);
    }
}

// ---- Lines -----------------------------------------------------------------

static void test_lines_are_broken_at_spaces(void **state)
{
    static const char sentence[] = "the quick brown fox jumps over the lazy dog";
    const char *at = sentence;
    int lines = 0;
    while (*at) {
        size_t length = text_fit(*state, style, at, 100);
        assert_true(length > 0 && text_width(*state, style, at, length) <= 100);
        at += length;
        assert_true(*at == ' ' || *at == '\0');
        if (*at) { // the next word would not have fitted
            size_t word = strcspn(at + 1, " ");
            assert_true(text_width(*state, style, at - length, length + 1 + word) > 100);
            at++;
        }
        lines++;
    }
    assert_true(lines > 2);
    assert_int_equal(text_fit(*state, style, sentence, 1e6f), strlen(sentence));
    assert_int_equal(text_fit(*state, style, "two\nlines", 1e6f), 3);
    assert_int_equal(text_fit(*state, style, "", 100), 0);
}

static void test_a_long_word_is_broken_inside(void **state)
{
    static const char word[] = "\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9\xc3\xa9";
    size_t length = text_fit(*state, style, word, 30);
    assert_true(length > 2 && length < strlen(word) && length % 2 == 0); // whole characters
    assert_int_equal(text_fit(*state, style, word, 0), 2);
    assert_int_equal(text_fit(*state, style, word, -5), 2);
}

// ---- Ink -------------------------------------------------------------------

enum { wide = 240, high = 160 };

typedef struct ink {
    int left, top, right, bottom; // right and bottom are outside
    double x, y, sum;             // its centre and amount
} ink;

static ink measure_ink(text *t, float x, float y, text_style s, const char *utf8)
{
    static uint8_t pixels[wide * high * 4];
    memset(pixels, 0, sizeof pixels);
    canvas c = { pixels, wide, high };
    text_draw(t, &c, x, y, s, white, utf8, SIZE_MAX);
    ink found = { .left = wide, .top = high };
    for (int j = 0; j < high; j++) {
        for (int i = 0; i < wide; i++) {
            double alpha = pixels[4 * (j * wide + i) + 3];
            if (alpha < 1)
                continue;
            found.left = i < found.left ? i : found.left;
            found.top = j < found.top ? j : found.top;
            found.right = i + 1 > found.right ? i + 1 : found.right;
            found.bottom = j + 1;
            found.x += alpha * i;
            found.y += alpha * j;
            found.sum += alpha;
        }
    }
    found.x /= found.sum;
    found.y /= found.sum;
    return found;
}

// DejaVu's capitals are 1493 of 2048 units high and stand on the base line; hinting makes heights
// whole.
static void test_capitals_stand_on_the_base_line(void **state)
{
    for (float size = 12; size <= 120; size += 12) {
        ink h = measure_ink(*state, 20, 130, (text_style) { .size_px = size }, "H");
        assert_int_equal(h.bottom, 130);
        assert_true(fabs(h.bottom - h.top - (double)size * 1493 / 2048) <= 1.5);
    }
}

static void test_ink_lies_between_the_metrics(void **state)
{
    static const char sentence[] = "\xc3\x85gQj|_";
    text_style s = { .size_px = 40 };
    text_metrics m = text_line(*state, s);
    ink found = measure_ink(*state, 10, 80, s, sentence);
    float width = text_width(*state, s, sentence, SIZE_MAX);
    assert_true(found.left >= 8 && (float)found.right <= 12 + width);
    assert_true((float)found.top >= 79 - m.ascent && (float)found.bottom <= 81 + m.descent);
    assert_true(m.ascent > 30 && m.descent > 5 && m.line >= m.ascent + m.descent - 1);
}

static void test_letters_stand_at_quarters_of_a_pixel(void **state)
{
    double from = measure_ink(*state, 20, 40, style, "o").x;
    for (int i = 1; i <= 8; i++) {
        double x = measure_ink(*state, 20 + 0.25f * (float)i, 40, style, "o").x;
        assert_true(fabs(x - from - 0.25 * i) < 0.03);
    }
}

static void test_nothing_is_drawn_outside(void **state)
{
    static uint8_t pixels[3 * 16 * 16 * 4];
    canvas c = { pixels + 16 * 16 * 4, 16, 16 };
    for (int y = -30; y < 60; y += 7)
        for (int x = -60; x < 40; x += 9)
            text_draw(*state, &c, (float)x, (float)y, (text_style) { .size_px = 30 }, white, "WgW",
                      SIZE_MAX);
    size_t inside = 0;
    for (size_t i = 0; i < sizeof pixels; i++) {
        bool within = i / 1024 == 1;
        assert_true(within || pixels[i] == 0);
        inside += pixels[i] > 0;
    }
    assert_true(inside > 100);
}

// Far more glyphs than are kept.
static void test_the_glyphs_may_all_change(void **state)
{
    float before = width_of(*state, "Argand");
    for (int size = 8; size < 60; size++)
        for (char c = '!'; c < '~'; c++)
            text_width(*state, (text_style) { .size_px = (float)size }, &c, 1);
    assert_true(width_of(*state, "Argand") == before);
    assert_true(measure_ink(*state, 10, 40, style, "Argand").sum > 1000);
}

// ---- Shapes ----------------------------------------------------------------

static void test_colors_are_laid_over(void **state)
{
    (void)state;
    for (int back = 0; back < 256; back += 15) {
        for (int front = 0; front < 256; front += 15) {
            uint8_t pixel[4] = { 200, 40, 90, (uint8_t)back };
            canvas c = { pixel, 1, 1 };
            canvas_fill(&c, (box) { -5, -5, 11, 11 }, 0, (color) { 10, 220, 90, (uint8_t)front });
            double f = front / 255.0, b = back / 255.0, a = f + b - f * b;
            assert_true(fabs(pixel[3] - 255 * a) <= 0.5 + 1e-3);
            if (a == 0)
                continue;
            assert_true(fabs(pixel[0] - (10 * f + 200 * b * (1 - f)) / a) <= 0.5 + 1e-3);
            assert_true(fabs(pixel[1] - (220 * f + 40 * b * (1 - f)) / a) <= 0.5 + 1e-3);
            assert_int_equal(pixel[2], 90);
        }
    }
}

// The alpha of a shape sums to its area: pi r^2 for corners that make a disk.
static void test_a_shape_has_its_area(void **state)
{
    (void)state;
    static uint8_t pixels[wide * high * 4];
    const struct {
        box shape;
        float radius;
        double area;
    } cases[] = {
        { { 20.3f, 30.6f, 50.25f, 40.5f }, 0, 50.25 * 40.5 },
        { { 20.3f, 30.6f, 60, 60 }, 30, 3.14159265 * 900 },
        { { 20.3f, 30.6f, 60, 60 }, 99, 3.14159265 * 900 },
        { { 10, 10, 200, 100 }, 12, 200 * 100 - (4 - 3.14159265) * 144 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        memset(pixels, 0, sizeof pixels);
        canvas c = { pixels, wide, high };
        canvas_fill(&c, cases[i].shape, cases[i].radius, white);
        double sum = 0;
        for (size_t p = 3; p < sizeof pixels; p += 4)
            sum += pixels[p] / 255.0;
        assert_true(fabs(sum - cases[i].area) < 0.003 * cases[i].area);
    }
}

// ---- The font --------------------------------------------------------------

static void keep_sentence(void *user, ag_log_level level, const char *sentence)
{
    (void)level;
    snprintf(user, 512, "%s", sentence);
}

static void test_a_missing_or_broken_font_is_told(void **state)
{
    (void)state;
    char sentence[512] = "", folder[] = "/tmp/argand-fonts-XXXXXX", path[64];
    ag_log log = { .write = keep_sentence, .user = sentence };
    text *t;
    assert_non_null(mkdtemp(folder));
    setenv("ARGAND_FONTS", folder, 1);
    assert_int_equal(text_create(&log, &t), AG_ERROR_FILE);
    assert_null(t);
    assert_non_null(strstr(sentence, folder));
    assert_non_null(strstr(sentence, "fonts-dejavu-core"));

    snprintf(path, sizeof path, "%s/DejaVuSans.ttf", folder);
    FILE *file = fopen(path, "w");
    fputs("no font", file);
    fclose(file);
    assert_int_equal(text_create(&log, &t), AG_ERROR_FORMAT);
    assert_null(t);
    unlink(path);
    rmdir(folder);
    unsetenv("ARGAND_FONTS");
    text_destroy(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_digits_are_of_one_width),
        cmocka_unit_test(test_widths_scale_with_the_size),
        cmocka_unit_test(test_neighbours_are_kerned),
        cmocka_unit_test(test_sizes_and_styles_are_kept_apart),
        cmocka_unit_test(test_broken_utf8),
        cmocka_unit_test(test_nothing_is_read_past_the_length),
        cmocka_unit_test(test_any_bytes_are_survived),
        cmocka_unit_test(test_lines_are_broken_at_spaces),
        cmocka_unit_test(test_a_long_word_is_broken_inside),
        cmocka_unit_test(test_capitals_stand_on_the_base_line),
        cmocka_unit_test(test_ink_lies_between_the_metrics),
        cmocka_unit_test(test_letters_stand_at_quarters_of_a_pixel),
        cmocka_unit_test(test_nothing_is_drawn_outside),
        cmocka_unit_test(test_the_glyphs_may_all_change),
        cmocka_unit_test(test_colors_are_laid_over),
        cmocka_unit_test(test_a_shape_has_its_area),
        cmocka_unit_test(test_a_missing_or_broken_font_is_told),
    };
    return cmocka_run_group_tests(tests, open_font, close_font);
}
