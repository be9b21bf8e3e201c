// A worker: a thread that does one job at a time, beside that of the window.
#include "worker.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SENTENCES_MAX = 16 };

typedef struct said {
    ag_log_level level;
    char text[WORKER_SENTENCE_MAX];
} said;

struct worker {
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    void (*wake)(void);
    worker_job job; // NULL: nothing to do
    void *context;
    bool done, quits;
    ag_status status;
    bool busy; // of the other thread alone
    atomic_bool stop;
    said sentences[SENTENCES_MAX];
    size_t first, count;
    worker_stage stage;
};

static _Thread_local worker *running; // by this thread

static void *work(void *argument)
{
    worker *w = running = argument;
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
        w->wake();
    }
    pthread_mutex_unlock(&w->lock);
    return NULL;
}

worker *worker_create(void (*wake)(void))
{
    worker *w = calloc(1, sizeof *w);
    if (!w)
        return NULL;
    w->wake = wake;
    pthread_mutex_init(&w->lock, NULL);
    pthread_cond_init(&w->changed, NULL);
    // Signals are for the thread of the window.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    bool started = pthread_create(&w->thread, NULL, work, w) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (!started) {
        pthread_cond_destroy(&w->changed);
        pthread_mutex_destroy(&w->lock);
        free(w);
        return NULL;
    }
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

bool worker_hear(worker *w, ag_log_level *level, char sentence[WORKER_SENTENCE_MAX])
{
    pthread_mutex_lock(&w->lock);
    bool any = w->count > 0;
    if (any) {
        const said *s = &w->sentences[w->first];
        *level = s->level;
        memcpy(sentence, s->text, sizeof s->text);
        w->first = (w->first + 1) % SENTENCES_MAX;
        w->count--;
    }
    pthread_mutex_unlock(&w->lock);
    return any;
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
        w->wake();
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

// A scene keeps the log of the loader, whoever reads it: it is the thread that says something.
// The oldest gives way: what matters is said last.  That it was stopped, who stopped it knows.
static void say(void *user, ag_log_level level, const char *sentence)
{
    worker *w = running ? running : user;
    if (worker_is_stopped(w))
        return;
    pthread_mutex_lock(&w->lock);
    if (w->count == SENTENCES_MAX) {
        w->first = (w->first + 1) % SENTENCES_MAX;
        w->count--;
    }
    said *s = &w->sentences[(w->first + w->count++) % SENTENCES_MAX];
    s->level = level;
    snprintf(s->text, sizeof s->text, "%s", sentence);
    pthread_mutex_unlock(&w->lock);
    w->wake();
}

ag_log worker_log(worker *w, ag_log_level level)
{
    return (ag_log) { .write = say, .user = w, .level = level };
}
