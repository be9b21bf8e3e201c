// Specular lighting: materials from rough to smooth under point lights.
//
//   ./specular [FOLDER [SIZE]]
//
// A point light has no size, so that the text draws a small glowing ball where it is.  The ball
// must be as bright as the light: radiance = intensity / (pi radius^2).
#include "specular_scene.h"

#include <math.h>

static void hang_bulb(ag_scene *scene, ag_mesh ball, ag_light_desc light, float radius)
{
    ag_material_desc glow = paint(0, 0, 0, 0, 1);
    for (int i = 0; i < 3; i++)
        glow.emissive[i] = light.color[i] * light.intensity / (KIT_PI * radius * radius);
    shine(scene, light);
    show(scene, ball, make_material(scene, glow), light.position[0], light.position[1],
         light.position[2]);
}

int main(int argc, char **argv)
{
    kit k = kit_open(argc, argv);
    ag_scene *scene = make_scene(AG_ENVIRONMENT_NONE, 1); // metals show nothing but highlights
    build_specular(scene, 0.01f);
    const float radius = 0.0125f;
    ag_mesh ball = make_ball(scene, radius, 32);
    for (int i = 0; i < LAMPS; i++)
        hang_bulb(scene, ball, lamp(i, AG_LIGHT_POINT, 0), radius);

    // A camera at EV100 = 8 saturates at 1.2 * 2^8 cd/m^2; our watts are 683 lumens each.
    check(ag_scene_set_exposure(scene, 683 / (1.2f * exp2f(8))));
    k.options.tonemap = AG_TONEMAP_ACES_NARKOWICZ;
    kit_finish(&k, scene, &specular_camera, "specular");
    kit_close(&k);
    return 0;
}
