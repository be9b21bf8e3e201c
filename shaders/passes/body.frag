// The bodies of lights: they are as bright as they light the scene.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "physics/display.glsl"
#include "passes/frame.glsl"

layout(constant_id = 6) const uint TONE = 0u;

layout(location = 0) flat in vec3 in_radiance;
layout(location = 0) out vec4 out_color;

void main()
{
    vec3 color = min(exposed(in_radiance), 60000.0);
    if (TONE != GPU_TONE_LINEAR)
        color = display(TONE, color);
    out_color = vec4(color, 1.0);
}
