// The picture: what is drawn when, how finely, and what lies over it.
#include "state.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SAMPLES_ENOUGH = 4096, DEVICE_ATTEMPTS = 3 };
static const double budget_ms = 40; // of a frame while something moves
static const double rest_s = 0.15;  // without motion until the picture is sharp again
static const double settled_ev = 0.004;
static const float split_width = 2; // px
static const float backdrop[3] = { 0.11f, 0.115f, 0.125f };

static bool rests(const viewer *v)
{
    return v->now >= v->moved + rest_s;
}

// ---- The eye -----------------------------------------------------------------

static bool adapts(const viewer *v)
{
    const eye *e = &v->eye;
    return e->automatic && isfinite(e->ev100) &&
           fabs((double)(e->target_ev100 - e->ev100)) > settled_ev;
}

static void adapt(viewer *v)
{
    eye *e = &v->eye;
    double seconds = v->now - e->stepped;
    e->stepped = v->now;
    if (!adapts(v))
        return;
    // While it stood still it was not looking.
    e->ev100 = ag_eye_adapt(NULL, e->ev100, e->target_ev100, seconds < 0.1 ? (float)seconds : 0.1f);
    if (!adapts(v))
        e->ev100 = e->target_ev100;
    e->exposure = ag_exposure_from_ev100(e->ev100);
    v->picture_stale = true;
    v->truth.stale = true;
}

static void see(viewer *v, float ev100)
{
    eye *e = &v->eye;
    e->target_ev100 = ev100;
    if (!isfinite(e->ev100)) { // painted so already
        e->ev100 = ev100;
        e->exposure = ag_exposure_from_ev100(ev100);
    }
}

// ---- After an order ------------------------------------------------------------

static bool is_complete(const viewer *v)
{
    return v->document.scene && !worker_is_busy(v->loading.worker) && !v->loading.ready;
}

static void count_frame(viewer *v, const paint_result *result)
{
    viewer_report *report = v->report;
    if (is_complete(v) && report->scene_shown_ms <= 0)
        report->scene_shown_ms = v->now * 1e3;
    if (!is_complete(v) || v->frame_count >= v->setup->frames)
        return;
    v->frame_ms[v->frame_count++] = result->ms;
    if (v->frame_count == v->setup->frames && v->setup->exits)
        v->quits = true;
}

static void take_times(viewer *v, const paint_result *result)
{
    uint32_t width = v->ordered.options.width, height = v->ordered.options.height;
    double mpx = (double)width * height * 1e-6;
    double since = v->now - v->painted;
    v->painted = v->now;
    v->shown.frame_ms = result->ms;
    v->shown.fps = since > 0 && since < 1 ? 1 / since : 0;
    v->shown.stats = result->stats;
    v->shown.width = width;
    v->shown.height = height;
    v->layers_stale |= v->shown.status; // at rest it tells of this frame, too
    // Frames in which something was prepared tell nothing about the next one.
    if (result->stats.compile_ms + result->stats.upload_ms + result->stats.bake_ms < 5)
        v->ms_per_mpx = result->ms / mpx;
}

// Of pictures in a row, while something moves, none is worth a sentence.
static void tell_view(const viewer *v)
{
    const ag_camera_desc *c = &v->ordered_camera;
    if (v->rough || v->moving || v->setup->frames)
        return;
    viewer_tell(v, "shown: %u × %u px, from %g %g %g m to %g %g %g m, %s", v->shown.width,
                v->shown.height, (double)c->position[0], (double)c->position[1],
                (double)c->position[2], (double)c->target[0], (double)c->target[1],
                (double)c->target[2], c->height_m > 0 ? "orthographic" : "perspective");
}

static void lose_device(viewer *v, ag_status status)
{
    if (status != AG_ERROR_DEVICE || ++v->losses == DEVICE_ATTEMPTS ||
        v->report->first_pixels_ms <= 0) {
        v->failed = status;
        v->quits = v->report->first_pixels_ms <= 0 || status == AG_ERROR_DEVICE || v->setup->frames;
        return;
    }
    viewer_say(v, true, "the device was lost and is opened again");
    viewer_redraw(v);
}

