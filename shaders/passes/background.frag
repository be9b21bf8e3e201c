// The environment where nothing stands before it.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "physics/environment.glsl"
#include "physics/tonemap.glsl"
#include "passes/frame.glsl"

layout(constant_id = 0) const uint TONE = 0u;

layout(location = 0) in vec2 in_clip;
layout(location = 0) out vec4 out_color;

void main()
{
    vec3 d = frame.ray_center;
    if (frame.orthographic == 0.0)
        d += in_clip.x * frame.ray_x + in_clip.y * frame.ray_y;
    vec2 uv = environment_uv(normalize(environment_from_world(d)));
    vec3 color = textureLod(environment_image, uv, 0.0).rgb *
                 (frame.environment_intensity * frame.exposure);
    if (TONE != GPU_TONE_LINEAR)
        color = tonemap(TONE, color);
    out_color = vec4(min(color, 60000.0), 1.0);
}
