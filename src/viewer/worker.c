// Workers: threads that do one job at a time each, beside that of the window.
#include "worker.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { SENTENCES_MAX = 32 };

typedef struct said {
    ag_log_level level;
    char text[CREW_SENTENCE_MAX];
} said;

struct crew {
    pthread_mutex_t lock;
    void (*wake)(void);
    worker *workers;
    said sentences[SENTENCES_MAX];
    size_t first, count;
};

struct worker {
    crew *crew;
    worker *next; // of the crew
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    worker_job job; // NULL: nothing to do
    void *context;
    bool done, quits;
    ag_status status;
    bool busy; // of the other thread alone
    atomic_bool stop;
    worker_stage stage;
};

// ---- The crew ------------------------------------------------------------------

crew *crew_create(void (*wake)(void))
{
    crew *c = calloc(1, sizeof *c);
    if (!c)
        return NULL;
    c->wake = wake;
    pthread_mutex_init(&c->lock, NULL);
    return c;
}

void crew_destroy(crew *c)
{
    if (!c)
        return;
    pthread_mutex_destroy(&c->lock);
    free(c);
}

// The caller has the lock.
static bool speaker_is_stopped(const crew *c)
{
    for (const worker *w = c->workers; w; w = w->next)
        if (pthread_equal(w->thread, pthread_self()))
            return worker_is_stopped(w);
    return false; // the window's thread
}

// The oldest gives way: what matters is said last.  That it was stopped, who stopped it knows.
static void say(void *user, ag_log_level level, const char *sentence)
{
    crew *c = user;
    pthread_mutex_lock(&c->lock);
    bool heard = !speaker_is_stopped(c);
    if (heard && c->count == SENTENCES_MAX) {
        c->first = (c->first + 1) % SENTENCES_MAX;
        c->count--;
    }
    if (heard) {
        said *s = &c->sentences[(c->first + c->count++) % SENTENCES_MAX];
        s->level = level;
        snprintf(s->text, sizeof s->text, "%s", sentence);
    }
    pthread_mutex_unlock(&c->lock);
    if (heard)
        c->wake();
}

ag_log crew_log(crew *c, ag_log_level level)
{
    return (ag_log) { .write = say, .user = c, .level = level };
}

bool crew_hear(crew *c, ag_log_level *level, char sentence[CREW_SENTENCE_MAX])
{
    pthread_mutex_lock(&c->lock);
    bool any = c->count > 0;
    if (any) {
        const said *s = &c->sentences[c->first];
        *level = s->level;
        memcpy(sentence, s->text, sizeof s->text);
        c->first = (c->first + 1) % SENTENCES_MAX;
        c->count--;
    }
    pthread_mutex_unlock(&c->lock);
    return any;
}

// ---- Its workers ---------------------------------------------------------------

static void *work(void *argument)
{
    worker *w = argument;
    pthread_mutex_lock(&w->lock);
    for (;;) {
        while (!w->job && !w->quits)
            pthread_cond_wait(&w->changed, &w->lock);
        if (!w->job)
            break;
        worker_job job = w->job;
        pthread_mutex_unlock(&w->lock);
        ag_status status = job(w->context, w);
        pthread_mutex_lock(&w->lock);
        w->job = NULL;
        w->status = status;
        w->done = true;
        pthread_cond_broadcast(&w->changed);
        w->crew->wake();
    }
    pthread_mutex_unlock(&w->lock);
    return NULL;
}

