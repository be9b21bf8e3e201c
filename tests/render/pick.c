// What ag_scene_pick finds is what the picture shows: each thing in a colour of its own.
#include "stage.h"

enum { WIDTH = 144, HEIGHT = 96, THINGS = 40, UNIT = 128 };

static float noise(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return (float)(*state >> 8) / 16777216.0f;
}

static ag_texture add_holes(ag_scene *scene)
{
    enum { SIZE = 8 };
    uint8_t pixels[SIZE * SIZE][4];
    for (int i = 0; i < SIZE * SIZE; i++)
        memcpy(pixels[i], (uint8_t[4]) { 255, 255, 255, i * i / SIZE % 5 > 1 ? 255 : 0 }, 4);
    const ag_image_desc desc = { SIZE, SIZE, AG_FORMAT_RGBA8, pixels };
    ag_texture_desc texture = { .wrap_v = AG_WRAP_MIRROR,
                                .mag = AG_FILTER_NEAREST,
                                .min = AG_FILTER_NEAREST,
                                .no_mips = true };
    ag_texture added;
    ag_image *image;
    OK(ag_image_create(NULL, &desc, &image));
    texture.image = image;
    OK(ag_scene_add_texture(scene, &texture, &added));
    ag_image_destroy(image);
    return added;
}

// Turned, stretched and moved anyhow; every third one mirrored.
static void scatter(int i, uint32_t *seed, float world[16])
{
    memset(world, 0, 16 * sizeof *world);
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            world[4 * column + row] = 1.2f * noise(seed) - 0.6f;
    const float *w = world;
    bool mirrored = w[0] * (w[5] * w[10] - w[6] * w[9]) - w[4] * (w[1] * w[10] - w[2] * w[9]) +
                        w[8] * (w[1] * w[6] - w[2] * w[5]) <
                    0;
    for (int row = 0; row < 3 && mirrored != (i % 3 == 0); row++)
        world[row] = -world[row];
    for (int row = 0; row < 3; row++)
        world[12 + row] = 5 * noise(seed) - 2.5f;
    world[15] = 1;
}

// Instance i has the colour (i + 1) / UNIT; with `holes` every third one has some.
static ag_scene *many_things(bool holes)
{
    ag_scene *scene = stage_dark();
    const float corners[4][3] = { { -1, -1, -1 }, { 1, -1, 1 }, { -1, 1, 1 }, { 1, 1, -1 } };
    const uint32_t faces[12] = { 0, 1, 2, 1, 3, 2, 0, 2, 3, 0, 3, 1 };
    const ag_mesh_desc desc = {
        .positions = corners[0], .vertex_count = 4, .indices = faces, .index_count = 12
    };
    ag_mesh shapes[2];
    OK(ag_scene_add_mesh(scene, &desc, &shapes[0]));
    shapes[1] = stage_quad(scene, -1, -1, 1, 1, 0, NULL);
    ag_texture texture = add_holes(scene);
    uint32_t seed = 7;
    for (int i = 0; i < THINGS; i++) {
        ag_material_desc m = stage_unlit((float)(i + 1) / UNIT, 0, 0, 1);
        m.double_sided = i % 4 == 0 || holes;
        if (holes && i % 3 == 1) {
            m.alpha_mode = AG_ALPHA_MASK;
            m.base_color_texture = (ag_texture_use) { .texture = texture,
                                                      .scale = { 1.5f, 2 },
                                                      .offset = { 0.1f, -0.3f },
                                                      .rotation_rad = 0.5f };
        }
        float world[16];
        scatter(i, &seed, world);
        ag_material material;
        ag_instance instance;
        OK(ag_scene_add_material(scene, &m, &material));
        OK(ag_scene_add_instance(scene, shapes[i % 2], material, world, &instance));
    }
    return scene;
}

