// What rays meet: the triangles of a scene, in Embree.
//
// A mesh that is shown once has its triangles in world space; others are instanced.
#include "trace/world.h"

#include "base/log.h"
#include "image/srgb.h"
#include "trace/sampler.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

// ---- Instances -----------------------------------------------------------------

// Cofactors of a matrix made of size 1, lest they overflow.
static void set_frame(const float w[16], world_instance *i)
{
    i->x = vec3(w[0], w[1], w[2]);
    i->y = vec3(w[4], w[5], w[6]);
    i->z = vec3(w[8], w[9], w[10]);
    i->at = vec3(w[12], w[13], w[14]);
    float size2 = dot(i->x, i->x) + dot(i->y, i->y) + dot(i->z, i->z);
    float scale = size2 > 0 && isfinite(size2) ? 1 / sqrtf(size2) : 1;
    vec3 x = i->x * scale, y = i->y * scale, z = i->z * scale;
    i->nx = cross(y, z);
    i->ny = cross(z, x);
    i->nz = cross(x, y);
    i->flip = dot(x, i->nx) < 0 ? -1 : 1;
}

static bool has_holes(const ag_material_desc *m)
{
    return m->alpha_mode != AG_ALPHA_OPAQUE;
}

// Of all that is woven: the pictures of a scene are kept twice so far.
static const size_t WOVEN_MAX = (size_t)256 << 20;

static ag_status make_textures(const ag_scene *scene, size_t limit, world *w)
{
    w->texture_count = 0;
    w->textures = calloc(scene->materials_count + 1, sizeof *w->textures);
    if (!w->textures)
        return log_fail(&w->log, AG_ERROR_MEMORY, "no memory for %zu materials",
                        scene->materials_count);
    w->texture_count = scene->materials_count;
    for (size_t i = 0; i < scene->materials_count; i++) {
        ag_status status = texture_set_init(scene, &scene->materials[i], &w->textures[i]);
        if (status)
            return status;
        limit -= texture_set_weave(&w->textures[i], limit);
    }
    return AG_OK;
}

static ag_status make_instances(const ag_scene *scene, world *w)
{
    uint32_t *shown = calloc(scene->meshes_count + 1, sizeof *shown);
    w->instances = aligned_alloc(_Alignof(world_instance),
                                 (scene->instances_count + 1) * sizeof *w->instances);
    if (!shown || !w->instances) {
        free(shown);
        return log_fail(&w->log, AG_ERROR_MEMORY, "no memory for %zu instances",
                        scene->instances_count);
    }
    for (size_t i = 0; i < scene->instances_count; i++)
        shown[scene->instances[i].mesh]++;
    for (size_t i = 0; i < scene->instances_count; i++) {
        const scene_instance *from = &scene->instances[i];
        world_instance *to = &w->instances[i];
        *to = (world_instance) {
            .mesh = &scene->meshes[from->mesh],
            .material = &scene->materials[from->material],
            .textures = &w->textures[from->material],
            .model = material_model(&scene->materials[from->material]),
            .moved = shown[from->mesh] > 1,
            .holes = has_holes(&scene->materials[from->material]),
        };
        set_frame(from->world, to);
    }
    w->instance_count = scene->instances_count;
    free(shown);
    return AG_OK;
}

// ---- What is not wholly there ----------------------------------------------------

typedef struct query {
    struct RTCIntersectContext context; // first: the filters are handed this
    const world *world;
    const ray *ray; // NULL -> of the packet, by the id that Embree carries
    const ray_packet *packet;
} query;

ray world_ray(const ray_packet *p, unsigned lane)
{
    return (ray) {
        .origin = vec3(p->origin[0][lane], p->origin[1][lane], p->origin[2][lane]),
        .direction = vec3(p->direction[0][lane], p->direction[1][lane], p->direction[2][lane]),
        .near = p->near[lane],
        .far = p->far[lane],
        .from_eye = true,
        .dice = p->dice[lane],
    };
}

