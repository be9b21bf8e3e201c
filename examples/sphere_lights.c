// Sphere lights: highlights as large as the lamps that make them.
//
//   ./sphere_lights [FOLDER [SIZE]]
//
// A sphere light is seen, shines and is mirrored with one and the same radiance.  The first lamp
// is six times as wide as the others, its highlights are too; on rough balls they look alike.
#include "specular_scene.h"

#include <math.h>

int main(int argc, char **argv)
{
    kit k = kit_open(argc, argv);
    ag_scene *scene = make_scene(AG_ENVIRONMENT_STUDIO, 0.2f); // something for metals to mirror
    build_specular(scene, 0.1f);
    for (int i = 0; i < LAMPS; i++)
        shine(scene, lamp(i, AG_LIGHT_SPHERE, i == 0 ? 0.075f : 0.0125f));

    check(ag_scene_set_exposure(scene, 683 / (1.2f * exp2f(8)))); // EV100 = 8, as in specular.c
    k.options.tonemap = AG_TONEMAP_ACES_NARKOWICZ;
    kit_finish(&k, scene, &specular_camera, "sphere-lights");
    kit_close(&k);
    return 0;
}
