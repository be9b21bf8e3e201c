// A panel: rows of text on a dark plate, as an image to lay over the window.
//
// Threads: one at a time for each object.
#ifndef VIEWER_PANEL_H
#define VIEWER_PANEL_H

#include "text.h"

#include <argand/image.h>

typedef enum panel_row_kind {
    PANEL_VALUE = 0, // left: what it is; right: its value, flush right
    PANEL_KEY,       // left: the key; right: what it does
    PANEL_TITLE,     // left, and beside it, smaller, right
    PANEL_SECTION,   // left, above the rows that it heads
    PANEL_NOTE,      // left, broken into lines; below it, dimmer, right
    PANEL_ERROR,     // the same as an alarm: what happened; what to do
    PANEL_PROGRESS,  // left: the stage; right: how far; below them a bar
} panel_row_kind;

typedef struct panel_row {
    panel_row_kind kind;
    const char *left, *right; // UTF-8; NULL -> nothing
    float fraction;           // PANEL_PROGRESS: [0, 1]
} panel_row;

// What the panel may take of the window.
typedef struct panel_room {
    uint32_t width, height; // px
    float scale;            // 2 on a display of twice the density; 0 -> 1
} panel_room;

typedef struct panel panel;

// An empty panel.  `t` is borrowed; NULL (there is no font) -> panels stay empty.
ag_status panel_create(const ag_log *log, text *t, panel **made);
void panel_destroy(panel *p); // NULL is allowed

// Show these rows; none -> nothing.  Sections flow into columns where they would be too tall, and
// letters shrink to half their size before anything is cut off.  While the first row's left text
// stays, the panel never gets narrower, so that changing numbers do not make it tremble.  Where
// nothing changed nothing is done.  AG_ERROR_MEMORY keeps what was shown.
ag_status panel_show(panel *p, const panel_row *rows, size_t count, panel_room room);

// The panel as RGBA8, straight alpha, sRGB-coded, to be mixed as such; NULL while it is empty.
// Borrowed until the next panel_show.
const ag_image *panel_image(const panel *p);

// Another number whenever the image is another.
uint64_t panel_revision(const panel *p);

#endif
