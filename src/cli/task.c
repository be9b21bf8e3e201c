// One call that runs beside the main thread.
#include "task.h"

#include <signal.h>
#include <sys/resource.h>
#include <time.h>

double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

uint64_t peak_memory_bytes(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (uint64_t)usage.ru_maxrss * 1024 : 0;
}

static void *run(void *argument)
{
    task *t = argument;
    double start = now_ms();
    ag_log log = console_log(&t->console);
    t->status = t->run(t->context, &log);
    t->ms = now_ms() - start;
    return NULL;
}

void task_start(task *t, ag_log_level level, ag_status (*call)(void *, const ag_log *),
                void *context)
{
    *t = (task) { .run = call, .context = context };
    console_init(&t->console, level, true);
    // The thread, and those that a driver makes on it, leave signals to the main thread,
    // which holds them back while a file is being written.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    t->started = pthread_create(&t->thread, NULL, run, t) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (!t->started)
        run(t);
}

ag_status task_wait(task *t)
{
    if (t->started)
        pthread_join(t->thread, NULL);
    t->started = false;
    return t->status;
}

ag_status task_join(task *t, console *shown)
{
    if (!t->run || t->joined)
        return t->status;
    task_wait(t);
    t->joined = true;
    console_replay(&t->console, shown);
    return t->status;
}

void task_finish(task *t)
{
    if (t->run)
        console_finish(&t->console);
}