// Signals are for the thread of the window.
static bool start_thread(worker *w)
{
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    bool started = pthread_create(&w->thread, NULL, work, w) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

static void join_crew(worker *w, crew *c)
{
    pthread_mutex_lock(&c->lock);
    w->next = c->workers;
    c->workers = w;
    pthread_mutex_unlock(&c->lock);
}

static void leave_crew(const worker *w)
{
    crew *c = w->crew;
    pthread_mutex_lock(&c->lock);
    worker **at = &c->workers;
    while (*at != w)
        at = &(*at)->next;
    *at = w->next;
    pthread_mutex_unlock(&c->lock);
}

worker *worker_create(crew *c)
{
    worker *w = calloc(1, sizeof *w);
    if (!w)
        return NULL;
    w->crew = c;
    pthread_mutex_init(&w->lock, NULL);
    pthread_cond_init(&w->changed, NULL);
    if (!start_thread(w)) {
        pthread_cond_destroy(&w->changed);
        pthread_mutex_destroy(&w->lock);
        free(w);
        return NULL;
    }
    join_crew(w, c);
    return w;
}

void worker_destroy(worker *w)
{
    if (!w)
        return;
    atomic_store(&w->stop, true);
    pthread_mutex_lock(&w->lock);
    w->quits = true;
    pthread_cond_broadcast(&w->changed);
    pthread_mutex_unlock(&w->lock);
    pthread_join(w->thread, NULL);
    leave_crew(w);
    pthread_cond_destroy(&w->changed);
    pthread_mutex_destroy(&w->lock);
    free(w);
}

void worker_start(worker *w, worker_job job, void *context)
{
    pthread_mutex_lock(&w->lock);
    atomic_store(&w->stop, false);
    w->busy = true;
    w->done = false;
    w->job = job;
    w->context = context;
    w->stage = (worker_stage) { 0 };
    pthread_cond_broadcast(&w->changed);
    pthread_mutex_unlock(&w->lock);
}

bool worker_is_busy(const worker *w)
{
    return w->busy;
}

bool worker_collect(worker *w, ag_status *status)
{
    pthread_mutex_lock(&w->lock);
    bool done = w->done;
    w->done = false;
    *status = w->status;
    pthread_mutex_unlock(&w->lock);
    if (done)
        w->busy = false;
    return done;
}

void worker_stop(worker *w)
{
    atomic_store(&w->stop, true);
}

void worker_wait(worker *w)
{
    pthread_mutex_lock(&w->lock);
    while (w->job)
        pthread_cond_wait(&w->changed, &w->lock);
    pthread_mutex_unlock(&w->lock);
}

bool worker_ends(worker *w, double seconds)
{
    struct timespec until;
    timespec_get(&until, TIME_UTC);
    long long ns = until.tv_nsec + (long long)(seconds * 1e9);
    until.tv_sec += (time_t)(ns / 1000000000);
    until.tv_nsec = (long)(ns % 1000000000);
    pthread_mutex_lock(&w->lock);
    while (w->job && pthread_cond_timedwait(&w->changed, &w->lock, &until) == 0)
        continue;
    bool ended = !w->job;
    pthread_mutex_unlock(&w->lock);
    return ended;
}

worker_stage worker_at(worker *w)
{
    pthread_mutex_lock(&w->lock);
    worker_stage stage = w->stage;
    pthread_mutex_unlock(&w->lock);
    return stage;
}

// ---- For the job ---------------------------------------------------------------

bool worker_is_stopped(const worker *w)
{
    return atomic_load(&w->stop);
}

void worker_tell(worker *w, const char *stage, double fraction)
{
    enum { STEPS = 50 }; // of a bar: more are not worth a wakeup
    pthread_mutex_lock(&w->lock);
    bool news = strcmp(stage, w->stage.name) != 0 ||
                (int)(fraction * STEPS) != (int)(w->stage.fraction * STEPS);
    if (news) {
        snprintf(w->stage.name, sizeof w->stage.name, "%s", stage);
        w->stage.fraction = fraction;
    }
    pthread_mutex_unlock(&w->lock);
    if (news)
        w->crew->wake();
}

static bool update(void *user, const char *stage, double fraction)
{
    worker_tell(user, stage, fraction);
    return !worker_is_stopped(user);
}

ag_progress worker_progress(worker *w)
{
    return (ag_progress) { .update = update, .user = w };
}
