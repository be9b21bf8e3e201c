// The renderer's pictures against the reference's, where it approximates nothing: light straight
// from its source, without shadows, on a matte wall.
#include "stage.h"

enum { SIZE = 32, BLOCK = 8 };

// All that the renderer has.
static const ag_render_options linear = {
    .width = SIZE,
    .height = SIZE,
    .format = AG_FORMAT_RGBA32F,
    .background = AG_BACKGROUND_TRANSPARENT,
    .parts = AG_PART_SEEN | AG_PART_LIGHTS | AG_PART_DIFFUSE | AG_PART_SPECULAR,
};

static ag_image *trace(const ag_scene *scene, const ag_camera_desc *camera)
{
    const ag_reference_options options = { .unshadowed = true, .direct_only = true };
    ag_reference *reference;
    ag_image *image;
    OK(ag_reference_create(scene, camera, &linear, &options, &reference));
    OK(ag_reference_trace(reference, &(ag_reference_goal) { .samples = 64 }));
    OK(ag_reference_picture(reference, &image));
    ag_reference_destroy(reference);
    return image;
}

static float mean_of(const ag_image *image, uint32_t left, uint32_t top, int channel)
{
    float sum = 0;
    for (uint32_t i = 0; i < BLOCK * BLOCK; i++)
        sum += stage_float(image, left + i % BLOCK, top + i / BLOCK)[channel];
    return sum / (BLOCK * BLOCK);
}

// Block by block, so that noise and the pixels' filter count for little.
static void assert_same_light(const ag_image *drawn, const ag_image *traced, float tolerance)
{
    for (uint32_t y = 0; y < SIZE; y += BLOCK)
        for (uint32_t x = 0; x < SIZE; x += BLOCK)
            for (int c = 0; c < 3; c++) {
                float wanted = mean_of(traced, x, y, c);
                assert_close(mean_of(drawn, x, y, c), wanted, tolerance * wanted + 1e-3f);
            }
}

static void assert_agree(ag_renderer *renderer, const ag_scene *scene, float tolerance)
{
    const ag_camera_desc camera = stage_flat_camera();
    ag_image *drawn, *traced = trace(scene, &camera);
    OK(ag_renderer_render(renderer, scene, &camera, &linear, &drawn, NULL));
    assert_same_light(drawn, traced, tolerance);
    ag_image_destroy(drawn);
    ag_image_destroy(traced);
}

static void light_on_a_wall_is_the_same(void **state)
{
    const ag_light_desc lights[] = {
        { .kind = AG_LIGHT_POINT, .position = { 0.5f, 0.3f, 1 }, .intensity = 2, .range_m = 2 },
        { .kind = AG_LIGHT_SPOT, .position = { 0, 0, 1.5f }, .intensity = 2 },
        { .kind = AG_LIGHT_DIRECTIONAL, .direction = { 1, 2, -2 }, .intensity = 2 },
        { .kind = AG_LIGHT_SUN,
          .direction = { 1, 0, -0.2f },
          .angular_radius_rad = 0.4f,
          .intensity = 2 },
        { .kind = AG_LIGHT_SPHERE,
          .position = { 0.3f, 0, 0.5f },
          .radius_m = 0.4f,
          .intensity = 1 },
        { .kind = AG_LIGHT_DISK,
          .position = { 0.3f, 0, 0.9f },
          .direction = { -1, 0, -0.5f },
          .radius_m = 0.5f,
          .intensity = 3 },
        { .kind = AG_LIGHT_RECT,
          .position = { -0.5f, 0, 0.8f },
          .direction = { 1, 0.3f, -0.5f },
          .up = { 1, 1, 0 },
          .width_m = 0.5f,
          .height_m = 1,
          .intensity = 3 },
        { .kind = AG_LIGHT_TUBE,
          .position = { 0, 0.3f, 0.5f },
          .direction = { 1, 0.5f, 0.2f },
          .radius_m = 0.1f,
          .length_m = 1,
          .intensity = 3 },
        { .kind = AG_LIGHT_HEMISPHERIC,
          .direction = { 1, 0, 1 },
          .intensity = 2,
          .ground_color = { 1, 0.2f, 0 } },
    };
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++) {
        ag_scene *scene = stage_dark();
        ag_light_desc hidden = lights[i];
        ag_light light;
        const ag_material_desc matte = stage_matte(0.8f);
        hidden.hidden = true;
        memcpy(hidden.color, (float[3]) { 1, 0.5f, 0.25f }, sizeof hidden.color);
        stage_show(scene, stage_quad(scene, -4, -4, 4, 4, 0, NULL), &matte);
        OK(ag_scene_add_light(scene, &hidden, &light));
        assert_agree(renderer, scene, 0.015f);
        ag_scene_destroy(scene);
    }
    ag_renderer_destroy(renderer);
}

// Each texel another; turned, shifted, scaled, as far as bilinear lookups go.
static ag_texture_use painted(ag_scene *scene, const uint8_t texels[4][4])
{
    const ag_image_desc image_desc = { 2, 2, AG_FORMAT_RGBA8, texels };
    ag_image *image;
    ag_texture_use use = { .offset = { 0.1f, 0.2f },
                           .rotation_rad = 0.5f,
                           .scale = { 0.8f, 1.1f } };
    OK(ag_image_create(NULL, &image_desc, &image));
    const ag_texture_desc desc = { .image = image, .wrap_u = AG_WRAP_MIRROR, .no_mips = true };
    OK(ag_scene_add_texture(scene, &desc, &use.texture));
    ag_image_destroy(image);
    return use;
}

static void paint_is_the_same(void **state)
{
    static const uint8_t colors[4][4] = {
        { 255, 40, 90, 255 }, { 30, 255, 90, 255 }, { 200, 200, 40, 255 }, { 90, 40, 255, 255 }
    };
    static const uint8_t tilts[4][4] = {
        { 200, 128, 230, 255 }, { 128, 200, 230, 255 }, { 60, 100, 220, 255 }, { 128, 60, 230, 255 }
    };
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    for (int i = 0; i < 4; i++) {
        ag_scene *scene = stage_dark();
        ag_material_desc m = stage_matte(0.8f);
        const ag_light_desc sun = { .kind = AG_LIGHT_DIRECTIONAL,
                                    .direction = { -1, -1.5f, -2 },
                                    .intensity = 3 };
        ag_light light;
        OK(ag_scene_add_light(scene, &sun, &light));
        if (i == 0 || i == 3)
            m.base_color_texture = painted(scene, colors);
        if (i == 1 || i == 3)
            m.normal_texture = painted(scene, tilts);
        if (i == 2 || i == 3)
            m.emissive_texture = painted(scene, colors);
        for (int c = 0; c < 3 && i >= 2; c++)
            m.emissive[c] = 0.5f;
        stage_show(scene, stage_quad(scene, -1.2f, -1.2f, 1.2f, 1.2f, 0, NULL), &m);
        assert_agree(renderer, scene, 0.015f);
        ag_scene_destroy(scene);
    }
    ag_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        KIT_TEST(light_on_a_wall_is_the_same),
        KIT_TEST(paint_is_the_same),
    };
    return cmocka_run_group_tests_name("reference", tests, kit_open, kit_close);
}
