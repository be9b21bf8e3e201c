// A worker: a thread that does one job at a time, beside that of the window.  A crew: all of
// them, and what they say.
//
// Threads: the functions of the first two groups belong to the thread that made the crew, those
// of the third to the job.
#ifndef VIEWER_WORKER_H
#define VIEWER_WORKER_H

#include <argand/base.h>

typedef struct crew crew;

// `wake` is called on a worker's thread when there is news.  NULL: no memory.
crew *crew_create(void (*wake)(void));
void crew_destroy(crew *c); // after its workers; NULL is allowed

// A log for all threads of the crew: a scene keeps the one that it was loaded with, whoever
// reads it.  What a worker says that is to stop is not heard.
ag_log crew_log(crew *c, ag_log_level level);

enum { CREW_SENTENCE_MAX = 1024 };

// The next sentence that was said, oldest first; false: there is none.
bool crew_hear(crew *c, ag_log_level *level, char sentence[CREW_SENTENCE_MAX]);

// ---- Workers -------------------------------------------------------------------

typedef struct worker worker;
typedef ag_status (*worker_job)(void *context, worker *self);

// NULL: no thread, no memory.
worker *worker_create(crew *c);
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
bool worker_ends(worker *w, double seconds); // so long at most; whether it has ended

typedef struct worker_stage {
    char name[32]; // "" -> none was told
    double fraction;
} worker_stage;

worker_stage worker_at(worker *w);

// ---- For the job ---------------------------------------------------------------

bool worker_is_stopped(const worker *w);
void worker_tell(worker *w, const char *stage, double fraction);
ag_progress worker_progress(worker *w); // tells, and ends calls when the worker is stopped

#endif
