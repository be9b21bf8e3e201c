// Work spread over the processor's cores.
#ifndef AG_BASE_THREADS_H
#define AG_BASE_THREADS_H

#include <stddef.h>

// Cores that this process may use, at least 1.
unsigned threads_available(void);

// Call `task(context, i)` once for every i in [0, count), on up to
// `threads_available()` threads, the caller's among them, in rising order of i as
// threads become free; returns when all are done.  Where no thread can be made the
// caller does all of it.
void parallel_for(size_t count, void (*task)(void *context, size_t index), void *context);

// The same on at most `most` threads; `worker` is below that, and no two tasks run with one at a
// time.
void parallel_for_workers(unsigned most, size_t count,
                          void (*task)(void *context, size_t index, unsigned worker),
                          void *context);

#endif
