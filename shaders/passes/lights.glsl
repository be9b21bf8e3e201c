// The light that lights send to the eye by way of a surface at the place `here`.
#include "physics/ambient.glsl"
#include "physics/light_direction.glsl"
#include "physics/light_disk.glsl"
#include "physics/light_ltc.glsl"
#include "physics/light_punctual.glsl"
#include "physics/light_representative.glsl"
#include "physics/light_small.glsl"
#include "physics/light_tube.glsl"
#include "physics/surface_light.glsl"
#include "passes/frame.glsl"

// Of gpu_surface_constants
layout(constant_id = 5) const uint LIGHTS = 0u;
layout(constant_id = 8) const uint GROUPS = 0u;
layout(constant_id = 9) const uint CLUSTERED = 0u;
layout(constant_id = 10) const uint AMBIENT = 0u;
layout(constant_id = 11) const uint METHOD = GPU_METHOD_EXACT;

// A surface as lights of extent ask for it.
struct lit_surface {
    surface s;
    surface_frame f;
    light_ggx ggx;
    vec2 dfg;
    vec4 ltc; // of light_ltc_matrix(), where it is needed
};

bool uses_ltc()
{
    return METHOD == GPU_METHOD_LTC;
}

lit_surface lit_surface_from(surface s, vec3 n, vec3 wo, vec2 dfg)
{
    lit_surface lit;
    lit.s = s;
    lit.f = surface_frame_from(s, n, wo);
    lit.ggx = light_ggx_from(lit.f.v, lit.f.ax, lit.f.ay);
    lit.dfg = dfg;
    lit.ltc = vec4(0.0);
    if (uses_ltc()) {
        vec2 uv = light_ltc_uv(lit.f.v.z, sqrt(lit.f.ax));
        lit.ltc = light_ltc_matrix(textureLod(ltc_table, uv, 0.0), lit.f.ax);
    }
    return lit;
}

// ---- Without extent ------------------------------------------------------------

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

// ---- With extent -----------------------------------------------------------------

vec2 cap_lobe(light_cap cap, lit_surface lit)
{
    switch (METHOD) {
    case GPU_METHOD_LTC: return light_ltc_cap(cap, lit.f.v, lit.ltc, lit.dfg);
    case GPU_METHOD_REPRESENTATIVE: return light_representative_cap(cap, lit.f.v, lit.f.ax);
    }
    return light_cap_lobe(cap, lit.ggx);
}

// A sun, or a sphere of intensity I: the irradiance of what faces it is I / max(d, R)^2.
vec3 lit_by_cap(gpu_light light, lit_surface lit)
{
    light_cap cap = light_cap(-light.direction, light.radius, light.cone_scale);
    float falloff = 1.0;
    if (light.kind == GPU_LIGHT_SPHERE) {
        vec3 to_light = light.position - here.position;
        float distance2 = dot(to_light, to_light);
        falloff = light_window(distance2, light.inverse_range2) /
                  max(distance2, max(light.radius * light.radius, LIGHT_MIN_DISTANCE2));
        cap = light_cap_sphere(to_light, light.radius);
    }
    cap.axis = normalize(surface_frame_in(lit.f, cap.axis));
    surface_shine shine;
    shine.irradiance = light_cap_cosine(cap);
    shine.lobe = cap_lobe(cap, lit);
    shine.mean = light_cap_mean(cap);
    shine.nearest = light_cap_nearest(cap, lit.f.v, shine.mean);
    return falloff * light.intensity * surface_shone(lit.s, lit.f, shine);
}

float window_of(gpu_light light)
{
    vec3 to_light = light.position - here.position;
    return light_window(dot(to_light, to_light), light.inverse_range2);
}

// Of a light around `c`, `half_size` being half its extent.
surface_shine point_if_small(surface_shine shine, vec3 c, vec3 area, float half_size,
                             lit_surface lit)
{
    if (light_is_small(c, half_size, min(lit.f.ax, lit.f.ay))) {
        shine.irradiance = light_small_irradiance(c, area);
        shine.lobe = light_small_ggx(c, area, lit.f.v, lit.f.ax, lit.f.ay);
    }
    return shine;
}

vec3 lit_by_rect(gpu_light light, lit_surface lit)
{
    vec3 c = surface_frame_in(lit.f, light.position - here.position);
    vec3 x = surface_frame_in(lit.f, light.x), y = surface_frame_in(lit.f, light.y);
    vec3 p0 = c - x - y, p1 = c + x - y, p2 = c + x + y, p3 = c - x + y;
    surface_shine shine;
    shine.irradiance = PI * light_quad_form_factor(p0, p1, p2, p3);
    shine.lobe = uses_ltc() ? light_ltc_quad(p0, p1, p2, p3, lit.f.v, lit.ltc, lit.dfg)
                            : light_quad_ggx(p0, p1, p2, p3, lit.f.v, lit.f.ax, lit.f.ay);
    shine = point_if_small(shine, c, 4.0 * cross(x, y), sqrt(dot(x, x) + dot(y, y)), lit);
    shine.mean = light_direction_mean(c, 4.0 * cross(x, y));
    shine.nearest = light_direction_flat(c, x, y, lit.f.v, false);
    return window_of(light) * light.intensity * surface_shone(lit.s, lit.f, shine);
}

