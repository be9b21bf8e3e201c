// The sun as a sphere at no distance that a float could hold: only its angular radius counts.
//
//   ./sun [FOLDER [SIZE]]
//
// Two pictures: the real sun's ratio of radius to distance, .00465, and one of .1 with the same
// illuminance.  The disk in the sky, the path on the floor and the edges of highlights widen.
#include "kit.h"

#include <math.h>

static ag_material glossy(ag_scene *scene, ag_material_desc desc)
{
    desc.shadowing = AG_SHADOWING_SCHLICK;
    desc.layering = AG_LAYERING_GLTF;
    desc.single_bounce = true;
    return make_material(scene, desc);
}

static void build(ag_scene *scene)
{
    ag_mesh ball = make_ball(scene, 0.45f, 96), floor = make_panel(scene, 4000, 4000);
    for (int i = 0; i < 5; i++) {
        float roughness = 0.05f + 0.15f * (float)i, x = (float)(i - 2);
        show(scene, ball, glossy(scene, paint(0.95f, 0.64f, 0.54f, 1, roughness)), x, 1.45f, 0);
        show(scene, ball, glossy(scene, paint(0.02f, 0.05f, 0.12f, 0, roughness)), x, 0.45f, 0);
    }
    show_turned(scene, floor, glossy(scene, paint(0.05f, 0.05f, 0.05f, 0, 0.25f)), (float[3]) { 0 },
                0, -KIT_PI / 2);
}

static void take_picture(kit *k, float ratio, const char *name)
{
    ag_scene *scene = make_scene(AG_ENVIRONMENT_SKY, 0.35f); // the sky has no sun of its own
    const ag_camera_desc camera = { .position = { 0, 1.7f, 6.4f },
                                    .target = { 0, 1.2f, 0 },
                                    .fov_y_rad = 0.8f };
    build(scene);
    shine(scene, (ag_light_desc) { .kind = AG_LIGHT_SUN,
                                   .direction = { 0.16f, -0.2f, 0.97f }, // the way light travels
                                   .color = { 1, 0.93f, 0.82f },
                                   .intensity = 1.5f, // lux on what faces it
                                   .angular_radius_rad = asinf(ratio) });
    kit_finish(k, scene, &camera, name);
}

int main(int argc, char **argv)
{
    kit k = kit_open(argc, argv);
    k.options.tonemap = AG_TONEMAP_ACES_NARKOWICZ;
    take_picture(&k, 0.00465f, "sun");
    take_picture(&k, 0.1f, "sun-large");
    kit_close(&k);
    return 0;
}
