// What stands in the scenes of the texts on specular lighting and on sphere lights.
#ifndef SPECULAR_SCENE_H
#define SPECULAR_SCENE_H

#include "kit.h"

// 13 textured shapes, and 30 spheres from roughness 1 on the right to the least on the left.
void build_specular(ag_scene *scene, float least_roughness);

// Lamp `index` of the seven, with its position and its radiant intensity in W/sr.
enum { LAMPS = 7 };
ag_light_desc lamp(int index, ag_light_kind kind, float radius);

extern const ag_camera_desc specular_camera;

#endif
