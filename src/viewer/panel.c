// A panel: rows of text on a dark plate, as an image to lay over the window.
//
// put_row() both measures and draws: without a canvas it only tells the height.
#include "panel.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct panel {
    ag_log log;
    text *t;
    ag_image *image;
    uint64_t revision;
    uint64_t content, head; // hashes of what is shown and of how it begins
    float column;           // px, the widest since it begins so
};

static ag_status no_memory(const ag_log *log)
{
    static const char sentence[] = "There is no memory for a panel.";
    if (log && log->write)
        log->write(log->user, AG_LOG_ERROR, sentence);
    else
        fprintf(stderr, "argand: error: %s\n", sentence);
    return AG_ERROR_MEMORY;
}

ag_status panel_create(const ag_log *log, text *t, panel **made)
{
    *made = calloc(1, sizeof **made);
    if (!*made)
        return no_memory(log);
    **made = (panel) { .log = log ? *log : (ag_log) { 0 }, .t = t };
    return AG_OK;
}

void panel_destroy(panel *p)
{
    if (p)
        ag_image_destroy(p->image);
    free(p);
}

const ag_image *panel_image(const panel *p)
{
    return p->image;
}

uint64_t panel_revision(const panel *p)
{
    return p->revision;
}

// ---- Its looks -------------------------------------------------------------

// px at scale 1
static const float text_size = 13, title_size = 15, section_size = 11.5f;
static const float margin_x = 16, margin_y = 12, corner = 9;
static const float gutter = 18;      // between what is left and what is right
static const float column_gap = 36;  // between columns
static const float section_gap = 9;  // above a section
static const float title_gap = 6;    // below the title
static const float note_width = 480; // at most, before lines are broken
static const float bar_width = 240, bar_height = 4, bar_gap = 6;
static const float leading = 1.5f; // line to line, in sizes

static const color plate = { 20, 22, 27, 222 }, rim = { 255, 255, 255, 26 };
static const color bright = { 238, 240, 244, 255 }, dim = { 166, 172, 183, 255 };
static const color accent = { 143, 184, 255, 255 }, alarm = { 255, 138, 122, 255 };
static const color track = { 255, 255, 255, 40 };

// ---- Rows ------------------------------------------------------------------

typedef struct draft {
    text *t;
    const canvas *c; // NULL -> measure only
    float scale;
    float left; // px that the left texts of keys and values take
} draft;

typedef enum side { flush_left, flush_right } side;

static float put_text(const draft *d, const char *utf8, float size, bool bold, color over, float x,
                      float y, float width, side flush)
{
    text_style style = { .size_px = size * d->scale, .bold = bold };
    text_metrics m = text_line(d->t, style);
    float line = roundf(leading * style.size_px), height = 0;
    while (utf8 && *utf8) {
        size_t length = text_fit(d->t, style, utf8, width);
        float start = x, base = y + height + 0.5f * (line + m.ascent - m.descent);
        if (d->c && flush == flush_right)
            start += width - text_width(d->t, style, utf8, length);
        if (d->c)
            text_draw(d->t, d->c, start, base, style, over, utf8, length);
        utf8 += length;
        utf8 += *utf8 == ' ' || *utf8 == '\n';
        height += line;
    }
    return height;
}

// Left and right beside each other; empty ones are as high as a line.
static float put_pair(const draft *d, const panel_row *row, float x, float y, float width)
{
    bool key = row->kind == PANEL_KEY;
    float gap = d->left > 0 ? gutter * d->scale : 0;
    float left =
        put_text(d, row->left, text_size, false, key ? accent : dim, x, y, d->left + 1, flush_left);
    float right = put_text(d, row->right, text_size, false, bright, x + d->left + gap, y,
                           width - d->left - gap + 1, key ? flush_left : flush_right);
    return fmaxf(fmaxf(left, right), roundf(leading * text_size * d->scale));
}

static float put_note(const draft *d, const panel_row *row, float x, float y, float width)
{
    bool error = row->kind == PANEL_ERROR;
    float height =
        put_text(d, row->left, text_size, false, error ? alarm : bright, x, y, width, flush_left);
    return height + put_text(d, row->right, text_size, false, error ? bright : dim, x, y + height,
                             width, flush_left);
}

static float put_title(const draft *d, const panel_row *row, float x, float y, float width)
{
    float height = put_text(d, row->left, title_size, true, bright, x, y, width, flush_left);
    if (row->right) // on the title's base line
        put_text(d, row->right, text_size, false, dim, x,
                 y + 0.5f * (leading * d->scale) * (title_size - text_size), width, flush_right);
    return height + roundf(title_gap * d->scale);
}

