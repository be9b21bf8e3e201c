// One tile of a picture: recorded, drawn, and brought back to the host.
#ifndef AG_RENDER_FRAME_H
#define AG_RENDER_FRAME_H

#include "render/draws.h"
#include "render/renderer.h"
#include "render/view.h"

// What all tiles and samples of one picture share.
typedef struct picture {
    const ag_scene *scene;
    const ag_render_options *options; // defaults filled in
    view view;
    draws draws;
    bool hdr, background;  // see targets_desc; background: the environment is shown
    uint32_t frames;       // jittered and summed; 1 = one frame without jitter
    bool deferred;         // see deferred.h
    const gpu_image *into; // where it is shown; NULL: it goes to the host
} picture;

// Compile what the picture needs, by drawing nothing with every pipeline and material.
AG_CHECK ag_status frame_warm_up(ag_renderer *renderer, const picture *p);

// Draw frame `index` of p->frames of one tile; the last one is read back into
// renderer->targets.pixels, or handed over to p->into.
AG_CHECK ag_status frame_draw(ag_renderer *renderer, const picture *p, view_rect tile,
                              uint32_t index);

// What lies under the picture where nothing covers it, display-linear, premultiplied.
float4 frame_backdrop(const picture *p);

#endif