void world_uv(const world_instance *i, uint32_t triangle, float u, float v, vec2 uv[2])
{
    const uint32_t *at = i->mesh->indices + 3 * (size_t)triangle;
    const scene_vertex *vertices = i->mesh->vertices;
    for (int set = 0; set < 2; set++) {
        const float *a = vertices[at[0]].uv[set], *b = vertices[at[1]].uv[set],
                    *c = vertices[at[2]].uv[set];
        uv[set] = (1 - u - v) * vec2(a[0], a[1]) + u * vec2(b[0], b[1]) + v * vec2(c[0], c[1]);
    }
}

float world_opacity(const world_instance *i, uint32_t triangle, float u, float v)
{
    const ag_material_desc *m = i->material;
    if (m->alpha_mode == AG_ALPHA_OPAQUE)
        return 1;
    const uint32_t *at = i->mesh->indices + 3 * (size_t)triangle;
    const scene_vertex *vertices = i->mesh->vertices;
    vec2 uv[2];
    world_uv(i, triangle, u, v, uv);
    float color = ((1 - u - v) * (float)vertices[at[0]].color[3] +
                   u * (float)vertices[at[1]].color[3] + v * (float)vertices[at[2]].color[3]) /
                  65535;
    const texture_use *map = &i->textures->base_color;
    texture_place place = texture_find(map, uv);
    float alpha = m->base_color[3] * color * texture_read(map, &place)[3];
    if (m->alpha_mode == AG_ALPHA_MASK)
        return alpha >= m->alpha_cutoff ? 1 : 0;
    return alpha;
}

// Which instance a hit belongs to.
static uint32_t instance_of(uint32_t instance, uint32_t geometry)
{
    return instance != RTC_INVALID_GEOMETRY_ID ? instance : geometry;
}

// From what Embree calls the normal, an edge's cross product in the space of the triangle.
static vec3 normal_of(const world_instance *i, vec3 along)
{
    const float v[3] = { along[0], along[1], along[2] };
    return i->moved ? world_normal(i, v) : along * i->flip;
}

// Whether the eye sees the back of what has but one side.
static bool is_hidden(const world_instance *i, vec3 normal, vec3 direction)
{
    return !i->material->double_sided && dot(normal, direction) > 0;
}

// A candidate, as a filter is given it.
typedef struct candidate {
    uint32_t instance, triangle;
    float u, v;
    vec3 normal;
} candidate;

// Decided by dice that are the same whenever the same ray meets the same triangle.
static bool is_there(const world *w, const ray *r, const candidate *c)
{
    const world_instance *i = &w->instances[c->instance];
    if (r->from_eye && is_hidden(i, normal_of(i, c->normal), r->direction))
        return false;
    float opacity = world_opacity(i, c->triangle, c->u, c->v);
    if (opacity <= 0 || opacity >= 1)
        return opacity >= 1;
    uint32_t roll = sampler_mix(sampler_mix(r->dice, c->instance), c->triangle);
    return (float)(roll >> 8) * 0x1p-24f < opacity;
}

// Item `row` of ray or hit i of n, which stand side by side: the order is that of RTCRay and
// RTCHit.  (Embree's own accessors are C++.)
static float lane_float(const void *lanes, unsigned row, unsigned n, unsigned i)
{
    return ((const float *)lanes)[row * n + i];
}

static uint32_t lane_uint(const void *lanes, unsigned row, unsigned n, unsigned i)
{
    return ((const uint32_t *)lanes)[row * n + i];
}

static void filter(const struct RTCFilterFunctionNArguments *args)
{
    enum { RAY_ID = 10, NORMAL_X = 0, NORMAL_Y, NORMAL_Z, U, V, TRIANGLE, GEOMETRY, INSTANCE };
    const query *q = (const query *)(const void *)args->context;
    const void *h = args->hit;
    unsigned n = args->N;
    for (unsigned i = 0; i < n; i++) {
        if (!args->valid[i])
            continue;
        const candidate c = {
            .instance = instance_of(lane_uint(h, INSTANCE, n, i), lane_uint(h, GEOMETRY, n, i)),
            .triangle = lane_uint(h, TRIANGLE, n, i),
            .u = lane_float(h, U, n, i),
            .v = lane_float(h, V, n, i),
            .normal = vec3(lane_float(h, NORMAL_X, n, i), lane_float(h, NORMAL_Y, n, i),
                           lane_float(h, NORMAL_Z, n, i)),
        };
        const ray r = q->ray ? *q->ray : world_ray(q->packet, lane_uint(args->ray, RAY_ID, n, i));
        if (!is_there(q->world, &r, &c))
            args->valid[i] = 0;
    }
}

