// The bodies of lights: a grid laid around each, an instance a light.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "interop/body.glsl"
#include "passes/frame.glsl"

layout(location = 0) flat out vec3 out_radiance;

void main()
{
    gpu_light l = lights[gl_InstanceIndex];
    light_body body = light_body(l.kind, l.position, l.direction, l.x, l.y, l.radius);
    vec3 view = frame.orthographic != 0.0 ? frame.ray_center : l.position - frame.eye;
    bool seen = body_faces(body, view) && l.radiance != vec3(0.0);
    vec3 p = body_vertex(body, uint(gl_VertexIndex));
    out_radiance = frame.seen * l.radiance;
    gl_Position = seen ? frame.clip_from_world * vec4(p, 1.0) : vec4(0.0, 0.0, -1.0, 1.0);
}
