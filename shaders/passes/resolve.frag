// From exposed radiance, premultiplied, to the picture that leaves: tone-mapped, over
// the background.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "physics/display.glsl"
#include "interop/scene.glsl"

layout(constant_id = 6) const uint TONE = 0u;

layout(set = 0, binding = 0) uniform sampler2D picture;
layout(push_constant, scalar) uniform Push { gpu_resolve push; };

layout(location = 0) out vec4 out_color;

void main()
{
    vec4 c = texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
    if (TONE != GPU_TONE_LINEAR && c.a > 0.0)
        c.rgb = c.a * display(TONE, c.rgb / c.a);
    out_color = c + (1.0 - c.a) * push.background;
}
