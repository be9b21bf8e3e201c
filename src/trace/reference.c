// The reference: what ag_reference_* does.
#include <argand/reference.h>

#include "base/clock.h"
#include "base/log.h"
#include "base/threads.h"
#include "scene/picture.h"
#include "trace/film.h"
#include "trace/path.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

enum { SAMPLES_DEFAULT = 64, PASS_MAX = 8 };

struct ag_reference {
    path_scene scene;
    film film;
    ag_log log;
    uint32_t samples; // of every pixel
    uint64_t rays;
    double prepare_ms, trace_ms;
    float noise;
};

// ---- Preparing ---------------------------------------------------------------------

static ag_status check(const ag_log *log, const ag_reference_options *o)
{
    if (!(o->clamp >= 0) || (unsigned)o->estimator > AG_ESTIMATOR_SURFACE)
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "a reference's clamp is negative, or its estimator none of the listed");
    return AG_OK;
}

static ag_status prepare(const ag_scene *scene, const ag_camera_desc *camera, ag_reference *r)
{
    path_scene *s = &r->scene;
    ag_status status = check(&r->log, &s->options);
    if (!status)
        status = picture_check(scene, &s->picture);
    if (!status)
        s->exposure = picture_exposure(&s->picture);
    if (!status)
        status = picture_view(scene, camera, &s->picture, &s->view);
    if (!status)
        status = world_create(scene, &s->world);
    if (!status)
        status = sky_init(scene, &s->sky);
    if (!status)
        status = lights_init(scene, s->picture.light, &s->lights);
    if (!status)
        status = emitters_init(&s->world, &s->emitters);
    if (!status)
        status =
            film_init(&r->log, s->picture.width, s->picture.height, s->options.keep_aovs, &r->film);
    if (!status)
        albedo_init(&s->albedo);
    return status;
}

ag_status ag_reference_create(const ag_scene *scene, const ag_camera_desc *camera,
                              const ag_render_options *picture, const ag_reference_options *options,
                              ag_reference **reference)
{
    *reference = NULL;
    double start = clock_ms();
    ag_reference *r = aligned_alloc(_Alignof(ag_reference), sizeof *r);
    if (!r)
        return log_fail(&scene->log, AG_ERROR_MEMORY, "no memory for a reference");
    *r = (ag_reference) { .log = scene->log };
    if (picture)
        r->scene.picture = *picture;
    if (options)
        r->scene.options = *options;
    ag_status status = prepare(scene, camera, r);
    if (status) {
        ag_reference_destroy(r);
        return status;
    }
    r->prepare_ms = clock_ms() - start;
    *reference = r;
    return AG_OK;
}

void ag_reference_destroy(ag_reference *r)
{
    if (!r)
        return;
    film_finish(&r->film);
    emitters_finish(&r->scene.emitters);
    lights_finish(&r->scene.lights);
    sky_finish(&r->scene.sky);
    world_destroy(&r->scene.world);
    free(r);
}

// ---- Tracing -----------------------------------------------------------------------

// Samples [from, to) of every pixel.
typedef struct pass {
    ag_reference *reference;
    const ag_reference_goal *goal;
    uint32_t from, to;
    double deadline_ms; // INFINITY: none
    double done, share; // of the call: before this pass, and its part
    pthread_t caller;   // alone may say how far it is
    atomic_size_t tiles;
    atomic_ullong rays;
    atomic_bool stopped, cancelled;
} pass;

// As many pixels of a row at a time as fill a bundle.
static uint32_t trace_pixels(pass *p, uint32_t x, uint32_t right, uint32_t y, uint32_t from,
                             unsigned long long *rays)
{
    path_work work[PATH_BUNDLE] = { 0 };
    path_result results[PATH_BUNDLE];
    uint32_t each = p->to - from, pixels = PATH_BUNDLE / each;
    pixels = pixels < right - x ? pixels : right - x;
    for (uint32_t i = 0; i < pixels; i++)
        work[i] = (path_work) { x + i, y, from, each };
    path_follow(&p->reference->scene, work, pixels, results);
    for (uint32_t i = 0; i < pixels * each; i++) {
        film_add(&p->reference->film, x + i / each, y, &results[i]);
        *rays += results[i].rays;
    }
    return pixels;
}

static void trace_tile(pass *p, uint32_t tile)
{
    film *f = &p->reference->film;
    uint32_t left = tile % f->columns * FILM_TILE, top = tile / f->columns * FILM_TILE;
    uint32_t right = left + FILM_TILE < f->width ? left + FILM_TILE : f->width;
    uint32_t bottom = top + FILM_TILE < f->height ? top + FILM_TILE : f->height;
    unsigned long long rays = 0;
    if (f->samples[tile] >= p->to) // by a call that was stopped
        return;
    for (uint32_t y = top; y < bottom; y++)
        for (uint32_t x = left; x < right;)
            x += trace_pixels(p, x, right, y, f->samples[tile], &rays);
    f->samples[tile] = p->to;
    atomic_fetch_add(&p->rays, rays);
}

