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
    size_t count;
    void (*task)(void *context, size_t index);
    void *context;
} work;

static void *run(void *argument)
{
    work *w = argument;
    for (size_t i; (i = atomic_fetch_add(&w->next, 1)) < w->count;)
        w->task(w->context, i);
    return NULL;
}

void parallel_for(size_t count, void (*task)(void *context, size_t index), void *context)
{
    work w = { .count = count, .task = task, .context = context };
    pthread_t threads[THREADS_MAX];
    unsigned wanted = threads_available(), made = 0;
    if (wanted > count)
        wanted = (unsigned)count;
    while (made + 1 < wanted && pthread_create(&threads[made], NULL, run, &w) == 0)
        made++;
    run(&w);
    for (unsigned i = 0; i < made; i++)
        pthread_join(threads[i], NULL);
}
