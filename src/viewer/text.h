// Text: UTF-8 laid over a canvas in the packaged font.
//
// Threads: one at a time for each object.
#ifndef VIEWER_TEXT_H
#define VIEWER_TEXT_H

#include "canvas.h"

#include <argand/base.h>

typedef struct text text;

// Open the font: the folder that the build found it in, or that the environment's ARGAND_FONTS
// names.  AG_ERROR_FILE or _FORMAT where it cannot be read.  NULL log -> stderr.
ag_status text_create(const ag_log *log, text **made);
void text_destroy(text *t); // NULL is allowed

// Digits are all of one width.
typedef struct text_style {
    float size_px; // of the em, 4 to 400
    bool bold;
} text_style;

typedef struct text_metrics {
    float ascent, descent; // px above and below the base line, both positive
    float line;            // px from one base line to the next
} text_metrics;

text_metrics text_line(text *t, text_style style);

// px that `length` bytes take (SIZE_MAX -> up to the zero).  Bytes that are no UTF-8 show as
// U+FFFD, control characters as nothing.
float text_width(text *t, text_style style, const char *utf8, size_t length);

// Lay them over the canvas from x on the base line y; returns where the next would start.
float text_draw(text *t, const canvas *c, float x, float y, text_style style, color over,
                const char *utf8, size_t length);

// The bytes of the first line when lines are broken at spaces to be at most `width` px wide; a
// word that is wider is broken inside.  At least one character, unless there is none.
size_t text_fit(text *t, text_style style, const char *utf8, float width);

#endif
