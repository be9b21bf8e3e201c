// Sentences on their way to the caller's log.
#include "base/log.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void write_stderr(void *user, ag_log_level level, const char *sentence)
{
    (void)user;
    static const char *const label[] = { "", "error: ", "warning: ", "", "" };
    fprintf(stderr, "argand: %s%s\n", label[level], sentence);
}

ag_log log_resolve(const ag_log *log)
{
    ag_log out = log ? *log : (ag_log) { 0 };
    if (!out.write)
        out.write = write_stderr;
    if (!out.level)
        out.level = AG_LOG_WARNING;
    return out;
}

static void write_list(const ag_log *log, ag_log_level level, const char *format, va_list args)
{
    ag_log to = log_resolve(log);
    if (level > to.level)
        return;
    char text[1024];
    vsnprintf(text, sizeof text, format, args);
    to.write(to.user, level, text);
}

void log_write(const ag_log *log, ag_log_level level, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    write_list(log, level, format, args);
    va_end(args);
}

ag_status log_fail(const ag_log *log, ag_status status, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    write_list(log, AG_LOG_ERROR, format, args);
    va_end(args);
    return status;
}

static void write_buffer(void *user, ag_log_level level, const char *sentence)
{
    log_buffer *buffer = user;
    if (buffer->level && buffer->level <= level)
        return;
    buffer->level = level;
    snprintf(buffer->text, sizeof buffer->text, "%s", sentence);
}

ag_log log_to_buffer(log_buffer *buffer)
{
    return (ag_log) { .write = write_buffer, .user = buffer, .level = AG_LOG_WARNING };
}

void log_flush(const ag_log *log, log_buffer *buffer)
{
    if (buffer->level)
        log_write(log, buffer->level, "%s", buffer->text);
    buffer->level = 0;
}
