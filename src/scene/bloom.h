// Bloom on a picture's way from light to what is shown.
#ifndef AG_SCENE_BLOOM_H
#define AG_SCENE_BLOOM_H

#include <argand/renderer.h>

// The picture of linear light that one with bloom is made of.
ag_render_options bloom_light(const ag_render_options *options);

// Make the one that was asked for of it.  `light` is the caller's still.
AG_CHECK ag_status bloom_finish(const ag_log *log, const ag_image *light,
                                const ag_render_options *options, ag_image **picture);

#endif
