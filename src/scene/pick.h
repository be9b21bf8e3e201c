// What of a light a ray meets.
#ifndef AG_SCENE_PICK_H
#define AG_SCENE_PICK_H

#include "scene/scene.h"

// m to the light's body along the unit `direction`, INFINITY to a sun's; negative where the ray
// misses it, or it is not seen.
float pick_body(const ag_light_desc *l, const float origin[3], const float direction[3]);

#endif
