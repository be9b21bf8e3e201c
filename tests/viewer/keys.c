// Keys: no two do the same press, every action has one, and help and manual tell each of them.
#include "viewer/keys.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void test_no_press_is_used_twice(void **state)
{
    (void)state;
    key_use a, b;
    for (size_t i = 0; keys_at(i, &a); i++)
        for (size_t j = i + 1; keys_at(j, &b); j++)
            assert_true(a.key != b.key || a.modifiers != b.modifiers);
}

static void test_every_action_has_a_key(void **state)
{
    (void)state;
    bool found[ACTION_COUNT] = { false };
    key_use use;
    for (size_t i = 0; keys_at(i, &use); i++) {
        assert_true(use.does > ACTION_NONE && use.does < ACTION_COUNT);
        assert_int_equal(keys_action(use.key, use.modifiers), use.does);
        found[use.does] = true;
    }
    for (int i = ACTION_NONE + 1; i < ACTION_COUNT; i++)
        assert_true(found[i]);
}

static void test_modifiers(void **state)
{
    (void)state;
    assert_int_equal(keys_action('?', KEY_SHIFT), ACTION_HELP);
    assert_int_equal(keys_action('+', KEY_SHIFT), ACTION_BRIGHTER);
    assert_int_equal(keys_action('1', KEY_CTRL), ACTION_BACK);
    assert_int_equal(keys_action('R', KEY_SHIFT), ACTION_REFERENCE);
    assert_int_equal(keys_action('Q', KEY_CTRL | KEY_SHIFT), ACTION_QUIT);
    assert_int_equal(keys_action('R', KEY_CTRL), ACTION_NONE);
    assert_int_equal(keys_action('?', KEY_ALT), ACTION_NONE);
    assert_int_equal(keys_action(KEY_F12, KEY_SHIFT), ACTION_NONE);
    assert_int_equal(keys_action(KEY_HOME, KEY_SHIFT), ACTION_NONE);
    assert_int_equal(keys_action('W', 0), ACTION_NONE); // held down, it flies
    assert_int_equal(keys_action(0, 0), ACTION_NONE);
}

static const char *name_of(uint32_t pressed, char buffer[2])
{
    static const struct {
        uint32_t key;
        const char *name;
    } names[] = { { KEY_ESCAPE, "Esc" },   { KEY_ENTER, "Enter" }, { KEY_TAB, "Tab" },
                  { KEY_HOME, "Home" },    { KEY_LEFT, "Left" },   { KEY_RIGHT, "Right" },
                  { KEY_UP, "Up" },        { KEY_DOWN, "Down" },   { KEY_F1, "F1" },
                  { KEY_F5, "F5" },        { KEY_F11, "F11" },     { KEY_F12, "F12" },
                  { '=', "+" /* there */ } };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (names[i].key == pressed)
            return names[i].name;
    buffer[0] = (char)pressed;
    buffer[1] = '\0';
    return buffer;
}

static void test_the_help_names_the_keys(void **state)
{
    (void)state;
    key_use use;
    char buffer[2];
    for (size_t i = 0; keys_at(i, &use); i++) {
        assert_non_null(strstr(use.shown, name_of(use.key, buffer)));
        if (use.modifiers == KEY_CTRL)
            assert_true(strstr(use.shown, "Ctrl") || strstr(use.about, "Ctrl"));
    }
}

static void test_rows_fill_what_there_is(void **state)
{
    (void)state;
    panel_row rows[128] = { 0 };
    size_t count = keys_rows(rows, 128), sections = 0;
    assert_true(count > 20 && count < 128);
    for (size_t i = 0; i < count; i++) {
        sections += rows[i].kind == PANEL_SECTION;
        assert_true(rows[i].kind == PANEL_SECTION || (rows[i].kind == PANEL_KEY && rows[i].right));
        assert_non_null(rows[i].left);
    }
    assert_true(sections > 3 && rows[0].kind == PANEL_SECTION);
    panel_row few[3] = { [2].left = "untouched" };
    assert_int_equal(keys_rows(few, 2), count);
    assert_string_equal(few[2].left, "untouched");
}

// In one line, without mdoc's "\&".
static char *read_manual(void)
{
    FILE *file = fopen(MANUAL, "r");
    assert_non_null(file);
    char *all = calloc(1, 1 << 20), *end = all;
    assert_true(fread(all, 1, (1 << 20) - 1, file) > 0);
    fclose(file);
    for (const char *c = all; *c; c++) {
        if (c[0] == '\\' && c[1] == '&')
            c++;
        else
            *end++ = *c == '\n' ? ' ' : *c;
    }
    *end = '\0';
    return all;
}

static void test_the_manual_tells_every_key(void **state)
{
    (void)state;
    char *manual = read_manual();
    panel_row rows[128];
    size_t count = keys_rows(rows, 128);
    const char *at = strstr(manual, ".Ss Keys of view");
    assert_non_null(at);
    for (size_t i = 0; i < count; i++) {
        char item[256];
        if (rows[i].kind == PANEL_SECTION)
            snprintf(item, sizeof item, ".Pp %s:", rows[i].left);
        else
            snprintf(item, sizeof item, ".It %s %s", rows[i].left, rows[i].right);
        at = strstr(at, item);
        if (!at)
            fail_msg("docs/argand.1 has not, or not here: %s", item);
    }
    free(manual);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_press_is_used_twice),
        cmocka_unit_test(test_every_action_has_a_key),
        cmocka_unit_test(test_modifiers),
        cmocka_unit_test(test_the_help_names_the_keys),
        cmocka_unit_test(test_rows_fill_what_there_is),
        cmocka_unit_test(test_the_manual_tells_every_key),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
