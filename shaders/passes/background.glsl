// The environment where nothing stands before it.
#include "physics/display.glsl"
#include "physics/environment.glsl"
#include "passes/frame.glsl"

// Of gpu_surface_constants
layout(constant_id = 4) const uint ENVIRONMENT = 1u;
layout(constant_id = 6) const uint TONE = 0u;
layout(constant_id = 8) const uint GROUPS = 0u;

vec3 direction_at(vec2 clip)
{
    vec3 d = frame.ray_center;
    if (frame.orthographic == 0.0)
        d += clip.x * frame.ray_x + clip.y * frame.ray_y;
    return normalize(d);
}

vec3 environment_at(vec3 d)
{
    vec2 uv = environment_uv(environment_from_world(d));
    return frame.environment_intensity * textureLod(environment_image, uv, 0.0).rgb;
}

// Suns hide what is behind them; their edges are a pixel wide.
vec3 behind_suns(vec2 clip, vec3 color)
{
    vec3 d = direction_at(clip), dx = direction_at(clip + vec2(frame.pixel.x, 0.0)),
         dy = direction_at(clip + vec2(0.0, frame.pixel.y));
    for (uint i = frame.light_ends[GPU_LIGHTS_PUNCTUAL]; i < frame.first_body; i++) {
        gpu_light sun = lights[i];
        float share = environment_sun_share(d, dx, dy, sun.direction, sun.radius);
        color = mix(color, sun.radiance, sun.radiance != vec3(0.0) ? share : 0.0);
    }
    return color;
}

vec4 background_at(vec2 clip)
{
    vec3 color = ENVIRONMENT != 0u ? environment_at(direction_at(clip)) : vec3(0.0);
    if ((GROUPS >> GPU_LIGHTS_CAP & 1u) != 0u)
        color = behind_suns(clip, color);
    color = exposed(frame.seen * color);
    if (TONE != GPU_TONE_LINEAR)
        color = display(TONE, color);
    return vec4(min(color, 60000.0), 1.0);
}
