// Pictures shaded from a list of what is seen, against the same drawn triangle by triangle.
#include "stage.h"

#include "render/renderer.h"

typedef struct difference {
    double mean;  // of all channels of all pixels, steps of 8 bits
    int interior; // greatest where the forward picture is even
    int edges;    // pixels that are not even
} difference;

static ag_image *draw(ag_device *device, const ag_scene *scene, const ag_camera_desc *camera,
                      const ag_render_options *options, bool forward)
{
    ag_renderer *renderer;
    ag_image *image;
    OK(ag_renderer_create(device, &renderer));
    renderer->forward_only = forward;
    OK(ag_renderer_render(renderer, scene, camera, options, &image, NULL));
    bool host = ag_device_describe(device)->kind == AG_DEVICE_CPU;
    assert_true(renderer->targets.desc.deferred == (host && !forward));
    ag_renderer_destroy(renderer);
    return image;
}

static int apart(const uint8_t *a, const uint8_t *b)
{
    int most = 0;
    for (int c = 0; c < 4; c++)
        most = abs(a[c] - b[c]) > most ? abs(a[c] - b[c]) : most;
    return most;
}

static bool is_even(const ag_image *image, uint32_t x, uint32_t y)
{
    if (x == 0 || y == 0 || x + 1 == ag_image_width(image) || y + 1 == ag_image_height(image))
        return false;
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++)
            if (apart(stage_byte(image, x, y),
                      stage_byte(image, x + (uint32_t)dx, y + (uint32_t)dy)) > 6)
                return false;
    return true;
}

static difference compare(const ag_image *forward, const ag_image *deferred)
{
    difference d = { 0 };
    uint32_t width = ag_image_width(forward), height = ag_image_height(forward);
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            const uint8_t *a = stage_byte(forward, x, y), *b = stage_byte(deferred, x, y);
            for (int c = 0; c < 4; c++)
                d.mean += abs(a[c] - b[c]) / (4.0 * width * height);
            if (!is_even(forward, x, y))
                d.edges++;
            else if (apart(a, b) > d.interior)
                d.interior = apart(a, b);
        }
    return d;
}

// Both paths agree: nearly everywhere, and on the mean where edges are.
static void agree(ag_device *device, const ag_scene *scene, const ag_camera_desc *camera,
                  const ag_render_options *options)
{
    ag_image *forward = draw(device, scene, camera, options, true);
    ag_image *deferred = draw(device, scene, camera, options, false);
    difference d = compare(forward, deferred);
    if (d.mean > 0.25 || d.interior > 6)
        fail_msg("mean %g, interior %d, edges %d", d.mean, d.interior, d.edges);
    ag_image_destroy(forward);
    ag_image_destroy(deferred);
}

static ag_scene *demo(const char *name)
{
    ag_scene *scene;
    OK(ag_scene_create(NULL, &scene));
    OK(ag_scene_load_demo(scene, name, AG_LOOK_ARGAND));
    return scene;
}

static void demos_agree(void **state)
{
    static const char *const names[] = { "spheres", "grid", "sphere-lights" };
    const ag_render_options options = { .width = 160, .height = 120 };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        ag_scene *scene = demo(names[i]);
        agree(*state, scene, NULL, &options);
        ag_scene_destroy(scene);
    }
}

static void options_agree(void **state)
{
    ag_scene *scene = demo("lights");
    for (int i = 0; i <= AG_QUALITY_BEST; i++) {
        const ag_render_options options = { .width = 93,
                                            .height = 71,
                                            .quality = (ag_quality)i,
                                            .background = (ag_background)((i + 2) % 3),
                                            .background_color = { 0.2f, 0.9f, 0.5f },
                                            .tonemap = AG_TONEMAP_ACES };
        agree(*state, scene, NULL, &options);
    }
    ag_scene_destroy(scene);
}

static void light_is_the_same(void **state)
{
    ag_scene *scene = demo("spheres");
    const ag_render_options options = { .width = 64, .height = 48, .format = AG_FORMAT_RGBA32F };
    ag_image *forward = draw(*state, scene, NULL, &options, true);
    ag_image *deferred = draw(*state, scene, NULL, &options, false);
    double sum = 0, wrong = 0;
    for (uint32_t i = 0; i < 64 * 48; i++)
        for (int c = 0; c < 3; c++) {
            float a = stage_float(forward, i % 64, i / 64)[c];
            sum += (double)a;
            wrong += fabs((double)a - (double)stage_float(deferred, i % 64, i / 64)[c]);
        }
    assert_true(wrong < 5e-3 * sum);
    ag_image_destroy(forward);
    ag_image_destroy(deferred);
    ag_scene_destroy(scene);
}

// A checker and a normal map, both with mips and a transform of their coordinates.
static ag_texture noise(ag_scene *scene, bool normals)
{
    enum { N = 64 };
    static uint8_t texels[N][N][4];
    for (int y = 0; y < N; y++)
        for (int x = 0; x < N; x++) {
            uint8_t wave = (uint8_t)(128 + 60 * sin(x * 0.4) * cos(y * 0.3));
            const uint8_t bump[4] = { wave, (uint8_t)(255 - wave), 240, 255 };
            const uint8_t color[4] = { wave, (x / 8 + y / 8) % 2 ? 220 : 90, 200, 255 };
            memcpy(texels[y][x], normals ? bump : color, 4);
        }
    const ag_image_desc image_desc = { N, N, AG_FORMAT_RGBA8, texels };
    ag_image *image;
    ag_texture texture;
    OK(ag_image_create(NULL, &image_desc, &image));
    OK(ag_scene_add_texture(scene, &(ag_texture_desc) { .image = image }, &texture));
    ag_image_destroy(image);
    return texture;
}

