// Light on surfaces as the pixels have it, against sums done by hand.
#include "stage.h"

static const float PI_F = 3.14159265f;

static const ag_render_options linear = {
    .width = 64, .height = 64, .format = AG_FORMAT_RGBA32F, .background = AG_BACKGROUND_TRANSPARENT
};

static float center(ag_device *device, const ag_scene *scene)
{
    const ag_camera_desc camera = stage_flat_camera();
    ag_image *image = stage_render(device, scene, &camera, &linear);
    float value = stage_float(image, 32, 32)[1];
    ag_image_destroy(image);
    return value;
}

static ag_scene *matte_wall(float albedo)
{
    ag_scene *scene = stage_dark();
    const ag_material_desc matte = stage_matte(albedo);
    stage_show(scene, stage_quad(scene, -4, -4, 4, 4, 0, NULL), &matte);
    return scene;
}

static void add(ag_scene *scene, ag_light_desc desc)
{
    ag_light light;
    OK(ag_scene_add_light(scene, &desc, &light));
}

// Radiance of a matte wall: albedo / pi * irradiance.
static void directional_light_is_lambert(void **state)
{
    ag_scene *scene = matte_wall(0.6f);
    add(scene, (ag_light_desc) { .kind = AG_LIGHT_DIRECTIONAL,
                                 .direction = { 1, 0, -1 }, // 45 degrees off the normal
                                 .intensity = 10 });
    assert_close(center(*state, scene), 0.6f / PI_F * 10 * sqrtf(0.5f), 2e-3f);
    ag_scene_destroy(scene);
}

static void point_light_falls_off_by_the_square(void **state)
{
    for (float distance = 0.5f; distance < 5; distance *= 2) {
        ag_scene *scene = matte_wall(0.5f);
        add(scene, (ag_light_desc) { .kind = AG_LIGHT_POINT,
                                     .position = { 0.03125f / 2, -0.03125f / 2, distance },
                                     .intensity = 4 });
        float wanted = 0.5f / PI_F * 4 / (distance * distance);
        assert_close(center(*state, scene), wanted, 2e-3f * wanted);
        ag_scene_destroy(scene);
    }
}

// KHR_lights_punctual: full inside the inner cone, none outside the outer one, half way by
// cosine a quarter.
static void spot_light_has_a_cone(void **state)
{
    const float inner = 0.3f, outer = 0.6f, tilt[3] = { 0.2f, 0.7f, 0 };
    float wanted[3] = { 1, 0, 0.25f };
    float middle = acosf((cosf(inner) + cosf(outer)) / 2);
    for (int i = 0; i < 3; i++) {
        float a = i == 2 ? middle : tilt[i];
        ag_scene *scene = matte_wall(1);
        add(scene, (ag_light_desc) { .kind = AG_LIGHT_SPOT,
                                     .position = { 0.03125f / 2, -0.03125f / 2, 2 },
                                     .direction = { sinf(a), 0, -cosf(a) },
                                     .intensity = PI_F * 4,
                                     .cone_inner_rad = inner,
                                     .cone_outer_rad = outer });
        assert_close(center(*state, scene), wanted[i], 4e-3f);
        ag_scene_destroy(scene);
    }
}

