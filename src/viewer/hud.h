// What is written over the picture: help, status, messages, the name of what is picked.
#ifndef VIEWER_HUD_H
#define VIEWER_HUD_H

#include "panel.h"

#include <argand/argand.h>

typedef struct hud hud;

// Without a font it stays empty; the log is told.  NULL: no memory.
hud *hud_create(const ag_log *log);
void hud_destroy(hud *h); // NULL is allowed

enum { HUD_TEXT_MAX = 256 };

// "" and 0 where there is nothing to say.
typedef struct hud_state {
    bool help, status;
    char file[HUD_TEXT_MAX];
    const ag_device_info *device; // NULL -> not yet known
    ag_scene_summary scene;
    ag_render_stats stats; // of the last picture
    double frame_ms, fps;
    uint32_t width, height; // px, of the picture
    float ev100;
    char exposure[HUD_TEXT_MAX], look[HUD_TEXT_MAX];
    bool traces;
    uint32_t samples;
    float noise, flip; // flip below 0 -> not known
    char thing[HUD_TEXT_MAX], about_thing[HUD_TEXT_MAX];
    char message[4 * HUD_TEXT_MAX];
    bool alarm; // the message is an error
    char stage[HUD_TEXT_MAX];
    double fraction;
} hud_state;

// Lay what there is to say over a window of this size in px: up to HUD_LAYERS layers from
// `layers` on.  Returns how many.  Their images live until the next call.
enum { HUD_LAYERS = 4 };
uint32_t hud_compose(hud *h, const hud_state *state, panel_room room, ag_layer *layers);

#endif
