// The viewer: its life from the first pixel to the last.
#include "canvas.h"
#include "state.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MESSAGE_S = 4 };

void viewer_say(viewer *v, bool alarm, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(v->message.text, sizeof v->message.text, format, args);
    va_end(args);
    v->message.alarm = alarm;
    v->message.until = v->now + (alarm ? 3 : 1) * MESSAGE_S;
    v->layers_stale = true;
    const ag_log *log = v->setup->log;
    ag_log_level level = alarm ? AG_LOG_ERROR : AG_LOG_INFO;
    if (log && log->write && level <= v->setup->level)
        log->write(log->user, level, v->message.text);
}

void viewer_tell(const viewer *v, const char *format, ...)
{
    char sentence[CREW_SENTENCE_MAX];
    const ag_log *log = v->setup->log;
    va_list args;
    va_start(args, format);
    vsnprintf(sentence, sizeof sentence, format, args);
    va_end(args);
    if (log && log->write && v->setup->level >= AG_LOG_INFO)
        log->write(log->user, AG_LOG_INFO, sentence);
}

void viewer_redraw(viewer *v)
{
    v->picture_stale = true;
    v->meters = true;
    v->truth.stale = true;
}

bool viewer_can_edit(viewer *v)
{
    if (worker_is_busy(tracer_worker(v->tracer)))
        worker_stop(tracer_worker(v->tracer));
    return !worker_is_busy(painter_worker(v->painter)) &&
           !worker_is_busy(tracer_worker(v->tracer)) && !worker_is_busy(v->saver) &&
           !worker_is_busy(v->looking.worker);
}

// ---- What the threads say --------------------------------------------------------

static void hear(viewer *v)
{
    ag_log_level level;
    char sentence[CREW_SENTENCE_MAX];
    while (crew_hear(v->crew, &level, sentence)) {
        const ag_log *log = v->setup->log;
        if (log && log->write)
            log->write(log->user, level, sentence);
        v->report->validation_messages += strncmp(sentence, "validation: ", 12) == 0;
        if (level > AG_LOG_WARNING)
            continue;
        snprintf(v->message.text, sizeof v->message.text, "%s", sentence);
        v->message.alarm = level == AG_LOG_ERROR;
        v->message.until = v->now + 3 * MESSAGE_S;
        v->layers_stale = true;
    }
    if (v->message.text[0] && v->now >= v->message.until) {
        v->message.text[0] = 0;
        v->layers_stale = true;
    }
}

// ---- Its life --------------------------------------------------------------------

static ag_status no_memory(const viewer *v)
{
    if (v->setup->log && v->setup->log->write)
        v->setup->log->write(v->setup->log->user, AG_LOG_ERROR, "no memory for the viewer");
    return AG_ERROR_MEMORY;
}

// A bright ring within a dark one: it shows on anything.
static ag_status create_ring(viewer *v)
{
    enum { SIZE = 28 };
    static uint8_t pixels[SIZE][SIZE][4];
    const canvas c = { pixels[0][0], SIZE, SIZE };
    const ag_image_desc desc = { SIZE, SIZE, AG_FORMAT_RGBA8, pixels };
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            double r = hypot(x + 0.5 - SIZE / 2, y + 0.5 - SIZE / 2);
            double bright = 1 - fabs(r - 10), dark = 1.5 - fabs(r - 10) / 2;
            double cover = dark < 0 ? 0 : dark < 1 ? dark : 1;
            double white = bright < 0 ? 0 : bright;
            uint8_t level = (uint8_t)(255 * white);
            canvas_fill(&c, (box) { (float)x, (float)y, 1, 1 }, 0,
                        (color) { level, level, level, (uint8_t)(160 * cover + 95 * white) });
        }
    return ag_image_create(v->setup->log, &desc, &v->ring);
}

