// Surfaces, shaded from a list: the triangle is fetched, and the place in it found.
//
// Burns, Hunt 2013, "The Visibility Buffer"; Schied, Dachsbacher 2015, "Deferred Attribute
// Interpolation for Memory-Efficient Deferred Shading".
#version 460
#extension GL_GOOGLE_include_directive : require
#define LISTED
#include "passes/surface.glsl"
#include "passes/vertex.glsl"
#include "passes/listed.glsl"

layout(set = 2, binding = 1) uniform samplerBuffer vertices;  // four texels a scene_vertex
layout(set = 2, binding = 2) uniform samplerBuffer instances; // three a gpu_instance
layout(set = 2, binding = 3) uniform usamplerBuffer indices;

struct corner {
    vec3 position, normal;
    vec4 tangent, uvs, color;
    vec3 clip; // x, y, w
};

corner corner_of(int index, vec4 rows[3], world_frame f)
{
    vec4 a = texelFetch(vertices, index), b = texelFetch(vertices, index + 1);
    vec4 c = texelFetch(vertices, index + 2), d = texelFetch(vertices, index + 3);
    corner v;
    v.position = world_position(rows, a.xyz);
    v.normal = world_normal(f, vec3(a.w, b.xy));
    v.tangent = world_tangent(f, vec4(b.zw, c.xy));
    v.uvs = vec4(c.zw, d.xy);
    v.color = vec4(unpackUnorm2x16(floatBitsToUint(d.z)), unpackUnorm2x16(floatBitsToUint(d.w)));
    v.clip = (frame.clip_from_world * vec4(v.position, 1.0)).xyw;
    return v;
}

// A triangle's barycentric coordinates at a pixel, and their changes to the next ones.
struct barycentrics {
    vec3 at, dx, dy;
    bool front; // counter-clockwise
};

// At the pixel (x, y) coordinate i is to the others as the determinant of (x, y, 1) and the
// other two corners: Olano, Greer 1997, "Triangle Scan Conversion using 2D Homogeneous
// Coordinates", equation 5 and what precedes it.
barycentrics barycentrics_at(vec2 clip, vec3 a, vec3 b, vec3 c)
{
    vec3 u = cross(b, c), v = cross(c, a), w = cross(a, b);
    vec3 at = vec3(dot(u.xy, clip) + u.z, dot(v.xy, clip) + v.z, dot(w.xy, clip) + w.z);
    vec3 x = frame.pixel.x * vec3(u.x, v.x, w.x), y = frame.pixel.y * vec3(u.y, v.y, w.y);
    float sum = at.x + at.y + at.z;
    float sum_x = sum + x.x + x.y + x.z, sum_y = sum + y.x + y.y + y.z;
    barycentrics r;
    r.at = at / sum;
    r.dx = (at + x) / sum_x - r.at;
    r.dy = (at + y) / sum_y - r.at;
    r.front = dot(a, u) < 0.0; // y points down
    return r;
}

#define BETWEEN(b, field) (b.x * p.field + b.y * q.field + b.z * r.field)

place place_listed(uvec4 entry)
{
    vec4 rows[3];
    int row = int(entry.y) * 3;
    rows[0] = texelFetch(instances, row);
    rows[1] = texelFetch(instances, row + 1);
    rows[2] = texelFetch(instances, row + 2);
    world_frame f = world_frame_of(rows);
    int first = int(entry.z);
    uvec3 index = uvec3(texelFetch(indices, first).r, texelFetch(indices, first + 1).r,
                        texelFetch(indices, first + 2).r);
    index = 4u * (index + entry.w);
    corner p = corner_of(int(index.x), rows, f), q = corner_of(int(index.y), rows, f),
           r = corner_of(int(index.z), rows, f);
    barycentrics b = barycentrics_at(clip_of(entry.x), p.clip, q.clip, r.clip);
    place seen;
    seen.position = BETWEEN(b.at, position);
    seen.normal = BETWEEN(b.at, normal);
    seen.tangent = BETWEEN(b.at, tangent);
    seen.uvs = BETWEEN(b.at, uvs);
    seen.color = BETWEEN(b.at, color);
    seen.front = b.front == (f.flip > 0.0);
    seen.pixel = vec2(entry.x & 0xffffu, entry.x >> 16) + 0.5;
    seen.normal_dx = BETWEEN(b.dx, normal);
    seen.normal_dy = BETWEEN(b.dy, normal);
    seen.uvs_dx = BETWEEN(b.dx, uvs);
    seen.uvs_dy = BETWEEN(b.dy, uvs);
    return seen;
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count)
        return;
    i += push.first;
    here = place_listed(texelFetch(listed, int(i)));
    store(i, color_here(base_here()));
}
