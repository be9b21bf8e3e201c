// A scene that was written and read back looks the same, float by float.
#include "stage.h"

#include <stdio.h>
#include <unistd.h>

static ag_image *draw(ag_renderer *renderer, const ag_scene *scene)
{
    const ag_render_options options = { .width = 64, .height = 64, .format = AG_FORMAT_RGBA32F };
    ag_camera_desc camera;
    ag_image *image;
    bool has_camera = ag_scene_camera(scene, 0, &camera);
    OK(ag_renderer_render(renderer, scene, has_camera ? &camera : NULL, &options, &image, NULL));
    return image;
}

static ag_scene *write_and_read(const ag_scene *scene)
{
    char path[] = "/tmp/argand-saved-XXXXXX";
    int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    ag_scene *read;
    OK(ag_scene_save(scene, path));
    OK(ag_scene_create(NULL, &read));
    OK(ag_scene_load(read, path, NULL));
    unlink(path);
    return read;
}

static void same_picture(ag_renderer *renderer, const ag_scene *scene, const char *name)
{
    ag_scene *read = write_and_read(scene);
    ag_image *before = draw(renderer, scene), *after = draw(renderer, read);
    if (memcmp(ag_image_pixels(before), ag_image_pixels(after), 64 * 64 * 16) != 0)
        fail_msg("%s is another picture", name);
    ag_image_destroy(before);
    ag_image_destroy(after);
    ag_scene_destroy(read);
}

static void built_in_scenes(void **state)
{
    static const char *const names[] = { "lights", "specular", "ambient-sh-blinn" };
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        ag_scene *scene;
        OK(ag_scene_create(NULL, &scene));
        OK(ag_scene_load_demo(scene, names[i], AG_LOOK_TEXT));
        same_picture(renderer, scene, names[i]);
        ag_scene_destroy(scene);
    }
    ag_renderer_destroy(renderer);
}

// Colours at the corners, a texture that is turned, and a sky of its own.
static void a_scene_of_its_own(void **state)
{
    const float colors[4][4] = {
        { 1, 0, 0, 1 }, { 0, 1, 0, 1 }, { 0, 0, 1, 1 }, { 1, 1, 1, 0.3f }
    };
    uint8_t pixels[8 * 8 * 4];
    for (size_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (uint8_t)(i * 73 ^ i >> 4);
    const ag_image_desc image_desc = { 8, 8, AG_FORMAT_RGBA8, pixels };
    ag_image *image;
    OK(ag_image_create(NULL, &image_desc, &image));
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    ag_scene *scene = stage_dark();
    stage_surround(scene, 0.1f, 0.2f, 0.7f);
    const ag_texture_desc texture_desc = { .image = image, .wrap_u = AG_WRAP_MIRROR };
    ag_material_desc material = ag_material_default();
    ag_texture texture;
    OK(ag_scene_add_texture(scene, &texture_desc, &texture));
    material.base_color_texture =
        (ag_texture_use) { .texture = texture, .rotation_rad = 0.5f, .scale = { 2, 3 } };
    material.normal_texture = material.base_color_texture;
    material.alpha_mode = AG_ALPHA_BLEND;
    material.roughness = 0.4f;
    material.emissive[1] = 3.3f;
    stage_show(scene, stage_quad(scene, -0.9f, -0.7f, 0.8f, 0.9f, 0, colors), &material);
    same_picture(renderer, scene, "the scene");
    ag_scene_destroy(scene);
    ag_renderer_destroy(renderer);
    ag_image_destroy(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = { KIT_TEST(built_in_scenes), KIT_TEST(a_scene_of_its_own) };
    return cmocka_run_group_tests(tests, kit_open, kit_close);
}
