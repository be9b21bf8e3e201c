// Panels: when they are remade, that they fit, that numbers do not make them tremble, and that
// they can be read over anything.
#include "viewer/panel.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const panel_room desk = { 1240, 680, 1 };

typedef struct stage {
    text *t;
    panel *p;
} stage;

static int set_up(void **state)
{
    stage *s = calloc(1, sizeof *s);
    if (text_create(NULL, &s->t) || panel_create(NULL, s->t, &s->p))
        return -1;
    *state = s;
    return 0;
}

static int tear_down(void **state)
{
    stage *s = *state;
    panel_destroy(s->p);
    text_destroy(s->t);
    free(s);
    return 0;
}

static const ag_image *show(stage *s, const panel_row *rows, size_t count, panel_room room)
{
    assert_int_equal(panel_show(s->p, rows, count, room), AG_OK);
    return panel_image(s->p);
}

// ---- Remaking --------------------------------------------------------------

static void test_only_a_change_remakes_it(void **state)
{
    stage *s = *state;
    char value[16] = "41.2 ms";
    panel_row rows[] = { { .left = "frame", .right = value },
                         { .kind = PANEL_PROGRESS, .left = "decode", .fraction = 0.25f } };
    assert_null(panel_image(s->p));
    const ag_image *image = show(s, rows, 2, desk);
    uint64_t first = panel_revision(s->p);
    assert_non_null(image);
    assert_true(show(s, rows, 2, desk) == image);
    assert_true(panel_revision(s->p) == first);

    uint64_t last = first;
    for (int change = 0; change < 6; change++) {
        panel_room room = desk;
        if (change == 0)
            value[0] = '5';
        else if (change == 1)
            rows[1].fraction = 0.5f;
        else if (change == 2)
            rows[0].kind = PANEL_KEY;
        else if (change == 3)
            rows[0].left = "frames";
        else if (change == 4)
            room.scale = 2;
        else
            rows[1].right = "";
        show(s, rows, 2, room);
        assert_true(panel_revision(s->p) != last);
        last = panel_revision(s->p);
    }
    assert_null(show(s, rows, 0, desk));
    assert_true(panel_revision(s->p) != last);
}

static void test_without_a_font_it_stays_empty(void **state)
{
    (void)state;
    panel *p;
    assert_int_equal(panel_create(NULL, NULL, &p), AG_OK);
    const panel_row row = { .kind = PANEL_NOTE, .left = "Saved" };
    assert_int_equal(panel_show(p, &row, 1, desk), AG_OK);
    assert_null(panel_image(p));
    panel_destroy(p);
    panel_destroy(NULL);
}

// ---- Size ------------------------------------------------------------------

static const panel_row many[] = {
    { PANEL_TITLE, "Argand", "version 0", 0 },
    { PANEL_SECTION, "View", NULL, 0 },
    { PANEL_KEY, "left button", "turn around the target, to which the pointer was moved", 0 },
    { PANEL_KEY, "Home", "show all", 0 },
    { PANEL_KEY, "1 / 3 / 7", "from the front, the right, the top", 0 },
    { PANEL_SECTION, "Lights", NULL, 0 },
    { PANEL_KEY, "L", "the next light", 0 },
    { PANEL_KEY, "Shift + wheel", "its radius", 0 },
    { PANEL_KEY, "Ctrl + wheel", "its intensity", 0 },
    { PANEL_SECTION, "Picture", NULL, 0 },
    { PANEL_VALUE, "exposure", "EV100 12.4, automatic", 0 },
    { PANEL_VALUE, "device", "a device whose name is longer than any that one has ever seen", 0 },
    { PANEL_NOTE, "A sentence that says what happened, long enough for two lines", "and more", 0 },
    { PANEL_ERROR, "helmet.glb: is cut short", "Fetch the file again.", 0 },
    { PANEL_PROGRESS, "decoding textures", "40 %", 0.4f },
};
static const size_t many_count = sizeof many / sizeof *many;

static void test_it_fits_its_room(void **state)
{
    stage *s = *state;
    static const uint32_t sizes[][2] = { { 440, 240 },  { 440, 900 },   { 900, 200 }, { 300, 300 },
                                         { 1240, 680 }, { 3800, 2100 }, { 20, 20 },   { 1, 1 } };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        for (float scale = 1; scale <= 3; scale += 0.5f) {
            panel_room room = { sizes[i][0], sizes[i][1], scale };
            const ag_image *image = show(s, many, many_count, room);
            assert_non_null(image);
            assert_true(ag_image_width(image) <= room.width);
            assert_true(ag_image_height(image) <= room.height);
        }
    }
}

static void test_it_grows_with_the_scale(void **state)
{
    stage *s = *state;
    const ag_image *image = show(s, many + 10, 1, desk);
    uint32_t width = ag_image_width(image), height = ag_image_height(image);
    image = show(s, many + 10, 1, (panel_room) { 1240, 680, 2 });
    assert_true(abs((int)ag_image_width(image) - 2 * (int)width) <= 4);
    assert_true(abs((int)ag_image_height(image) - 2 * (int)height) <= 4);
}

static void test_tall_ones_take_columns(void **state)
{
    stage *s = *state;
    const ag_image *image = show(s, many, 10, (panel_room) { 2000, 900, 1 });
    uint32_t width = ag_image_width(image), height = ag_image_height(image);
    image = show(s, many, 10, (panel_room) { 2000, height - 1, 1 });
    assert_true(ag_image_width(image) > width * 3 / 2);
    assert_true(ag_image_height(image) < height * 4 / 5);
}

