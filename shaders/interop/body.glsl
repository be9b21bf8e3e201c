// The bodies of lights: a grid of points laid around each.
#ifndef AG_INTEROP_BODY_GLSL
#define AG_INTEROP_BODY_GLSL

#include "physics/lang.glsl"
#include "interop/scene.glsl"

// What of a gpu_light it takes.
STRUCT(light_body) {
    uint kind;
    vec3 position, direction, x, y;
    real radius;
};

// A point of the unit sphere: at[0] in [0, 1] around the axis z, at[1] from pole to pole.
static inline vec3 body_sphere(vec2 at)
{
    real turn = 2.0f * PI * at[0], tilt = PI * at[1];
    return vec3(cos(turn) * sin(tilt), sin(turn) * sin(tilt), cos(tilt));
}

// Half a sphere around each end of a tube; the row across the middle is stretched between.
static inline vec3 body_tube(light_body b, vec2 at, real wider)
{
    vec3 z = b.direction;
    vec3 other = max(z[0], -z[0]) < 0.7f ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f, 1.0f, 0.0f);
    vec3 x = normalize(cross(other, z)), p = wider * b.radius * body_sphere(at);
    vec3 end = at[1] < 0.5f ? b.x : -b.x;
    return b.position + p[0] * x + p[1] * cross(z, x) + p[2] * z + end;
}

// `wider`: so much that a round outline of few corners has the area that it should.
static inline vec3 body_point(light_body b, vec2 at, real wider)
{
    real turn = 2.0f * PI * at[0];
    switch (b.kind) {
    case GPU_LIGHT_RECT:
        return b.position + (2.0f * at[0] - 1.0f) * b.x + (2.0f * at[1] - 1.0f) * b.y;
    case GPU_LIGHT_DISK:
        return b.position + wider * at[1] * (cos(turn) * b.x + sin(turn) * b.y);
    case GPU_LIGHT_TUBE: return body_tube(b, at, wider);
    }
    return b.position + wider * b.radius * body_sphere(at);
}

static inline uint body_columns(uint level)
{
    return to_uint(GPU_BODY_COLUMNS) >> level;
}

static inline uint body_rows(uint level)
{
    return to_uint(GPU_BODY_ROWS) >> level | 1u;
}

// Point number `index` of a grid; its level stands in the upper bits.
static inline vec3 body_vertex(light_body b, uint index)
{
    uint level = index >> GPU_BODY_LEVEL_SHIFT, i = index & ((1u << GPU_BODY_LEVEL_SHIFT) - 1u);
    uint columns = body_columns(level), row = i / (columns + 1u);
    real corner = 2.0f * PI / to_real(columns);
    vec2 at = vec2(to_real(i - row * (columns + 1u)) / to_real(columns),
                   to_real(row) / to_real(body_rows(level)));
    return body_point(b, at, sqrt(corner / sin(corner)));
}

// Flat lights are seen from their front; `along` goes from the eye to the light.
static inline bool body_faces(light_body b, vec3 along)
{
    bool has_front = b.kind == GPU_LIGHT_RECT || b.kind == GPU_LIGHT_DISK;
    return !has_front || dot(along, b.direction) < 0.0f;
}

#endif
