// Does the text of lights with an outline compile for the GPU?
#version 460
#extension GL_GOOGLE_include_directive : require

#include "physics/light_disk.glsl"
#include "physics/light_polygon.glsl"
#include "physics/light_tube.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer inputs { vec4 u[]; };
layout(std430, set = 0, binding = 1) writeonly buffer outputs { vec2 y[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    vec3 o = u[4 * i].xyz;
    vec3 a = u[4 * i + 1].xyz;
    vec3 b = u[4 * i + 2].xyz;
    vec3 v = normalize(u[4 * i + 3].xyz);
    float r = u[4 * i].w;
    y[i] = light_quad_ggx(o - a - b, o + a - b, o + a + b, o - a + b, v, r, r);
    y[i] += light_disk_ggx(o, a, b, v, r, r) + light_tube_ggx(o, a, b.x, v, r, r);
    y[i] += vec2(light_disk_form_factor(o, a, b), light_tube_form_factor(o, a, b.x));
}
