// The table of cases on the GPU: y[id * count + i] = physics_case(id, u[i]).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "cases.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer inputs { vec4 u[]; };
layout(std430, set = 0, binding = 1) writeonly buffer outputs { float y[]; };
layout(push_constant) uniform parameters { uint count; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < count * CASE_COUNT)
        y[i] = physics_case(i / count, u[i % count]);
}
