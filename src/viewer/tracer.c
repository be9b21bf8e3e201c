// The tracer: the path traced picture of a view, growing beside the window's thread.
#include "tracer.h"

#include <stdlib.h>

enum { COARSE = 4, PASS_MAX = 16 };

struct tracer {
    worker *worker;
    ag_log log;
    ag_reference *reference;
    const ag_scene *scene; // that the reference has
    bool coarse;           // it makes the small picture
    trace_order order;
    trace_result result;
};

tracer *tracer_create(crew *c, ag_log_level level)
{
    tracer *t = calloc(1, sizeof *t);
    if (!t)
        return NULL;
    t->worker = worker_create(c);
    if (!t->worker) {
        free(t);
        return NULL;
    }
    t->log = crew_log(c, level);
    return t;
}

void tracer_forget(tracer *t)
{
    ag_reference_destroy(t->reference);
    t->reference = NULL;
    t->scene = NULL;
}

void tracer_destroy(tracer *t)
{
    if (!t)
        return;
    worker_destroy(t->worker);
    tracer_forget(t);
    ag_image_destroy(t->result.picture);
    free(t);
}

worker *tracer_worker(tracer *t)
{
    return t->worker;
}

// Have the reference look at the order's view; `coarse`: for a small picture.
static ag_status look(tracer *t, bool coarse)
{
    const trace_order *o = &t->order;
    const ag_reference_options options = { .progress = worker_progress(t->worker) };
    ag_render_options picture = o->picture;
    t->coarse = coarse;
    if (coarse) {
        picture.width = (picture.width + COARSE - 1) / COARSE;
        picture.height = (picture.height + COARSE - 1) / COARSE;
    }
    if (t->reference && t->scene == o->scene)
        return ag_reference_restart(t->reference, &o->camera, &picture, &options);
    tracer_forget(t);
    ag_status status = ag_reference_create(o->scene, &o->camera, &picture, &options, &t->reference);
    t->scene = status ? NULL : o->scene;
    return status;
}

// Passes get longer: the first ones show something soon, later ones change little.
static uint32_t next_samples(uint32_t samples)
{
    uint32_t more = samples / 4 + 1;
    return samples + (more < PASS_MAX ? more : PASS_MAX);
}

static bool is_power_of_two(uint32_t n)
{
    return (n & (n - 1)) == 0;
}

// Comparing takes as long as a pass: seldom.
static ag_status compare(tracer *t, uint32_t before)
{
    trace_result *r = &t->result;
    bool crossed = false;
    for (uint32_t n = before + 1; n <= r->samples; n++)
        crossed |= is_power_of_two(n);
    const ag_image *beside = t->order.beside;
    bool same_size = beside && ag_image_width(beside) == ag_image_width(r->picture) &&
                     ag_image_height(beside) == ag_image_height(r->picture);
    if (!same_size || !crossed || worker_is_stopped(t->worker))
        return AG_OK; // of another size: the window has just changed
    ag_difference difference;
    ag_status status = ag_image_compare(&t->log, r->picture, beside, NULL, &difference, NULL);
    r->compared = !status;
    r->flip = difference.flip;
    return status;
}

static ag_status trace(tracer *t)
{
    bool again = t->order.again;
    ag_status status = again || t->coarse || !t->reference ? look(t, again) : AG_OK;
    if (status)
        return status;
    uint32_t before = ag_reference_describe(t->reference).samples;
    const ag_reference_goal goal = { .samples = next_samples(before),
                                     .progress = worker_progress(t->worker) };
    status = ag_reference_trace(t->reference, &goal);
    if (status)
        return status;
    const ag_reference_state state = ag_reference_describe(t->reference);
    t->result.noise = state.noise;
    t->result.samples = t->coarse ? 0 : state.samples;
    status = ag_reference_picture(t->reference, &t->result.picture);
    return status || t->coarse ? status : compare(t, before);
}

static ag_status trace_job(void *context, worker *self)
{
    (void)self;
    tracer *t = context;
    ag_status status = trace(t);
    t->result.cancelled = status == AG_ERROR_CANCELLED;
    return t->result.cancelled ? AG_OK : status;
}

void tracer_begin(tracer *t, const trace_order *order)
{
    t->order = *order;
    t->result = (trace_result) { 0 };
    worker_start(t->worker, trace_job, t);
}

bool tracer_collect(tracer *t, ag_status *status, trace_result *result)
{
    if (!worker_collect(t->worker, status))
        return false;
    *result = t->result;
    t->result.picture = NULL;
    return true;
}
