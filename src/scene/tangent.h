// Tangent frames for normal maps.
#ifndef AG_SCENE_TANGENT_H
#define AG_SCENE_TANGENT_H

#include "scene/scene.h"

// Compute the tangents of a mesh from its positions, unit normals and one uv set, as
// MikkTSpace does.  Vertices at which tangents disagree are split: `vertices` may move and
// grow.  False when there is no memory; then only tangents may have changed.
//
// The handedness follows glTF: v runs downwards in the image, and the bitangent
// w cross(normal, tangent) runs upwards.
bool tangents_compute(scene_mesh *mesh, unsigned uv_set);

// Give every vertex some tangent perpendicular to its normal.
void tangents_any(scene_mesh *mesh);

#endif