static ag_status create_parts(viewer *v)
{
    const viewer_setup *setup = v->setup;
    const ag_log log = setup->log ? *setup->log : (ag_log) { 0 };
    ag_status status = screen_create(&log, "argand", setup->width, setup->height, &v->screen);
    if (status)
        return status;
    // Of each frame only what is wrong is worth a word.
    const painter_desc device = { setup->device, setup->validate, AG_LOG_WARNING };
    v->hud = hud_create(setup->log);
    v->crew = crew_create(screen_wake);
    if (!v->hud || !v->crew)
        return no_memory(v);
    v->painter = painter_create(v->screen, v->crew, &device);
    v->tracer = tracer_create(v->crew, setup->level);
    v->loading.worker = worker_create(v->crew);
    v->loading.crew = v->crew;
    v->loading.setup = setup;
    v->saver = worker_create(v->crew);
    v->looking.worker = worker_create(v->crew);
    v->frame_ms = calloc(setup->frames + 1ul, sizeof *v->frame_ms);
    if (!v->painter || !v->tracer || !v->loading.worker || !v->saver || !v->looking.worker ||
        !v->frame_ms)
        return no_memory(v);
    const uint8_t white[4] = { 255, 255, 255, 255 };
    const ag_image_desc pixel = { 1, 1, AG_FORMAT_RGBA8, white };
    status = ag_image_create(setup->log, &pixel, &v->white);
    return status ? status : create_ring(v);
}

// Jobs take a moment to end, some of them longer: nobody has to look on.  But a frame is shown to
// its end: on Wayland it may wait for the window to be seen.
static void leave(viewer *v)
{
    static const double frame_s = 0.2;
    worker_stop(v->loading.worker);
    worker_stop(tracer_worker(v->tracer));
    worker_stop(painter_worker(v->painter));
    (void)worker_ends(painter_worker(v->painter), frame_s);
    screen_hide(v->screen);
    painter_close(v->painter);
    hear(v);
}

// First everybody is stopped, then what they read is freed.
static void destroy_parts(viewer *v)
{
    painter_destroy(v->painter);
    tracer_destroy(v->tracer);
    worker_destroy(v->saver);
    worker_destroy(v->looking.worker);
    worker_destroy(v->loading.worker);
    hud_destroy(v->hud);
    ag_scene_destroy(v->loading.document.scene);
    ag_scene_destroy(v->document.scene);
    ag_image_destroy(v->truth.picture);
    ag_image_destroy(v->truth.beside);
    ag_image_destroy(v->white);
    ag_image_destroy(v->ring);
    ag_image_destroy(v->saved);
    crew_destroy(v->crew);
    screen_destroy(v->screen);
    free(v->frame_ms);
}

static void handle_events(viewer *v)
{
    screen_event event;
    while (!picking_holds(v) && screen_event_next(v->screen, &event)) {
        if (!v->asks)
            v->asked = v->orders;
        v->asks = true;
        if (event.kind == SCREEN_KEY)
            actions_do(v, keys_action(event.key, event.modifiers));
        else if (event.kind == SCREEN_DROP && event.path)
            document_load(v, event.path, false);
        else
            pointer_event(v, &event);
        free(event.path);
    }
    if (screen_damaged(v->screen))
        v->layers_stale = true;
    v->quits |= screen_closing(v->screen);
}

static void run(viewer *v)
{
    document_load(v, v->setup->input, false);
    while (!v->quits) {
        v->now = screen_time();
        hear(v);
        picking_collect(v);
        handle_events(v);
        actions_collect(v); // first who is done: then the scene may be changed
        picture_collect(v);
        document_collect(v);
        document_watch(v);
        pointer_step(v);
        picking_step(v);
        picture_follow_truth(v);
        picture_begin(v);
        if (!v->quits)
            screen_wait(v->screen, picture_next(v));
    }
}

static int by_time(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

ag_status viewer_run(const viewer_setup *setup, viewer_report *report)
{
    viewer_report unwanted;
    viewer v = { .setup = setup, .report = report ? report : &unwanted, .first = true };
    *v.report = (viewer_report) { 0 };
    v.truth.split = 0.5;
    v.truth.flip = -1;
    v.eye.ev100 = v.eye.target_ev100 = NAN;
    v.eye.exposure = 1;
    navigation_init(&v.navigation);
    ag_status status = create_parts(&v);
    if (!status) {
        run(&v);
        leave(&v);
        status = v.failed;
        if (!status && !v.document.scene && !v.loading.ready)
            status = v.loading.failed; // nothing was ever seen
    }
    if (v.frame_count) {
        qsort(v.frame_ms, v.frame_count, sizeof *v.frame_ms, by_time);
        v.report->median_frame_ms = v.frame_ms[v.frame_count / 2];
        v.report->frames = v.frame_count;
    }
    destroy_parts(&v);
    return status;
}
