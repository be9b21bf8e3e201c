// A worker: a thread that does one job at a time, beside that of the window.
//
// Threads: the functions of the first group belong to the thread that made it, those of the
// second to the job.
#ifndef VIEWER_WORKER_H
#define VIEWER_WORKER_H

#include <argand/base.h>

typedef struct worker worker;
typedef ag_status (*worker_job)(void *context, worker *self);

// `wake` is called on the worker's thread when there is news.  NULL: no thread, no memory.
worker *worker_create(void (*wake)(void));
void worker_destroy(worker *w); // stops its job and waits; NULL is allowed

// Start a job; the worker is not busy.
void worker_start(worker *w, worker_job job, void *context);

// From the start of a job until it is collected.
bool worker_is_busy(const worker *w);

// True once after each job has ended, with its status.
bool worker_collect(worker *w, ag_status *status);

// Ask the job to end early; it is collected as ever, and says nothing more.
void worker_stop(worker *w);

// Wait for the end of the job; it is still to be collected.
void worker_wait(worker *w);

enum { WORKER_SENTENCE_MAX = 1024 };

// The next sentence that was said, oldest first; false: there is none.
bool worker_hear(worker *w, ag_log_level *level, char sentence[WORKER_SENTENCE_MAX]);

typedef struct worker_stage {
    char name[32]; // "" -> none was told
    double fraction;
} worker_stage;

worker_stage worker_at(worker *w);

// ---- For the job ---------------------------------------------------------------

bool worker_is_stopped(const worker *w);
void worker_tell(worker *w, const char *stage, double fraction);
ag_log worker_log(worker *w, ag_log_level level);
ag_progress worker_progress(worker *w); // tells, and ends calls when the worker is stopped

#endif
