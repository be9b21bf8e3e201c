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
    const ag_scene *source;
    uint64_t revision, materials_revision, environment_revision; // of the source
    uint32_t samples;                                            // of every pixel
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

// What of `before` (NULL: nothing) still holds is shared with it.
static ag_status prepare_world(const ag_reference *before, ag_reference *r)
{
    path_scene *s = &r->scene;
    const ag_progress *progress = &s->options.progress;
    bool built = before && before->revision == r->revision;
    if (built && before->materials_revision == r->materials_revision) {
        s->world = before->scene.world;
        s->emitters = before->scene.emitters;
        return AG_OK;
    }
    ag_status status = built ? world_renew(r->source, &before->scene.world, progress, &s->world)
                             : world_create(r->source, progress, &s->world);
    return status ? status : emitters_init(&s->world, &s->emitters);
}

static ag_status prepare_sky(const ag_reference *before, ag_reference *r)
{
    if (!before || before->environment_revision != r->environment_revision)
        return sky_init(r->source, &r->scene.sky);
    r->scene.sky = before->scene.sky;
    sky_turn(r->source, &r->scene.sky);
    return AG_OK;
}

static ag_status prepare(const ag_camera_desc *camera, const ag_reference *before, ag_reference *r)
{
    path_scene *s = &r->scene;
    ag_status status = check(&r->log, &s->options);
    if (!status)
        status = picture_check(r->source, &s->picture);
    if (!status)
        s->exposure = picture_exposure(&s->picture);
    if (!status)
        status = picture_view(r->source, camera, &s->picture, &s->view);
    if (!status)
        status =
            film_init(&r->log, s->picture.width, s->picture.height, s->options.keep_aovs, &r->film);
    if (!status)
        status = lights_init(r->source, s->picture.light, &s->lights);
    if (!status)
        status = prepare_sky(before, r);
    if (!status)
        status = prepare_world(before, r);
    if (status)
        return status;
    if (before)
        s->albedo = before->scene.albedo;
    else
        albedo_init(&s->albedo);
    return AG_OK;
}

// Free all that it does not share with `kept` (NULL: nothing), and itself.
static void leave(ag_reference *r, const ag_reference *kept)
{
    film_finish(&r->film);
    lights_finish(&r->scene.lights);
    if (!kept || r->scene.emitters.where != kept->scene.emitters.where)
        emitters_finish(&r->scene.emitters);
    if (!kept || r->scene.sky.sums != kept->scene.sky.sums)
        sky_finish(&r->scene.sky);
    world_leave(&r->scene.world, kept ? &kept->scene.world : NULL);
    free(r);
}

static ag_status make(const ag_scene *scene, const ag_camera_desc *camera,
                      const ag_render_options *picture, const ag_reference_options *options,
                      const ag_reference *before, ag_reference **made)
{
    double start = clock_ms();
    ag_reference *r = aligned_alloc(_Alignof(ag_reference), sizeof *r);
    if (!r)
        return log_fail(&scene->log, AG_ERROR_MEMORY, "no memory for a reference");
    *r = (ag_reference) { .log = scene->log,
                          .source = scene,
                          .revision = scene->revision,
                          .materials_revision = scene->materials_revision,
                          .environment_revision = scene->environment_revision };
    if (picture)
        r->scene.picture = *picture;
    if (options)
        r->scene.options = *options;
    ag_status status = prepare(camera, before, r);
    r->prepare_ms = clock_ms() - start;
    *made = r;
    return status;
}

ag_status ag_reference_create(const ag_scene *scene, const ag_camera_desc *camera,
                              const ag_render_options *picture, const ag_reference_options *options,
                              ag_reference **reference)
{
    ag_reference *made = NULL;
    ag_status status = make(scene, camera, picture, options, NULL, &made);
    if (status) {
        ag_reference_destroy(made);
        made = NULL;
    }
    *reference = made;
    return status;
}

ag_status ag_reference_restart(ag_reference *r, const ag_camera_desc *camera,
                               const ag_render_options *picture,
                               const ag_reference_options *options)
{
    ag_reference *next = NULL;
    ag_status status = make(r->source, camera, picture, options, r, &next);
    if (!status) { // what is to go away comes to lie in `next`
        ag_reference before = *r;
        *r = *next;
        *next = before;
        r->scene.emitters.world = &r->scene.world;
        next->scene.emitters.world = &next->scene.world;
    }
    if (next)
        leave(next, r);
    return status;
}

void ag_reference_destroy(ag_reference *r)
{
    if (r)
        leave(r, NULL);
}

// ---- Tracing -----------------------------------------------------------------------

// At most so many of each pixel of a tile before it is asked whether to go on: 1024 paths.
enum { SAMPLES_AT_ONCE = 4 };

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
                             uint32_t each, unsigned long long *rays)
{
    path_work work[PATH_BUNDLE] = { 0 };
    path_result results[PATH_BUNDLE];
    uint32_t pixels = PATH_BUNDLE / each;
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
    uint32_t left = tile % f->columns * FILM_TILE_WIDTH, right = left + FILM_TILE_WIDTH;
    uint32_t top = tile / f->columns * FILM_TILE_HEIGHT, bottom = top + FILM_TILE_HEIGHT;
    right = right < f->width ? right : f->width;
    bottom = bottom < f->height ? bottom : f->height;
    uint32_t from = f->samples[tile], each = p->to - from;
    each = each < SAMPLES_AT_ONCE ? each : SAMPLES_AT_ONCE;
    unsigned long long rays = 0;
    for (uint32_t y = top; y < bottom; y++)
        for (uint32_t x = left; x < right;)
            x += trace_pixels(p, x, right, y, from, each, &rays);
    f->samples[tile] = from + each;
    atomic_fetch_add(&p->rays, rays);
}

static bool goes_on(pass *p)
{
    if (p->stopped || (clock_ms() > p->deadline_ms && p->from > 0))
        return false;
    const ag_progress *progress = &p->goal->progress;
    if (!progress->update || !pthread_equal(pthread_self(), p->caller))
        return true;
    size_t all = (size_t)p->reference->film.columns * p->reference->film.rows;
    double fraction = p->done + p->share * (double)p->tiles / (double)all;
    if (progress->update(progress->user, "trace", fraction < 1 ? fraction : 1))
        return true;
    p->cancelled = true;
    return false;
}

// A call that was stopped may have left some of a tile's samples to this one.
static void run_tile(void *context, size_t index)
{
    pass *p = context;
    const uint32_t *samples = &p->reference->film.samples[index];
    while (*samples < p->to && !p->stopped) {
        if (goes_on(p))
            trace_tile(p, (uint32_t)index);
        else
            p->stopped = true;
    }
    atomic_fetch_add(&p->tiles, 1);
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
