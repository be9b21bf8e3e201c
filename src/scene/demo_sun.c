// The sun of the text on distant sphere lights, and a larger one, over balls from smooth to rough.
//
// The text has a formula and the real sun's ratio of radius to distance, .00465; the scene is
// ours, and its look that of the paper that the text adds to (Karis 2013).
#include "scene/demo.h"

static const float pi = 3.14159265359f;

static ag_material paint(stage *s, vec3 color, float metallic, float roughness)
{
    ag_material_desc desc = ag_material_default();
    vec3_store(color, desc.base_color);
    desc.metallic = metallic;
    desc.roughness = roughness;
    if (s->look == AG_LOOK_TEXT) {
        desc.shadowing = AG_SHADOWING_SCHLICK;
        desc.layering = AG_LAYERING_GLTF;
        desc.single_bounce = true;
    }
    return stage_material(s, desc);
}

static void show(stage *s)
{
    enum { COLUMNS = 5 };
    ag_mesh ball = stage_sphere(s, 0.45f, 96, 60);
    for (int i = 0; i < COLUMNS; i++) {
        float roughness = 0.05f + 0.15f * (float)i, x = (float)i - 0.5f * (COLUMNS - 1);
        stage_show(s, ball, paint(s, (vec3) { 0.95f, 0.64f, 0.54f }, 1.0f, roughness),
                   (vec3) { x, 1.45f, 0 });
        stage_show(s, ball, paint(s, (vec3) { 0.02f, 0.05f, 0.12f }, 0.0f, roughness),
                   (vec3) { x, 0.45f, 0 });
    }
    stage_view(s, (ag_camera_desc) {
                      .position = { 0, 1.7f, 6.4f }, .target = { 0, 1.2f, 0 }, .fov_y_rad = 0.8f });
    stage_show_turned(s, stage_panel(s, 4000.0f, 4000.0f, 1.0f),
                      paint(s, (vec3) { 0.05f, 0.05f, 0.05f }, 0.0f, 0.25f), (vec3) { 0, 0, 0 }, 0,
                      -0.5f * pi);
    stage_surround(s, AG_ENVIRONMENT_SKY, 0.35f);
}

// `ratio`: of radius to distance, the angular radius' sine.
static void rise(stage *s, float ratio)
{
    show(s);
    stage_light(s, (ag_light_desc) { .kind = AG_LIGHT_SUN,
                                     .direction = { 0.16f, -0.2f, 0.97f },
                                     .color = { 1.0f, 0.93f, 0.82f },
                                     .intensity = 1.5f,
                                     .angular_radius_rad = asinf(ratio) });
}

void demo_sun(stage *s)
{
    rise(s, 0.00465f);
}

void demo_sun_large(stage *s)
{
    rise(s, 0.1f);
}
