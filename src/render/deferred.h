// Frames that are shaded when all that can be seen is known: the host finds which triangle each
// sample shows, and the device shades each surface once in each pixel.
//
// For devices that are the processor itself: drawing, they shade whole blocks of 4x4 pixels for
// each triangle, and the host is as near to the samples as the device.
#ifndef AG_RENDER_DEFERRED_H
#define AG_RENDER_DEFERRED_H

#include "render/frame.h"

// Whether the picture, whose scene is resident, can and should be drawn so.
bool deferred_fits(const ag_renderer *r, const picture *p);

AG_CHECK ag_status deferred_prepare(ag_renderer *r, const picture *p);
AG_CHECK ag_status deferred_warm_up(ag_renderer *r, const picture *p);

// After r->frame is written; the last frame leaves its pixels in r->targets.pixels, and hands
// them over to p->into.
AG_CHECK ag_status deferred_draw(ag_renderer *r, const picture *p, view_rect tile, uint32_t index);

#endif
