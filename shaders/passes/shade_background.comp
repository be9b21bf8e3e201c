// The environment where nothing stands before it, from a list.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/background.glsl"
#include "passes/listed.glsl"

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count)
        return;
    i += push.first;
    store(i, background_at(clip_of(texelFetch(listed, int(i)).x)));
}
