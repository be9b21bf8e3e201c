// Surfaces, opaque or blended.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "passes/fragment.glsl"
