// Rays of the reference, on one thread: how many millions a second of processor time.
//
//   bench_rays FILE|demo:NAME
//
// The eye's, eight samples of a pixel together; then, one by one from where those end, diffuse
// bounces (the closest hit) and shadow rays the same way (any hit).  512x512 pixels.  Last, whole
// samples with all that is done for them.
#include "physics/sampling.glsl"
#include "scene/picture.h"
#include "trace/eye.h"
#include "trace/place.h"
#include "trace/sampler.h"
#include "trace/world.h"

#include <argand/argand.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { SIZE = 512 };

typedef struct bouncing {
    ray *rays;
    size_t count;
} bouncing;

static double cpu_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static double process_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static ray bounce(const world *w, const ray *r, const hit *h, sampler *dice)
{
    place p = place_at(w, h, -r->direction);
    vec3 d = sampling_cosine(sampler_pair(dice));
    vec3 x = normalize(cross(fabsf(p.face[0]) < 0.7f ? vec3(1, 0, 0) : vec3(0, 1, 0), p.face));
    d = d[0] * x + d[1] * cross(p.face, x) + d[2] * p.face;
    vec3 origin = p.unlit ? p.position + 1e-4f * h->distance * p.face : p.origin;
    return (ray) { .origin = origin, .direction = normalize(d), .far = INFINITY };
}

// Prints the rate of the eye's rays, and leaves what bounces of one in eight.
static void trace_eye(const world *w, const view *v, bouncing *b)
{
    double spent = 0;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            eye_samples samples;
            for (uint32_t i = 0; i < WORLD_PACKET; i++) {
                samples.x[i] = (uint32_t)x;
                samples.y[i] = (uint32_t)y;
                samples.index[i] = i;
                samples.seed[i] = (uint32_t)(y * SIZE + x);
            }
            ray_packet rays;
            hit hits[WORLD_PACKET];
            eye_rays(v, &samples, &rays);
            double start = cpu_s();
            unsigned met = world_closest_packet(w, &rays, WORLD_PACKET, hits);
            spent += cpu_s() - start;
            sampler dice = { (uint32_t)x, (uint32_t)y, 0 };
            const ray first = world_ray(&rays, 0);
            if (met & 1)
                b->rays[b->count++] = bounce(w, &first, &hits[0], &dice);
        }
    printf("eye      %6.2f million/s\n", SIZE * SIZE * 8e-6 / spent);
}

static void trace_bounces(const world *w, const bouncing *b)
{
    size_t met = 0;
    hit h;
    double start = cpu_s();
    for (size_t i = 0; i < b->count; i++)
        met += world_closest(w, &b->rays[i], &h);
    double closest = cpu_s() - start;
    start = cpu_s();
    for (size_t i = 0; i < b->count; i++)
        met += world_blocked(w, &b->rays[i]);
    double blocked = cpu_s() - start, count = (double)b->count;
    printf("bounces  %6.2f million/s (%.0f %% meet something)\n", count * 1e-6 / closest,
           50 * (double)met / count);
    printf("shadows  %6.2f million/s\n", count * 1e-6 / blocked);
}

static int trace_samples(const ag_scene *scene, const ag_camera_desc *camera)
{
    const ag_render_options picture = { .width = SIZE, .height = SIZE };
    ag_reference *r;
    if (ag_reference_create(scene, camera, &picture, NULL, &r))
        return 1;
    double start = process_s();
    ag_status status = ag_reference_trace(r, &(ag_reference_goal) { .samples = 32 });
    double spent = process_s() - start;
    ag_reference_state state = ag_reference_describe(r);
    printf("samples  %6.2f million/s, %.2f rays each: %.2f million rays/s, all their work in it\n",
           SIZE * SIZE * 32e-6 / spent, (double)state.rays / (SIZE * SIZE * 32.0),
           (double)state.rays * 1e-6 / spent);
    ag_reference_destroy(r);
    return status != AG_OK;
}

static int bench(ag_scene *scene)
{
    ag_render_options options = { .width = SIZE, .height = SIZE };
    view v;
    world w;
    if (picture_check(scene, &options) || picture_view(scene, NULL, &options, &v) ||
        world_create(scene, NULL, &w))
        return 1;
    bouncing b = { .rays = aligned_alloc(_Alignof(ray), SIZE * SIZE * sizeof(ray)) };
    if (!b.rays)
        return 1;
    for (int turn = 0; turn < 3; turn++) {
        b.count = 0;
        trace_eye(&w, &v, &b);
        trace_bounces(&w, &b);
    }
    free(b.rays);
    world_destroy(&w);
    return trace_samples(scene, NULL);
}

int main(int argc, char **argv)
{
    ag_scene *scene;
    if (argc != 2 || ag_scene_create(NULL, &scene)) {
        fputs("usage: bench_rays FILE|demo:NAME\n", stderr);
        return 2;
    }
    bool demo = strncmp(argv[1], "demo:", 5) == 0;
    ag_status status = demo ? ag_scene_load_demo(scene, argv[1] + 5, AG_LOOK_ARGAND)
                            : ag_scene_load(scene, argv[1], NULL);
    int failed = status ? 1 : bench(scene);
    ag_scene_destroy(scene);
    return failed;
}