// ---- Triangles -------------------------------------------------------------------

static ag_status no_memory(const world *w)
{
    return log_fail(&w->log, AG_ERROR_MEMORY, "no memory for the tree of triangles");
}

// The corners of a mesh, in world space where `i` is not NULL.
static bool set_vertices(RTCGeometry g, const scene_mesh *mesh, const world_instance *i)
{
    if (!i) {
        rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh->vertices,
                                   offsetof(scene_vertex, position), sizeof(scene_vertex),
                                   mesh->vertex_count);
        return true;
    }
    float *to = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                        3 * sizeof(float), mesh->vertex_count);
    for (uint32_t k = 0; to && k < mesh->vertex_count; k++, to += 3) {
        vec3 p = world_point(i, mesh->vertices[k].position);
        to[0] = p[0];
        to[1] = p[1];
        to[2] = p[2];
    }
    return to != NULL;
}

static RTCGeometry new_triangles(const world *w, const scene_mesh *mesh, const world_instance *i)
{
    RTCGeometry g = rtcNewGeometry(w->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    if (!g)
        return NULL;
    if (!set_vertices(g, mesh, i)) {
        rtcReleaseGeometry(g);
        return NULL;
    }
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh->indices, 0,
                               3 * sizeof(uint32_t), mesh->index_count / 3);
    return g;
}

// A filter costs a call at every hit: only where a material needs it.
static void set_filter(RTCGeometry g, bool holes)
{
    if (holes) {
        rtcSetGeometryIntersectFilterFunction(g, filter);
        rtcSetGeometryOccludedFilterFunction(g, filter);
    }
}

