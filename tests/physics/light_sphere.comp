// Does the text of lights with extent compile for the GPU?
#version 460
#extension GL_GOOGLE_include_directive : require

#include "physics/light_ltc.glsl"
#include "physics/light_polygon.glsl"
#include "physics/light_representative.glsl"
#include "physics/surface_light.glsl"

layout(local_size_x = 64) in;
layout(std430, set = 0, binding = 0) readonly buffer inputs { vec4 u[]; };
layout(std430, set = 0, binding = 1) writeonly buffer outputs { vec4 y[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    light_cap cap = light_cap_sphere(u[2 * i].xyz, u[2 * i].w);
    light_cap sun = light_cap_sun(cap.axis, cap.sin_s);
    vec2 x = light_cap_ggx(cap, normalize(u[2 * i + 1].xyz), u[2 * i + 1].w, u[2 * i + 1].w);
    surface s;
    s.model = 0u;
    s.lambert = vec3(.1);
    s.bounced = vec3(.01);
    s.upwards = vec3(-.5);
    s.forwards = vec3(.5);
    s.f0 = vec3(.04);
    s.f90 = 1;
    s.a2 = .1;
    vec3 seen = surface_cap(s, vec3(0, 0, 1), normalize(u[2 * i + 1].xyz), sun);
    y[i] = vec4(x, light_cap_cosine(cap), light_cap_cosine(sun)) + vec4(seen, 0);
    vec4 m = light_ltc_matrix(u[i], .3);
    y[i].xy += light_representative_cap(cap, u[i].xyz, x[0]) +
               light_representative_tube(u[i].xyz, u[i].yzx, x[0], u[i].xyz, x[1]);
    y[i].xy += light_ltc_cap(sun, u[i].xyz, m, x) + light_ltc_uv(x[0], x[1]) +
               light_ltc_disk(u[i].xyz, u[i].yzx, u[i].zxy, u[i].xyz, m, x) +
               light_ltc_tube(u[i].xyz, u[i].yzx, x[0], u[i].xyz, m, x);
    y[i][0] += light_quad_form_factor(u[i].xyz, u[2 * i].xyz, u[i].yzx, u[2 * i].yzx);
}
