// Finds vertices that are the same point of a surface.
#ifndef AG_SCENE_WELD_H
#define AG_SCENE_WELD_H

#include "scene/scene.h"

// For each vertex, the first one with the same position, normal and uv of `uv_set`, into
// `welded` [vertex_count].  False when there is no memory.
bool weld_vertices(const scene_mesh *mesh, unsigned uv_set, uint32_t *welded);

#endif
