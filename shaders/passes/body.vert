// The bodies of lights: a grid laid around each, an instance a light.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "physics/lang.glsl"
#include "passes/frame.glsl"

layout(location = 0) flat out vec3 out_radiance;

// A point of the unit sphere: x in [0, 1] around the axis z, y from pole to pole.
vec3 sphere_point(vec2 at)
{
    float turn = 2.0 * PI * at.x, tilt = PI * at.y;
    return vec3(cos(turn) * sin(tilt), sin(turn) * sin(tilt), cos(tilt));
}

// Any two unit vectors square to z and each other.
mat3 frame_around(vec3 z)
{
    vec3 other = abs(z.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    vec3 x = normalize(cross(other, z));
    return mat3(x, cross(z, x), z);
}

// `wider`: so much that a round outline of few corners has the area that it should.
vec3 point_of(gpu_light light, vec2 at, float wider)
{
    switch (light.kind) {
    case GPU_LIGHT_RECT:
        return light.position + (2.0 * at.x - 1.0) * light.x + (2.0 * at.y - 1.0) * light.y;
    case GPU_LIGHT_DISK: {
        float turn = 2.0 * PI * at.x;
        return light.position + wider * at.y * (cos(turn) * light.x + sin(turn) * light.y);
    }
    case GPU_LIGHT_TUBE: {
        // Half a sphere around each end; the row across the middle is stretched between.
        vec3 p = wider * light.radius * sphere_point(at);
        return light.position + frame_around(light.direction) * p +
               (at.y < 0.5 ? light.x : -light.x);
    }
    }
    return light.position + wider * light.radius * sphere_point(at);
}

// Flat lights are seen from their front, and nothing of hidden ones.
bool is_seen(gpu_light light)
{
    bool flat_one = light.kind == GPU_LIGHT_RECT || light.kind == GPU_LIGHT_DISK;
    vec3 view = frame.orthographic != 0.0 ? frame.ray_center : light.position - frame.eye;
    bool front = !flat_one || dot(view, light.direction) < 0.0;
    return front && light.radiance != vec3(0.0);
}

void main()
{
    gpu_light light = lights[gl_InstanceIndex];
    int level = gl_VertexIndex >> GPU_BODY_LEVEL_SHIFT;
    int columns = GPU_BODY_COLUMNS >> level, rows = GPU_BODY_ROWS >> level | 1;
    int i = gl_VertexIndex & ((1 << GPU_BODY_LEVEL_SHIFT) - 1);
    vec2 cell = vec2(i % (columns + 1), i / (columns + 1));
    float corner = 2.0 * PI / float(columns);
    vec3 p = point_of(light, cell / vec2(columns, rows), sqrt(corner / sin(corner)));
    out_radiance = light.radiance;
    gl_Position = is_seen(light) ? frame.clip_from_world * vec4(p, 1.0) : vec4(0.0, 0.0, -1.0, 1.0);
}