static bool goes_on(pass *p, size_t tiles)
{
    if (clock_ms() > p->deadline_ms && p->from > 0)
        return false;
    const ag_progress *progress = &p->goal->progress;
    if (!progress->update || !pthread_equal(pthread_self(), p->caller))
        return true;
    size_t all = (size_t)p->reference->film.columns * p->reference->film.rows;
    double fraction = p->done + p->share * (double)tiles / (double)all;
    if (progress->update(progress->user, "trace", fraction < 1 ? fraction : 1))
        return true;
    p->cancelled = true;
    return false;
}

static void run_tile(void *context, size_t index)
{
    pass *p = context;
    if (p->stopped)
        return;
    if (!goes_on(p, atomic_fetch_add(&p->tiles, 1)))
        p->stopped = true;
    else
        trace_tile(p, (uint32_t)index);
}

// How far the call is, by the goal that is nearest.
static double fraction_done(const ag_reference *r, const ag_reference_goal *g, double start)
{
    double done = 0;
    if (g->samples)
        done = (double)r->samples / g->samples;
    if (g->seconds > 0)
        done = fmax(done, (clock_ms() - start) / 1000 / g->seconds);
    if (g->noise > 0 && r->noise > 0)
        done = fmax(done, pow((double)(g->noise / r->noise), 2)); // it falls as the root
    return fmin(done, 1);
}

// Passes that depend on nothing but how many samples there are: what they end with is the same
// on any machine.
static uint32_t pass_end(const ag_reference *r, const ag_reference_goal *g)
{
    uint32_t size = r->samples < 1 ? 1 : r->samples < PASS_MAX ? r->samples : PASS_MAX;
    uint32_t end = r->samples + size;
    return g->samples && end > g->samples ? g->samples : end;
}

static bool is_reached(const ag_reference *r, const ag_reference_goal *g, double start)
{
    return (g->samples && r->samples >= g->samples) ||
           (g->seconds > 0 && clock_ms() - start >= g->seconds * 1000) ||
           (g->noise > 0 && r->samples > 1 && r->noise <= g->noise);
}

static uint32_t fewest(const film *f)
{
    uint32_t least = UINT32_MAX;
    for (size_t i = 0; i < (size_t)f->columns * f->rows; i++)
        least = f->samples[i] < least ? f->samples[i] : least;
    return least;
}

static bool run_pass(ag_reference *r, const ag_reference_goal *g, double start)
{
    double done = fraction_done(r, g, start);
    pass p = {
        .reference = r,
        .goal = g,
        .from = r->samples,
        .to = pass_end(r, g),
        .deadline_ms = g->seconds > 0 ? start + g->seconds * 1000 : (double)INFINITY,
        .done = done,
        .caller = pthread_self(),
    };
    if (g->samples)
        p.share = (double)(p.to - p.from) / g->samples;
    if (g->seconds > 0 || g->noise > 0)
        p.share = 0; // there the next pass tells
    parallel_for((size_t)r->film.columns * r->film.rows, run_tile, &p);
    r->samples = fewest(&r->film);
    r->rays += p.rays;
    r->noise = r->samples > 1 ? film_noise(&r->film) : 0;
    return !p.cancelled;
}

ag_status ag_reference_trace(ag_reference *r, const ag_reference_goal *goal)
{
    ag_reference_goal g = goal ? *goal : (ag_reference_goal) { 0 };
    if (!(g.seconds >= 0) || !(g.noise >= 0))
        return log_fail(&r->log, AG_ERROR_ARGUMENT,
                        "a goal of %g s or of noise %g is not at least 0", g.seconds,
                        (double)g.noise);
    if (!g.samples && g.seconds == 0 && g.noise == 0)
        g.samples = SAMPLES_DEFAULT;
    double start = clock_ms();
    bool cancelled = false;
    while (!cancelled && !is_reached(r, &g, start))
        cancelled = !run_pass(r, &g, start);
    r->trace_ms += clock_ms() - start;
    if (cancelled)
        return log_fail(&r->log, AG_ERROR_CANCELLED, "the tracing was stopped after %u samples",
                        r->samples);
    return AG_OK;
}

// ---- What came of it ------------------------------------------------------------------

ag_reference_state ag_reference_describe(const ag_reference *r)
{
    return (ag_reference_state) {
        .samples = r->samples,
        .noise = r->noise,
        .rays = r->rays,
        .prepare_ms = r->prepare_ms,
        .trace_ms = r->trace_ms,
    };
}

ag_status ag_reference_picture(const ag_reference *r, ag_image **image)
{
    *image = NULL;
    return film_picture(&r->log, &r->film, &r->scene.picture, image);
}

ag_status ag_reference_aov(const ag_reference *r, ag_aov aov, ag_image **image)
{
    *image = NULL;
    return film_aov_image(&r->log, &r->film, aov, image);
}
