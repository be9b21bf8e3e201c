// What every part of Argand shares: status codes, the log, progress, the version.
#ifndef ARGAND_BASE_H
#define ARGAND_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define AG_VERSION_MAJOR 0
#define AG_VERSION_MINOR 1
#define AG_VERSION_PATCH 0

#define AG_API __attribute__((visibility("default")))
#define AG_CHECK __attribute__((visibility("default"), warn_unused_result))

// How a call ended.  Whatever can fail returns one; it must be looked at.  On
// failure nothing has changed, the result parameter is NULL or zero, and one
// finished sentence that says what, where and the way out has gone to the log.
typedef enum ag_status {
    AG_OK = 0,
    AG_ERROR_ARGUMENT,    // a value outside what the function documents
    AG_ERROR_MEMORY,      // out of memory, on the host or on the device
    AG_ERROR_FILE,        // missing, unreadable or unwritable
    AG_ERROR_FORMAT,      // the contents are broken
    AG_ERROR_UNSUPPORTED, // the contents are sound, but need what Argand lacks
    AG_ERROR_DEVICE,      // no usable Vulkan device, or the device was lost
    AG_ERROR_CANCELLED,   // the progress callback said stop
} ag_status;

// The name of a status, "format error" say.  Static storage, never NULL.
AG_API const char *ag_status_name(ag_status status);

// The library's version as "major.minor.patch".  Static storage.
AG_API const char *ag_version(void);

typedef enum ag_log_level {
    AG_LOG_ERROR = 1, // why a call failed
    AG_LOG_WARNING,   // the call succeeds, but something was skipped or mended
    AG_LOG_INFO,      // what was chosen: device, caches
    AG_LOG_DEBUG,
} ag_log_level;

// Where sentences go.  Copied at creation; `user` is borrowed for the life of
// the object.  Zero means: errors and warnings to stderr.
//
// Threads: `write` is only called on the thread that called Argand, inside that
// call.  The one exception are driver messages under validation, which may come
// from a driver's thread.
typedef struct ag_log {
    void (*write)(void *user, ag_log_level level, const char *sentence);
    void *user;
    ag_log_level level; // the most talkative level wanted; 0 -> AG_LOG_WARNING
} ag_log;

// How far a long call is.  Return false to stop it: it fails then with
// AG_ERROR_CANCELLED.  NULL = not wanted.  Called on the calling thread.
typedef struct ag_progress {
    bool (*update)(void *user, const char *stage, double fraction); // fraction in [0, 1]
    void *user;
} ag_progress;

#ifdef __cplusplus
}
#endif
#endif
