// The environment where nothing stands before it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/background.glsl"

layout(location = 0) in vec2 in_clip;
layout(location = 0) out vec4 out_color;

void main()
{
    out_color = background_at(in_clip);
}
