// What is seen at a place of a picture: one ray against all that is there.
#include "scene/pick.h"

#include "base/array.h"
#include "base/log.h"
#include "base/threads.h"
#include "image/image.h"
#include "physics/lang.glsl"
#include "scene/frame.h"
#include "scene/picture.h"

#include <pthread.h>
#include <stdlib.h>

static vec3 loaded(const float v[3])
{
    return vec3(v[0], v[1], v[2]);
}

static void store(vec3 v, float out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = v[i];
}

enum {
    CHUNK = 1 << 14,   // triangles that a task looks at
    THREADED = 1 << 16 // as many are worth threads
};

typedef struct task {
    uint32_t instance, first, end;
} task;

typedef struct meeting {
    double distance; // m
    uint32_t instance, triangle;
} meeting;

// The ray goes along -z of its frame.
typedef struct search {
    const ag_scene *scene;
    frame frame;
    double near; // m
    task *tasks;
    size_t count, capacity, triangles;
    pthread_mutex_t lock;
    meeting nearest;
} search;

// ---- What is there of a triangle -------------------------------------------------

// A coordinate's texel in a line of `size`.
static uint32_t texel_at(float u, ag_wrap wrap, uint32_t size)
{
    float at = u - floorf(u);
    if (wrap == AG_WRAP_CLAMP)
        at = fminf(fmaxf(u, 0), 1);
    else if (wrap == AG_WRAP_MIRROR && fmodf(floorf(u), 2) != 0)
        at = 1 - at;
    uint32_t texel = (uint32_t)(at * (float)size);
    return texel < size ? texel : size - 1;
}

// KHR_texture_transform, as src/render/materials.c has it; 1 without a texture, or where its image
// was given away.
static float texture_alpha(const ag_scene *scene, const ag_texture_use *use, const float uv[2])
{
    if (!use->texture.id)
        return 1;
    const scene_texture *texture = &scene->textures[use->texture.id - 1];
    const ag_image *image = texture->image;
    if (!image->pixels)
        return 1;
    float c = cosf(use->rotation_rad), s = sinf(use->rotation_rad);
    float x = use->scale[0] * uv[0], y = use->scale[1] * uv[1];
    uint32_t column = texel_at(c * x + s * y + use->offset[0], texture->desc.wrap_u, image->width);
    uint32_t row = texel_at(c * y - s * x + use->offset[1], texture->desc.wrap_v, image->height);
    const uint8_t *pixels = image->pixels;
    return pixels[4 * ((size_t)row * image->width + column) + 3] / 255.0f;
}

// Whether the surface is there at a triangle's place, given by the weights of its corners.
static bool is_there(const ag_scene *scene, const scene_instance *instance, uint32_t triangle,
                     const float weights[3])
{
    const ag_material_desc *m = &scene->materials[instance->material];
    if (m->alpha_mode == AG_ALPHA_OPAQUE)
        return true;
    const scene_mesh *mesh = &scene->meshes[instance->mesh];
    float uv[2] = { 0, 0 }, alpha = 0;
    for (int i = 0; i < 3; i++) {
        const scene_vertex *v = &mesh->vertices[mesh->indices[3 * (size_t)triangle + (size_t)i]];
        alpha += weights[i] * (float)v->color[3] / 65535;
        uv[0] += weights[i] * v->uv[m->base_color_texture.uv_set][0];
        uv[1] += weights[i] * v->uv[m->base_color_texture.uv_set][1];
    }
    alpha *= m->base_color[3] * texture_alpha(scene, &m->base_color_texture, uv);
    return alpha >= (m->alpha_mode == AG_ALPHA_MASK ? m->alpha_cutoff : 0.5f);
}

// ---- Triangles ---------------------------------------------------------------------

// A mesh on the way to the ray's frame.
typedef struct aim {
    affine way;
    const scene_instance *instance;
    const scene_mesh *mesh;
    bool double_sided, mirrored;
} aim;

static aim aim_at(const search *s, uint32_t index)
{
    const scene_instance *instance = &s->scene->instances[index];
    aim a = { .way = frame_from_mesh(&s->frame, instance->world),
              .instance = instance,
              .mesh = &s->scene->meshes[instance->mesh],
              .double_sided = s->scene->materials[instance->material].double_sided };
    const float *w = instance->world;
    a.mirrored = dot(loaded(w), cross(loaded(w + 4), loaded(w + 8))) < 0;
    return a;
}

// The ray goes through (0, 0).  A vertex has the same two floats in all its triangles and their
// products are exact: no ray slips between neighbours (Woop, Benthin & Wald 2013, "Watertight
// Ray/Triangle Intersection").  Twice the signed areas of the three parts; their sum, or 0.
static double surrounds(const float x[3], const float y[3], double parts[3])
{
    for (int i = 0; i < 3; i++) {
        int a = (i + 1) % 3, b = (i + 2) % 3;
        parts[i] = (double)x[a] * (double)y[b] - (double)y[a] * (double)x[b];
    }
    bool left = parts[0] >= 0 && parts[1] >= 0 && parts[2] >= 0;
    bool right = parts[0] <= 0 && parts[1] <= 0 && parts[2] <= 0;
    return left || right ? parts[0] + parts[1] + parts[2] : 0;
}

