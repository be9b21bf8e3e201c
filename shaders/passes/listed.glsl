// Places to shade, listed by the host, and the colours that come of them.
#include "passes/frame.glsl"

// lavapipe reads each number of a uniform buffer anew for every eight places, lane by lane, and
// allocates for each of their groups: so eight invocations share a group and go on through the
// list, with copies of what they read.
layout(local_size_x = 8) in;
const uint PLACES = 64u; // of an invocation

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
