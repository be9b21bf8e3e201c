// Surfaces: from object to clip space.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "passes/frame.glsl"

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
    vec3 x = row_x.xyz, y = row_y.xyz, z = row_z.xyz;
    vec4 p = vec4(position, 1.0);
    out_position = vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
    gl_Position = frame.clip_from_world * vec4(out_position, 1.0);

    // Normals go by the cofactors, which are right under any scaling (made of size 1 first,
    // lest they overflow); mirrored ones would turn inside out, hence the sign of the
    // determinant.
    float size = inversesqrt(dot(x, x) + dot(y, y) + dot(z, z));
    x *= size;
    y *= size;
    z *= size;
    vec3 yz = cross(y, z);
    float flip = dot(x, yz) < 0.0 ? -1.0 : 1.0;
    out_normal = flip * normalize(vec3(dot(yz, normal), dot(cross(z, x), normal),
                                       dot(cross(x, y), normal)));
    out_tangent.xyz = vec3(dot(x, tangent.xyz), dot(y, tangent.xyz), dot(z, tangent.xyz));
    float length2 = dot(out_tangent.xyz, out_tangent.xyz);
    out_tangent.xyz *= length2 > 0.0 ? inversesqrt(length2) : 0.0;
    out_tangent.w = flip * tangent.w;
    out_uvs = uvs;
    out_color = color;
}
