// The screen: one window of the desktop, and what the user does in it.
//
// Threads: the main thread's, but for screen_wake and screen_surface.
#ifndef VIEWER_SCREEN_H
#define VIEWER_SCREEN_H

#include "keys.h"

#include <argand/base.h>

typedef enum screen_event_kind {
    SCREEN_KEY, // pressed or repeated
    SCREEN_BUTTON,
    SCREEN_MOTION,
    SCREEN_WHEEL,
    SCREEN_DROP, // of a file
} screen_event_kind;

typedef enum screen_button {
    SCREEN_LEFT,
    SCREEN_RIGHT,
    SCREEN_MIDDLE,
} screen_button;

typedef struct screen_event {
    screen_event_kind kind;
    unsigned modifiers; // KEY_SHIFT and so on
    double at[2];       // px, of the pointer
    uint32_t key;       // as keys.h counts them
    screen_button button;
    bool down;
    double steps; // of the wheel, away from the user
    char *path;   // of a drop; the receiver's to free()
} screen_event;

typedef struct screen screen;

// Open a window.  AG_ERROR_DEVICE where there is no display.
ag_status screen_create(const ag_log *log, const char *title, uint32_t width, uint32_t height,
                        screen **made);
void screen_destroy(screen *s); // NULL is allowed

// Wait until something happens or `seconds` have passed; below 0: without end.
void screen_wait(screen *s, double seconds);

// Any thread: let screen_wait return.
void screen_wake(void);

// The next event; false: there is none.
bool screen_event_next(screen *s, screen_event *event);

// px; 0 while nothing of it is seen.
void screen_size(const screen *s, uint32_t *width, uint32_t *height);

// Of letters: 2 on a display of twice the density.
float screen_scale(const screen *s);

// Where the pointer is, px; false: outside.
bool screen_pointer(const screen *s, double at[2]);

// Whether a key stands pressed, by its place: 'W' is where a US keyboard has it.
bool screen_held(const screen *s, char letter);

bool screen_closing(const screen *s);

// True once after the system asked for the window to be drawn again.
bool screen_damaged(screen *s);

void screen_set_title(screen *s, const char *title);
void screen_toggle_full(screen *s);
void screen_hide(screen *s);

// Any thread: make its Vulkan surface, as ag_window_desc wants it; `user` is the screen.
int screen_surface(void *user, void *instance, void *surface);

double screen_time(void); // s

#endif
