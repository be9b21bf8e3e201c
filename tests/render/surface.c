// Every choice of a material as the pixels have it, against the physics in C.
#include "stage.h"

#include "physics/surface_light.glsl"

#include "../physics/albedo.h" // after the physics, whose locals have its names

typedef struct choice {
    const char *name;
    uint model;
    ag_diffuse diffuse;
    ag_distribution distribution;
    ag_shadowing shadowing;
    ag_fresnel fresnel;
    ag_layering layering;
    bool single_bounce;
    float anisotropy;
} choice;

static const choice choices[] = {
    { .name = "default" },
    { .name = "Oren-Nayar", .model = SURFACE_OREN_NAYAR, .diffuse = AG_DIFFUSE_OREN_NAYAR },
    { .name = "EON", .model = SURFACE_EON, .diffuse = AG_DIFFUSE_EON },
    { .name = "Blinn", .model = SURFACE_BLINN, .distribution = AG_DISTRIBUTION_BLINN },
    { .name = "anisotropic", .model = SURFACE_ANISOTROPIC, .anisotropy = 0.7f },
    { .name = "Schlick-GGX", .model = SURFACE_SCHLICK_GGX, .shadowing = AG_SHADOWING_SCHLICK },
    { .name = "conductor", .model = SURFACE_CONDUCTOR, .fresnel = AG_FRESNEL_CONDUCTOR },
    { .name = "F82", .model = SURFACE_F82, .fresnel = AG_FRESNEL_F82 },
    { .name = "by F", .model = SURFACE_LAYERED_BY_F, .layering = AG_LAYERING_FRESNEL },
    { .name = "as glTF", .model = SURFACE_LAYERED_AS_GLTF, .layering = AG_LAYERING_GLTF },
    { .name = "blend", .model = SURFACE_BLENDED, .layering = AG_LAYERING_BLEND },
    { .name = "single bounce", .model = SURFACE_SINGLE_BOUNCE, .single_bounce = true },
};
enum { CHOICES = sizeof choices / sizeof choices[0] };

static const float turn = 0.4f; // of the anisotropy
static const vec3 up = { 0, 0, 1 };

static ag_material_desc material_of(const choice *c)
{
    ag_material_desc m = ag_material_default();
    memcpy(m.base_color, (float[4]) { 0.8f, 0.5f, 0.3f, 1 }, sizeof m.base_color);
    memcpy(m.specular_color, (float[3]) { 1, 0.9f, 0.8f }, sizeof m.specular_color);
    memcpy(m.conductor_n, (float[3]) { 0.2f, 0.6f, 1.4f }, sizeof m.conductor_n);
    memcpy(m.conductor_k, (float[3]) { 3.4f, 2.1f, 1.8f }, sizeof m.conductor_k);
    memcpy(m.f82_tint, (float[3]) { 0.7f, 0.8f, 0.9f }, sizeof m.f82_tint);
    m.metallic = 0.4f;
    m.roughness = 0.6f;
    m.diffuse = c->diffuse;
    m.diffuse_roughness = 0.8f;
    m.distribution = c->distribution;
    m.shininess = 20;
    m.anisotropy = c->anisotropy;
    m.anisotropy_rotation_rad = turn;
    m.shadowing = c->shadowing;
    m.fresnel = c->fresnel;
    m.layering = c->layering;
    m.reflectiveness = 0.3f;
    m.single_bounce = c->single_bounce;
    return m;
}

static surface surface_of(const choice *c, vec3 wo)
{
    const surface_material m = {
        .base_color = vec3(0.8f, 0.5f, 0.3f),
        .metallic = 0.4f,
        .roughness = 0.6f,
        .dielectric_f0 = 0.04f,
        .specular_color = vec3(1, 0.9f, 0.8f),
        .specular = 1,
        .model = c->model,
        .diffuse_roughness = 0.8f,
        .shininess = 20,
        .anisotropy = c->anisotropy,
        .tangent = vec3(cosf(turn), sinf(turn), 0),
        .conductor_n = vec3(0.2f, 0.6f, 1.4f),
        .conductor_k = vec3(3.4f, 2.1f, 1.8f),
        .f82_tint = vec3(0.7f, 0.8f, 0.9f),
        .reflectiveness = 0.3f,
    };
    albedo e = albedo_of((double)wo[2], 0.36, 200);
    vec2 dfg = c->anisotropy > 0 ? surface_sky(m, up, wo) : vec2((float)e.scale, (float)e.bias);
    return surface_from_metallic_roughness(m, wo[2], dfg);
}

// One strip of wall a choice, under a directional light, a sphere, and a world of one colour.
static ag_scene *strips(void)
{
    ag_scene *scene = stage_dark();
    ag_light light;
    const ag_light_desc directional = { .kind = AG_LIGHT_DIRECTIONAL,
                                        .direction = { 0.48f, -0.36f, -0.8f },
                                        .intensity = 5 };
    const ag_light_desc sphere = {
        .kind = AG_LIGHT_SPHERE, .position = { -1, -1, 1.5f }, .intensity = 10, .radius_m = 0.6f
    };
    for (int i = 0; i < CHOICES; i++) {
        const ag_material_desc m = material_of(&choices[i]);
        stage_show(scene, stage_quad(scene, -1, (float)i, 1, (float)i + 1, 0, NULL), &m);
    }
    OK(ag_scene_add_light(scene, &directional, &light));
    OK(ag_scene_add_light(scene, &sphere, &light));
    stage_surround(scene, 2, 2, 2);
    return scene;
}

static void choices_draw_what_the_physics_says(void **state)
{
    enum { SIZE = 2 * CHOICES };
    const vec3 wo = vec3(0.6f, 0, 0.8f), wi = vec3(-0.48f, 0.36f, 0.8f), two = vec3(2, 2, 2);
    const ag_render_options linear = { .width = SIZE, .height = SIZE, .format = AG_FORMAT_RGBA32F };
    const ag_camera_desc camera = { .position = { 3, CHOICES / 2.0f, 4 },
                                    .target = { 0, CHOICES / 2.0f, 0 },
                                    .height_m = CHOICES };
    ag_scene *scene = strips();
    ag_image *image = stage_render(*state, scene, &camera, &linear);
    for (int i = 0; i < CHOICES; i++) {
        // A pixel is half a metre; this one's middle is right of the picture's and in the strip's
        // lower half.
        vec3 point = vec3(0.25f / 0.8f, (float)i + 0.25f, 0);
        vec3 to_sphere = vec3(-1, -1, 1.5f) - point;
        surface s = surface_of(&choices[i], wo);
        vec3 expected = 5 * surface_direct(s, up, wo, wi) +
                        10 / dot(to_sphere, to_sphere) *
                            surface_cap(s, up, wo, light_cap_sphere(to_sphere, 0.6f)) +
                        surface_environment(s, two, two);
        const float *pixel = stage_float(image, CHOICES, (uint32_t)(SIZE - 1 - 2 * i));
        for (int k = 0; k < 3; k++) {
            if (!(fabsf(pixel[k] - expected[k]) <= 0.01f * expected[k]))
                print_error("%s, channel %d:\n", choices[i].name, k);
            assert_close(pixel[k], expected[k], 0.01f * expected[k]);
        }
    }
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = { KIT_TEST(choices_draw_what_the_physics_says) };
    return cmocka_run_group_tests(tests, kit_open, kit_close);
}