static void look_at(const search *s, const aim *a, uint32_t triangle, meeting *nearest)
{
    const uint32_t *at = a->mesh->indices + 3 * (size_t)triangle;
    const float *corners[3];
    float x[3], y[3], weights[3];
    for (int i = 0; i < 3; i++) {
        corners[i] = a->mesh->vertices[at[i]].position;
        x[i] = (float)affine_row(&a->way, 0, corners[i]);
    }
    if ((x[0] > 0 && x[1] > 0 && x[2] > 0) || (x[0] < 0 && x[1] < 0 && x[2] < 0))
        return;
    for (int i = 0; i < 3; i++)
        y[i] = (float)affine_row(&a->way, 1, corners[i]);
    double parts[3], area = surrounds(x, y, parts), distance = 0;
    if (area == 0 || (!a->double_sided && (area > 0) == a->mirrored))
        return;
    for (int i = 0; i < 3; i++) {
        weights[i] = (float)(parts[i] / area);
        distance -= parts[i] / area * affine_row(&a->way, 2, corners[i]);
    }
    if (distance >= s->near && distance < nearest->distance &&
        is_there(s->scene, a->instance, triangle, weights)) {
        nearest->distance = distance;
        nearest->triangle = triangle;
    }
}

static bool is_before(const meeting *a, const meeting *b)
{
    if (a->distance != b->distance)
        return a->distance < b->distance;
    return a->instance != b->instance ? a->instance < b->instance : a->triangle < b->triangle;
}

static void run_task(void *context, size_t index)
{
    search *s = context;
    const task *t = &s->tasks[index];
    const aim a = aim_at(s, t->instance);
    pthread_mutex_lock(&s->lock);
    meeting nearest = s->nearest;
    pthread_mutex_unlock(&s->lock);
    nearest.distance = nextafter(nearest.distance, (double)INFINITY); // the same place counts
    nearest.triangle = UINT32_MAX;
    nearest.instance = t->instance;
    for (uint32_t triangle = t->first; triangle < t->end; triangle++)
        look_at(s, &a, triangle, &nearest);
    pthread_mutex_lock(&s->lock);
    if (nearest.triangle != UINT32_MAX && is_before(&nearest, &s->nearest))
        s->nearest = nearest;
    pthread_mutex_unlock(&s->lock);
}

// Whether the ray may meet the box of a mesh: Arvo 1990, in the ray's frame.
static bool meets_box(const search *s, uint32_t index)
{
    const aim a = aim_at(s, index);
    double center[3], half[3];
    for (int row = 0; row < 3; row++) {
        const double *m = a.way.m[row];
        center[row] = m[3];
        half[row] = 0;
        for (int i = 0; i < 3; i++) {
            double low = (double)a.mesh->min[i], high = (double)a.mesh->max[i];
            center[row] += m[i] * 0.5 * (low + high);
            half[row] += fabs(m[i]) * 0.5 * (high - low);
        }
        half[row] += 1e-6 * (half[row] + fabs(center[row])); // corners are rounded to floats
    }
    return fabs(center[0]) <= half[0] && fabs(center[1]) <= half[1] &&
           -center[2] + half[2] >= s->near && -center[2] - half[2] <= s->nearest.distance;
}

static bool add_tasks(search *s, uint32_t index)
{
    uint32_t triangles = s->scene->meshes[s->scene->instances[index].mesh].index_count / 3;
    size_t more = (triangles + CHUNK - 1) / CHUNK;
    if (!array_reserve(&s->tasks, &s->capacity, s->count + more, sizeof *s->tasks))
        return false;
    s->triangles += triangles;
    for (uint32_t first = 0; first < triangles; first += CHUNK) {
        uint32_t end = triangles - first > CHUNK ? first + CHUNK : triangles;
        s->tasks[s->count++] = (task) { index, first, end };
    }
    return true;
}

static ag_status search_surfaces(search *s)
{
    bool noted = true;
    for (size_t i = 0; i < s->scene->instances_count && noted; i++)
        if (meets_box(s, (uint32_t)i))
            noted = add_tasks(s, (uint32_t)i);
    if (noted && s->triangles > THREADED)
        parallel_for(s->count, run_task, s);
    else
        for (size_t i = 0; i < s->count; i++)
            run_task(s, i);
    free(s->tasks);
    return noted ? AG_OK
                 : log_fail(&s->scene->log, AG_ERROR_MEMORY,
                            "There is no memory to find what is seen at a place.");
}

// ---- What was found ------------------------------------------------------------------

static void along(const ag_ray *ray, float distance, float position[3])
{
    store(loaded(ray->origin) + loaded(ray->direction) * distance, position);
}

