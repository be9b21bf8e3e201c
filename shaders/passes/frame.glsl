// What every pass over the scene can read: set 0.
#ifndef AG_PASSES_FRAME_GLSL
#define AG_PASSES_FRAME_GLSL

#include "interop/scene.glsl"

layout(scalar, set = 0, binding = 0) uniform Frame { gpu_frame frame; };
layout(set = 0, binding = 1) uniform samplerCube environment_cube; // prefiltered
layout(set = 0, binding = 2) uniform sampler2D environment_image;  // equirectangular
layout(set = 0, binding = 3) uniform sampler2D dfg_table;
layout(scalar, set = 0, binding = 4) readonly buffer Lights { gpu_light lights[]; };
layout(scalar, set = 0, binding = 5) readonly buffer Instances { gpu_instance instances[]; };
layout(set = 0, binding = 6) uniform samplerCube irradiance_cube; // over pi

// A direction of the world in the environment's own frame.
vec3 environment_from_world(vec3 d)
{
    return vec3(frame.environment_cos * d.x - frame.environment_sin * d.z, d.y,
                frame.environment_sin * d.x + frame.environment_cos * d.z);
}

#endif
