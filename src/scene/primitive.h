// Simple solids as meshes of a scene: centred on the origin, +Y up, with uvs and tangents.
#ifndef AG_SCENE_PRIMITIVE_H
#define AG_SCENE_PRIMITIVE_H

#include "scene/scene.h"

// A sphere of 2 segments (rings - 1) triangles; at least 3 segments, 2 rings.
AG_CHECK ag_status primitive_sphere(ag_scene *scene, float radius, unsigned segments,
                                    unsigned rings, ag_mesh *mesh);

// A rectangle, width along X by height along Y, facing +Z; the uvs run from 0 to `repeats`.
AG_CHECK ag_status primitive_panel(ag_scene *scene, float width, float height, float repeats,
                                   ag_mesh *mesh);

// A box of the given half extents, its edges rounded by `bevel` (0 -> sharp) in `steps`.
AG_CHECK ag_status primitive_box(ag_scene *scene, const float half[3], float bevel, unsigned steps,
                                 ag_mesh *mesh);

// A ring around the Y axis: `radius` to the middle of the tube of radius `tube`.
AG_CHECK ag_status primitive_torus(ag_scene *scene, float radius, float tube, unsigned segments,
                                   unsigned sides, ag_mesh *mesh);

#endif