static float put_progress(const draft *d, const panel_row *row, float x, float y, float width)
{
    float height = put_text(d, row->left, text_size, false, bright, x, y, width, flush_left);
    put_text(d, row->right, text_size, false, dim, x, y, width, flush_right);
    float top = y + height + roundf(0.5f * bar_gap * d->scale), high = bar_height * d->scale;
    float fraction = row->fraction > 0 ? fminf(row->fraction, 1) : 0;
    if (d->c) {
        canvas_fill(d->c, (box) { x, top, width, high }, 0.5f * high, track);
        canvas_fill(d->c, (box) { x, top, width * fraction, high }, 0.5f * high, accent);
    }
    return height + roundf((bar_height + bar_gap) * d->scale);
}

static float put_row(const draft *d, const panel_row *row, float x, float y, float width)
{
    switch (row->kind) {
    case PANEL_VALUE:
    case PANEL_KEY: return put_pair(d, row, x, y, width);
    case PANEL_TITLE: return put_title(d, row, x, y, width);
    case PANEL_SECTION:
        return put_text(d, row->left, section_size, true, dim, x, y, width, flush_left);
    case PANEL_NOTE:
    case PANEL_ERROR: return put_note(d, row, x, y, width);
    case PANEL_PROGRESS: return put_progress(d, row, x, y, width);
    }
    return 0;
}

// ---- Their layout ----------------------------------------------------------

typedef struct place {
    float y, height;
    unsigned column;
} place;

typedef struct layout {
    draft d;
    bool titled;
    float column; // px, width of a column
    unsigned columns;
    float title, height; // px, of the title and of the columns below it
    place *places;
} layout;

static float natural_width(const draft *d, const char *utf8, float size, bool bold)
{
    text_style style = { .size_px = size * d->scale, .bold = bold };
    return utf8 ? ceilf(text_width(d->t, style, utf8, SIZE_MAX)) : 0;
}

// The width of a column that breaks no line but those of notes; sets the draft's left.
static float natural_column(draft *d, const panel_row *rows, size_t count)
{
    float right = 0, whole = 0;
    d->left = 0;
    for (size_t i = 0; i < count; i++) {
        const panel_row *r = &rows[i];
        bool pair = r->kind == PANEL_VALUE || r->kind == PANEL_KEY;
        float a = natural_width(d, r->left, r->kind == PANEL_TITLE ? title_size : text_size,
                                r->kind == PANEL_TITLE);
        float b = natural_width(d, r->right, text_size, false);
        if (pair) {
            d->left = fmaxf(d->left, a);
            right = fmaxf(right, b);
        } else if (r->kind == PANEL_NOTE || r->kind == PANEL_ERROR) {
            whole = fmaxf(whole, fminf(fmaxf(a, b), note_width * d->scale));
        } else {
            float both = a + b + (b > 0 ? gutter * d->scale : 0);
            float least = r->kind == PANEL_PROGRESS ? bar_width * d->scale : 0;
            whole = fmaxf(whole, fmaxf(both, least));
        }
    }
    float gap = d->left > 0 && right > 0 ? gutter * d->scale : 0;
    return ceilf(fmaxf(d->left + gap + right, whole));
}

// Stack the rows; a section that would pass `limit` starts a column.  Returns the greatest height.
static float stack(layout *l, const panel_row *rows, size_t count, float limit)
{
    float y = 0, tallest = 0;
    l->columns = 1;
    for (size_t i = 0; i < count; i++) {
        if (rows[i].kind == PANEL_SECTION && y > 0) {
            float block = y + roundf(section_gap * l->d.scale) + l->places[i].height;
            for (size_t j = i + 1; j < count && rows[j].kind != PANEL_SECTION; j++)
                block += l->places[j].height;
            y += roundf(section_gap * l->d.scale);
            if (block > limit) {
                l->columns++;
                y = 0;
            }
        }
        l->places[i].column = l->columns - 1;
        l->places[i].y = y;
        y += l->places[i].height;
        tallest = fmaxf(tallest, y);
    }
    return tallest;
}

// Into at most so many columns, about equally high.
static void balance(layout *l, const panel_row *rows, size_t count, unsigned columns)
{
    float total = stack(l, rows, count, INFINITY);
    float limit = floorf(total / (float)columns);
    do
        l->height = stack(l, rows, count, limit);
    while (l->columns > columns && (limit += 4) < total);
}

static float outer_width(const layout *l)
{
    return (float)l->columns * (l->column + column_gap * l->d.scale) +
           (2 * margin_x - column_gap) * l->d.scale;
}

static float outer_height(const layout *l)
{
    return l->title + l->height + 2 * margin_y * l->d.scale;
}

// One try: letters of this scale in so many columns.  Is it small enough?
static bool try_layout(layout *l, const panel_row *rows, size_t count, panel_room room,
                       unsigned columns, float at_least)
{
    float inner = (float)room.width - (2 * margin_x - column_gap) * l->d.scale;
    float widest = floorf(inner / (float)columns - column_gap * l->d.scale);
    float natural = fmaxf(natural_column(&l->d, rows, count), at_least);
    if (columns > 1 && 0.75f * natural > widest)
        return false; // breaking so many lines gains nothing
    l->column = fmaxf(fminf(natural, widest), 1);
    l->d.left = fminf(l->d.left, ceilf(0.45f * l->column));
    for (size_t i = 0; i < count; i++)
        l->places[i].height = put_row(&l->d, &rows[i], 0, 0, l->column);
    size_t head = l->titled;
    place *all = l->places;
    l->places += head;
    balance(l, rows + head, count - head, columns);
    l->places = all;
    l->title = head ? all[0].height : 0;
    return outer_height(l) <= (float)room.height;
}

