// What is drawn into: the images of one tile, and the way its pixels leave.
#ifndef AG_RENDER_TARGETS_H
#define AG_RENDER_TARGETS_H

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/image.h"

typedef struct targets_desc {
    uint32_t width, height; // px
    uint32_t samples;       // 1 or 4
    bool hdr;               // surfaces leave linear radiance for a resolve pass
    bool sum;               // several pictures are accumulated
    bool deferred;          // nothing is drawn: the host makes the picture
    ag_format format;       // of the picture
} targets_desc;

typedef struct targets {
    targets_desc desc;
    gpu_image depth;
    gpu_image samples;  // multisampled colour; none when samples = 1
    gpu_image radiance; // hdr: one sample a pixel, half floats
    gpu_image sum;      // sum: floats
    gpu_image picture;  // what leaves
    gpu_buffer pixels;  // the picture, where the host can read it
} targets;

// Have targets for `desc`; those that are there are kept when they fit.
AG_CHECK ag_status targets_ensure(gpu_device *device, const targets_desc *desc, targets *t);
void targets_destroy(gpu_device *device, targets *t); // zero is allowed

// The format that surfaces are drawn in.
VkFormat targets_surface_format(const targets_desc *desc);
VkFormat targets_picture_format(ag_format format);

// Copy the picture (last used as a colour attachment) to `pixels`.
void targets_read_back(const gpu_commands *commands, const targets *t);

// Copy the picture, or `pixels` where nothing was drawn, to (x, y) of an image that is sampled,
// as far as it reaches.
void targets_hand_over(const gpu_commands *commands, const targets *t, const gpu_image *image,
                       uint32_t x, uint32_t y);

#endif
