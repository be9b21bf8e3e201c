// Sentences and a progress bar on standard error.
#include "console.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { BAR_WIDTH = 32, KEPT_MOST = 10000 };

void console_init(console *c, ag_log_level level, bool keeping)
{
    *c = (console) { .level = level, .keeping = keeping, .percent = -1 };
    pthread_mutex_init(&c->lock, NULL);
}

void console_finish(console *c)
{
    console_clear(c);
    for (size_t i = 0; i < c->kept_count; i++)
        free(c->kept[i].text);
    free(c->kept);
    pthread_mutex_destroy(&c->lock);
}

void console_allow_bar(console *c)
{
    const char *terminal = getenv("TERM");
    c->bar = isatty(STDERR_FILENO) && !(terminal && strcmp(terminal, "dumb") == 0);
}

void console_relay(console *c, const ag_log *log, const ag_progress *progress)
{
    pthread_mutex_lock(&c->lock);
    c->heard_by = *log;
    c->followed_by = *progress;
    pthread_mutex_unlock(&c->lock);
}

static void wipe(console *c)
{
    if (c->bar_drawn)
        fputs("\r\033[K", stderr); // ECMA-48 EL: erase to the end of the line
    c->bar_drawn = false;
}

static void show(console *c, ag_log_level level, const char *text)
{
    const char *label = level == AG_LOG_ERROR     ? "error: "
                        : level == AG_LOG_WARNING ? "warning: "
                                                  : "";
    size_t length = strlen(text);
    const char *end = length && strchr(".!?", text[length - 1]) ? "" : ".";
    wipe(c);
    fprintf(stderr, "argand: %s%s%s\n", label, text, end);
}

static void keep(console *c, ag_log_level level, const char *text)
{
    if (c->kept_count == c->kept_capacity) {
        size_t capacity = c->kept_capacity ? 2 * c->kept_capacity : 16;
        sentence *grown = capacity <= KEPT_MOST ? realloc(c->kept, capacity * sizeof *grown) : NULL;
        if (!grown) {
            c->kept_lost++;
            return;
        }
        c->kept = grown;
        c->kept_capacity = capacity;
    }
    char *copy = strdup(text);
    if (copy)
        c->kept[c->kept_count++] = (sentence) { level, copy };
    else
        c->kept_lost++;
}

static void write_sentence(void *user, ag_log_level level, const char *text)
{
    console *c = user;
    pthread_mutex_lock(&c->lock);
    if (c->keeping)
        keep(c, level, text);
    else if (c->heard_by.write)
        c->heard_by.write(c->heard_by.user, level, text);
    else if (level <= c->level)
        show(c, level, text);
    pthread_mutex_unlock(&c->lock);
}

ag_log console_log(console *c)
{
    return (ag_log) { .write = write_sentence, .user = c, .level = c->level };
}

void console_say(console *c, ag_log_level level, const char *format, ...)
{
    char text[1024];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    if (level <= c->level)
        write_sentence(c, level, text);
}

static void draw(console *c)
{
    char bar[BAR_WIDTH + 1];
    int width = *c->detail ? BAR_WIDTH / 2 : BAR_WIDTH;
    memset(bar, ' ', BAR_WIDTH);
    memset(bar, '#', (size_t)(c->percent * width / 100));
    bar[width] = 0;
    fprintf(stderr, "\r\033[K%-10s [%s] %3d %%  %s", c->stage, bar, c->percent, c->detail);
    fflush(stderr);
    c->bar_drawn = true;
}

void console_stage_detail(console *c, const char *stage, double fraction, const char *detail)
{
    if (!c->bar)
        return;
    int percent = fraction > 0 ? fraction < 1 ? (int)(fraction * 100) : 100 : 0;
    pthread_mutex_lock(&c->lock);
    if (percent != c->percent || strcmp(stage, c->stage) != 0 || strcmp(detail, c->detail) != 0 ||
        !c->bar_drawn) {
        c->percent = percent;
        snprintf(c->stage, sizeof c->stage, "%s", stage);
        snprintf(c->detail, sizeof c->detail, "%s", detail);
        draw(c);
    }
    pthread_mutex_unlock(&c->lock);
}

void console_stage(console *c, const char *stage, double fraction)
{
    console_stage_detail(c, stage, fraction, "");
}

static bool update(void *user, const char *stage, double fraction)
{
    const console *c = user;
    if (c->followed_by.update)
        return c->followed_by.update(c->followed_by.user, stage, fraction);
    console_stage(user, stage, fraction);
    return true;
}

ag_progress console_progress(console *c)
{
    return (ag_progress) { .update = update, .user = c };
}

void console_clear(console *c)
{
    pthread_mutex_lock(&c->lock);
    wipe(c);
    pthread_mutex_unlock(&c->lock);
}

void console_replay(console *from, console *to)
{
    pthread_mutex_lock(&from->lock);
    from->keeping = false;
    for (size_t i = 0; i < from->kept_count; i++) {
        console_say(to, from->kept[i].level, "%s", from->kept[i].text);
        free(from->kept[i].text);
    }
    if (from->kept_lost)
        console_say(to, AG_LOG_WARNING, "%zu more messages were lost", from->kept_lost);
    from->kept_count = 0;
    pthread_mutex_unlock(&from->lock);
}
