// What is written over the picture: no panel covers another one, in windows of any shape.
#include "viewer/hud.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

static bool overlap(const ag_layer *a, const ag_layer *b)
{
    return a->x < b->x + b->width && b->x < a->x + a->width && a->y < b->y + b->height &&
           b->y < a->y + a->height;
}

static void test_what_is_picked_covers_nothing(void **state)
{
    (void)state;
    static const panel_room windows[] = {
        { 1280, 720, 1 }, { 480, 300, 1 }, { 640, 240, 1 }, { 300, 400, 1 }, { 960, 600, 2 },
    };
    hud *h = hud_create(NULL);
    assert_non_null(h);
    const hud_state said = {
        .status = true,
        .file = "a.glb",
        .exposure = "held, x 1",
        .look = "neutral",
        .thing = "Material: steel",
        .about_thing = "roughness 0.50 metalness 1.00",
    };
    for (size_t i = 0; i < sizeof windows / sizeof *windows; i++) {
        ag_layer layers[HUD_LAYERS];
        assert_int_equal(hud_compose(h, &said, windows[i], layers), 2);
        if (overlap(&layers[0], &layers[1]))
            fail_msg("in %u x %u px", windows[i].width, windows[i].height);
        for (int k = 0; k < 2; k++) {
            assert_true(layers[k].x >= 0 && layers[k].y >= 0);
            assert_true(layers[k].x + layers[k].width <= (float)windows[i].width);
            assert_true(layers[k].y + layers[k].height <= (float)windows[i].height);
        }
    }
    hud_destroy(h);
}

static void test_a_message_stands_below_what_is_picked(void **state)
{
    (void)state;
    hud *h = hud_create(NULL);
    assert_non_null(h);
    const hud_state said = { .thing = "Material: steel",
                             .about_thing = "roughness 0.50 metalness 1.00",
                             .message = "the device was lost and is opened again" };
    ag_layer layers[HUD_LAYERS];
    assert_int_equal(hud_compose(h, &said, (panel_room) { 360, 240, 1 }, layers), 2);
    assert_false(overlap(&layers[0], &layers[1]));
    // Where there is room, both stand on the lower edge.
    assert_int_equal(hud_compose(h, &said, (panel_room) { 1280, 720, 1 }, layers), 2);
    assert_true(layers[0].y + layers[0].height == layers[1].y + layers[1].height);
    hud_destroy(h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_picked_covers_nothing),
        cmocka_unit_test(test_a_message_stands_below_what_is_picked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
