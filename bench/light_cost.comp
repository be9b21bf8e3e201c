// Evaluates one method LIGHTS times an invocation, each time for another light (light_cost.c).
#version 460
#extension GL_GOOGLE_include_directive : require

#include "physics/light_disk.glsl"
#include "physics/light_ltc.glsl"
#include "physics/light_polygon.glsl"
#include "physics/light_representative.glsl"
#include "physics/light_sphere.glsl"
#include "physics/light_tube.glsl"

layout(constant_id = 0) const uint METHOD = 0;
layout(constant_id = 1) const uint LIGHTS = 16;

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) writeonly buffer outputs { vec2 y[]; };
layout(set = 0, binding = 1) uniform sampler2D ltc_table;
layout(set = 0, binding = 2) uniform sampler2D dfg_table;

vec2 point(vec3 l, vec3 v, float alpha)
{
    vec3 h = v + l;
    float a2 = alpha * alpha;
    float NoL = max(l.z, 0.0);
    float lobe = microfacet_d_half(dot(h.xy, h.xy), h.z, a2) * microfacet_v(v.z, NoL, a2) * NoL;
    return vec2(lobe, lobe * pow5(1.0 - 0.5 * sqrt(dot(h, h))));
}

vec4 fetch_ltc(float NoV, float roughness)
{
    vec4 texel = textureLod(ltc_table, light_ltc_uv(NoV, roughness), 0.0);
    return light_ltc_matrix(texel, roughness * roughness);
}

void main()
{
    uint id = gl_GlobalInvocationID.x;
    vec3 u = fract(vec3(id) * vec3(0.7548777, 0.5698403, 0.6180340));
    float roughness = 0.1 + 0.9 * u.x;
    float alpha = roughness * roughness;
    vec3 v = normalize(vec3(u.y, u.z - 0.5, 0.1 + u.z));
    vec4 m = fetch_ltc(v.z, roughness);
    vec2 dfg = textureLod(dfg_table, vec2(v.z, roughness), 0.0).xy;
    light_ggx ggx = light_ggx_from(v, alpha, alpha);
    vec2 sum = vec2(0.0);
    for (uint i = 0; i < LIGHTS; i++) {
        u = fract(u + vec3(0.8191725, 0.6710436, 0.5497005));
        light_cap cap;
        cap.axis = normalize(vec3(u.xy - 0.5, u.z));
        cap.sin_s = 0.05 + 0.5 * u.y;
        cap.cos_s = sqrt(1.0 - cap.sin_s * cap.sin_s);
        vec3 side = 0.3 * vec3(u.z, -0.1, u.x);
        vec3 up = 0.2 * vec3(0.1, u.z, u.y);
        vec3 at = 2.0 * cap.axis;
        if (METHOD == 0)
            sum += at.xy + cap.cos_s * side.xy + up.xy;
        else if (METHOD == 1)
            sum += point(cap.axis, v, alpha);
        else if (METHOD == 2)
            sum += light_representative_cap(cap, v, alpha);
        else if (METHOD == 3)
            sum += light_ltc_cap(cap, v, m, dfg);
        else if (METHOD == 4)
            sum += light_ltc_cap(cap, v, fetch_ltc(v.z, u.x), dfg);
        else if (METHOD == 5)
            sum += light_ltc_cap(cap, v, fetch_ltc(v.z, u.x), textureLod(dfg_table, u.xy, 0.0).xy);
        else if (METHOD == 6)
            sum += light_cap_lobe(cap, ggx);
        else if (METHOD == 7)
            sum += light_representative_tube(at, side, cap.sin_s, v, alpha);
        else if (METHOD == 8)
            sum += light_ltc_disk(at, side, up, v, m, dfg);
        else if (METHOD == 9)
            sum += light_ltc_quad(at - side - up, at + side - up, at + side + up, at - side + up, v,
                                  m, dfg);
        else if (METHOD == 10)
            sum += light_ltc_tube(at, side, cap.sin_s, v, m, dfg);
        else if (METHOD == 11)
            sum += light_disk_ggx(at, side, up, v, alpha, alpha);
        else if (METHOD == 12)
            sum += light_quad_ggx(at - side - up, at + side - up, at + side + up, at - side + up, v,
                                  alpha, alpha);
        else if (METHOD == 13)
            sum += light_tube_ggx(at, side, cap.sin_s, v, alpha, alpha);
    }
    y[id] = sum;
}
