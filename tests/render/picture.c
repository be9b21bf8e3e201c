// Pixels: where they lie, how they are coded, what covers what.
#include "stage.h"

#include "physics/color.glsl"
#include "physics/tonemap.glsl"

static ag_scene *unlit_wall(float r, float g, float b, float a, ag_alpha_mode mode)
{
    ag_scene *scene = stage_dark();
    ag_material_desc m = stage_unlit(r, g, b, a);
    m.alpha_mode = mode;
    stage_show(scene, stage_quad(scene, -0.5f, -0.5f, 0.5f, 0.5f, 0, NULL), &m);
    return scene;
}

// A wall whose colour is its position: every pixel says where it is, in any tiling.
static void every_pixel_is_in_its_place(void **state)
{
    ag_scene *scene = stage_dark();
    const float colors[4][4] = { { 0, 0, 0, 1 }, { 1, 0, 0, 1 }, { 1, 1, 0, 1 }, { 0, 1, 0, 1 } };
    const ag_material_desc m = stage_unlit(1, 1, 1, 1);
    stage_show(scene, stage_quad(scene, -20, -1, 20, 1, 0, colors), &m);
    const uint32_t widths[] = { 64, 63, 4100 }; // the last one takes three tiles on a CPU,
    const float eye_x[] = { 0, 0, 36.9f };      // and the wall lies across the first two
    for (int i = 0; i < 3; i++) {
        const ag_camera_desc camera = { .position = { eye_x[i], 0, 5 },
                                        .target = { eye_x[i], 0, 0 },
                                        .height_m = 2 };
        const ag_render_options options = { .width = widths[i],
                                            .height = 37,
                                            .format = AG_FORMAT_RGBA32F };
        ag_image *image = stage_render(*state, scene, &camera, &options);
        float width_m = 2.0f * (float)widths[i] / 37;
        for (uint32_t x = 0; x < widths[i]; x += 7)
            for (uint32_t y = 0; y < 37; y += 5) {
                float px = (((float)x + 0.5f) / (float)widths[i] - 0.5f) * width_m + eye_x[i];
                if (fabsf(px) > 19.9f)
                    continue;
                assert_close(stage_float(image, x, y)[0], px / 40 + 0.5f, 7e-4f);
                assert_close(stage_float(image, x, y)[1], 1 - ((float)y + 0.5f) / 37, 7e-4f);
            }
        ag_image_destroy(image);
    }
    ag_scene_destroy(scene);
}

// Bytes are the sRGB code of the tone curve, in every path that pixels can take.
static void bytes_are_tone_mapped_and_coded(void **state)
{
    const float color[3] = { 1, 0.25f, 0.03f }, exposure = 1.7f;
    ag_scene *scene = unlit_wall(color[0], color[1], color[2], 1, AG_ALPHA_OPAQUE);
    const ag_camera_desc camera = stage_flat_camera();
    for (int curve = 0; curve <= AG_TONEMAP_AGX; curve++)
        for (int quality = 0; quality <= AG_QUALITY_BEST; quality++) {
            const ag_render_options options = { .width = 32,
                                                .height = 32,
                                                .tonemap = (ag_tonemap)curve,
                                                .quality = (ag_quality)quality,
                                                .exposure = exposure,
                                                .background = AG_BACKGROUND_TRANSPARENT };
            ag_image *image = stage_render(*state, scene, &camera, &options);
            vec3 shown = tonemap((uint)curve, vec3(color[0], color[1], color[2]) * exposure);
            for (int c = 0; c < 3; c++) {
                float code = color_srgb_encode_channel(shown[c]) * 255;
                assert_close(stage_byte(image, 16, 16)[c], code, 1.01f);
            }
            assert_int_equal(stage_byte(image, 16, 16)[3], 255);
            assert_int_equal(stage_byte(image, 1, 1)[3], 0);
            ag_image_destroy(image);
        }
    ag_scene_destroy(scene);
}

