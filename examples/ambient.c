// Ambient light, three ways: the same from everywhere, of sky and ground, and as spherical
// harmonics of the normal.
//
//   ./ambient [FOLDER [SIZE]]
//
// The text's colours C reflect as C albedo, they are irradiance over pi.  So are the three kinds
// of ambient light; a directional light is given in lux: pi times as much.
#include "kit.h"

static ag_material_desc matte(float red, float green, float blue)
{
    ag_material_desc desc = paint(red, green, blue, 0, 0.8f);
    desc.specular = 0;
    return desc;
}

static void take_picture(kit *k, ag_scene *scene, ag_material_desc desc, const char *name)
{
    ag_material material = make_material(scene, desc);
    show(scene, make_ball(scene, 0.6f, 64), material, -1.35f, 0, 0);
    show_turned(scene, make_ring(scene, 0.45f, 0.2f), material, (float[3]) { 0 }, 0.5f, 0.9f);
    show_turned(scene, make_box(scene, 0.45f), material, (float[3]) { 1.35f, 0, 0 }, 0.6f, 0.4f);
    ag_camera_desc camera = look_straight(scene, 0.5f);
    kit_finish(k, scene, &camera, name);
}

static void clay_in_fog(kit *k)
{
    ag_scene *scene = make_scene(AG_ENVIRONMENT_NONE, 1);
    ag_material_desc clay = matte(0.70f, 0.32f, 0.17f);
    clay.diffuse = AG_DIFFUSE_OREN_NAYAR; // rough: flat, and bright towards its edges
    clay.diffuse_roughness = 0.8f;
    shine(scene, (ag_light_desc) { .kind = AG_LIGHT_DIRECTIONAL,
                                   .direction = { -0.35f, -0.4f, -0.85f },
                                   .color = { 1, 0.96f, 0.88f },
                                   .intensity = KIT_PI });
    shine(scene, (ag_light_desc) {
                     .kind = AG_LIGHT_AMBIENT, .color = { 0.08f, 0.09f, 0.12f }, .intensity = 1 });
    take_picture(k, scene, clay, "ambient-oren-nayar");
}

static void plaster_outdoors(kit *k)
{
    ag_scene *scene = make_scene(AG_ENVIRONMENT_NONE, 1);
    shine(scene, (ag_light_desc) { .kind = AG_LIGHT_DIRECTIONAL,
                                   .direction = { -0.8f, -0.35f, -0.5f },
                                   .color = { 0.55f, 0.50f, 0.40f },
                                   .intensity = KIT_PI });
    // `direction` is the hemisphere's own axis; up is the default.
    shine(scene, (ag_light_desc) { .kind = AG_LIGHT_HEMISPHERIC,
                                   .color = { 0.22f, 0.36f, 0.62f },
                                   .ground_color = { 0.24f, 0.15f, 0.07f },
                                   .intensity = 1 });
    take_picture(k, scene, matte(0.75f, 0.73f, 0.70f), "ambient-hemispheric");
}

// In the text the four lamps make highlights and no diffuse light.  Here a lamp makes both; so
// they shine with a thousandth of their light on highlights a thousand times as bright.
static void enamel_among_lamps(kit *k)
{
    static const float lamps[4][2][3] = {
        { { -0.6f, -0.6f, -0.5f }, { 1, 0.85f, 0.6f } },
        { { 0.7f, -0.4f, -0.6f }, { 0.5f, 0.7f, 1 } },
        { { 0.2f, 0.7f, -0.7f }, { 0.9f, 0.3f, 0.3f } },
        { { -0.9f, 0.1f, 0.1f }, { 0.3f, 0.9f, 0.4f } },
    };
    ag_scene *scene = make_scene(AG_ENVIRONMENT_NONE, 1);
    for (int i = 0; i < 4; i++)
        shine(scene,
              (ag_light_desc) { .kind = AG_LIGHT_DIRECTIONAL,
                                .direction = { lamps[i][0][0], lamps[i][0][1], lamps[i][0][2] },
                                .color = { lamps[i][1][0], lamps[i][1][1], lamps[i][1][2] },
                                .intensity = 0.001f });
    shine(scene, (ag_light_desc) { .kind = AG_LIGHT_HARMONICS,
                                   .intensity = 1,
                                   .harmonics = { { 0.45f, 0.45f, 0.48f },      // the mean
                                                  { 0.20f, 0.05f, -0.05f },     // times x
                                                  { 0.10f, 0.20f, 0.35f },      // times y
                                                  { 0.05f, 0.05f, 0.05f } } }); // times z
    ag_material_desc enamel = matte(0.30f, 0.34f, 0.40f);
    enamel.distribution = AG_DISTRIBUTION_BLINN;
    enamel.shininess = 60;
    enamel.specular = 1;
    for (int i = 0; i < 3; i++)
        enamel.specular_color[i] = 500;
    take_picture(k, scene, enamel, "ambient-sh-blinn");
}

int main(int argc, char **argv)
{
    kit k = kit_open(argc, argv);
    k.options.tonemap = AG_TONEMAP_NONE;
    clay_in_fog(&k);
    plaster_outdoors(&k);
    enamel_among_lamps(&k);
    kit_close(&k);
    return 0;
}