// Lights come after the things: as bright as their number.
static void add_bodies(ag_scene *scene)
{
    const float number = THINGS + 1, pi = 3.14159265f;
    ag_light_desc lights[] = {
        { .kind = AG_LIGHT_SPHERE, .position = { -1, 1, 1 }, .radius_m = 0.4f },
        { .kind = AG_LIGHT_DISK,
          .position = { 1, 1, 1 },
          .direction = { 0.3f, 0, 1 },
          .radius_m = 0.5f },
        { .kind = AG_LIGHT_RECT,
          .position = { 1, -1, 1 },
          .direction = { 0, 0.4f, 1 },
          .up = { 1, 1, 0 },
          .width_m = 0.5f,
          .height_m = 1 },
        { .kind = AG_LIGHT_TUBE,
          .position = { -1, -1, 1 },
          .direction = { 1, 1, -0.5f },
          .radius_m = 0.2f,
          .length_m = 1 },
    };
    for (int i = 0; i < 4; i++) {
        lights[i].intensity = (number + (float)i) / UNIT * (i ? 1 : pi * 0.4f * 0.4f);
        ag_light light;
        OK(ag_scene_add_light(scene, &lights[i], &light));
    }
}

static int picked(const ag_scene *scene, const ag_camera_desc *camera, float x, float y)
{
    ag_pick pick;
    OK(ag_scene_pick(scene, camera, WIDTH, HEIGHT, x, y, 0, &pick));
    return pick.kind == AG_PICK_LIGHT ? THINGS + (int)pick.light.id : (int)pick.instance.id;
}

// Whether it is picked within `slack` px: pictures put vertices on a raster of 1/256 px, and bodies
// of lights have corners in them.
static bool agrees(const ag_scene *scene, const ag_camera_desc *camera, float x, float y, int shown)
{
    if (picked(scene, camera, x, y) == shown)
        return true;
    float slack = shown > THINGS || picked(scene, camera, x, y) > THINGS ? 0.75f : 0.02f;
    for (int i = 0; i < 9; i++)
        if (picked(scene, camera, x + slack * (float)(i % 3 - 1), y + slack * (float)(i / 3 - 1)) ==
            shown)
            return true;
    return false;
}

static void compare(ag_device *device, const ag_scene *scene, const ag_camera_desc *camera)
{
    const ag_render_options options = {
        .width = WIDTH, .height = HEIGHT, .format = AG_FORMAT_RGBA32F, .quality = AG_QUALITY_FAST
    };
    ag_image *image = stage_render(device, scene, camera, &options);
    int seen[THINGS + 5] = { 0 }, different = 0, kinds = 0;
    for (uint32_t y = 0; y < HEIGHT; y++)
        for (uint32_t x = 0; x < WIDTH; x++) {
            int shown = (int)lroundf(stage_float(image, x, y)[0] * UNIT);
            assert_in_range(shown, 0, THINGS + 4);
            seen[shown]++;
            if (!agrees(scene, camera, (float)x + 0.5f, (float)y + 0.5f, shown)) {
                print_error("at %u %u: %d is shown, %d picked\n", x, y, shown,
                            picked(scene, camera, (float)x + 0.5f, (float)y + 0.5f));
                different++;
            }
        }
    for (int i = 0; i < THINGS + 5; i++)
        kinds += seen[i] > 0;
    assert_true(kinds > THINGS / 2);
    assert_int_equal(different, 0);
    ag_image_destroy(image);
}

static const ag_camera_desc aslant = { .position = { 3, 2, 7 }, .fov_y_rad = 0.8f };
static const ag_camera_desc flat = { .position = { -3, 1, 7 }, .height_m = 6 };

static void opaque_things(void **state)
{
    ag_scene *scene = many_things(false);
    compare(*state, scene, &aslant);
    compare(*state, scene, &flat);
    ag_scene_destroy(scene);
}

static void things_with_holes(void **state)
{
    ag_scene *scene = many_things(true);
    compare(*state, scene, &aslant);
    ag_scene_destroy(scene);
}

static void things_among_lights(void **state)
{
    ag_scene *scene = many_things(false);
    add_bodies(scene);
    compare(*state, scene, &aslant);
    compare(*state, scene, &flat);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        KIT_TEST(opaque_things),
        KIT_TEST(things_with_holes),
        KIT_TEST(things_among_lights),
    };
    return cmocka_run_group_tests(tests, kit_open, kit_close);
}
