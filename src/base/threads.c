// Work spread over the processor's cores.
#define _GNU_SOURCE
#include "base/threads.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>

enum { THREADS_MAX = 64 };

unsigned threads_available(void)
{
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) != 0)
        return 1;
    int count = CPU_COUNT(&set);
    return count < 1 ? 1 : count > THREADS_MAX ? THREADS_MAX : (unsigned)count;
}

typedef struct work {
    atomic_size_t next;
    atomic_uint workers;
    size_t count;
    void (*task)(void *context, size_t index, unsigned worker);
    void *context;
} work;

static void *run(void *argument)
{
    work *w = argument;
    unsigned worker = atomic_fetch_add(&w->workers, 1);
    for (size_t i; (i = atomic_fetch_add(&w->next, 1)) < w->count;)
        w->task(w->context, i, worker);
    return NULL;
}

void parallel_for_workers(unsigned most, size_t count,
                          void (*task)(void *context, size_t index, unsigned worker), void *context)
{
    work w = { .count = count, .task = task, .context = context };
    pthread_t threads[THREADS_MAX];
    unsigned wanted = threads_available(), made = 0;
    wanted = wanted < most ? wanted : most;
    if (wanted > count)
        wanted = (unsigned)count;
    while (made + 1 < wanted && pthread_create(&threads[made], NULL, run, &w) == 0)
        made++;
    run(&w);
    for (unsigned i = 0; i < made; i++)
        pthread_join(threads[i], NULL);
}

typedef struct plain_task {
    void (*task)(void *context, size_t index);
    void *context;
} plain_task;

static void run_plain(void *context, size_t index, unsigned worker)
{
    (void)worker;
    plain_task *plain = context;
    plain->task(plain->context, index);
}

void parallel_for(size_t count, void (*task)(void *context, size_t index), void *context)
{
    plain_task plain = { task, context };
    parallel_for_workers(THREADS_MAX, count, run_plain, &plain);
}