static void collect_painted(viewer *v)
{
    ag_status status;
    paint_result result;
    if (!painter_collect(v->painter, &status, &result))
        return;
    v->shown.device = painter_device(v->painter);
    v->orders++;
    if (v->answers && v->orders - v->asked > v->report->answer_frames)
        v->report->answer_frames = v->orders - v->asked;
    if (status) {
        lose_device(v, status);
        return;
    }
    v->losses = 0;
    v->failed = AG_OK;
    if (v->report->first_pixels_ms <= 0)
        v->report->first_pixels_ms = v->now * 1e3;
    if (!result.has_picture)
        return;
    if (v->ordered.meters)
        see(v, result.ev100);
    take_times(v, &result);
    count_frame(v, &result);
    tell_view(v);
    if (result.kept)
        actions_keep(v, result.kept);
}

static void take_truth(viewer *v, const trace_result *result)
{
    truth *t = &v->truth;
    if (!result->picture || t->stale || !t->wanted) {
        ag_image_destroy(result->picture);
        return;
    }
    ag_image_destroy(t->picture);
    t->picture = result->picture;
    t->version++;
    t->samples = result->samples;
    t->noise = result->noise;
    if (result->compared) {
        t->flip = result->flip;
        viewer_tell(v, "FLIP to the reference of %u samples: %.4f", t->samples, (double)t->flip);
    }
    v->layers_stale = true;
}

static void collect_traced(viewer *v)
{
    ag_status status;
    trace_result result;
    if (worker_is_busy(painter_worker(v->painter)) || !tracer_collect(v->tracer, &status, &result))
        return; // the painter may be reading the last one
    take_truth(v, &result);
    v->truth.wanted &= !status; // it has been said why
}

void picture_collect(viewer *v)
{
    collect_painted(v);
    collect_traced(v);
}

// ---- An order --------------------------------------------------------------------

// The share of the window's resolution at which a frame comes in time.
static double choose_scale(const viewer *v, uint32_t width, uint32_t height)
{
    static const double scales[] = { 1, 0.75, 0.5, 0.375, 0.25 };
    double full_ms = v->ms_per_mpx * width * height * 1e-6;
    size_t i = 0;
    if (!rests(v) && v->setup->frames == 0)
        while (i + 1 < sizeof scales / sizeof *scales &&
               full_ms * scales[i] * scales[i] > budget_ms)
            i++;
    return scales[i];
}

static uint32_t scaled_px(uint32_t size, double scale)
{
    uint32_t px = (uint32_t)(size * scale + 0.5);
    return px ? px : 1;
}

// The real-time picture of what is traced.
static bool lacks_beside(const viewer *v)
{
    return v->truth.wanted && !v->truth.stale && !v->truth.beside;
}

static void set_options(viewer *v, paint_order *o, uint32_t width, uint32_t height)
{
    double scale = choose_scale(v, width, height);
    v->rough = scale < 1;
    o->options = v->document.look;
    o->options.width = scaled_px(width, scale);
    o->options.height = scaled_px(height, scale);
    o->options.exposure = v->eye.exposure;
    o->meters = v->meters && v->eye.automatic;
    o->metering = v->eye.metering;
    o->adapts = o->meters && !isfinite(v->eye.ev100);
    o->keeps = !v->rough && (v->shoots || lacks_beside(v));
}

static void put_truth(const viewer *v, ag_show_options *show, ag_layer *layers)
{
    const truth *t = &v->truth;
    const float x = (float)(int)(t->split * show->width), height = (float)show->height;
    if (!t->wanted)
        return;
    if (t->picture && !t->stale)
        layers[show->layer_count++] = (ag_layer) { .image = t->picture,
                                                   .width = (float)show->width,
                                                   .height = height,
                                                   .clip = { x, 0, (float)show->width, height },
                                                   .version = t->version };
    layers[show->layer_count++] = (ag_layer) { .image = v->white,
                                               .x = x - split_width / 2,
                                               .width = split_width,
                                               .height = height,
                                               .version = 1 };
}

static void put_stage(viewer *v)
{
    hud_state *s = &v->shown;
    s->stage[0] = 0;
    if (worker_is_busy(v->loading.worker)) {
        worker_stage at = worker_at(v->loading.worker);
        snprintf(s->stage, sizeof s->stage, "%s %.200s", at.name[0] ? at.name : "load",
                 v->loading.input);
        s->fraction = at.fraction;
    } else if (v->first && v->document.scene) {
        snprintf(s->stage, sizeof s->stage, "bring to the device");
        s->fraction = 1;
    }
}