static void test_changing_numbers_keep_the_width(void **state)
{
    stage *s = *state;
    panel_row row = { .left = "frame", .right = "110.1 ms" };
    uint32_t width = ag_image_width(show(s, &row, 1, desk));
    static const char *const values[] = { "9.9 ms", "888.8 ms", "0 ms", "111.1 ms" };
    for (int i = 0; i < 4; i++) {
        row.right = values[i];
        assert_int_equal(ag_image_width(show(s, &row, 1, desk)), width);
    }
    const panel_row rows[] = { { .left = "frame", .right = "1 ms" },
                               { .left = "now", .right = "and then" } };
    assert_int_equal(ag_image_width(show(s, rows, 2, desk)), width);
    row.left = "at";
    row.right = "1";
    assert_true(ag_image_width(show(s, &row, 1, desk)) < width);
}

// ---- Pixels ----------------------------------------------------------------

static const uint8_t *pixel(const ag_image *image, uint32_t x, uint32_t y)
{
    return (const uint8_t *)ag_image_pixels(image) + 4 * ((size_t)y * ag_image_width(image) + x);
}

// Where only a digit changes, only its pixels do.
static void test_digits_do_not_move_their_neighbours(void **state)
{
    stage *s = *state;
    panel_row row = { .left = "frame", .right = "41.2 ms" };
    const ag_image *image = show(s, &row, 1, desk);
    uint32_t width = ag_image_width(image), height = ag_image_height(image);
    size_t size = 4 * (size_t)width * height;
    uint8_t *before = malloc(size);
    memcpy(before, ag_image_pixels(image), size);
    row.right = "48.2 ms";
    image = show(s, &row, 1, desk);
    uint32_t first = width, last = 0;
    for (uint32_t x = 0; x < width; x++) {
        for (uint32_t y = 0; y < height; y++) {
            if (memcmp(before + 4 * ((size_t)y * width + x), pixel(image, x, y), 4) == 0)
                continue;
            first = x < first ? x : first;
            last = x;
        }
    }
    free(before);
    assert_true(first <= last && last - first < 12);
}

// WCAG 2.1: relative luminance and contrast.
static double luminance(const double rgb[3])
{
    double linear[3];
    for (int i = 0; i < 3; i++) {
        double c = rgb[i] / 255;
        linear[i] = c <= 0.03928 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
    }
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
}

static double luminance_over(const uint8_t *rgba, double back)
{
    double rgb[3], alpha = rgba[3] / 255.0;
    for (int i = 0; i < 3; i++)
        rgb[i] = alpha * rgba[i] + (1 - alpha) * back;
    return luminance(rgb);
}

// Level AA for text: 4.5, over white and over black.
static void test_text_stands_out_over_anything(void **state)
{
    stage *s = *state;
    static const panel_row_kind kinds[] = { PANEL_VALUE, PANEL_KEY,   PANEL_TITLE,
                                            PANEL_NOTE,  PANEL_ERROR, PANEL_SECTION };
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        for (double back = 0; back <= 255; back += 255) {
            const panel_row row = { .kind = kinds[k], .left = "HHHH" };
            const ag_image *image = show(s, &row, 1, desk);
            double brightest = 0;
            uint32_t height = ag_image_height(image), width = ag_image_width(image);
            for (uint32_t y = 4; y < height - 4; y++)
                for (uint32_t x = 4; x < width - 4; x++)
                    brightest = fmax(brightest, luminance_over(pixel(image, x, y), back));
            double plate = luminance_over(pixel(image, width / 2, 4), back);
            assert_true((brightest + 0.05) / (plate + 0.05) >= 4.5);
        }
    }
}

static void test_corners_are_round_and_the_plate_is_dense(void **state)
{
    stage *s = *state;
    const ag_image *image = show(s, many, many_count, desk);
    uint32_t width = ag_image_width(image), height = ag_image_height(image);
    assert_int_equal(pixel(image, 0, 0)[3], 0);
    assert_int_equal(pixel(image, width - 1, 0)[3], 0);
    assert_int_equal(pixel(image, 0, height - 1)[3], 0);
    assert_true(pixel(image, width / 2, 4)[3] > 200 && pixel(image, width / 2, 4)[3] < 255);
}

// The bar is the longest run of one bright colour.
static uint32_t longest_run(const ag_image *image)
{
    uint32_t longest = 0;
    for (uint32_t y = 0; y < ag_image_height(image); y++) {
        uint32_t run = 0;
        for (uint32_t x = 1; x < ag_image_width(image); x++) {
            const uint8_t *p = pixel(image, x, y);
            bool same = p[2] > 200 && p[3] > 200 && memcmp(p, p - 4, 4) == 0;
            run = same ? run + 1 : 0;
            longest = run > longest ? run : longest;
        }
    }
    return longest;
}

static void test_the_bar_is_as_long_as_it_says(void **state)
{
    stage *s = *state;
    panel_row row = { PANEL_PROGRESS, "decode", NULL, 1 };
    double whole = longest_run(show(s, &row, 1, desk));
    assert_true(whole > 200);
    for (int i = 1; i < 10; i++) {
        row.fraction = 0.1f * (float)i;
        assert_true(fabs(longest_run(show(s, &row, 1, desk)) - 0.1 * i * whole) < 5);
    }
    static const float odd[] = { NAN, -1, INFINITY };
    for (int i = 0; i < 3; i++) {
        row.fraction = odd[i];
        assert_non_null(show(s, &row, 1, desk));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_only_a_change_remakes_it, set_up, tear_down),
        cmocka_unit_test(test_without_a_font_it_stays_empty),
        cmocka_unit_test_setup_teardown(test_it_fits_its_room, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_it_grows_with_the_scale, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_tall_ones_take_columns, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_changing_numbers_keep_the_width, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_digits_do_not_move_their_neighbours, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(test_text_stands_out_over_anything, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_corners_are_round_and_the_plate_is_dense, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(test_the_bar_is_as_long_as_it_says, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