static vec3 corner(const scene_mesh *mesh, const float w[16], uint32_t index)
{
    const float *p = mesh->vertices[mesh->indices[index]].position;
    return loaded(w) * p[0] + loaded(w + 4) * p[1] + loaded(w + 8) * p[2] + loaded(w + 12);
}

static void tell_surface(const ag_scene *scene, const ag_ray *ray, const meeting *m, ag_pick *pick)
{
    const scene_instance *instance = &scene->instances[m->instance];
    const scene_mesh *mesh = &scene->meshes[instance->mesh];
    vec3 a = corner(mesh, instance->world, 3 * m->triangle);
    vec3 b = corner(mesh, instance->world, 3 * m->triangle + 1);
    vec3 c = corner(mesh, instance->world, 3 * m->triangle + 2);
    vec3 normal = cross(b - a, c - a);
    float length2 = dot(normal, normal);
    normal = length2 > 0 ? normal / sqrtf(length2) : -loaded(ray->direction);
    *pick = (ag_pick) { .kind = AG_PICK_SURFACE,
                        .instance = { m->instance + 1 },
                        .material = { instance->material },
                        .distance_m = (float)m->distance };
    store(dot(normal, loaded(ray->direction)) > 0 ? -normal : normal, pick->normal);
    along(ray, pick->distance_m, pick->position);
}

static void tell_light(const ag_scene *scene, size_t index, float distance, ag_pick *pick)
{
    *pick = (ag_pick) { .kind = AG_PICK_LIGHT,
                        .light = { (uint32_t)index + 1 },
                        .distance_m = distance };
    if (!isinf(distance))
        store(loaded(scene->lights[index].position), pick->position);
}

// The nearest body before what was found; suns behind all.
static void find_body(const ag_scene *scene, const ag_ray *ray, float near, float far,
                      ag_pick *pick)
{
    float nearest = pick->kind ? pick->distance_m : INFINITY;
    for (size_t i = 0; i < scene->lights_count; i++) {
        float distance = pick_body(&scene->lights[i], ray->origin, ray->direction);
        bool sun = isinf(distance);
        if (!(sun ? !pick->kind : distance >= near && distance <= far && distance < nearest))
            continue;
        nearest = distance;
        tell_light(scene, i, distance, pick);
        if (!sun)
            along(ray, distance, pick->position);
    }
}

// The light whose position is seen nearest to the place.
static bool find_mark(const ag_scene *scene, const view *v, const float at[2], float reach,
                      ag_pick *pick)
{
    for (size_t i = 0; i < scene->lights_count; i++) {
        const ag_light_desc *light = &scene->lights[i];
        float place[2];
        if (!light_has_position(light->kind) || !view_project(v, light->position, place))
            continue;
        float apart = hypotf(place[0] - at[0], place[1] - at[1]);
        if (!(apart < reach))
            continue;
        vec3 to = loaded(light->position) - loaded(v->eye);
        reach = apart;
        tell_light(scene, i, sqrtf(dot(to, to)), pick);
    }
    return pick->kind;
}

static frame frame_of(const ag_ray *ray)
{
    vec3 z = -loaded(ray->direction);
    vec3 x = normalize(cross(fabsf(z[1]) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0), z));
    const vec3 axes[3] = { x, cross(z, x), z };
    frame f;
    for (int i = 0; i < 3; i++) {
        f.origin[i] = (double)ray->origin[i];
        for (int k = 0; k < 3; k++)
            f.axis[i][k] = (double)axes[i][k];
    }
    return f;
}

static ag_status find(const ag_scene *scene, const view *v, const float at[2], ag_pick *pick)
{
    ag_ray ray;
    view_ray(v, at[0], at[1], ray.origin, ray.direction);
    float slant = dot(loaded(ray.direction), loaded(v->forward));
    float near = fmaxf(v->near_m, 0) / slant, far = v->far_m / slant;
    search s = { .scene = scene,
                 .frame = frame_of(&ray),
                 .near = (double)near,
                 .lock = PTHREAD_MUTEX_INITIALIZER,
                 .nearest = { .distance = (double)far, .instance = UINT32_MAX } };
    ag_status status = search_surfaces(&s);
    if (status)
        return status;
    if (s.nearest.instance != UINT32_MAX)
        tell_surface(scene, &ray, &s.nearest, pick);
    find_body(scene, &ray, near, far, pick);
    return AG_OK;
}

ag_status ag_scene_pick(const ag_scene *scene, const ag_camera_desc *camera, uint32_t width,
                        uint32_t height, float x, float y, float reach_px, ag_pick *pick)
{
    *pick = (ag_pick) { 0 };
    const ag_render_options picture = { .width = width, .height = height };
    const float at[2] = { x, y };
    view v;
    if (!width || !height || !isfinite(x) || !isfinite(y) || !(reach_px >= 0))
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "A place to look at needs a picture of at least 1x1 px, finite numbers and "
                        "a reach of at least 0.");
    ag_status status = picture_view(scene, camera, &picture, &v);
    if (status || find_mark(scene, &v, at, reach_px, pick))
        return status;
    return find(scene, &v, at, pick);
}
