// Built-in still lifes: one of materials, one of lights.
#include "scene/demo.h"

static const float pi = 3.14159265359f;

// ---- Textures --------------------------------------------------------------

static uint8_t to_byte(float value)
{
    return (uint8_t)(fminf(fmaxf(value, 0.0f), 1.0f) * 255.0f + 0.5f);
}

// A leaf-green lattice with round holes.
static void paint_lattice(float u, float v, uint8_t out[4])
{
    float x = 6.0f * u - floorf(6.0f * u) - 0.5f, y = 6.0f * v - floorf(6.0f * v) - 0.5f;
    float rim = (hypotf(x, y) - 0.34f) * 12.0f;
    out[0] = to_byte(0.35f);
    out[1] = to_byte(0.62f);
    out[2] = to_byte(0.30f);
    out[3] = to_byte(0.5f + rim);
}

// Round studs: the normals of spherical caps, 16 across.
static void paint_studs(float u, float v, uint8_t out[4])
{
    float x = 2.0f * (16.0f * u - floorf(16.0f * u)) - 1.0f;
    float y = 1.0f - 2.0f * (8.0f * v - floorf(8.0f * v));
    float square = x * x + y * y, slope = square < 0.64f ? 0.7f : 0.0f;
    vec3 n = vec3_unit((vec3) { slope * x, slope * y, 1.0f });
    out[0] = to_byte(0.5f + 0.5f * n.x);
    out[1] = to_byte(0.5f + 0.5f * n.y);
    out[2] = to_byte(0.5f + 0.5f * n.z);
    out[3] = 255;
}

static void paint_tiles(float u, float v, uint8_t out[4])
{
    bool odd = ((int)(2.0f * u) + (int)(2.0f * v)) & 1;
    out[0] = out[1] = out[2] = to_byte(odd ? 0.62f : 0.52f);
    out[3] = 255;
}

// ---- Materials -------------------------------------------------------------

static void show_metals(stage *s, ag_mesh ball)
{
    // Lagarde 2011, "Feeding a physically based shading model": linear reflectance.
    static const vec3 metals[] = {
        { 0.972f, 0.960f, 0.915f }, // silver
        { 1.000f, 0.782f, 0.344f }, // gold
        { 0.955f, 0.638f, 0.538f }, // copper
        { 0.560f, 0.570f, 0.580f }, // iron
        { 0.542f, 0.497f, 0.449f }, // titanium
    };
    for (int i = 0; i < 5; i++)
        stage_show(s, ball, stage_paint(s, metals[i], 1.0f, 0.12f + 0.06f * (float)i),
                   (vec3) { (float)i - 2.0f, 0.42f, -1.1f });
}

static void show_dielectrics(stage *s, ag_mesh ball)
{
    static const struct {
        vec3 color;
        float roughness, ior;
    } dielectrics[] = {
        { { 0.012f, 0.012f, 0.014f }, 0.05f, 1.5f }, // lacquer
        { { 0.55f, 0.035f, 0.025f }, 0.25f, 1.5f },  // plastic
        { { 0.03f, 0.10f, 0.38f }, 0.08f, 2.0f },    // glaze
        { { 0.80f, 0.78f, 0.72f }, 0.75f, 1.4f },    // plaster
    };
    for (int i = 0; i < 4; i++) {
        ag_material_desc desc = ag_material_default();
        vec3_store(dielectrics[i].color, desc.base_color);
        desc.metallic = 0.0f;
        desc.roughness = dielectrics[i].roughness;
        desc.ior = dielectrics[i].ior;
        stage_show(s, ball, stage_material(s, desc), (vec3) { (float)i - 1.5f, 0.42f, 0.0f });
    }
}

static void show_normal_map(stage *s, ag_mesh ball)
{
    ag_material_desc desc = ag_material_default();
    vec3_store((vec3) { 0.85f, 0.6f, 0.3f }, desc.base_color);
    desc.roughness = 0.3f;
    desc.normal_texture.texture = stage_texture(s, 512, paint_studs);
    stage_show(s, ball, stage_material(s, desc), (vec3) { -1.0f, 0.42f, 1.1f });
}

static void show_emission(stage *s, ag_mesh ball)
{
    ag_material_desc desc = ag_material_default();
    vec3_store((vec3) { 0.02f, 0.02f, 0.02f }, desc.base_color);
    desc.metallic = 0.0f;
    desc.roughness = 0.4f;
    vec3_store((vec3) { 1.6f, 0.55f, 0.12f }, desc.emissive);
    stage_show(s, ball, stage_material(s, desc), (vec3) { 0.0f, 0.42f, 1.1f });
}

