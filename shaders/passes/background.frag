// The environment where nothing stands before it.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "physics/display.glsl"
#include "physics/environment.glsl"
#include "passes/frame.glsl"

// Of gpu_surface_constants
layout(constant_id = 4) const uint ENVIRONMENT = 1u;
layout(constant_id = 6) const uint TONE = 0u;
layout(constant_id = 8) const uint GROUPS = 0u;

layout(location = 0) in vec2 in_clip;
layout(location = 0) out vec4 out_color;

vec3 environment_at(vec3 d)
{
    vec2 uv = environment_uv(environment_from_world(d));
    return frame.environment_intensity * textureLod(environment_image, uv, 0.0).rgb;
}

// Suns hide what is behind them; their edges are a pixel wide.
vec3 behind_suns(vec3 d, vec3 color)
{
    for (uint i = frame.light_ends[GPU_LIGHTS_PUNCTUAL]; i < frame.first_body; i++) {
        gpu_light sun = lights[i];
        vec3 apart = cross(d, sun.direction); // as long as the sine of the angle
        float edge = (sun.radius - length(apart)) / max(fwidth(length(apart)), 1e-7) + 0.5;
        bool towards = dot(d, sun.direction) < 0.0 && sun.radiance != vec3(0.0);
        color = mix(color, sun.radiance, towards ? clamp(edge, 0.0, 1.0) : 0.0);
    }
    return color;
}

void main()
{
    vec3 d = frame.ray_center;
    if (frame.orthographic == 0.0)
        d += in_clip.x * frame.ray_x + in_clip.y * frame.ray_y;
    d = normalize(d);
    vec3 color = ENVIRONMENT != 0u ? environment_at(d) : vec3(0.0);
    if ((GROUPS >> GPU_LIGHTS_CAP & 1u) != 0u)
        color = behind_suns(d, color);
    color *= frame.exposure;
    if (TONE != GPU_TONE_LINEAR)
        color = display(TONE, color);
    out_color = vec4(min(color, 60000.0), 1.0);
}
