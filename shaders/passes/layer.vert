// An image in its place in a window.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "interop/scene.glsl"

layout(push_constant, scalar) uniform Push { gpu_layer push; };

layout(location = 0) out vec2 out_uv;

void main()
{
    uint corner = uint(gl_VertexIndex) < 3u ? uint(gl_VertexIndex) : 6u - uint(gl_VertexIndex);
    out_uv = vec2(corner & 1u, corner >> 1);
    gl_Position = vec4(mix(push.place.xy, push.place.zw, out_uv), 0.0, 1.0);
}
