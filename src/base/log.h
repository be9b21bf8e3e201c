// Sentences on their way to the caller's log.
#ifndef AG_BASE_LOG_H
#define AG_BASE_LOG_H

#include <argand/base.h>

// The caller's log with its defaults filled in; NULL -> stderr.
ag_log log_resolve(const ag_log *log);

__attribute__((format(printf, 3, 4))) void log_write(const ag_log *log, ag_log_level level,
                                                     const char *format, ...);

// Log an error and hand its status on: `return log_fail(log, AG_ERROR_FILE, ...)`.
__attribute__((format(printf, 3, 4), warn_unused_result)) ag_status
log_fail(const ag_log *log, ag_status status, const char *format, ...);

// Keeps the first error of code that runs on worker threads, where the caller's log
// may not be called; not thread-safe itself: one per worker.
typedef struct log_buffer {
    char text[1024];
    ag_log_level level; // of the sentence held; 0 = none
} log_buffer;

// A log that fills `buffer`.
ag_log log_to_buffer(log_buffer *buffer);

// Hand what a buffer holds to `log`, on the caller's thread.
void log_flush(const ag_log *log, log_buffer *buffer);

#endif
