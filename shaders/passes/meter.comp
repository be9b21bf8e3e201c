// The histogram of a picture's luminances.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "interop/scene.glsl"
#include "physics/color.glsl"
#include "physics/metering.glsl"

layout(local_size_x = METER_BINS) in;

layout(set = 0, binding = 0, std430) readonly buffer Pixels { vec4 pixels[]; }; // premultiplied
layout(set = 0, binding = 1, std430) buffer Bins { uint bins[]; };
layout(push_constant, scalar) uniform Push { gpu_meter push; };

shared uint here[METER_BINS]; // the group's share of them

void count(uint at)
{
    vec4 c = pixels[at];
    vec2 place = vec2(at % push.width, at / push.width) + 0.5;
    meter_pattern pattern =
        meter_pattern(push.meter, push.x, push.y, push.radius, push.shorter);
    meter_share s = meter_shares(push.scale * color_luminance(c.rgb) / max(c.a, 1e-6),
                                 c.a * meter_weight(pattern, place.x, place.y));
    if (s.here > 0u)
        atomicAdd(here[s.bin], s.here);
    if (s.next > 0u)
        atomicAdd(here[s.bin + 1u], s.next);
}

void main()
{
    uint i = gl_LocalInvocationIndex, all = gl_NumWorkGroups.x * METER_BINS;
    here[i] = 0u;
    barrier();
    for (uint at = gl_GlobalInvocationID.x; at < push.width * push.height; at += all)
        count(at);
    barrier();
    if (here[i] > 0u)
        atomicAdd(bins[i], here[i]);
}
