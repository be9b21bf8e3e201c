// What is written over the picture.
#include "hud.h"

#include "keys.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

enum { ROWS_MAX = 64, VALUE_MAX = 96, MARGIN = 12 };

// Where panels stand; those that others make room for come first.
typedef enum place {
    PLACE_NEWS,   // the middle below
    PLACE_THING,  // the lower left
    PLACE_STATUS, // the upper left
    PLACE_HELP,   // the middle
} place;

struct hud {
    text *text;
    panel *panels[HUD_LAYERS];
};

hud *hud_create(const ag_log *log)
{
    hud *h = calloc(1, sizeof *h);
    if (!h)
        return NULL;
    if (text_create(log, &h->text) != AG_OK)
        h->text = NULL;
    for (int i = 0; i < HUD_LAYERS; i++)
        if (panel_create(log, h->text, &h->panels[i]) != AG_OK) {
            hud_destroy(h);
            return NULL;
        }
    return h;
}

void hud_destroy(hud *h)
{
    if (!h)
        return;
    for (int i = 0; i < HUD_LAYERS; i++)
        panel_destroy(h->panels[i]);
    text_destroy(h->text);
    free(h);
}

// ---- Rows ------------------------------------------------------------------

typedef struct rows {
    panel_row items[ROWS_MAX];
    char values[ROWS_MAX][VALUE_MAX];
    size_t count;
} rows;

static void put(rows *r, panel_row row)
{
    if (r->count < ROWS_MAX)
        r->items[r->count++] = row;
}

__attribute__((format(printf, 3, 4))) static void value(rows *r, const char *name,
                                                        const char *format, ...)
{
    if (r->count == ROWS_MAX)
        return;
    char *shown = r->values[r->count];
    va_list args;
    va_start(args, format);
    vsnprintf(shown, VALUE_MAX, format, args);
    va_end(args);
    put(r, (panel_row) { PANEL_VALUE, name, shown, 0 });
}

// 12 345 678
static void count(rows *r, const char *name, uint64_t n)
{
    char digits[32], grouped[48];
    int length = snprintf(digits, sizeof digits, "%llu", (unsigned long long)n), to = 0;
    for (int i = 0; i < length; i++) {
        if (i && (length - i) % 3 == 0)
            grouped[to++] = ' ';
        grouped[to++] = digits[i];
    }
    grouped[to] = 0;
    value(r, name, "%s", grouped);
}

static void put_times(rows *r, const hud_state *s)
{
    put(r, (panel_row) { PANEL_SECTION, "Frame", NULL, 0 });
    value(r, "whole", "%.1f ms", s->frame_ms);
    if (s->fps > 0)
        value(r, "a second", "%.1f", s->fps);
    value(r, "drawing", "%.1f ms", s->stats.frame_ms);
    value(r, "showing", "%.1f ms", s->stats.show_ms);
    if (s->stats.upload_ms > 0.05)
        value(r, "uploading", "%.1f ms", s->stats.upload_ms);
    if (s->stats.bake_ms > 0.05)
        value(r, "baking", "%.1f ms", s->stats.bake_ms);
    if (s->stats.compile_ms > 1)
        value(r, "compiling", "%.1f ms", s->stats.compile_ms);
    value(r, "picture", "%u × %u", s->width, s->height);
}

static void put_scene(rows *r, const hud_state *s)
{
    put(r, (panel_row) { PANEL_SECTION, "Scene", NULL, 0 });
    count(r, "triangles", s->scene.triangles);
    count(r, "instances", s->scene.instances);
    count(r, "materials", s->scene.materials);
    count(r, "lights", s->scene.lights);
}

static void put_look(rows *r, const hud_state *s)
{
    put(r, (panel_row) { PANEL_SECTION, "Eye", NULL, 0 });
    value(r, "EV100", "%+.2f", (double)s->ev100);
    value(r, "exposure", "%s", s->exposure);
    value(r, "tone curve", "%s", s->look);
}

static void put_truth(rows *r, const hud_state *s)
{
    put(r, (panel_row) { PANEL_SECTION, "Ground truth", NULL, 0 });
    count(r, "samples", s->samples);
    if (s->samples > 1)
        value(r, "noise", "%.1f %%", 100 * (double)s->noise);
    if (s->flip >= 0)
        value(r, "FLIP", "%.4f", (double)s->flip);
}

