// What the samples of a picture add up to.
#ifndef AG_TRACE_FILM_H
#define AG_TRACE_FILM_H

#include <argand/reference.h>

#include "trace/path.h"

enum { FILM_TILE_WIDTH = 64, FILM_TILE_HEIGHT = 4 }; // px; what one task adds to

typedef struct film_pixel {
    float direct[3], indirect[3], alpha;
    float square; // of luminance
} film_pixel;

typedef struct film_aov {
    float albedo[3], normal[3], depth;
} film_aov;

typedef struct film {
    uint32_t width, height, columns, rows; // px; tiles
    film_pixel *pixels;                    // sums
    film_aov *aovs;                        // sums; NULL: not kept
    uint32_t *samples;                     // [tile], of each of its pixels
} film;

AG_CHECK ag_status film_init(const ag_log *log, uint32_t width, uint32_t height, bool aovs,
                             film *f);
void film_finish(film *f); // zero is allowed

void film_add(film *f, uint32_t x, uint32_t y, const path_result *sample);

// ag_reference_state.noise
float film_noise(const film *f);

// As ag_renderer_render leaves a picture.
AG_CHECK ag_status film_picture(const ag_log *log, const film *f, const ag_render_options *options,
                                ag_image **image);
AG_CHECK ag_status film_aov_image(const ag_log *log, const film *f, ag_aov aov, ag_image **image);

#endif