// Two rectangles, one mirrored and seen from behind, under a lamp and an even sky.
static ag_scene *sheets(void)
{
    ag_scene *scene = stage_dark();
    stage_surround(scene, 0.5f, 0.6f, 0.7f);
    const ag_light_desc lamp = {
        .kind = AG_LIGHT_POINT, .position = { 0.3f, 0.5f, 2 }, .color = { 1, 1, 1 }, .intensity = 4
    };
    ag_light light;
    OK(ag_scene_add_light(scene, &lamp, &light));
    ag_material_desc m = ag_material_default();
    m.metallic = 0.3f;
    m.roughness = 0.4f;
    m.double_sided = true;
    m.base_color_texture = (ag_texture_use) { .texture = noise(scene, false),
                                              .scale = { 2, 1 },
                                              .rotation_rad = 0.3f };
    m.normal_texture.texture = noise(scene, true);
    const float colors[4][4] = { { 1, 1, 1, 1 }, { 1, 0, 0, 1 }, { 0, 1, 0, 1 }, { 0, 0, 1, 1 } };
    ag_mesh mesh = stage_quad(scene, -1, -1, 1, 1, 0, colors);
    ag_material id;
    ag_instance instance;
    OK(ag_scene_add_material(scene, &m, &id));
    const float behind[16] = {
        0.5f, 0.1f, 0.6f, 0, 0, 1, 0, 0, 0.7f, 0, -0.6f, 0, 0.9f, 0, 0.5f, 1
    };
    const float mirrored[16] = { -0.8f, 0, 0, 0, 0, 0.8f, 0.2f, 0, 0, 0, 1, 0, -0.8f, 0, 0, 1 };
    OK(ag_scene_add_instance(scene, mesh, id, behind, &instance));
    OK(ag_scene_add_instance(scene, mesh, id, mirrored, &instance));
    return scene;
}

static void sheets_agree(void **state)
{
    ag_scene *scene = sheets();
    const ag_render_options options = { .width = 200, .height = 150 };
    const ag_camera_desc cameras[] = {
        { .position = { 0.4f, 0.3f, 4 } },
        { .position = { 0.4f, 0.3f, -4 } },
        { .position = { 0.4f, 0.3f, 4 }, .height_m = 3 },
    };
    for (int i = 0; i < 3; i++)
        agree(*state, scene, &cameras[i], &options);
    ag_scene_destroy(scene);
}

// More lights than every pixel is lit by, some of them with a body.
static void clusters_agree(void **state)
{
    ag_scene *scene = stage_dark();
    const ag_material_desc m = stage_matte(0.7f);
    stage_show(scene, stage_quad(scene, -3, -2, 3, 2, 0, NULL), &m);
    for (int i = 0; i < 40; i++) {
        const ag_light_desc desc = { .kind = i % 4 ? AG_LIGHT_POINT : AG_LIGHT_SPHERE,
                                     .position = { (float)(i % 8) - 3.5f, (float)i / 10 - 2, 0.4f },
                                     .radius_m = 0.1f,
                                     .color = { 1, 0.5f, (float)(i % 3) },
                                     .intensity = 0.3f,
                                     .range_m = 2 };
        ag_light light;
        OK(ag_scene_add_light(scene, &desc, &light));
    }
    const ag_camera_desc camera = { .position = { 0.5f, -1, 5 } };
    const ag_render_options options = { .width = 180, .height = 140 };
    agree(*state, scene, &camera, &options);
    ag_scene_destroy(scene);
}

static void tiles_agree(void **state)
{
    ag_scene *scene = demo("lights");
    const ag_render_options options = { .width = 2500, .height = 40, .quality = AG_QUALITY_FAST };
    agree(*state, scene, NULL, &options);
    ag_scene_destroy(scene);
}

// Through the near plane, and a floor that goes far behind the eye.
static void near_planes_agree(void **state)
{
    ag_scene *scene = stage_dark();
    stage_surround(scene, 1, 0.7f, 0.4f);
    const ag_material_desc m = stage_matte(0.5f);
    stage_show(scene, stage_quad(scene, -900, -900, 900, 900, 0, NULL), &m);
    const ag_camera_desc camera = {
        .position = { 0, 0, 1 }, .target = { 5, 1, 0.3f }, .up = { 0, 0, 1 }, .near_m = 0.05f
    };
    const ag_render_options options = { .width = 120, .height = 90 };
    agree(*state, scene, &camera, &options);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        KIT_TEST(demos_agree),       KIT_TEST(options_agree),  KIT_TEST(light_is_the_same),
        KIT_TEST(sheets_agree),      KIT_TEST(clusters_agree), KIT_TEST(tiles_agree),
        KIT_TEST(near_planes_agree),
    };
    return cmocka_run_group_tests(tests, kit_open, kit_close);
}
