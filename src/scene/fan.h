// The triangles around one vertex, and the tangent frames they agree on.
#ifndef AG_SCENE_FAN_H
#define AG_SCENE_FAN_H

#include "scene/vector.h"

#include <stdint.h>

// What a triangle says about its tangent.
typedef enum facing {
    FACING_ANY = 0, // nothing: its uvs span no area
    FACING_SAME,    // the uvs run as the corners do
    FACING_MIRRORED,
    FACING_POINT, // nothing, and it has no edges: two of its corners coincide
} facing;

// One triangle as seen from the vertex.
typedef struct fan_corner {
    uint32_t next, previous; // the other corners' vertices
    facing facing;
    vec3 tangent; // unit, of the triangle
    float angle;  // rad, at this corner, in the plane of the vertex normal
} fan_corner;

typedef struct fan_frame {
    vec3 tangent;     // unit, perpendicular to the normal
    float handedness; // +1 or -1
} fan_frame;

// Find the frame of each of the `count` corners around a vertex with this unit normal.  False
// when there is no memory.
bool fan_solve(vec3 normal, const fan_corner *corners, size_t count, fan_frame *frames);

#endif
