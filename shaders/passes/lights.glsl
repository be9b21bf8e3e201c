// The light that lights send to the eye by way of a surface at the place `here`.
#include "physics/ambient.glsl"
#include "physics/light_punctual.glsl"
#include "physics/surface_light.glsl"
#include "passes/frame.glsl"

// Of gpu_surface_constants
layout(constant_id = 5) const uint LIGHTS = 0u;
layout(constant_id = 8) const uint GROUPS = 0u;
layout(constant_id = 9) const uint CLUSTERED = 0u;
layout(constant_id = 10) const uint AMBIENT = 0u;

vec3 lit_by_punctual(gpu_light light, surface s, vec3 n, vec3 wo)
{
    vec3 wi = -light.direction;
    float falloff = 1.0;
    if (light.kind != GPU_LIGHT_DIRECTIONAL) {
        vec3 to_light = light.position - here.position;
        float distance2 = dot(to_light, to_light);
        falloff = light_point(distance2, light.inverse_range2);
        wi = to_light * inversesqrt(max(distance2, 1e-20));
        if (light.kind == GPU_LIGHT_SPOT)
            falloff *= light_spot(-dot(light.direction, wi),
                                  vec2(light.cone_scale, light.cone_offset));
    }
    return falloff * light.intensity * surface_direct(s, n, wo, wi);
}

vec3 lit_by_cap(gpu_light light, surface s, vec3 n, vec3 wo)
{
    if (light.kind == GPU_LIGHT_SUN) {
        light_cap sun = light_cap(-light.direction, light.radius, light.cone_scale);
        return light.intensity * surface_cap(s, n, wo, sun);
    }
    vec3 to_light = light.position - here.position;
    float distance2 = dot(to_light, to_light);
    float falloff = light_window(distance2, light.inverse_range2) /
                    max(distance2, max(light.radius * light.radius, LIGHT_MIN_DISTANCE2));
    return falloff * light.intensity *
           surface_cap(s, n, wo, light_cap_sphere(to_light, light.radius));
}

vec3 lit_by_group(int group, gpu_light light, surface s, vec3 n, vec3 wo)
{
    switch (group) {
    case GPU_LIGHTS_CAP: return lit_by_cap(light, s, n, wo);
    default: return lit_by_punctual(light, s, n, wo);
    }
}

// Where the lights of this place are listed: a record of `clusters`.
uint cluster_here()
{
    uvec2 tile = uvec2(here.pixel) / uvec2(frame.cluster_tile_x, frame.cluster_tile_y);
    float depth = dot(frame.depth.xyz, here.position) + frame.depth.w;
    float slice = log2(max(depth, 1e-30)) * frame.slice_scale + frame.slice_offset;
    uint z = uint(clamp(slice, 0.0, float(GPU_CLUSTERS - 1)));
    return ((z * GPU_CLUSTERS + tile.y) * GPU_CLUSTERS + tile.x) * GPU_CLUSTER_WORDS;
}

vec3 lit_by_groups(surface s, vec3 n, vec3 wo)
{
    vec3 sum = vec3(0.0);
    uint cluster = CLUSTERED != 0u ? cluster_here() : 0u;
#define LIT_BY_GROUP(group)                                                                      \
    if ((GROUPS >> group & 1u) != 0u) {                                                          \
        uint i = CLUSTERED != 0u ? clusters[cluster + group]                                     \
                 : group > 0     ? frame.light_ends[max(group - 1, 0)]                           \
                                 : 0u;                                                           \
        uint end = CLUSTERED != 0u ? clusters[cluster + group + 1] : frame.light_ends[group];    \
        for (; i < end; i++)                                                                     \
            sum += lit_by_group(group, lights[CLUSTERED != 0u ? clusters[i] : i], s, n, wo);     \
    }
    LIT_BY_GROUP(GPU_LIGHTS_PUNCTUAL)
    LIT_BY_GROUP(GPU_LIGHTS_CAP)
#undef LIT_BY_GROUP
    return sum;
}

vec3 lit_by_lights(surface s, vec3 n, vec3 wo)
{
    vec3 sum = vec3(0.0);
    // Written out, so that every light is at an offset known to the compiler: a CPU device
    // reads others lane by lane, at three times the cost.
#define LIT_BY(i) if (i < LIGHTS) sum += lit_by_punctual(near_lights[i], s, n, wo)
    LIT_BY(0u);
    LIT_BY(1u);
    LIT_BY(2u);
    LIT_BY(3u);
    LIT_BY(4u);
    LIT_BY(5u);
    LIT_BY(6u);
    LIT_BY(7u);
#undef LIT_BY
    return GROUPS != 0u ? sum + lit_by_groups(s, n, wo) : sum;
}

// Irradiance over pi.
vec3 ambient_here(vec3 n)
{
    return ambient_at(ambient_light(frame.ambient[0], frame.ambient[1], frame.ambient[2],
                                    frame.ambient[3], frame.ambient[4], frame.ambient[5],
                                    frame.ambient[6], frame.ambient[7], frame.ambient[8]),
                      n);
}
