// Textures that are woven read as each by itself.
#include "stage.h"

#include "trace/texture.h"

enum { WIDE = 37, HIGH = 23, IMAGES = 3, USES = 5, PLACES = 500 };

static uint8_t images[IMAGES][WIDE * HIGH * 4];

// Two uses are of one image; one has none.
static texture_set some_set(void)
{
    texture_use plain = { .width = WIDE, .height = HIGH, .stride = 4, .u = { 1 }, .v = { 0, 1 } };
    texture_set set = { .alike = true };
    texture_use *uses[USES] = { &set.base_color, &set.metallic_roughness, &set.normal,
                                &set.specular, &set.specular_color };
    for (int i = 0; i < USES; i++) {
        *uses[i] = plain;
        uses[i]->pixels = images[i % IMAGES];
    }
    return set;
}

static void read_all(const texture_set *set, vec4 *seen)
{
    const texture_use *uses[] = {
        &set->base_color, &set->metallic_roughness, &set->normal,
        &set->emissive,   &set->specular,           &set->specular_color
    };
    for (int i = 0; i < PLACES; i++) {
        const vec2 uv[2] = { { 0.0137f * (float)i - 2, 0.0091f * (float)i - 1 } };
        for (int k = 0; k < 6; k++) {
            texture_place place = texture_find(uses[k], uv);
            *seen++ = texture_read(uses[k], &place);
        }
    }
}

static void woven_textures_read_as_before(void **state)
{
    (void)state;
    static vec4 before[PLACES * 6], after[PLACES * 6];
    for (int k = 0; k < IMAGES; k++)
        for (int i = 0; i < WIDE * HIGH * 4; i++)
            images[k][i] = (uint8_t)((i * (i + k)) % 251);
    texture_set set = some_set();
    read_all(&set, before);
    assert_int_equal(texture_set_weave(&set, WIDE * HIGH * 16 - 1), 0);
    assert_null(set.woven);
    assert_int_equal(texture_set_weave(&set, WIDE * HIGH * 16), WIDE * HIGH * 16);
    assert_int_equal(set.normal.stride, 16);
    read_all(&set, after);
    assert_memory_equal(before, after, sizeof before);
    texture_set_finish(&set);
}

static void what_is_not_alike_stays(void **state)
{
    (void)state;
    texture_set set = some_set();
    set.alike = false;
    assert_int_equal(texture_set_weave(&set, SIZE_MAX), 0);
    set = some_set();
    set.base_color.pixels = set.normal.pixels = set.specular.pixels = NULL;
    set.metallic_roughness.pixels = set.specular_color.pixels; // one image: nothing to weave
    assert_int_equal(texture_set_weave(&set, SIZE_MAX), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(woven_textures_read_as_before),
        cmocka_unit_test(what_is_not_alike_stays),
    };
    return cmocka_run_group_tests_name("weaving", tests, NULL, NULL);
}