static void put_status(rows *r, const hud_state *s)
{
    put(r, (panel_row) { PANEL_TITLE, s->file[0] ? s->file : "argand", NULL, 0 });
    if (s->device)
        put(r, (panel_row) { PANEL_NOTE, s->device->name, NULL, 0 });
    put_times(r, s);
    put_scene(r, s);
    put_look(r, s);
    if (s->traces)
        put_truth(r, s);
}

static void put_news(rows *r, const hud_state *s)
{
    if (s->message[0])
        put(r, (panel_row) { s->alarm ? PANEL_ERROR : PANEL_NOTE, s->message, NULL, 0 });
    if (s->stage[0]) {
        char *percent = r->values[r->count];
        snprintf(percent, VALUE_MAX, "%.0f %%", 100 * s->fraction);
        put(r, (panel_row) { PANEL_PROGRESS, s->stage, percent, (float)s->fraction });
    }
}

static void put_help(rows *r)
{
    put(r, (panel_row) { PANEL_TITLE, "argand view", "? closes this", 0 });
    r->count += keys_rows(r->items + r->count, ROWS_MAX - r->count);
    if (r->count > ROWS_MAX)
        r->count = ROWS_MAX;
}

static void fill(rows *r, place which, const hud_state *s)
{
    r->count = 0;
    if (which == PLACE_HELP && s->help)
        put_help(r);
    else if (which == PLACE_STATUS && s->status)
        put_status(r, s);
    else if (which == PLACE_THING && s->thing[0])
        put(r, (panel_row) { PANEL_NOTE, s->thing, s->about_thing, 0 });
    else if (which == PLACE_NEWS)
        put_news(r, s);
}

// ---- Places ----------------------------------------------------------------

static float margin_of(panel_room room)
{
    return MARGIN * (room.scale > 0 ? room.scale : 1);
}

static void set_place(ag_layer *layer, place which, panel_room room)
{
    float margin = margin_of(room);
    layer->width = (float)ag_image_width(layer->image);
    layer->height = (float)ag_image_height(layer->image);
    float across = (float)room.width - layer->width, down = (float)room.height - layer->height;
    bool middle = which == PLACE_NEWS || which == PLACE_HELP;
    layer->x = (float)(int)(middle ? across / 2 : margin);
    layer->y = (float)(int)(which == PLACE_HELP     ? down / 2
                            : which == PLACE_STATUS ? margin
                                                    : down - margin);
}

static bool is_under(const ag_layer *lower, const ag_layer *upper)
{
    return lower->x < upper->x + upper->width && upper->x < lower->x + lower->width;
}

// What is left of the window for a panel beside those that stand.
static panel_room room_for(place which, panel_room window, const ag_layer *thing)
{
    float margin = margin_of(window);
    float width = (float)window.width - 2 * margin, height = (float)window.height - 2 * margin;
    if (which == PLACE_STATUS && thing)
        height = thing->y - 2 * margin;
    return (panel_room) { width > 0 ? (uint32_t)width : window.width,
                          height > 0 ? (uint32_t)height : window.height, window.scale };
}

uint32_t hud_compose(hud *h, const hud_state *state, panel_room window, ag_layer *layers)
{
    uint32_t used = 0;
    rows r;
    const ag_layer *news = NULL, *thing = NULL;
    for (int i = 0; i < HUD_LAYERS; i++) {
        fill(&r, (place)i, state);
        // What cannot be shown for want of memory stays as it was.
        if (panel_show(h->panels[i], r.items, r.count, room_for((place)i, window, thing)) != AG_OK)
            continue;
        const ag_image *image = panel_image(h->panels[i]);
        if (!image)
            continue;
        ag_layer *layer = &layers[used++];
        const uint64_t owner = (uint64_t)(i + 1) << 48;
        *layer = (ag_layer) { .image = image, .version = owner + panel_revision(h->panels[i]) };
        set_place(layer, (place)i, window);
        if (i == PLACE_NEWS)
            news = layer;
        if (i == PLACE_THING) {
            thing = layer;
            if (news && is_under(news, layer))
                layer->y = news->y - margin_of(window) / 2 - layer->height;
        }
    }
    return used;
}