static void show_panels(stage *s)
{
    ag_mesh panel = stage_panel(s, 0.8f, 0.8f, 1.0f);
    ag_material_desc lattice = ag_material_default();
    lattice.metallic = 0.0f;
    lattice.roughness = 0.6f;
    lattice.double_sided = true;
    lattice.alpha_mode = AG_ALPHA_MASK;
    lattice.base_color_texture.texture = stage_texture(s, 256, paint_lattice);
    stage_show_turned(s, panel, stage_material(s, lattice), (vec3) { 1.0f, 0.42f, 1.1f }, 0.3f, 0);

    ag_material_desc pane = ag_material_default();
    vec3_store((vec3) { 0.25f, 0.55f, 0.80f }, pane.base_color);
    pane.base_color[3] = 0.35f;
    pane.metallic = 0.0f;
    pane.roughness = 0.05f;
    pane.double_sided = true;
    pane.alpha_mode = AG_ALPHA_BLEND;
    ag_material glass = stage_material(s, pane);
    for (int i = 0; i < 3; i++)
        stage_show_turned(s, panel, glass,
                          (vec3) { 1.9f + 0.12f * (float)i, 0.42f, 1.2f - 0.25f * (float)i }, 0.3f,
                          0);
}

void demo_materials(stage *s)
{
    ag_mesh ball = stage_sphere(s, 0.42f, 64, 40);
    show_metals(s, ball);
    show_dielectrics(s, ball);
    show_normal_map(s, ball);
    show_emission(s, ball);
    show_panels(s);
    stage_camera(s, 0.25f, 1.15f, 0.45f);
    ag_material_desc floor = ag_material_default();
    floor.metallic = 0.0f;
    floor.roughness = 0.55f;
    floor.base_color_texture.texture = stage_texture(s, 64, paint_tiles);
    stage_show_turned(s, stage_panel(s, 9.0f, 9.0f, 9.0f), stage_material(s, floor),
                      (vec3) { 0, 0, 0 }, 0, -0.5f * pi);
    stage_environment(s, AG_ENVIRONMENT_STUDIO);
}

// ---- Lights ----------------------------------------------------------------

void demo_lights(stage *s)
{
    stage_show(s, stage_box(s, (vec3) { 0.5f, 0.5f, 0.5f }, 0.08f),
               stage_paint(s, (vec3) { 0.50f, 0.06f, 0.04f }, 0.0f, 0.35f),
               (vec3) { -1.4f, 0.5f, -0.3f });
    stage_show(s, stage_sphere(s, 0.6f, 64, 40),
               stage_paint(s, (vec3) { 1.0f, 0.782f, 0.344f }, 1.0f, 0.25f),
               (vec3) { 0.1f, 0.6f, 0.2f });
    stage_show(s, stage_torus(s, 0.5f, 0.2f),
               stage_paint(s, (vec3) { 0.03f, 0.20f, 0.40f }, 0.0f, 0.15f),
               (vec3) { 1.6f, 0.2f, 0.4f });
    stage_camera(s, 0.3f, 1.05f, 0.6f);
    stage_show_turned(s, stage_panel(s, 12.0f, 12.0f, 1.0f),
                      stage_paint(s, (vec3) { 0.6f, 0.6f, 0.6f }, 0.0f, 0.5f), (vec3) { 0, 0, 0 },
                      0, -0.5f * pi);
    stage_light(s, (ag_light_desc) { .kind = AG_LIGHT_POINT,
                                     .position = { -2.4f, 1.6f, 1.4f },
                                     .color = { 1.0f, 0.62f, 0.35f },
                                     .intensity = 6.0f });
    stage_light(s, (ag_light_desc) { .kind = AG_LIGHT_SPOT,
                                     .position = { 2.6f, 4.0f, 2.2f },
                                     .direction = { -0.42f, -0.82f, -0.39f },
                                     .color = { 0.55f, 0.75f, 1.0f },
                                     .intensity = 60.0f,
                                     .cone_inner_rad = 0.28f,
                                     .cone_outer_rad = 0.36f });
    stage_light(s, (ag_light_desc) { .kind = AG_LIGHT_DIRECTIONAL,
                                     .direction = { 0.35f, -0.75f, -0.55f },
                                     .intensity = 0.7f });
    stage_environment(s, AG_ENVIRONMENT_NONE);
}