static RTCScene new_scene(const world *w)
{
    RTCScene s = rtcNewScene(w->device);
    if (s)
        rtcSetSceneFlags(s, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    return s;
}

// A tree that grows, on many threads; the caller's alone may say how far it is.
typedef struct growth {
    const ag_progress *progress;
    pthread_t caller;
    atomic_bool stopped;
} growth;

static bool goes_on(void *user, double fraction)
{
    growth *g = user;
    const ag_progress *p = g->progress;
    if (!g->stopped && p && p->update && pthread_equal(pthread_self(), g->caller) &&
        !p->update(p->user, "prepare", fmin(fmax(fraction, 0), 1)))
        g->stopped = true;
    return !g->stopped;
}

static ag_status commit(const world *w, RTCScene s)
{
    growth g = { .progress = w->progress, .caller = pthread_self() };
    if (goes_on(&g, 0)) {
        rtcSetSceneProgressMonitorFunction(s, goes_on, &g);
        rtcCommitScene(s);
        rtcSetSceneProgressMonitorFunction(s, NULL, NULL);
    }
    bool failed = rtcGetDeviceError(w->device) != RTC_ERROR_NONE;
    if (g.stopped)
        return log_fail(&w->log, AG_ERROR_CANCELLED, "preparing the reference was stopped");
    return failed ? no_memory(w) : AG_OK;
}

// The tree of a mesh that is shown more than once; `holes`: of any that shows it.
static ag_status make_mesh(const ag_scene *scene, world *w, size_t mesh, bool holes)
{
    RTCGeometry g = new_triangles(w, &scene->meshes[mesh], NULL);
    RTCScene s = g ? new_scene(w) : NULL;
    if (!s) {
        if (g)
            rtcReleaseGeometry(g);
        return no_memory(w);
    }
    set_filter(g, holes);
    rtcCommitGeometry(g);
    rtcAttachGeometry(s, g);
    rtcReleaseGeometry(g);
    w->meshes[mesh] = s;
    return commit(w, s);
}

static ag_status make_meshes(const ag_scene *scene, world *w)
{
    w->mesh_count = scene->meshes_count;
    w->meshes = calloc(scene->meshes_count + 1, sizeof(RTCScene));
    enum { SHOWN = 1, HOLES = 2 };
    uint8_t *needs = calloc(scene->meshes_count + 1, 1);
    ag_status status = w->meshes && needs ? AG_OK : no_memory(w);
    for (size_t i = 0; i < w->instance_count && !status; i++)
        if (w->instances[i].moved)
            needs[scene->instances[i].mesh] |= w->instances[i].holes ? SHOWN | HOLES : SHOWN;
    for (size_t i = 0; i < scene->meshes_count && !status; i++)
        if (needs[i])
            status = make_mesh(scene, w, i, needs[i] & HOLES);
    free(needs);
    return status;
}

static RTCGeometry new_instance(const world *w, const world_instance *i, RTCScene mesh)
{
    RTCGeometry g = rtcNewGeometry(w->device, RTC_GEOMETRY_TYPE_INSTANCE);
    if (!g)
        return NULL;
    const float columns[12] = { i->x[0], i->x[1], i->x[2], i->y[0],  i->y[1],  i->y[2],
                                i->z[0], i->z[1], i->z[2], i->at[0], i->at[1], i->at[2] };
    rtcSetGeometryInstancedScene(g, mesh);
    rtcSetGeometryTransform(g, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
    return g;
}

static ag_status attach_all(const ag_scene *scene, world *w)
{
    w->top = new_scene(w);
    if (!w->top)
        return no_memory(w);
    for (size_t i = 0; i < w->instance_count; i++) {
        const world_instance *instance = &w->instances[i];
        RTCGeometry g = instance->moved
                            ? new_instance(w, instance, w->meshes[scene->instances[i].mesh])
                            : new_triangles(w, instance->mesh, instance);
        if (!g)
            return no_memory(w);
        if (!instance->moved)
            set_filter(g, instance->holes);
        rtcCommitGeometry(g);
        rtcAttachGeometryByID(w->top, g, (unsigned)i);
        rtcReleaseGeometry(g);
    }
    return commit(w, w->top);
}

ag_status world_create(const ag_scene *scene, const ag_progress *progress, world *w)
{
    *w = (world) { .log = scene->log, .progress = progress };
    srgb_decoder_init(w->decode);
    w->device = rtcNewDevice(NULL);
    if (!w->device)
        return log_fail(&w->log, AG_ERROR_UNSUPPORTED,
                        "Embree does not run on this processor (error %d)",
                        (int)rtcGetDeviceError(NULL));
    ag_status status = make_textures(scene, WOVEN_MAX, w);
    if (!status)
        status = make_instances(scene, w);
    if (!status)
        status = make_meshes(scene, w);
    if (!status)
        status = attach_all(scene, w);
    w->progress = NULL;
    if (status)
        world_destroy(w);
    return status;
}

static bool filters_hold(const ag_scene *scene, const world *w)
{
    for (size_t i = 0; i < w->instance_count; i++)
        if (has_holes(&scene->materials[scene->instances[i].material]) && !w->instances[i].holes)
            return false;
    return true;
}

ag_status world_renew(const ag_scene *scene, const world *from, const ag_progress *progress,
                      world *w)
{
    if (!filters_hold(scene, from))
        return world_create(scene, progress, w);
    *w = *from;
    ag_status status = make_textures(scene, 0, w); // weaving takes longer than a hand at work waits
    if (!status)
        status = make_instances(scene, w);
    if (status)
        world_leave(w, from);
    else
        for (size_t i = 0; i < w->instance_count; i++)
            w->instances[i].holes = from->instances[i].holes;
    return status;
}

static void release_trees(world *w)
{
    for (size_t i = 0; i < w->mesh_count && w->meshes; i++)
        if (w->meshes[i])
            rtcReleaseScene(w->meshes[i]);
    if (w->top)
        rtcReleaseScene(w->top);
    if (w->device)
        rtcReleaseDevice(w->device);
    free(w->meshes);
}

static void release_textures(world *w)
{
    for (size_t i = 0; i < w->texture_count; i++)
        texture_set_finish(&w->textures[i]);
    free(w->textures);
}

void world_leave(world *w, const world *kept)
{
    if (!kept || w->device != kept->device)
        release_trees(w);
    if (!kept || w->instances != kept->instances)
        free(w->instances);
    if (!kept || w->textures != kept->textures)
        release_textures(w);
    *w = (world) { 0 };
}

void world_destroy(world *w)
{
    world_leave(w, NULL);
}

// ---- Rays ------------------------------------------------------------------------

static struct RTCRay ray_for(const ray *r)
{
    return (struct RTCRay) {
        .org_x = r->origin[0],
        .org_y = r->origin[1],
        .org_z = r->origin[2],
        .tnear = r->near,
        .dir_x = r->direction[0],
        .dir_y = r->direction[1],
        .dir_z = r->direction[2],
        .tfar = r->far,
        .mask = 0xffffffffu,
    };
}

static query query_for(const world *w, const ray *r)
{
    query q = { .world = w, .ray = r };
    rtcInitIntersectContext(&q.context);
    return q;
}

static hit hit_from(const world *w, uint32_t instance, uint32_t triangle, float distance, float u,
                    float v, vec3 along)
{
    const world_instance *i = &w->instances[instance];
    return (hit) { i, triangle, distance, u, v, normal_of(i, along) };
}

bool world_closest(const world *w, const ray *r, hit *h)
{
    query q = query_for(w, r);
    if (r->from_eye)
        q.context.filter = filter;
    struct RTCRayHit rh = { .ray = ray_for(r), .hit.geomID = RTC_INVALID_GEOMETRY_ID };
    rh.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(w->top, &q.context, &rh);
    if (rh.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return false;
    *h = hit_from(w, instance_of(rh.hit.instID[0], rh.hit.geomID), rh.hit.primID, rh.ray.tfar,
                  rh.hit.u, rh.hit.v, vec3(rh.hit.Ng_x, rh.hit.Ng_y, rh.hit.Ng_z));
    return true;
}

static void load(const ray_packet *p, struct RTCRay8 *r)
{
    float *to[] = { r->org_x, r->org_y, r->org_z, r->dir_x, r->dir_y, r->dir_z };
    for (int k = 0; k < 3; k++) {
        memcpy(to[k], p->origin[k], sizeof p->origin[k]);
        memcpy(to[k + 3], p->direction[k], sizeof p->direction[k]);
    }
    memcpy(r->tnear, p->near, sizeof p->near);
    memcpy(r->tfar, p->far, sizeof p->far);
    for (unsigned i = 0; i < WORLD_PACKET; i++) {
        r->time[i] = 0;
        r->mask[i] = 0xffffffffu;
        r->id[i] = i;
        r->flags[i] = 0;
    }
}

// Few rays meet a back first: they look again, and at every side.
unsigned world_closest_packet(const world *w, const ray_packet *p, unsigned count, hit *h)
{
    query q = query_for(w, NULL);
    q.packet = p;
    q.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    struct RTCRayHit8 rh;
    int valid[WORLD_PACKET] __attribute__((aligned(32)));
    load(p, &rh.ray);
    for (unsigned i = 0; i < WORLD_PACKET; i++) {
        valid[i] = i < count ? -1 : 0;
        rh.hit.geomID[i] = rh.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect8(valid, w->top, &q.context, &rh);
    unsigned found = 0;
    for (unsigned i = 0; i < count; i++) {
        if (rh.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID)
            continue;
        found |= 1u << i;
        h[i] = hit_from(w, instance_of(rh.hit.instID[0][i], rh.hit.geomID[i]), rh.hit.primID[i],
                        rh.ray.tfar[i], rh.hit.u[i], rh.hit.v[i],
                        vec3(rh.hit.Ng_x[i], rh.hit.Ng_y[i], rh.hit.Ng_z[i]));
        const ray r = world_ray(p, i);
        if (is_hidden(h[i].instance, h[i].normal, r.direction) && !world_closest(w, &r, &h[i]))
            found &= ~(1u << i);
    }
    return found;
}

bool world_blocked(const world *w, const ray *r)
{
    query q = query_for(w, r);
    struct RTCRay shadow = ray_for(r);
    rtcOccluded1(w->top, &q.context, &shadow);
    return shadow.tfar < 0;
}