static void lay_out(layout *l, const panel_row *rows, size_t count, panel_room room, float at_least)
{
    static const float smallest = 0.5f;
    float scale = room.scale > 0 ? room.scale : 1;
    l->titled = rows[0].kind == PANEL_TITLE;
    for (float factor = 1; factor >= smallest; factor *= 0.9f) {
        l->d.scale = scale * factor;
        for (unsigned columns = 1; columns <= 4; columns++)
            if (try_layout(l, rows, count, room, columns, factor < 1 ? 0 : at_least))
                return;
    }
    try_layout(l, rows, count, room, 1, 0); // what is too long is cut off
}

// ---- The image -------------------------------------------------------------

static void draw(const layout *l, const canvas *c, const panel_row *rows, size_t count)
{
    draft d = l->d;
    d.c = c;
    float s = d.scale, width = (float)c->width, height = (float)c->height, radius = corner * s;
    float line = fmaxf(1, roundf(s));
    canvas_fill(c, (box) { 0, 0, width, height }, radius, rim);
    canvas_fill(c, (box) { line, line, width - 2 * line, height - 2 * line }, radius - line, plate);
    float left = roundf(margin_x * s), top = roundf(margin_y * s);
    for (size_t i = 0; i < count; i++) {
        const place *at = &l->places[i];
        bool title = i == 0 && l->titled;
        float x = left + (float)at->column * (l->column + roundf(column_gap * s));
        put_row(&d, &rows[i], title ? left : x, title ? top : top + l->title + at->y,
                title ? width - 2 * left : l->column);
    }
}

static ag_status make_image(panel *p, const layout *l, const panel_row *rows, size_t count,
                            panel_room room)
{
    canvas c = { .width = (uint32_t)fminf(ceilf(outer_width(l)), (float)room.width),
                 .height = (uint32_t)fminf(ceilf(outer_height(l)), (float)room.height) };
    c.pixels = calloc((size_t)c.width * c.height, 4);
    if (!c.pixels)
        return no_memory(&p->log);
    draw(l, &c, rows, count);
    ag_image *image;
    ag_image_desc desc = { .width = c.width, .height = c.height, .pixels = c.pixels };
    ag_status status = ag_image_create(&p->log, &desc, &image);
    free(c.pixels);
    if (status)
        return status;
    ag_image_destroy(p->image);
    p->image = image;
    p->revision++;
    return AG_OK;
}

// ---- What is shown ---------------------------------------------------------

// FNV-1a
static uint64_t hash(uint64_t h, const void *data, size_t size)
{
    for (size_t i = 0; i < size; i++)
        h = (h ^ ((const uint8_t *)data)[i]) * 0x100000001b3u;
    return h;
}

static uint64_t hash_text(uint64_t h, const char *utf8)
{
    return utf8 ? hash(h, utf8, strlen(utf8) + 1) : hash(h, "\1", 1);
}

static uint64_t hash_room(panel_room room)
{
    uint64_t h = hash(0xcbf29ce484222325u, &room.width, sizeof room.width);
    h = hash(h, &room.height, sizeof room.height);
    return hash(h, &room.scale, sizeof room.scale);
}

static uint64_t hash_rows(const panel_row *rows, size_t count, panel_room room)
{
    uint64_t h = hash_room(room);
    for (size_t i = 0; i < count; i++) {
        h = hash_text(hash_text(h, rows[i].left), rows[i].right);
        h = hash(h, &rows[i].kind, sizeof rows[i].kind);
        h = hash(h, &rows[i].fraction, sizeof rows[i].fraction);
    }
    return h;
}

static void clear(panel *p)
{
    if (!p->image)
        return;
    ag_image_destroy(p->image);
    p->image = NULL;
    p->content = p->head = 0;
    p->revision++;
}

ag_status panel_show(panel *p, const panel_row *rows, size_t count, panel_room room)
{
    if (!p->t || !count || !room.width || !room.height) {
        clear(p);
        return AG_OK;
    }
    uint64_t content = hash_rows(rows, count, room);
    uint64_t head = hash_text(hash_room(room), rows[0].left);
    if (p->image && content == p->content)
        return AG_OK;
    layout l = { .d.t = p->t, .places = calloc(count, sizeof *l.places) };
    if (!l.places)
        return no_memory(&p->log);
    lay_out(&l, rows, count, room, head == p->head ? p->column : 0);
    ag_status status = make_image(p, &l, rows, count, room);
    if (!status) {
        p->content = content;
        p->head = head;
        p->column = l.column;
    }
    free(l.places);
    return status;
}
