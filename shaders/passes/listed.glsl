// Places to shade, listed by the host, and the colours that come of them.
#include "passes/frame.glsl"

layout(local_size_x = 64) in;

// A gpu_listed each.
layout(set = 2, binding = 0) uniform usamplerBuffer listed;
layout(scalar, set = 2, binding = 4) writeonly buffer Colors { uvec2 colors[]; };
layout(push_constant, scalar) uniform Push { gpu_list push; };

// Where the pixel is in clip space.
vec2 clip_of(uint pixel)
{
    return (vec2(pixel & 0xffffu, pixel >> 16) + 0.5) * frame.pixel - 1.0;
}

void store(uint i, vec4 color)
{
    colors[i] = uvec2(packHalf2x16(color.rg), packHalf2x16(color.ba));
}
