// Light of a scene as linear pictures, in real time and by the reference.
#include "ways.h"

#include "linear.h"

#include <math.h>
#include <stdlib.h>

ag_render_options maker_linear(const maker *m)
{
    ag_render_options o = m->look;
    o.format = AG_FORMAT_RGBA32F;
    if (o.background == AG_BACKGROUND_COLOR)
        o.background = AG_BACKGROUND_TRANSPARENT;
    o.progress = (ag_progress) { 0 };
    return o;
}

ag_status maker_draw(const maker *m, const ag_render_options *options, ag_image **image,
                     double *frame_ms)
{
    ag_render_stats stats;
    ag_status status =
        ag_renderer_render(m->renderer, m->shot->scene, &m->camera, options, image, &stats);
    if (frame_ms)
        *frame_ms = stats.frame_ms;
    return status;
}

static bool update(void *user, const char *stage, double fraction)
{
    const maker *m = user;
    const ag_progress *p = &m->look.progress;
    return !p->update || p->update(p->user, stage, m->done + fraction * m->doing / 2);
}

static ag_status trace(maker *m, const ag_render_options *picture,
                       const ag_reference_options *options, const ag_reference_goal *goal,
                       ag_reference_state *state, ag_image **image)
{
    ag_reference *reference;
    ag_status status =
        ag_reference_create(m->shot->scene, &m->camera, picture, options, &reference);
    if (status)
        return status;
    status = ag_reference_trace(reference, goal);
    if (!status)
        status = ag_reference_picture(reference, image);
    *state = ag_reference_describe(reference);
    ag_reference_destroy(reference);
    m->done += m->doing / 2;
    return status;
}

static ag_reference_state add_states(const ag_reference_state s[2])
{
    return (ag_reference_state) {
        .samples = s[0].samples + s[1].samples,
        .noise = hypotf(s[0].noise, s[1].noise) / 2,
        .rays = s[0].rays + s[1].rays,
        .prepare_ms = s[0].prepare_ms + s[1].prepare_ms,
        .trace_ms = s[0].trace_ms + s[1].trace_ms,
    };
}

ag_status maker_trace(maker *m, const ag_render_options *options, bool direct, double seconds,
                      side *s, ag_reference_state *state)
{
    const ag_reference_goal half = {
        .samples = (m->goal.samples + 1) / 2,
        .seconds = m->goal.seconds * seconds / 2,
        .noise = m->goal.noise * sqrtf(2),
        .progress = { update, m },
    };
    ag_reference_state states[2] = { 0 };
    ag_image *halves[2] = { NULL, NULL };
    ag_status status = AG_OK;
    for (uint32_t i = 0; i < 2 && !status; i++) {
        const ag_reference_options how = { .direct_only = direct, .unshadowed = direct, .seed = i };
        status = trace(m, options, &how, &half, &states[i], &halves[i]);
    }
    if (state)
        *state = add_states(states);
    if (!status)
        return side_from_halves(&m->shot->log, halves, s);
    ag_image_destroy(halves[0]);
    ag_image_destroy(halves[1]);
    return status;
}

ag_status side_from_halves(const ag_log *log, ag_image *const halves[2], side *s)
{
    const ag_image_desc desc = { ag_image_width(halves[0]), ag_image_height(halves[0]),
                                 AG_FORMAT_RGBA32F, NULL };
    float(*sum)[4] = calloc((size_t)desc.width * desc.height, sizeof *sum);
    ag_status status = AG_ERROR_MEMORY;
    *s = (side) { .half = { halves[0], halves[1] } };
    if (sum) {
        ag_image_desc mean = desc;
        mean.pixels = sum;
        linear_add(sum, halves[0], 0.5f);
        linear_add(sum, halves[1], 0.5f);
        status = ag_image_create(log, &mean, &s->mean);
    }
    free(sum);
    return status;
}

const ag_image *side_half(const side *s, int half)
{
    return s->half[half] ? s->half[half] : s->mean;
}

static void side_finish(side *s)
{
    ag_image_destroy(s->mean);
    ag_image_destroy(s->half[0]);
    ag_image_destroy(s->half[1]);
    *s = (side) { 0 };
}

void ways_finish(ways *w)
{
    side_finish(&w->real_time);
    side_finish(&w->reference);
}
