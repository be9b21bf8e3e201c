// The three cases of the text on ambient lighting, each on a ball, a ring and a box.
//
// The text has formulas and no numbers: shapes, colours and directions are ours.  Its lights'
// colours C reflect as C albedo: irradiance over pi.  One colour is its Cd and its Ca.
#include "scene/demo.h"

static const float pi = 3.14159265359f;

static void show(stage *s, ag_material_desc desc)
{
    ag_material material = stage_material(s, desc);
    stage_show(s, stage_sphere(s, 0.6f, 64, 40), material, (vec3) { -1.35f, 0, 0 });
    stage_show_turned(s, stage_torus(s, 0.45f, 0.2f), material, (vec3) { 0, 0, 0 }, 0.5f, 0.9f);
    stage_show_turned(s, stage_box(s, (vec3) { 0.45f, 0.45f, 0.45f }, 0.0f), material,
                      (vec3) { 1.35f, 0, 0 }, 0.6f, 0.4f);
    stage_camera(s, 0.0f, 0.5f * pi, 0.5f);
    stage_environment(s, AG_ENVIRONMENT_NONE);
}

// Without a lobe as in the text; with the default one in our look.
static ag_material_desc matte(const stage *s, vec3 color)
{
    ag_material_desc desc = ag_material_default();
    vec3_store(color, desc.base_color);
    desc.metallic = 0.0f;
    desc.roughness = 0.8f;
    desc.specular = s->look == AG_LOOK_TEXT ? 0.0f : 1.0f;
    return desc;
}

static void shine(stage *s, vec3 direction, vec3 color, float intensity)
{
    ag_light_desc desc = { .kind = AG_LIGHT_DIRECTIONAL, .intensity = intensity };
    vec3_store(direction, desc.direction);
    vec3_store(color, desc.color);
    stage_light(s, desc);
}

void demo_ambient_oren_nayar(stage *s)
{
    ag_material_desc clay = matte(s, (vec3) { 0.70f, 0.32f, 0.17f });
    clay.diffuse = s->look == AG_LOOK_TEXT ? AG_DIFFUSE_OREN_NAYAR : AG_DIFFUSE_EON;
    clay.diffuse_roughness = 0.8f;
    show(s, clay);
    shine(s, (vec3) { -0.35f, -0.4f, -0.85f }, (vec3) { 1.0f, 0.96f, 0.88f }, pi);
    stage_light(s, (ag_light_desc) { .kind = AG_LIGHT_AMBIENT,
                                     .color = { 0.08f, 0.09f, 0.12f },
                                     .intensity = 1.0f });
}

void demo_ambient_hemispheric(stage *s)
{
    show(s, matte(s, (vec3) { 0.75f, 0.73f, 0.70f }));
    shine(s, (vec3) { -0.8f, -0.35f, -0.5f }, (vec3) { 0.55f, 0.50f, 0.40f }, pi);
    stage_light(s, (ag_light_desc) { .kind = AG_LIGHT_HEMISPHERIC,
                                     .color = { 0.22f, 0.36f, 0.62f },
                                     .ground_color = { 0.24f, 0.15f, 0.07f },
                                     .intensity = 1.0f });
}

// The text's lights make highlights and no diffuse light.  Surfaces here have both, so that its
// lamps are a thousandth as strong and highlights a thousand times as bright.
static const float faint = 0.001f;

static ag_material_desc glossy(const stage *s)
{
    const float shininess = 60.0f;
    ag_material_desc desc = matte(s, (vec3) { 0.30f, 0.34f, 0.40f });
    if (s->look == AG_LOOK_ARGAND) {
        desc.roughness = powf(2.0f / (shininess + 2.0f), 0.25f); // as narrow a lobe
        return desc;
    }
    desc.distribution = AG_DISTRIBUTION_BLINN;
    desc.shininess = shininess;
    desc.specular = 1.0f;
    vec3_store((vec3) { 0.5f / faint, 0.5f / faint, 0.5f / faint }, desc.specular_color);
    return desc;
}

void demo_ambient_sh_blinn(stage *s)
{
    static const struct {
        vec3 direction, color;
    } lamps[4] = {
        { { -0.6f, -0.6f, -0.5f }, { 1.0f, 0.85f, 0.6f } },
        { { 0.7f, -0.4f, -0.6f }, { 0.5f, 0.7f, 1.0f } },
        { { 0.2f, 0.7f, -0.7f }, { 0.9f, 0.3f, 0.3f } },
        { { -0.9f, 0.1f, 0.1f }, { 0.3f, 0.9f, 0.4f } },
    };
    show(s, glossy(s));
    for (int i = 0; i < 4; i++)
        shine(s, lamps[i].direction, lamps[i].color, s->look == AG_LOOK_TEXT ? faint : 1.0f);
    stage_light(s, (ag_light_desc) { .kind = AG_LIGHT_HARMONICS,
                                     .intensity = 1.0f,
                                     .harmonics = { { 0.45f, 0.45f, 0.48f },      // 1
                                                    { 0.20f, 0.05f, -0.05f },     // x
                                                    { 0.10f, 0.20f, 0.35f },      // y
                                                    { 0.05f, 0.05f, 0.05f } } }); // z
}