static void lights_add_up_in_their_colours(void **state)
{
    ag_scene *scene = matte_wall(1);
    for (int i = 0; i < 11; i++) // more than are written out in the shader
        add(scene, (ag_light_desc) { .kind = AG_LIGHT_DIRECTIONAL,
                                     .direction = { 0, 0, -1 },
                                     .color = { 1, 0.5f, 0.25f },
                                     .intensity = PI_F });
    const ag_camera_desc camera = stage_flat_camera();
    ag_image *image = stage_render(*state, scene, &camera, &linear);
    const float *pixel = stage_float(image, 20, 40);
    assert_close(pixel[0], 11, 1e-2f);
    assert_close(pixel[1], 5.5f, 1e-2f);
    assert_close(pixel[2], 2.75f, 1e-2f);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

// Emission is seen as it is, in nit, times the exposure.
static void emission_is_radiance(void **state)
{
    ag_scene *scene = stage_dark();
    ag_material_desc glow = stage_matte(0);
    memcpy(glow.emissive, (float[3]) { 3, 2, 1 }, sizeof glow.emissive);
    stage_show(scene, stage_quad(scene, -1, -1, 1, 1, 0, NULL), &glow);
    ag_render_options options = linear;
    options.exposure = 0.5f;
    const ag_camera_desc camera = stage_flat_camera();
    ag_image *image = stage_render(*state, scene, &camera, &options);
    assert_close(stage_float(image, 32, 32)[0], 1.5f, 1e-3f);
    assert_close(stage_float(image, 32, 32)[2], 0.5f, 1e-3f);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

// The white furnace: what reflects everything cannot be told from a white world, metal or
// plastic, smooth or rough, face on or at the edge.
static void white_furnace(void **state)
{
    ag_scene *scene;
    OK(ag_scene_create(NULL, &scene));
    OK(ag_scene_load_demo(scene, "furnace", AG_LOOK_TEXT));
    stage_surround(scene, 1, 1, 1);
    ag_render_options options = { .width = 256, .height = 256, .format = AG_FORMAT_RGBA32F };
    const ag_quality qualities[] = { AG_QUALITY_DEFAULT, AG_QUALITY_FAST };
    for (int q = 0; q < 2; q++) {
        options.quality = qualities[q];
        ag_image *image = stage_render(*state, scene, NULL, &options);
        for (uint32_t y = 0; y < 256; y++)
            for (uint32_t x = 0; x < 256; x++)
                for (int c = 0; c < 3; c++)
                    assert_close(stage_float(image, x, y)[c], 1, 0.01f);
        ag_image_destroy(image);
    }
    ag_scene_destroy(scene);
}

// A matte wall under a world of one colour has that colour times its albedo.
static void image_light_is_diffuse_light(void **state)
{
    ag_scene *scene = matte_wall(0.5f);
    stage_surround(scene, 2, 1, 0.5f);
    const ag_camera_desc camera = stage_flat_camera();
    ag_image *image = stage_render(*state, scene, &camera, &linear);
    assert_close(stage_float(image, 10, 10)[0], 1, 5e-3f);
    assert_close(stage_float(image, 10, 10)[1], 0.5f, 5e-3f);
    assert_close(stage_float(image, 10, 10)[2], 0.25f, 5e-3f);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

// An environment that is bright towards +X only: a patch of 40 degrees about it.
static ag_image *bright_towards_x(void)
{
    enum { W = 256, H = 128 };
    static float pixels[H][W][4];
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            bool bright = abs(2 * x + 1 - W) < W / 9 && abs(2 * y + 1 - H) < 2 * H / 9;
            float v = bright ? 8 : 0;
            memcpy(pixels[y][x], (float[4]) { v, v, v, 1 }, sizeof pixels[y][x]);
        }
    const ag_image_desc desc = { W, H, AG_FORMAT_RGBA32F, pixels };
    ag_image *image;
    OK(ag_image_create(NULL, &desc, &image));
    return image;
}

// Seen in the background, and in a mirror: the light stands where its direction is,
// turned by the environment's rotation.
static void environment_has_its_directions(void **state)
{
    ag_image *patch = bright_towards_x();
    const float turns[] = { 0, PI_F / 2, -2 };
    for (int i = 0; i < 3; i++) {
        // Counter-clockwise from above: +X goes to -Z after a quarter turn.
        const float d[3] = { cosf(turns[i]), 0, -sinf(turns[i]) };
        ag_scene *scene = stage_dark();
        const ag_environment_desc around = { .kind = AG_ENVIRONMENT_IMAGE,
                                             .image = patch,
                                             .rotation_rad = turns[i] };
        OK(ag_scene_set_environment(scene, &around));
        const ag_camera_desc looking = { .position = { 0, 0, 0 }, .target = { d[0], 0, d[2] } };
        ag_render_options options = linear;
        options.background = AG_BACKGROUND_ENVIRONMENT;
        ag_image *image = stage_render(*state, scene, &looking, &options);
        assert_close(stage_float(image, 32, 32)[0], 8, 0.05f);
        assert_close(stage_float(image, 2, 32)[0], 0, 0.05f);
        ag_image_destroy(image);

        // A mirror facing half way between the light and +Y, seen from above.
        ag_material_desc mirror = ag_material_default();
        mirror.roughness = 0;
        ag_mesh mesh = stage_quad(scene, -1, -1, 1, 1, 0, NULL);
        ag_material material;
        ag_instance instance;
        OK(ag_scene_add_material(scene, &mirror, &material));
        const float h = sqrtf(0.5f);
        const float n[3] = { h * d[0], h, h * d[2] }, t[3] = { -d[2], 0, d[0] };
        const float b[3] = { n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2],
                             n[0] * t[1] - n[1] * t[0] };
        const float world[16] = { t[0], t[1], t[2], 0, b[0], b[1], b[2], 0,
                                  n[0], n[1], n[2], 0, 0,    0,    0,    1 };
        OK(ag_scene_add_instance(scene, mesh, material, world, &instance));
        const ag_camera_desc above = { .position = { 0, 5, 0 }, .height_m = 1, .up = { 0, 0, 1 } };
        image = stage_render(*state, scene, &above, &linear);
        assert_close(stage_float(image, 32, 32)[0], 8, 0.1f);
        ag_image_destroy(image);
        ag_scene_destroy(scene);
    }
    ag_image_destroy(patch);
}

// A mirrored instance is lit as its twin that was modelled so.
static void mirrored_instances_keep_their_light(void **state)
{
    float value[2];
    for (int i = 0; i < 2; i++) {
        ag_scene *scene = stage_dark();
        const ag_material_desc matte = stage_matte(0.8f);
        ag_mesh mesh = stage_quad(scene, -1, -1, 1, 1, 0, NULL);
        ag_material material;
        ag_instance instance;
        OK(ag_scene_add_material(scene, &matte, &material));
        const float world[16] = { i ? -2.0f : 2.0f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
        OK(ag_scene_add_instance(scene, mesh, material, world, &instance));
        add(scene, (ag_light_desc) { .kind = AG_LIGHT_DIRECTIONAL,
                                     .direction = { 0.3f, 0.2f, -1 },
                                     .intensity = 3 });
        value[i] = center(*state, scene);
        ag_scene_destroy(scene);
    }
    assert_true(value[0] > 0.1f);
    assert_close(value[1], value[0], 1e-6f);
}

// One side is culled, two are lit from where the light comes.
static void sides(void **state)
{
    for (int two = 0; two < 2; two++) {
        ag_scene *scene = stage_dark();
        ag_material_desc matte = stage_matte(1);
        matte.double_sided = two;
        ag_mesh mesh = stage_quad(scene, -1, -1, 1, 1, 0, NULL);
        ag_material material;
        ag_instance instance;
        OK(ag_scene_add_material(scene, &matte, &material));
        const float turned[16] = { -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1 };
        OK(ag_scene_add_instance(scene, mesh, material, turned, &instance));
        add(scene, (ag_light_desc) { .kind = AG_LIGHT_DIRECTIONAL,
                                     .direction = { 0, 0, -1 },
                                     .intensity = PI_F });
        assert_close(center(*state, scene), two ? 1 : 0, 2e-3f);
        ag_scene_destroy(scene);
    }
}

// A normal map that leans towards +x of the texture: turning the texture by a quarter turns
// the lean with it, seen by light along each axis.
static void normal_maps_turn_with_their_texture(void **state)
{
    static const uint8_t leaning[4] = { 218, 128, 218, 255 }; // (.71, 0, .71)
    const ag_image_desc image_desc = { 1, 1, AG_FORMAT_RGBA8, leaning };
    // u' = cos u + sin v: after a quarter turn u' runs along v, down the wall.
    const float angles[] = { 0, PI_F / 2, PI_F }, towards[][2] = { { 1, 0 }, { 0, -1 }, { -1, 0 } };
    for (int i = 0; i < 3; i++) {
        ag_scene *scene = stage_dark();
        ag_image *image;
        ag_material_desc matte = stage_matte(1);
        OK(ag_image_create(NULL, &image_desc, &image));
        const ag_texture_desc desc = { .image = image };
        OK(ag_scene_add_texture(scene, &desc, &matte.normal_texture.texture));
        ag_image_destroy(image);
        matte.normal_texture.rotation_rad = angles[i];
        stage_show(scene, stage_quad(scene, -1, -1, 1, 1, 0, NULL), &matte);
        add(scene, (ag_light_desc) { .kind = AG_LIGHT_DIRECTIONAL,
                                     .direction = { -towards[i][0], -towards[i][1], -1 },
                                     .intensity = PI_F });
        assert_close(center(*state, scene), 1, 0.01f);
        ag_scene_destroy(scene);
    }
}

static void use_texel(ag_scene *scene, const uint8_t texel[4], ag_texture_use *use)
{
    const ag_image_desc image_desc = { 1, 1, AG_FORMAT_RGBA8, texel };
    ag_image *image;
    OK(ag_image_create(NULL, &image_desc, &image));
    const ag_texture_desc desc = { .image = image };
    OK(ag_scene_add_texture(scene, &desc, &use->texture));
    ag_image_destroy(image);
}

// Materials share a shader that reads every texture which any of them has: one that has
// fewer is as if it stood alone.
static void textures_of_others_change_nothing(void **state)
{
    static const uint8_t white[4] = { 255, 255, 255, 255 }, odd[4] = { 200, 90, 30, 60 };
    float value[2];
    for (int with = 0; with < 2; with++) {
        ag_scene *scene = stage_dark();
        ag_material_desc plain = ag_material_default(), rich = plain;
        use_texel(scene, white, &plain.base_color_texture);
        stage_show(scene, stage_quad(scene, -0.5f, -0.5f, 0.5f, 0.5f, 0, NULL), &plain);
        use_texel(scene, odd, &rich.base_color_texture);
        use_texel(scene, odd, &rich.metallic_roughness_texture);
        use_texel(scene, odd, &rich.normal_texture);
        use_texel(scene, odd, &rich.occlusion_texture);
        use_texel(scene, odd, &rich.emissive_texture);
        use_texel(scene, odd, &rich.specular_texture);
        use_texel(scene, odd, &rich.specular_color_texture);
        if (with)
            stage_show(scene, stage_quad(scene, 0.6f, 0.6f, 1, 1, 0, NULL), &rich);
        stage_surround(scene, 1, 0.5f, 0.25f);
        add(scene, (ag_light_desc) { .kind = AG_LIGHT_DIRECTIONAL,
                                     .direction = { 0.4f, 0.3f, -1 },
                                     .intensity = 3 });
        value[with] = center(*state, scene);
        ag_scene_destroy(scene);
    }
    assert_true(value[0] > 0.1f);
    assert_close(value[1], value[0], 1e-3f);
}

static ag_texture texel(ag_scene *scene, uint8_t r, uint8_t g, uint8_t b, uint8_t a)
{
    const uint8_t pixel[4] = { r, g, b, a };
    const ag_image_desc image_desc = { 1, 1, AG_FORMAT_RGBA8, pixel };
    ag_image *image;
    ag_texture texture;
    OK(ag_image_create(NULL, &image_desc, &image));
    const ag_texture_desc desc = { .image = image };
    OK(ag_scene_add_texture(scene, &desc, &texture));
    ag_image_destroy(image);
    return texture;
}

// The wall's middle in a world of radiance 1.
static float in_white_world(ag_device *device, ag_scene *scene, const ag_material_desc *material)
{
    stage_surround(scene, 1, 1, 1);
    stage_show(scene, stage_quad(scene, -4, -4, 4, 4, 0, NULL), material);
    float value = center(device, scene);
    ag_scene_destroy(scene);
    return value;
}

// Every channel reaches the input that glTF gives it, and no other one does.
static void textures_feed_their_inputs(void **state)
{
    ag_scene *scene = stage_dark();
    ag_material_desc m = ag_material_default();
    m.metallic_roughness_texture.texture = texel(scene, 0, 0, 255, 0); // white metal
    assert_close(in_white_world(*state, scene, &m), 1, 0.01f);

    // Rough and white, face on: plastic sends nearly all of E / pi back; metal 1.145 times, by the
    // random walk of tests/physics/many_bounces.c: what bounces on leaves upright.
    for (int metal = 0; metal < 2; metal++) {
        scene = stage_dark();
        m.metallic_roughness_texture.texture = texel(scene, 0, 255, metal ? 255 : 0, 0);
        stage_show(scene, stage_quad(scene, -4, -4, 4, 4, 0, NULL), &m);
        add(scene, (ag_light_desc) { .kind = AG_LIGHT_DIRECTIONAL,
                                     .direction = { 0, 0, -1 },
                                     .intensity = PI_F });
        float value = center(*state, scene);
        assert_close(value, metal ? 1.145f : 1, metal ? 0.04f : 0.02f);
        ag_scene_destroy(scene);
    }

    scene = stage_dark();
    m = ag_material_default();
    memcpy(m.base_color, (float[4]) { 0, 0, 0, 1 }, sizeof m.base_color);
    m.metallic_roughness_texture.texture = texel(scene, 255, 0, 0, 255); // black plastic
    assert_close(in_white_world(*state, scene, &m), 0.04f, 0.005f); // ((1.5 - 1) / (1.5 + 1))^2

    scene = stage_dark();
    m = ag_material_default();
    m.metallic = 0;
    m.roughness = 0;
    memcpy(m.base_color, (float[4]) { 0, 0, 0, 1 }, sizeof m.base_color);
    m.specular_texture.texture = texel(scene, 255, 255, 255, 128); // half the reflectance
    assert_close(in_white_world(*state, scene, &m), 0.02f, 0.003f);

    scene = stage_dark();
    m.specular_texture.texture.id = 0;
    m.specular_color_texture.texture = texel(scene, 0, 188, 0, 0); // sRGB 188 is .5
    assert_close(in_white_world(*state, scene, &m), 0.02f, 0.003f);

    scene = stage_dark();
    m = stage_matte(1);
    m.occlusion_texture.texture = texel(scene, 128, 0, 0, 0);
    assert_close(in_white_world(*state, scene, &m), 128 / 255.0f, 0.01f);

    scene = stage_dark();
    m = stage_matte(1);
    m.occlusion_strength = 0.5f;
    m.occlusion_texture.texture = texel(scene, 0, 255, 255, 255);
    assert_close(in_white_world(*state, scene, &m), 0.5f, 0.01f);

    scene = stage_dark();
    m = stage_matte(0);
    memcpy(m.emissive, (float[3]) { 4, 4, 4 }, sizeof m.emissive);
    m.emissive_texture.texture = texel(scene, 0, 188, 0, 0);
    assert_close(in_white_world(*state, scene, &m), 2, 0.02f);
}

// Parallel rays meet a flat mirror at one angle: it shows one point of the world, everywhere.
static void orthographic_mirrors_show_one_direction(void **state)
{
    ag_scene *scene = stage_dark();
    ag_image *patch = bright_towards_x();
    const ag_environment_desc around = { .kind = AG_ENVIRONMENT_IMAGE, .image = patch };
    OK(ag_scene_set_environment(scene, &around));
    ag_image_destroy(patch);
    ag_material_desc mirror = ag_material_default();
    mirror.roughness = 0;
    stage_show(scene, stage_quad(scene, -9, -9, 9, 9, 0, NULL), &mirror);
    // 75 degrees off the normal the mirror shows what is 15 degrees off +X: inside the patch,
    // whose edge would be in the picture if the rays spread.
    const ag_camera_desc camera = { .position = { -4.83f, 0, 1.29f }, .height_m = 2 };
    ag_image *image = stage_render(*state, scene, &camera, &linear);
    const float *middle = stage_float(image, 32, 32), *corner = stage_float(image, 1, 1);
    assert_true(middle[3] == 1 && corner[3] == 1);
    assert_close(middle[0], 8, 0.2f);
    assert_close(corner[0], middle[0], 1e-3f);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        KIT_TEST(directional_light_is_lambert),
        KIT_TEST(point_light_falls_off_by_the_square),
        KIT_TEST(spot_light_has_a_cone),
        KIT_TEST(lights_add_up_in_their_colours),
        KIT_TEST(emission_is_radiance),
        KIT_TEST(white_furnace),
        KIT_TEST(image_light_is_diffuse_light),
        KIT_TEST(environment_has_its_directions),
        KIT_TEST(mirrored_instances_keep_their_light),
        KIT_TEST(sides),
        KIT_TEST(normal_maps_turn_with_their_texture),
        KIT_TEST(textures_feed_their_inputs),
        KIT_TEST(orthographic_mirrors_show_one_direction),
        KIT_TEST(textures_of_others_change_nothing),
    };
    return cmocka_run_group_tests(tests, kit_open, kit_close);
}
