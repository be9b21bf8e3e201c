// What every pass over the scene can read: set 0.
#ifndef AG_PASSES_FRAME_GLSL
#define AG_PASSES_FRAME_GLSL

#include "interop/scene.glsl"
#include "physics/white_balance.glsl"

layout(scalar, set = 0, binding = 0) uniform Frame { gpu_frame frame; };
layout(set = 0, binding = 1) uniform samplerCube environment_cube; // prefiltered
layout(set = 0, binding = 2) uniform sampler2D environment_image;  // equirectangular
layout(set = 0, binding = 3) uniform sampler2D dfg_table;
// Uniform, not storage: a CPU device reads storage lane by lane.
layout(scalar, set = 0, binding = 4) uniform Near { gpu_light near_lights[GPU_LIGHTS_NEAR]; };
layout(set = 0, binding = 5) uniform samplerCube irradiance_cube; // over pi
layout(scalar, set = 0, binding = 6) readonly buffer Lights { gpu_light lights[]; };
layout(scalar, set = 0, binding = 7) readonly buffer Clusters { uint clusters[]; };
layout(set = 0, binding = 8) uniform sampler2D ltc_table;

// Light as the picture has it: exposed, its white balanced.
vec3 exposed(vec3 light)
{
    return white_balanced(light, frame.red, frame.green, frame.blue);
}

// A direction of the world in the environment's own frame.
vec3 environment_from_world(vec3 d)
{
    return vec3(frame.environment_cos * d.x - frame.environment_sin * d.z, d.y,
                frame.environment_sin * d.x + frame.environment_cos * d.z);
}

#endif
