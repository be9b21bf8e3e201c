// Direct lighting: a grid of balls, metallic upwards, rough to the right, under four point lights.
//
//   ./direct_lighting [FOLDER [SIZE]]
//
// The choices of a material make the look of the text: Schlick's shadowing, a base that gets
// what Fresnel's term of each light leaves, one bounce; then Reinhard's curve and gamma 2.2.
#include "kit.h"

#include <math.h>

static ag_material red(ag_scene *scene, float metallic, float roughness)
{
    ag_material_desc desc = paint(0.5f, 0, 0, metallic, roughness);
    desc.shadowing = AG_SHADOWING_SCHLICK;
    desc.layering = AG_LAYERING_FRESNEL;
    desc.single_bounce = true;
    return make_material(scene, desc);
}

int main(int argc, char **argv)
{
    kit k = kit_open(argc, argv);
    ag_scene *scene = make_scene(AG_ENVIRONMENT_NONE, 1);
    ag_mesh ball = make_ball(scene, 1, 48);
    for (int row = 0; row < 7; row++)
        for (int column = 0; column < 7; column++) {
            ag_material material =
                red(scene, (float)row / 7, fmaxf((float)column / 7, 0.05f)); // not a mirror
            show(scene, ball, material, 2.5f * (float)(column - 3), 2.5f * (float)(row - 3), 0);
        }
    ag_camera_desc camera = look_straight(scene, KIT_PI / 4);

    for (int i = 0; i < 4; i++)
        shine(scene, (ag_light_desc) { .kind = AG_LIGHT_POINT,
                                       .position = { i % 2 ? 10 : -10, i / 2 ? -10 : 10, 10 },
                                       .intensity = 300 });
    shine(scene, (ag_light_desc) { .kind = AG_LIGHT_AMBIENT, .intensity = 0.03f });
    k.options.tonemap = AG_TONEMAP_REINHARD;
    k.options.transfer = AG_TRANSFER_GAMMA_22;
    kit_finish(&k, scene, &camera, "grid");
    kit_close(&k);
    return 0;
}
