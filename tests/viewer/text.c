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

#include <cmocka.h>

static const text_style style = { .size_px = 14 };

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

static void test_digits_are_of_one_width(void **state)
{
    float one = text_width(*state, style, "1", SIZE_MAX);
    assert_true(one > 5 && one < 12);
    for (const char *d = "0123456789"; *d; d++)
        assert_true(text_width(*state, style, d, 1) == one);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_digits_are_of_one_width),
    };
    return cmocka_run_group_tests(tests, open_font, close_font);
}