static void put_words(viewer *v, ag_show_options *show, ag_layer *layers)
{
    hud_state *s = &v->shown;
    s->ev100 = ag_ev100_from_exposure(v->eye.exposure);
    s->traces = v->truth.wanted;
    s->samples = v->truth.samples;
    s->noise = v->truth.noise;
    s->flip = v->truth.flip;
    snprintf(s->message, sizeof s->message, "%s", v->message.text);
    s->alarm = v->message.alarm;
    actions_describe(v, s);
    picking_describe(v, s);
    put_stage(v);
    const panel_room room = { show->width, show->height, screen_scale(v->screen) };
    show->layer_count += hud_compose(v->hud, s, room, layers + show->layer_count);
}

static bool forced(const viewer *v)
{
    return is_complete(v) && v->frame_count < v->setup->frames;
}

void picture_begin(viewer *v)
{
    uint32_t width, height;
    screen_size(v->screen, &width, &height);
    v->hidden = !width || !height;
    if (v->quits || v->hidden || worker_is_busy(painter_worker(v->painter)))
        return;
    adapt(v);
    if (width != v->navigation.width || height != v->navigation.height)
        viewer_redraw(v);
    bool settles = v->rough && rests(v);
    bool owes = v->document.scene && lacks_beside(v) && !v->rough;
    v->picture_stale |= settles || owes || v->shoots || forced(v);
    if (!v->picture_stale && !v->layers_stale)
        return;
    navigation_resize(&v->navigation, width, height);
    paint_order *o = &v->ordered;
    *o = (paint_order) { .show = { .width = width, .height = height } };
    memcpy(o->show.backdrop, backdrop, sizeof backdrop);
    bool draws = v->picture_stale && v->document.scene && !v->first;
    if (draws) {
        o->scene = v->document.scene;
        o->camera = v->ordered_camera = navigation_camera(&v->navigation);
        set_options(v, o, width, height);
        v->meters = false;
    }
    put_truth(v, &o->show, o->layers);
    o->show.layer_count += picking_marks(v, &o->show, o->layers + o->show.layer_count);
    put_words(v, &o->show, o->layers);
    // Before the first frame, which may take long, it is said that it will come.
    v->picture_stale = v->document.scene && v->first;
    v->first = false;
    v->layers_stale = false;
    v->answers = v->asks && (draws || !v->picture_stale);
    v->asks &= !v->answers;
    painter_begin(v->painter, o);
}

double picture_next(const viewer *v)
{
    double next = -1;
    if (!worker_is_busy(painter_worker(v->painter)) &&
        (v->picture_stale || v->layers_stale || v->moving || adapts(v) || forced(v)))
        return v->hidden ? 0.1 : 0;
    const double moments[] = {
        v->watching.next,
        v->message.text[0] ? v->message.until : 0,
        v->rough || v->truth.wanted ? v->moved + rest_s : 0,
        v->rests_at,
    };
    for (size_t i = 0; i < sizeof moments / sizeof *moments; i++) {
        double wait = moments[i] - v->now;
        if (wait > 0 && (next < 0 || wait < next)) // what is over has been seen to
            next = wait > 0.001 ? wait : 0.001;
    }
    return next;
}

// ---- The ground truth --------------------------------------------------------------

static void drop_truth(viewer *v)
{
    truth *t = &v->truth;
    ag_image_destroy(t->picture);
    ag_image_destroy(t->beside);
    t->picture = t->beside = NULL;
    t->samples = 0;
    t->noise = 0;
    t->flip = -1;
    v->layers_stale = true;
}

void picture_follow_truth(viewer *v)
{
    truth *t = &v->truth;
    worker *w = tracer_worker(v->tracer);
    if (worker_is_busy(w) && (t->stale || !t->wanted))
        worker_stop(w);
    if (worker_is_busy(painter_worker(v->painter)) || worker_is_busy(w))
        return; // they read the pictures
    bool sharp = rests(v) && !v->picture_stale && !v->rough;
    if (t->stale && (t->picture || t->beside))
        drop_truth(v);
    if (!t->wanted || !v->document.scene || !sharp || adapts(v) || v->first || v->loading.ready ||
        (!t->stale && t->samples >= SAMPLES_ENOUGH))
        return;
    trace_order o = { .scene = v->document.scene,
                      .camera = v->ordered_camera,
                      .picture = v->document.look,
                      .again = t->stale || !t->picture,
                      .beside = t->beside };
    screen_size(v->screen, &o.picture.width, &o.picture.height);
    o.picture.exposure = v->eye.exposure;
    if (!o.picture.width || !o.picture.height)
        return;
    t->stale = false;
    tracer_begin(v->tracer, &o);
}
