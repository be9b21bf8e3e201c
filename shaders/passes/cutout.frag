// Surfaces with holes: as surface.frag, but fragments below the cutoff cover nothing.  A
// shader of its own, because one that may write its coverage is tested for depth late.
#version 460
#extension GL_GOOGLE_include_directive : require
#define CUTOUT
#include "passes/fragment.glsl"
