// A panel: rows of text on a dark plate, as an image to lay over the window.
#include "panel.h"

#include <stdlib.h>

struct panel {
    ag_log log;
    text *t;
    ag_image *image;
    uint64_t revision;
};

ag_status panel_create(const ag_log *log, text *t, panel **made)
{
    *made = calloc(1, sizeof **made);
    if (!*made)
        return AG_ERROR_MEMORY;
    **made = (panel) { .log = log ? *log : (ag_log) { 0 }, .t = t };
    return AG_OK;
}

void panel_destroy(panel *p)
{
    if (p)
        ag_image_destroy(p->image);
    free(p);
}

ag_status panel_show(panel *p, const panel_row *rows, size_t count, panel_room room)
{
    (void)p, (void)rows, (void)count, (void)room;
    return AG_OK;
}

const ag_image *panel_image(const panel *p)
{
    return p->image;
}

uint64_t panel_revision(const panel *p)
{
    return p->revision;
}
