// Metals by name, in rows from the upper left, in the order in which they are printed.
//
//   ./metals [FOLDER [SIZE]]
//
// ag_material_metal() alone gives the best that Argand knows of a metal.  Here its colour is kept
// and the rest is set to what the text on specular lighting does: Schlick's curve, one bounce.
#include "kit.h"

#include <stdio.h>

static ag_material as_in_the_text(ag_scene *scene, ag_material_desc metal)
{
    metal.fresnel = AG_FRESNEL_SCHLICK;
    metal.layering = AG_LAYERING_BLEND;
    metal.reflectiveness = 1;
    metal.single_bounce = true;
    return make_material(scene, metal);
}

int main(int argc, char **argv)
{
    kit k = kit_open(argc, argv);
    ag_scene *scene = make_scene(AG_ENVIRONMENT_STUDIO, 1);
    ag_mesh ball = make_ball(scene, 0.45f, 96);
    const char *name, *source;
    size_t count = 0;
    for (; ag_metal_info(count, &name, &source); count++)
        printf("%s, measured by %s\n", name, source);
    for (size_t i = 0; i < count; i++) {
        ag_material_desc metal = ag_material_metal((ag_metal)i, 0.25f);
        size_t row = i / 5, in_row = count - 5 * row < 5 ? count - 5 * row : 5;
        float x = (float)(i % 5) - 0.5f * (float)(in_row - 1);
        show(scene, ball, as_in_the_text(scene, metal), x, -(float)row, 0);
    }
    ag_camera_desc camera = look_straight(scene, 0.45f);
    k.options.tonemap = AG_TONEMAP_ACES_NARKOWICZ;
    kit_finish(&k, scene, &camera, "metals");
    kit_close(&k);
    return 0;
}