// The code of a radiance x under the power 1/2.2 is 255 x^(1/2.2), in every path that pixels
// can take; linear light and the background's colour are left alone.
static void gamma_is_a_power(void **state)
{
    const float color[3] = { 0.5f, 0.18f, 0.001f };
    ag_scene *scene = unlit_wall(color[0], color[1], color[2], 1, AG_ALPHA_OPAQUE);
    const ag_camera_desc camera = stage_flat_camera();
    ag_render_options options = { .width = 32,
                                  .height = 32,
                                  .tonemap = AG_TONEMAP_NONE,
                                  .transfer = AG_TRANSFER_GAMMA_22,
                                  .background = AG_BACKGROUND_COLOR,
                                  .background_color = { 0.2f, 0.4f, 1 } };
    for (int quality = 0; quality <= AG_QUALITY_BEST; quality++) {
        options.quality = (ag_quality)quality;
        ag_image *image = stage_render(*state, scene, &camera, &options);
        const float around[3] = { 51, 102, 255 };
        for (int c = 0; c < 3; c++) {
            assert_close(stage_byte(image, 16, 16)[c], 255 * powf(color[c], 1 / 2.2f), 1.01f);
            assert_close(stage_byte(image, 1, 1)[c], around[c], 1.01f);
        }
        ag_image_destroy(image);
    }
    options.format = AG_FORMAT_RGBA32F;
    ag_image *image = stage_render(*state, scene, &camera, &options);
    assert_close(stage_float(image, 16, 16)[1], color[1], 1e-3f);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

// A sun of angular radius .1: radiance within, nothing outside, a pixel between.
static void suns_are_disks(void **state)
{
    enum { SIZE = 256 };
    ag_scene *scene = stage_dark();
    ag_light light;
    OK(ag_scene_add_light(scene,
                          &(ag_light_desc) { .kind = AG_LIGHT_SUN,
                                             .direction = { 0.3f, -0.2f, 1 },
                                             .intensity = 1,
                                             .angular_radius_rad = 0.1f },
                          &light));
    const ag_camera_desc camera = { .target = { 0, 0, -1 }, .fov_y_rad = 1.5707963f };
    const ag_render_options options = { .width = SIZE,
                                        .height = SIZE,
                                        .format = AG_FORMAT_RGBA32F };
    ag_image *image = stage_render(*state, scene, &camera, &options);
    const float pixel = 2.0f / SIZE, radiance = 1 / (3.14159265f * sinf(0.1f) * sinf(0.1f));
    for (uint32_t y = 0; y < SIZE; y++)
        for (uint32_t x = 0; x < SIZE; x++) {
            float px = ((float)x + 0.5f) * pixel - 1, py = 1 - ((float)y + 0.5f) * pixel;
            float cosine = (0.3f * -px + 0.2f * py + 1) / sqrtf(1.13f * (px * px + py * py + 1));
            float angle = acosf(fminf(cosine, 1)), shown = stage_float(image, x, y)[0];
            if (angle > 0.1f + 1.5f * pixel)
                assert_close(shown, 0, 0);
            else if (angle < 0.1f - 1.5f * pixel)
                assert_close(shown, radiance, 0.01f * radiance);
        }
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

// Half covered by the wall's edge: the pixel keeps the wall's colour, with half alpha.
static void edges_are_straight_alpha(void **state)
{
    ag_scene *scene = unlit_wall(0.5f, 0.25f, 0.1f, 1, AG_ALPHA_OPAQUE);
    // 33 pixels over 2 m: the edges at +-0.5 m cut pixels 8 and 24 at a quarter.
    const ag_camera_desc camera = stage_flat_camera();
    const ag_render_options options = { .width = 33,
                                        .height = 33,
                                        .tonemap = AG_TONEMAP_NONE,
                                        .background = AG_BACKGROUND_TRANSPARENT };
    ag_image *image = stage_render(*state, scene, &camera, &options);
    const uint8_t *edge = stage_byte(image, 8, 16), *inside = stage_byte(image, 16, 16);
    assert_true(edge[3] > 100 && edge[3] < 255);
    for (int c = 0; c < 3; c++)
        assert_close(edge[c], inside[c], 2);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

static void colours_lie_under_the_picture(void **state)
{
    ag_scene *scene = unlit_wall(1, 1, 1, 0.5f, AG_ALPHA_BLEND);
    const ag_camera_desc camera = stage_flat_camera();
    ag_render_options options = { .width = 32,
                                  .height = 32,
                                  .tonemap = AG_TONEMAP_NONE,
                                  .exposure = 0.5f,
                                  .background = AG_BACKGROUND_COLOR,
                                  .background_color = { 0.2f, 0.4f, 1 } };
    for (int quality = 0; quality <= AG_QUALITY_BEST; quality++) {
        options.quality = (ag_quality)quality;
        ag_image *image = stage_render(*state, scene, &camera, &options);
        const uint8_t *around = stage_byte(image, 1, 1), *through = stage_byte(image, 16, 16);
        const float wanted[3] = { 51, 102, 255 };
        for (int c = 0; c < 3; c++) {
            assert_close(around[c], wanted[c], 1.01f);
            // Half the wall at exposure 1/2, half the colour, mixed in linear light.
            float mixed = 0.5f * 0.5f + 0.5f * color_srgb_decode_channel(wanted[c] / 255);
            assert_close(through[c], color_srgb_encode_channel(mixed) * 255, 1.01f);
        }
        assert_int_equal(around[3], 255);
        ag_image_destroy(image);
    }
    ag_scene_destroy(scene);
}

// Two panes over each other: far 1/2 red, near 1/4 green; premultiplied sums by hand.
static void panes_blend_back_to_front(void **state)
{
    ag_scene *scene = stage_dark();
    ag_material_desc near = stage_unlit(0, 1, 0, 0.25f), far = stage_unlit(1, 0, 0, 0.5f);
    near.alpha_mode = far.alpha_mode = AG_ALPHA_BLEND;
    near.double_sided = true; // its back faces are not there twice
    stage_show(scene, stage_quad(scene, -1, -1, 1, 1, 0.5f, NULL), &near);
    stage_show(scene, stage_quad(scene, -1, -1, 1, 1, 0, NULL), &far);
    const ag_camera_desc camera = stage_flat_camera();
    const ag_render_options options = { .width = 16,
                                        .height = 16,
                                        .format = AG_FORMAT_RGBA32F,
                                        .background = AG_BACKGROUND_TRANSPARENT };
    ag_image *image = stage_render(*state, scene, &camera, &options);
    const float *pixel = stage_float(image, 8, 8);
    float alpha = 0.25f + 0.75f * 0.5f;
    assert_close(pixel[3], alpha, 1e-3f);
    assert_close(pixel[0], 0.75f * 0.5f / alpha, 2e-3f);
    assert_close(pixel[1], 0.25f / alpha, 2e-3f);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

// Opaque before blended: a pane behind a wall is not seen, one before it is.
static void walls_hide_panes(void **state)
{
    for (int before = 0; before < 2; before++) {
        ag_scene *scene = stage_dark();
        ag_material_desc pane = stage_unlit(0, 1, 0, 0.5f);
        pane.alpha_mode = AG_ALPHA_BLEND;
        const ag_material_desc wall = stage_unlit(1, 0, 0, 1);
        stage_show(scene, stage_quad(scene, -1, -1, 1, 1, before ? 1 : -1, NULL), &pane);
        stage_show(scene, stage_quad(scene, -1, -1, 1, 1, 0, NULL), &wall);
        const ag_camera_desc camera = stage_flat_camera();
        const ag_render_options options = { .width = 8, .height = 8, .format = AG_FORMAT_RGBA32F };
        ag_image *image = stage_render(*state, scene, &camera, &options);
        assert_close(stage_float(image, 4, 4)[1], before ? 0.5f : 0, 1e-3f);
        ag_image_destroy(image);
        ag_scene_destroy(scene);
    }
}

// Alpha from 0 to 1 across the wall, cut at 1/2: the right half stays, opaque.
static void cut_outs_end_at_the_cutoff(void **state)
{
    ag_scene *scene = stage_dark();
    const float colors[4][4] = { { 1, 1, 1, 0 }, { 1, 1, 1, 1 }, { 1, 1, 1, 1 }, { 1, 1, 1, 0 } };
    ag_material_desc m = stage_unlit(1, 1, 1, 1);
    m.alpha_mode = AG_ALPHA_MASK;
    m.alpha_cutoff = 0.5f;
    stage_show(scene, stage_quad(scene, -1, -1, 1, 1, 0, colors), &m);
    const ag_camera_desc camera = stage_flat_camera();
    for (int quality = 0; quality <= AG_QUALITY_BEST; quality++) {
        const ag_render_options options = { .width = 64,
                                            .height = 64,
                                            .quality = (ag_quality)quality,
                                            .background = AG_BACKGROUND_TRANSPARENT };
        ag_image *image = stage_render(*state, scene, &camera, &options);
        assert_int_equal(stage_byte(image, 28, 30)[3], 0);
        assert_int_equal(stage_byte(image, 35, 30)[3], 255);
        ag_image_destroy(image);
    }
    ag_scene_destroy(scene);
}

// A checker of 2 x 2 texels: sampling, its coordinates, the second set and transforms.
static void textures_lie_as_told(void **state)
{
    static const uint8_t texels[4][4] = {
        { 255, 0, 0, 255 }, { 0, 255, 0, 255 }, { 0, 0, 255, 255 }, { 255, 255, 255, 255 }
    };
    const ag_image_desc image_desc = { 2, 2, AG_FORMAT_RGBA8, texels };
    const ag_texture_use uses[] = {
        { .uv_set = 0 },
        { .offset = { 0.5f, 0 } },                  // shifted by a texel to the left
        { .rotation_rad = 1.57079633f },            // about the upper left corner, u' = v, v' = -u
        { .scale = { -1, 1 }, .offset = { 1, 0 } }, // mirrored
    };
    // The colour at a quarter of the wall from its upper left corner.
    const uint8_t *wanted[] = { texels[0], texels[1], texels[2], texels[1] };
    for (int i = 0; i < 4; i++) {
        ag_scene *scene = stage_dark();
        ag_image *image;
        ag_texture texture;
        OK(ag_image_create(NULL, &image_desc, &image));
        const ag_texture_desc desc = {
            .image = image, .mag = AG_FILTER_NEAREST, .min = AG_FILTER_NEAREST, .no_mips = true
        };
        OK(ag_scene_add_texture(scene, &desc, &texture));
        ag_image_destroy(image);
        ag_material_desc m = stage_unlit(1, 1, 1, 1);
        m.base_color_texture = uses[i];
        m.base_color_texture.texture = texture;
        stage_show(scene, stage_quad(scene, -1, -1, 1, 1, 0, NULL), &m);
        const ag_camera_desc camera = stage_flat_camera();
        const ag_render_options options = { .width = 16, .height = 16, .tonemap = AG_TONEMAP_NONE };
        ag_image *picture = stage_render(*state, scene, &camera, &options);
        assert_memory_equal(stage_byte(picture, 4, 4), wanted[i], 3);
        ag_image_destroy(picture);
        ag_scene_destroy(scene);
    }
}

// Sixteen texels a pixel: the picture's mean is the mean of the light, not of the codes.
static void minified_colours_keep_their_light(void **state)
{
    enum { N = 256 };
    static uint8_t texels[N][N][4];
    for (int y = 0; y < N; y++)
        for (int x = 0; x < N; x++)
            memset(texels[y][x], (x ^ y) & 1 ? 255 : 0, 3), texels[y][x][3] = 255;
    const ag_image_desc image_desc = { N, N, AG_FORMAT_RGBA8, texels };
    ag_scene *scene = stage_dark();
    ag_image *image;
    ag_material_desc m = stage_unlit(1, 1, 1, 1);
    OK(ag_image_create(NULL, &image_desc, &image));
    const ag_texture_desc desc = { .image = image };
    OK(ag_scene_add_texture(scene, &desc, &m.base_color_texture.texture));
    ag_image_destroy(image);
    stage_show(scene, stage_quad(scene, -1, -1, 1, 1, 0, NULL), &m);
    const ag_camera_desc camera = stage_flat_camera();
    const ag_render_options options = { .width = 16, .height = 16, .format = AG_FORMAT_RGBA32F };
    ag_image *picture = stage_render(*state, scene, &camera, &options);
    assert_close(stage_float(picture, 5, 9)[0], 0.5f, 0.01f);
    ag_image_destroy(picture);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        KIT_TEST(every_pixel_is_in_its_place),
        KIT_TEST(bytes_are_tone_mapped_and_coded),
        KIT_TEST(gamma_is_a_power),
        KIT_TEST(suns_are_disks),
        KIT_TEST(edges_are_straight_alpha),
        KIT_TEST(colours_lie_under_the_picture),
        KIT_TEST(panes_blend_back_to_front),
        KIT_TEST(walls_hide_panes),
        KIT_TEST(cut_outs_end_at_the_cutoff),
        KIT_TEST(textures_lie_as_told),
        KIT_TEST(minified_colours_keep_their_light),
    };
    return cmocka_run_group_tests(tests, kit_open, kit_close);
}
