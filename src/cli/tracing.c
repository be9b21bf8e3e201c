// Path tracing with a bar, ended by an interrupt.
#include "tracing.h"

#include "task.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>

// All that a signal's handler can reach.
static volatile sig_atomic_t interrupts;

static void on_interrupt(int signal_number)
{
    (void)signal_number;
    interrupts = 1;
}

// The first interrupt asks for the end, the next one has its default effect.  Where
// interrupts are ignored, they stay so.
static void catch_interrupts(struct sigaction *before)
{
    interrupts = 0;
    struct sigaction action = {
        .sa_handler = on_interrupt,
        .sa_flags = SA_RESTART | (int)SA_RESETHAND,
    };
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, NULL, before);
    if (before->sa_handler != SIG_IGN)
        sigaction(SIGINT, &action, NULL);
}

typedef struct watch {
    console *console;
    const ag_reference *reference;
    double seconds; // to be spent; 0 = not given
    double start_ms, shown_ms;
    double fraction, end_ms; // how far it last said it was, and when it will end therefore
} watch;

static void say_left(char text[32], double seconds)
{
    int whole = seconds < 0 ? 0 : seconds < 359999 ? (int)(seconds + 0.5) : 359999;
    if (whole < 3600)
        snprintf(text, 32, ", %d:%02d left", whole / 60, whole % 60);
    else
        snprintf(text, 32, ", %d:%02d h left", whole / 3600, whole / 60 % 60);
}

static void show(const watch *w, double now)
{
    ag_reference_state state = ag_reference_describe(w->reference);
    char detail[80], noise[32] = "", left[32] = "";
    if (state.samples > 1) // else it is not known
        snprintf(noise, sizeof noise, ", %.2g %% noise", (double)state.noise * 100);
    if (w->fraction > 0.01)
        say_left(left, (w->end_ms - now) / 1e3);
    snprintf(detail, sizeof detail, "%u spp%s%s", state.samples, noise, left);
    console_stage_detail(w->console, "trace", w->fraction, detail);
}

static bool update(void *user, const char *stage, double fraction)
{
    enum { BETWEEN_MS = 100 };
    (void)stage;
    watch *w = user;
    double now = now_ms(), spent = now - w->start_ms;
    if (w->seconds > 0) // it is told only now and then
        fraction = fmax(fraction, fmin(spent / 1e3 / w->seconds, 1));
    if (fraction > w->fraction) {
        w->fraction = fraction;
        w->end_ms = w->start_ms + spent / fraction;
    }
    if (w->console->bar && now - w->shown_ms > BETWEEN_MS) {
        show(w, now);
        w->shown_ms = now;
    }
    if (interrupts)
        w->console->level = 0; // the library takes it for a failure, and would say so
    return !interrupts;
}

static ag_status end_interrupted(tracing *t, console *shown)
{
    console_clear(shown);
    if (t->state.samples == 0)
        raise(SIGINT);
    t->interrupted = true;
    console_say(shown, AG_LOG_WARNING, "interrupted: the picture has %u sample%s a pixel",
                t->state.samples, t->state.samples == 1 ? "" : "s");
    return AG_OK;
}

static ag_status gather(tracing *t, console *shown, ag_reference_goal goal)
{
    watch w = {
        .console = shown,
        .reference = t->reference,
        .seconds = goal.seconds,
        .start_ms = now_ms(),
    };
    goal.progress = (ag_progress) { .update = update, .user = &w };
    ag_log_level level = shown->level;
    struct sigaction before;
    catch_interrupts(&before);
    ag_status status = ag_reference_trace(t->reference, &goal);
    sigaction(SIGINT, &before, NULL);
    shown->level = level;
    t->state = ag_reference_describe(t->reference);
    return status == AG_ERROR_CANCELLED ? end_interrupted(t, shown) : status;
}

ag_status tracing_run(tracing *t, console *shown, const ag_scene *scene,
                      const ag_camera_desc *camera, const ag_render_options *picture,
                      const ag_reference_options *options, const ag_reference_goal *goal)
{
    *t = (tracing) { 0 };
    console_stage(shown, "prepare", 0);
    ag_status status = ag_reference_create(scene, camera, picture, options, &t->reference);
    return status ? status : gather(t, shown, *goal);
}

void tracing_finish(tracing *t)
{
    ag_reference_destroy(t->reference);
    t->reference = NULL;
}
