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

vec3 direction_at(vec2 clip)
{
    vec3 d = frame.ray_center;
    if (frame.orthographic == 0.0)
        d += clip.x * frame.ray_x + clip.y * frame.ray_y;
    return normalize(d);
}

// Suns hide what is behind them; their edges are a pixel wide.  Not by fwidth: lavapipe clips
// the pass into two triangles, and derivatives are wrong along their seam.
vec3 behind_suns(vec3 d, vec3 color)
{
    vec2 pixel = (in_clip + 1.0) / gl_FragCoord.xy;
    vec3 dx = direction_at(in_clip + vec2(pixel.x, 0.0)),
         dy = direction_at(in_clip + vec2(0.0, pixel.y));
    for (uint i = frame.light_ends[GPU_LIGHTS_PUNCTUAL]; i < frame.first_body; i++) {
        gpu_light sun = lights[i];
        float apart = length(cross(d, sun.direction)); // the sine of the angle
        float width = abs(length(cross(dx, sun.direction)) - apart) +
                      abs(length(cross(dy, sun.direction)) - apart);
        float edge = (sun.radius - apart) / max(width, 1e-7) + 0.5;
        bool towards = dot(d, sun.direction) < 0.0 && sun.radiance != vec3(0.0);
        color = mix(color, sun.radiance, towards ? clamp(edge, 0.0, 1.0) : 0.0);
    }
    return color;
}

void main()
{
    vec3 d = direction_at(in_clip);
    vec3 color = ENVIRONMENT != 0u ? environment_at(d) : vec3(0.0);
    if ((GROUPS >> GPU_LIGHTS_CAP & 1u) != 0u)
        color = behind_suns(d, color);
    color *= frame.exposure;
    if (TONE != GPU_TONE_LINEAR)
        color = display(TONE, color);
    out_color = vec4(min(color, 60000.0), 1.0);
}
