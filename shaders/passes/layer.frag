// An image in a window, straight alpha, coded as it is shown.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "interop/scene.glsl"

layout(set = 0, binding = 0) uniform sampler2D image;
layout(push_constant, scalar) uniform Push { gpu_layer push; };

layout(location = 0) in vec2 in_uv;
layout(location = 0) out vec4 out_color;

void main()
{
    vec4 c = textureLod(image, in_uv, 0.0);
    float alpha = mix(1.0, c.a, push.opacity);
    out_color = vec4(c.rgb * alpha, alpha);
}
