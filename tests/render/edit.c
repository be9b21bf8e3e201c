// Lights and materials that are set: the picture is that of a scene made so from the start, and
// what is on the device stays there.
#include "stage.h"

#include "render/renderer.h"

enum { MATERIALS = 3, LIGHTS = 2, SIZE = 48 };

typedef struct look {
    ag_material_desc materials[MATERIALS];
    ag_light_desc lights[LIGHTS];
} look;

// One lit surface: each variant of those takes a second to compile.
static look first_look(void)
{
    look l = { .materials = { stage_unlit(0.6f, 0.5f, 0.4f, 1), stage_matte(0.8f),
                              stage_unlit(0.2f, 0.3f, 0.5f, 1) },
               .lights = { { .position = { 1, 1, 2 }, .intensity = 6 },
                           { .position = { -0.7f, 0.2f, 1 }, .intensity = 1 } } };
    l.materials[1].roughness = 0.4f;
    l.materials[1].base_color_texture.texture.id = 1;
    return l;
}

// A texture whose colours, alpha and slopes all vary.
static void add_texture(ag_scene *scene)
{
    enum { N = 16 };
    uint8_t pixels[N * N][4];
    for (int i = 0; i < N * N; i++)
        memcpy(pixels[i],
               (uint8_t[4]) { (uint8_t)(90 + 5 * (i % N)), (uint8_t)(160 - 4 * (i / N)), 230,
                              (uint8_t)(i * 7) },
               4);
    const ag_image_desc desc = { N, N, AG_FORMAT_RGBA8, pixels };
    ag_image *image;
    ag_texture texture;
    OK(ag_image_create(NULL, &desc, &image));
    OK(ag_scene_add_texture(scene, &(ag_texture_desc) { .image = image }, &texture));
    ag_image_destroy(image);
}

// Three quads, one behind the other, with uvs.
static ag_scene *build(const look *l)
{
    ag_scene *scene = stage_dark();
    stage_surround(scene, 0.3f, 0.4f, 0.5f);
    add_texture(scene);
    for (int i = 0; i < MATERIALS; i++) {
        float x = 0.5f * (float)i - 1;
        stage_show(scene, stage_quad(scene, x, x, x + 1, x + 1, 0.3f * (float)i, NULL),
                   &l->materials[i]);
    }
    ag_light light;
    for (int i = 0; i < LIGHTS; i++)
        OK(ag_scene_add_light(scene, &l->lights[i], &light));
    return scene;
}

static void set(ag_scene *scene, const look *l)
{
    for (uint32_t i = 0; i < LIGHTS; i++)
        OK(ag_scene_set_light(scene, (ag_light) { i + 1 }, &l->lights[i]));
    for (uint32_t i = 0; i < MATERIALS; i++)
        OK(ag_scene_set_material(scene, (ag_material) { i + 1 }, &l->materials[i]));
}

static const ag_camera_desc camera = { .position = { 0, 0, 5 }, .height_m = 2.4f };

static ag_image *draw(ag_renderer *renderer, const ag_scene *scene, ag_render_stats *stats)
{
    const ag_render_options options = { .width = SIZE, .height = SIZE };
    ag_image *image;
    OK(ag_renderer_render(renderer, scene, &camera, &options, &image, stats));
    return image;
}

static bool same(const ag_image *a, const ag_image *b)
{
    return memcmp(ag_image_pixels(a), ag_image_pixels(b), (size_t)SIZE * SIZE * 4) == 0;
}

// ---- One change after the other ---------------------------------------------------------

static void move_a_light(look *l)
{
    l->lights[0].position[0] = -1;
}

static void polish(look *l)
{
    l->materials[1].roughness = 0.15f;
    l->materials[1].metallic = 1;
}

static void move_the_texture(look *l)
{
    l->materials[0].base_color_texture = (ag_texture_use) { .texture = { 1 }, .scale = { 2, 2 } };
}

static void cut_holes(look *l)
{
    l->materials[0].alpha_mode = AG_ALPHA_MASK;
}

static void make_glass(look *l)
{
    l->materials[2].alpha_mode = AG_ALPHA_BLEND;
    l->materials[2].base_color[3] = 0.4f;
}

static void close_all(look *l)
{
    l->materials[0].alpha_mode = l->materials[2].alpha_mode = AG_ALPHA_OPAQUE;
    l->lights[0].kind = AG_LIGHT_SPOT;
}

// `anew` draws scenes made so from the start.
static void changes_are_as_from_the_start(void **state)
{
    static void (*const changes[])(look *) = { move_a_light, polish,     move_the_texture,
                                               cut_holes,    make_glass, close_all };
    ag_renderer *renderer, *anew;
    OK(ag_renderer_create(*state, &renderer));
    OK(ag_renderer_create(*state, &anew));
    look l = first_look();
    ag_scene *scene = build(&l);
    ag_image *last = draw(renderer, scene, NULL);
    const resident *r = &renderer->resident;
    VkBuffer vertices = r->geometry.vertices.buffer;
    VkImage texture = r->textures.images[TEXTURE_COLOR].image, cube = r->surround.cube.image;
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        changes[i](&l);
        set(scene, &l);
        ag_scene *made = build(&l);
        ag_image *image = draw(renderer, scene, NULL), *wanted = draw(anew, made, NULL);
        if (!same(image, wanted) || same(image, last))
            print_error("after change %zu\n", i);
        assert_true(same(image, wanted));
        assert_false(same(image, last));
        assert_true(r->geometry.vertices.buffer == vertices && r->surround.cube.image == cube);
        assert_true(texture && r->textures.images[TEXTURE_COLOR].image == texture);
        ag_scene_destroy(made);
        ag_image_destroy(wanted);
        ag_image_destroy(last);
        last = image;
    }
    ag_image_destroy(last);
    ag_scene_destroy(scene);
    ag_renderer_destroy(renderer);
    ag_renderer_destroy(anew);
}

// A scene whose images were taken is still edited, as long as they suffice; and lights need no
// upload at all.
static void taken_scenes_are_edited(void **state)
{
    ag_renderer *renderer;
    OK(ag_renderer_create(*state, &renderer));
    look l = first_look();
    ag_scene *scene = build(&l);
    OK(ag_renderer_take(renderer, scene, NULL));
    ag_render_stats stats;
    ag_image *before = draw(renderer, scene, &stats), *after;
    assert_true(stats.upload_ms > 0); // of what surrounds it
    move_a_light(&l);
    OK(ag_scene_set_light(scene, (ag_light) { 1 }, &l.lights[0]));
    ag_image_destroy(draw(renderer, scene, &stats));
    assert_true(stats.upload_ms == 0 && stats.bake_ms == 0);
    polish(&l);
    set(scene, &l);
    after = draw(renderer, scene, NULL);
    assert_false(same(before, after));
    look more = l;
    move_the_texture(&more);
    cut_holes(&more);
    set(scene, &more);
    ag_image *none = before;
    assert_int_equal(ag_renderer_render(renderer, scene, &camera, NULL, &none, NULL),
                     AG_ERROR_ARGUMENT);
    assert_null(none);
    set(scene, &l);
    ag_image *again = draw(renderer, scene, NULL);
    assert_true(same(again, after));
    ag_image_destroy(before);
    ag_image_destroy(after);
    ag_image_destroy(again);
    ag_scene_destroy(scene);
    ag_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        KIT_TEST(changes_are_as_from_the_start),
        KIT_TEST(taken_scenes_are_edited),
    };
    return cmocka_run_group_tests(tests, kit_open, kit_close);
}