vec3 lit_by_disk(gpu_light light, lit_surface lit)
{
    vec3 c = surface_frame_in(lit.f, light.position - here.position);
    vec3 x = surface_frame_in(lit.f, light.x), y = surface_frame_in(lit.f, light.y);
    surface_shine shine;
    shine.irradiance = PI * light_disk_form_factor(c, x, y);
    shine.lobe = uses_ltc() ? light_ltc_disk(c, x, y, lit.f.v, lit.ltc, lit.dfg)
                            : light_disk_ggx(c, x, y, lit.f.v, lit.f.ax, lit.f.ay);
    shine = point_if_small(shine, c, PI * cross(x, y), length(x), lit);
    shine.mean = light_direction_mean(c, PI * cross(x, y));
    shine.nearest = light_direction_flat(c, x, y, lit.f.v, true);
    return window_of(light) * light.intensity * surface_shone(lit.s, lit.f, shine);
}

vec2 tube_lobe(vec3 c, vec3 axis, float radius, lit_surface lit)
{
    switch (METHOD) {
    case GPU_METHOD_LTC: return light_ltc_tube(c, axis, radius, lit.f.v, lit.ltc, lit.dfg);
    case GPU_METHOD_REPRESENTATIVE:
        return light_representative_tube(c, axis, radius, lit.f.v, lit.f.ax);
    }
    return light_tube_ggx(c, axis, radius, lit.f.v, lit.f.ax, lit.f.ay);
}

vec3 lit_by_tube(gpu_light light, lit_surface lit)
{
    vec3 c = surface_frame_in(lit.f, light.position - here.position);
    vec3 axis = surface_frame_in(lit.f, light.x);
    surface_shine shine;
    shine.irradiance = PI * light_tube_form_factor(c, axis, light.radius);
    shine.lobe = tube_lobe(c, axis, light.radius, lit);
    vec3 area = light_direction_tube_area(c, axis, light.radius);
    shine = point_if_small(shine, c, area, length(axis) + light.radius, lit);
    shine.mean = light_direction_mean(c, area);
    shine.nearest = light_direction_tube(c, axis, light.radius, lit.f.v);
    return window_of(light) * light.intensity * surface_shone(lit.s, lit.f, shine);
}

// ---- Which of them -----------------------------------------------------------------

// Where the lights of this place are listed: a record of `clusters`.
uint cluster_here()
{
    uvec2 tile = uvec2(here.pixel) / uvec2(frame.cluster_tile_x, frame.cluster_tile_y);
    float depth = dot(frame.depth.xyz, here.position) + frame.depth.w;
    float slice = log2(max(depth, 1e-30)) * frame.slice_scale + frame.slice_offset;
    uint z = uint(clamp(slice, 0.0, float(GPU_CLUSTERS - 1)));
    return ((z * GPU_CLUSTERS + tile.y) * GPU_CLUSTERS + tile.x) * GPU_CLUSTER_WORDS;
}

vec3 lit_by_groups(surface s, vec3 n, vec3 wo, vec2 dfg)
{
    vec3 sum = vec3(0.0);
    uint cluster = CLUSTERED != 0u ? cluster_here() : 0u;
    lit_surface lit = lit_surface_from(s, n, wo, dfg);
#define LIGHT_AT(i) lights[CLUSTERED != 0u ? clusters[i] : i]
#define LIT_BY_GROUP(group, call)                                                                \
    if ((GROUPS >> group & 1u) != 0u) {                                                          \
        uint i = CLUSTERED != 0u ? clusters[cluster + group]                                     \
                 : group > 0     ? frame.light_ends[max(group - 1, 0)]                           \
                                 : 0u;                                                           \
        uint end = CLUSTERED != 0u ? clusters[cluster + group + 1] : frame.light_ends[group];    \
        for (; i < end; i++)                                                                     \
            sum += call;                                                                         \
    }
    LIT_BY_GROUP(GPU_LIGHTS_PUNCTUAL, lit_by_punctual(LIGHT_AT(i), s, n, wo))
    LIT_BY_GROUP(GPU_LIGHTS_CAP, lit_by_cap(LIGHT_AT(i), lit))
    LIT_BY_GROUP(GPU_LIGHTS_RECT, lit_by_rect(LIGHT_AT(i), lit))
    LIT_BY_GROUP(GPU_LIGHTS_DISK, lit_by_disk(LIGHT_AT(i), lit))
    LIT_BY_GROUP(GPU_LIGHTS_TUBE, lit_by_tube(LIGHT_AT(i), lit))
#undef LIT_BY_GROUP
#undef LIGHT_AT
    return sum;
}

vec3 lit_by_lights(surface s, vec3 n, vec3 wo, vec2 dfg)
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
    return GROUPS != 0u ? sum + lit_by_groups(s, n, wo, dfg) : sum;
}

// Irradiance over pi.
vec3 ambient_here(vec3 n)
{
    return ambient_at(ambient_light(frame.ambient[0], frame.ambient[1], frame.ambient[2],
                                    frame.ambient[3], frame.ambient[4], frame.ambient[5],
                                    frame.ambient[6], frame.ambient[7], frame.ambient[8]),
                      n);
}
