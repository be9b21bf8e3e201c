// Add a picture to the sum of those before it.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "interop/scene.glsl"

layout(set = 0, binding = 0) uniform sampler2D picture;
layout(push_constant, scalar) uniform Push { gpu_resolve push; };

layout(location = 0) out vec4 out_color;

void main()
{
    out_color = push.weight * texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
}
