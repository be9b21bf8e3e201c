// Built-in scenes made of many like things.
#include "image/image.h"
#include "scene/demo.h"

static const float pi = 3.14159265359f;

// Rows from metal to plastic, columns from smooth to rough.
void demo_spheres(stage *s)
{
    enum { COLUMNS = 6, ROWS = 5 };
    // Reflectances of gold, copper and silver (Lagarde 2011, "Feeding a physically based
    // shading model"), then two plastics.
    static const struct {
        vec3 color;
        float metallic;
    } rows[ROWS] = {
        { { 0.972f, 0.960f, 0.915f }, 1.0f }, { { 1.000f, 0.782f, 0.344f }, 1.0f },
        { { 0.955f, 0.638f, 0.538f }, 1.0f }, { { 0.020f, 0.300f, 0.380f }, 0.0f },
        { { 0.600f, 0.035f, 0.020f }, 0.0f },
    };
    ag_mesh sphere = stage_sphere(s, 0.46f, 64, 40);
    for (int row = 0; row < ROWS; row++) {
        for (int column = 0; column < COLUMNS; column++) {
            float roughness = (float)column / (float)(COLUMNS - 1);
            ag_material material = stage_paint(s, rows[row].color, rows[row].metallic, roughness);
            vec3 at = { (float)column - 0.5f * (COLUMNS - 1), 0.5f * (ROWS - 1) - (float)row, 0 };
            stage_show(s, sphere, material, at);
        }
    }
    stage_environment(s, AG_ENVIRONMENT_STUDIO);
    stage_camera(s, 0.0f, 0.5f * pi, 0.45f);
}

static ag_material_desc grid_material(stage *s, float metallic, float roughness)
{
    ag_material_desc desc = ag_material_default();
    vec3_store((vec3) { 0.5f, 0, 0 }, desc.base_color);
    desc.metallic = metallic;
    desc.roughness = roughness;
    if (s->look == AG_LOOK_TEXT) {
        desc.shadowing = AG_SHADOWING_SCHLICK;
        desc.layering = AG_LAYERING_FRESNEL;
        desc.single_bounce = true;
    }
    return desc;
}

// The scene of the text on direct lighting: metallic rises upwards in sevenths, roughness to the
// right, 300 cd from each of four corners, and an ambient term: .03 of the albedo, of which
// metals here have none.
void demo_grid(stage *s)
{
    enum { SIDE = 7 };
    ag_mesh sphere = stage_sphere(s, 1.0f, 48, 30);
    for (int row = 0; row < SIDE; row++) {
        for (int column = 0; column < SIDE; column++) {
            float roughness = fminf(fmaxf((float)column / SIDE, 0.05f), 1.0f);
            ag_material material =
                stage_material(s, grid_material(s, (float)row / SIDE, roughness));
            vec3 at = { 2.5f * ((float)column - 3.0f), 2.5f * ((float)row - 3.0f), 0.0f };
            stage_show(s, sphere, material, at);
        }
    }
    for (int i = 0; i < 4; i++)
        stage_light(s, (ag_light_desc) {
                           .kind = AG_LIGHT_POINT,
                           .position = { i & 1 ? 10.0f : -10.0f, i & 2 ? -10.0f : 10.0f, 10.0f },
                           .intensity = 300.0f });
    if (s->look == AG_LOOK_TEXT)
        stage_light(s, (ag_light_desc) { .kind = AG_LIGHT_AMBIENT, .intensity = 0.03f });
    stage_environment(s, AG_ENVIRONMENT_NONE);
    stage_camera(s, 0.0f, 0.5f * pi, 0.785398163f);
}

// White metals of rising roughness above white plastics.  In a world of constant radiance 1
// nothing should be seen of what loses no energy.
void demo_furnace(stage *s)
{
    enum { COLUMNS = 5 };
    ag_mesh sphere = stage_sphere(s, 0.46f, 64, 40);
    for (int row = 0; row < 2; row++) {
        for (int column = 0; column < COLUMNS; column++) {
            float roughness = (float)column / (float)(COLUMNS - 1);
            ag_material material =
                stage_paint(s, (vec3) { 1, 1, 1 }, row == 0 ? 1.0f : 0.0f, roughness);
            stage_show(s, sphere, material,
                       (vec3) { (float)column - 2.0f, row == 0 ? 0.5f : -0.5f, 0.0f });
        }
    }
    enum { WIDTH = 64, HEIGHT = 32 };
    float white[WIDTH * HEIGHT * 4];
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++)
        white[i] = 1.0f;
    ag_image image = { WIDTH, HEIGHT, AG_FORMAT_RGBA32F, white };
    stage_camera(s, 0.0f, 0.5f * pi, 0.45f);
    if (s->status == AG_OK)
        s->status = ag_scene_set_environment(
            s->scene, &(ag_environment_desc) { .kind = AG_ENVIRONMENT_IMAGE, .image = &image });
}

// A colour wheel at even brightness.
static vec3 hue(float turns)
{
    float angle = 2.0f * pi * turns;
    return (vec3) { 0.42f + 0.33f * cosf(angle), 0.42f + 0.33f * cosf(angle - 2.0944f),
                    0.42f + 0.33f * cosf(angle + 2.0944f) };
}

void demo_million(stage *s)
{
    enum { COLUMNS = 14, ROWS = 7 };
    ag_mesh sphere = stage_sphere(s, 0.46f, 72, 72); // 10,224 triangles
    for (int row = 0; row < ROWS; row++) {
        for (int column = 0; column < COLUMNS; column++) {
            float roughness = (float)column / (float)(COLUMNS - 1);
            ag_material material =
                stage_paint(s, hue((float)row / ROWS), column & 1 ? 1.0f : 0.0f, roughness);
            stage_show(s, sphere, material, (vec3) { (float)column - 6.5f, 0, (float)row - 3.0f });
        }
    }
    stage_environment(s, AG_ENVIRONMENT_STUDIO);
    stage_camera(s, 0.35f, 1.0f, 0.5f);
}

void demo_nodes(stage *s)
{
    enum { SIDE = 100, MATERIALS = 20 };
    ag_mesh box = stage_box(s, (vec3) { 0.4f, 0.4f, 0.4f }, 0.0f);
    ag_material materials[MATERIALS];
    for (int i = 0; i < MATERIALS; i++)
        materials[i] =
            stage_paint(s, hue((float)i / MATERIALS), i & 1 ? 1.0f : 0.0f, 0.2f + 0.03f * (float)i);
    for (int z = 0; z < SIDE; z++) {
        for (int x = 0; x < SIDE; x++) {
            float fx = (float)x - 49.5f, fz = (float)z - 49.5f;
            float height = 5.0f * sinf(0.13f * fx) * cosf(0.11f * fz);
            int material = (int)((height + 5.0f) * 0.0999f * MATERIALS);
            stage_show_turned(s, box, materials[material], (vec3) { fx, height, fz },
                              0.05f * (float)(x + z), 0.0f);
        }
    }
    stage_environment(s, AG_ENVIRONMENT_STUDIO);
    stage_camera(s, 0.6f, 1.0f, 0.5f);
}
