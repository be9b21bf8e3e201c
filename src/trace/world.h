// What rays meet: the triangles of a scene, in Embree.
#ifndef AG_TRACE_WORLD_H
#define AG_TRACE_WORLD_H

#include <embree3/rtcore.h>

#include "physics/lang.glsl"
#include "scene/scene.h"
#include "trace/texture.h"

// One instance of the scene on its way to world space.
typedef struct world_instance {
    vec3 x, y, z, at; // columns of its matrix
    vec3 nx, ny, nz;  // columns of its cofactors, which normals go by
    float flip;       // -1: mirrored
    uint32_t model;   // of its material: physics/surface.glsl
    const scene_mesh *mesh;
    const ag_material_desc *material;
    const texture_set *textures;
    bool moved; // its triangles are in object space: a mesh that is shown more than once
    bool holes; // that rays may go through
} world_instance;

typedef struct world {
    RTCDevice device;
    RTCScene top;
    RTCScene *meshes; // of those that are shown more than once
    size_t mesh_count;
    world_instance *instances;
    size_t instance_count;
    texture_set *textures; // by material
    size_t texture_count;
    float decode[256];           // of sRGB
    const ag_progress *progress; // while it is made
    ag_log log;
} world;

typedef struct ray {
    vec3 origin, direction; // unit
    float near, far;        // m
    bool from_eye;          // does not see the backs of what has but one side
    uint32_t dice;          // decides what is partly there
} ray;

typedef struct hit {
    const world_instance *instance;
    uint32_t triangle;
    float distance;
    float u, v;  // barycentric, of the second and third corner
    vec3 normal; // geometric, world space, to the side of the front; not unit
} hit;

// `scene` is borrowed; `progress`: stage "prepare".
AG_CHECK ag_status world_create(const ag_scene *scene, const ag_progress *progress, world *w);
void world_destroy(world *w); // zero is allowed

// The world of a scene whose materials alone have changed since `from` was made: shares the trees
// with it where they still hold.
AG_CHECK ag_status world_renew(const ag_scene *scene, const world *from,
                               const ag_progress *progress, world *w);

// As world_destroy, but what it shares with `kept` (NULL: nothing) stays.
void world_leave(world *w, const world *kept);

// The first thing on a ray, if any.  Any number of threads may ask.
bool world_closest(const world *w, const ray *r, hit *h);

// Rays from the eye that go much the same way, by lanes.
enum { WORLD_PACKET = 8 };
typedef struct ray_packet {
    float origin[3][WORLD_PACKET], direction[3][WORLD_PACKET];
    float near[WORLD_PACKET], far[WORLD_PACKET];
    uint32_t dice[WORLD_PACKET];
} ray_packet;

ray world_ray(const ray_packet *rays, unsigned lane);

// The same for the first `count` of a packet: bit i of the answer tells of lane i.
unsigned world_closest_packet(const world *w, const ray_packet *rays, unsigned count, hit *h);

// Whether something is on it.
bool world_blocked(const world *w, const ray *r);

static inline vec3 world_point(const world_instance *i, const float p[3])
{
    return p[0] * i->x + p[1] * i->y + p[2] * i->z + i->at;
}

static inline vec3 world_normal(const world_instance *i, const float n[3])
{
    vec3 v = n[0] * i->nx + n[1] * i->ny + n[2] * i->nz;
    return v * (i->flip / sqrtf(max(dot(v, v), 1e-30f)));
}

static inline vec3 world_direction(const world_instance *i, const float d[3])
{
    vec3 v = d[0] * i->x + d[1] * i->y + d[2] * i->z;
    float length2 = dot(v, v);
    return length2 > 0 ? v / sqrtf(length2) : v;
}

// Both sets of its coordinates at a hit.
void world_uv(const world_instance *i, uint32_t triangle, float u, float v, vec2 uv[2]);

// The share of a surface that is there at a hit: its alpha, cut off or not.
float world_opacity(const world_instance *i, uint32_t triangle, float u, float v);

#endif
