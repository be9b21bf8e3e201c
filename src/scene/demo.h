// The built-in scenes; each fills an empty stage.
#ifndef AG_SCENE_DEMO_H
#define AG_SCENE_DEMO_H

#include "scene/stage.h"

void demo_spheres(stage *s);
void demo_grid(stage *s);
void demo_materials(stage *s);
void demo_furnace(stage *s);
void demo_lights(stage *s);
void demo_million(stage *s);
void demo_nodes(stage *s);
void demo_specular(stage *s);
void demo_sphere_lights(stage *s);
void demo_sun(stage *s);
void demo_sun_large(stage *s);
void demo_metals(stage *s);
void demo_terrace(stage *s);
void demo_ambient_oren_nayar(stage *s);
void demo_ambient_hemispheric(stage *s);
void demo_ambient_sh_blinn(stage *s);

#endif
