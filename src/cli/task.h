// One call that runs beside the main thread; what it says is heard when it is joined.
#ifndef CLI_TASK_H
#define CLI_TASK_H

#include "console.h"

typedef struct task {
    ag_status (*run)(void *context, const ag_log *log);
    void *context;
    console console; // after the join it speaks at once: what the call made may hold its log
    ag_status status;
    double ms; // wall time of the call
    pthread_t thread;
    bool started, joined;
} task;

// Start `run(context, log)`.  Where no thread can be made it runs here and now.
void task_start(task *task, ag_log_level level, ag_status (*run)(void *, const ag_log *),
                void *context);

// Wait for it; what it said stays kept.
ag_status task_wait(task *task);

// Wait for it, show on `shown` what it said, and return how it ended.  Again: the same
// status, at once.  A task that was never started ended with AG_OK.
ag_status task_join(task *task, console *shown);

// After the join, and after everything that the call made is destroyed.
void task_finish(task *task);

// Milliseconds since some fixed moment.
double now_ms(void);

// The most that the process has had in memory so far.
uint64_t peak_memory_bytes(void);

#endif
