// What the user sees while a command runs: sentences and a progress bar, both on standard
// error.  A console belongs to the main thread; other threads get their own, which keeps
// its sentences until they are joined.
#ifndef CLI_CONSOLE_H
#define CLI_CONSOLE_H

#include <argand/argand.h>

#include <pthread.h>

typedef struct sentence {
    ag_log_level level;
    char *text;
} sentence;

typedef struct console {
    pthread_mutex_t lock; // drivers may speak from threads of their own
    ag_log_level level;   // the most talkative level shown
    bool bar;             // draw progress
    bool bar_drawn;       // a bar stands on the terminal's last line
    char stage[24];       // what the bar shows
    char detail[80];
    int percent;
    bool keeping;    // keep sentences instead of showing them
    ag_log heard_by; // write NULL: nobody else; borrowed
    ag_progress followed_by;
    sentence *kept;
    size_t kept_count, kept_capacity;
    size_t kept_lost; // no memory, or more than anybody reads
} console;

// `keeping`: until console_replay.  Finish with console_finish.
void console_init(console *console, ag_log_level level, bool keeping);
void console_finish(console *console);

// Hand on to others what is said and how far it is, from now on, instead of showing it.
void console_relay(console *console, const ag_log *log, const ag_progress *progress);

// Show a progress bar from now on if standard error is a terminal.
void console_allow_bar(console *console);

// The library's view of it.  Borrows the console.
ag_log console_log(console *console);
ag_progress console_progress(console *console);

__attribute__((format(printf, 3, 4))) void console_say(console *console, ag_log_level level,
                                                       const char *format, ...);

// Move the bar; `fraction` in [0, 1].
void console_stage(console *console, const char *stage, double fraction);

// The same with up to 36 letters behind a shorter bar.
void console_stage_detail(console *console, const char *stage, double fraction, const char *detail);

// Take the bar away.
void console_clear(console *console);

// Show on `to` what `from` kept, and from now on show what it is told at once.
void console_replay(console *from, console *to);

#endif
