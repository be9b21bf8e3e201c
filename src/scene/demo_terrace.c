// A built-in scene to be lit in real units: it has no light of its own.
//
// Three cards lie on a table on a terrace, .6 m above the ground, white, grey and black; a person
// of 1.75 m stands by.  What the cards reflect is Lambert's alone, so that under E lux they are
// of reflectance E / pi nit.  docs/real-units.md lights it.
#include "scene/demo.h"

static const float pi = 3.14159265359f;

static ag_material matte(stage *s, vec3 color)
{
    ag_material_desc desc = ag_material_default();
    vec3_store(color, desc.base_color);
    desc.metallic = 0;
    desc.roughness = 1;
    desc.specular = 0;
    return stage_material(s, desc);
}

static ag_material grey(stage *s, float reflectance)
{
    return matte(s, (vec3) { reflectance, reflectance, reflectance });
}

static void show_cards(stage *s)
{
    static const float reflectances[] = { 0.9f, 0.18f, 0.04f };
    ag_mesh card = stage_panel(s, 0.36f, 0.5f, 1);
    for (int i = 0; i < 3; i++)
        stage_show_turned(s, card, grey(s, reflectances[i]),
                          (vec3) { 0.44f * (float)(i - 1), 0.605f, 0.1f }, 0, -0.5f * pi);
}

static void show_table(stage *s)
{
    ag_material wood = matte(s, (vec3) { 0.26f, 0.17f, 0.1f });
    stage_show(s, stage_box(s, (vec3) { 0.72f, 0.02f, 0.42f }, 0.008f), wood,
               (vec3) { 0, 0.58f, 0.05f });
    ag_mesh leg = stage_box(s, (vec3) { 0.03f, 0.28f, 0.03f }, 0.006f);
    for (int i = 0; i < 4; i++)
        stage_show(s, leg, wood, (vec3) { i & 1 ? 0.66f : -0.66f, 0.28f, i & 2 ? 0.4f : -0.3f });
}

static void show_balls(stage *s)
{
    ag_mesh ball = stage_sphere(s, 0.11f, 64, 40);
    stage_show(s, ball, stage_paint(s, (vec3) { 0.914f, 0.922f, 0.924f }, 1, 0.15f), // aluminium
               (vec3) { -0.5f, 0.71f, -0.25f });
    stage_show(s, ball, stage_paint(s, (vec3) { 0.4f, 0.025f, 0.02f }, 0, 0.3f),
               (vec3) { -0.24f, 0.71f, -0.27f });
}

static void show_person(stage *s)
{
    const vec3 at = { 1.12f, 0, -0.35f };
    ag_material skin = matte(s, (vec3) { 0.48f, 0.31f, 0.23f });
    ag_material shirt = matte(s, (vec3) { 0.06f, 0.2f, 0.3f });
    ag_material trousers = matte(s, (vec3) { 0.09f, 0.085f, 0.08f });
    ag_mesh leg = stage_box(s, (vec3) { 0.085f, 0.42f, 0.09f }, 0.05f);
    ag_mesh arm = stage_box(s, (vec3) { 0.05f, 0.31f, 0.055f }, 0.045f);
    for (int i = -1; i <= 1; i += 2) {
        stage_show(s, leg, trousers, vec3_add(at, (vec3) { 0.1f * (float)i, 0.42f, 0 }));
        stage_show(s, arm, shirt, vec3_add(at, (vec3) { 0.27f * (float)i, 1.12f, 0 }));
    }
    stage_show(s, stage_box(s, (vec3) { 0.2f, 0.32f, 0.12f }, 0.09f), shirt,
               vec3_add(at, (vec3) { 0, 1.12f, 0 }));
    stage_show(s, stage_sphere(s, 0.06f, 32, 20), skin, vec3_add(at, (vec3) { 0, 1.45f, 0 }));
    stage_show(s, stage_sphere(s, 0.125f, 64, 40), skin, vec3_add(at, (vec3) { 0, 1.625f, 0 }));
}

void demo_terrace(stage *s)
{
    show_cards(s);
    show_table(s);
    show_balls(s);
    show_person(s);
    stage_show_turned(s, stage_panel(s, 80, 80, 1), grey(s, 0.3f), (vec3) { 0, 0, 0 }, 0,
                      -0.5f * pi);
    stage_show(s, stage_panel(s, 6, 2.1f, 1), matte(s, (vec3) { 0.45f, 0.37f, 0.28f }),
               (vec3) { 0.4f, 1.05f, -2.2f });
    stage_environment(s, AG_ENVIRONMENT_NONE);
    stage_view(s, (ag_camera_desc) { .position = { -0.5f, 1.75f, 3.1f },
                                     .target = { 0.3f, 0.85f, -0.3f },
                                     .fov_y_rad = 0.66f });
}
