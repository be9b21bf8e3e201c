// A tile's pixels on their way from the device into a picture.
#ifndef AG_RENDER_PIXELS_H
#define AG_RENDER_PIXELS_H

#include "render/view.h"

#include <argand/image.h>

// Copy a tile of premultiplied pixels (linear light, stored as the format says) into its
// place, made straight; what reaches over the picture's edge is left out.  On all cores.
void pixels_place(const void *from, view_rect tile, ag_image *picture);

#endif
