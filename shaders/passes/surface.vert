// Surfaces: from object to clip space.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "passes/frame.glsl"
#include "passes/vertex.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec4 uvs;
layout(location = 4) in vec4 color;
layout(location = 5) in vec4 row_x; // of gpu_instance
layout(location = 6) in vec4 row_y;
layout(location = 7) in vec4 row_z;

layout(location = 0) out vec3 out_position; // world space
layout(location = 1) out vec3 out_normal;   // not normalised
layout(location = 2) out vec4 out_tangent;  // not normalised; w = handedness
layout(location = 3) out vec4 out_uvs;
layout(location = 4) out vec4 out_color;

void main()
{
    vec4 rows[3] = vec4[](row_x, row_y, row_z);
    out_position = world_position(rows, position);
    gl_Position = frame.clip_from_world * vec4(out_position, 1.0);
    world_frame f = world_frame_of(rows);
    out_normal = world_normal(f, normal);
    out_tangent = world_tangent(f, tangent);
    out_uvs = uvs;
    out_color = color;
}
