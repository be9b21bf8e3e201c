// The environment where nothing stands before it, as the host sees it: background.glsl's
// picture for devices that are the processor itself, which read an image pixel by pixel there.
#ifndef AG_RENDER_PANORAMA_H
#define AG_RENDER_PANORAMA_H

#include "render/surround.h"

typedef struct panorama {
    const surround *surround;
    const gpu_frame *frame;
    const gpu_light *suns; // as the frame counts them: lights of group GPU_LIGHTS_CAP
    uint32_t tone;         // of display.glsl, or GPU_TONE_LINEAR
} panorama;

enum { PANORAMA_RUN = 64 };

// The colours of `count` pixels, PANORAMA_RUN at most, from (x, y) on to the right; or their
// codes, of which `code` has one for each half float from 0 to 1.  What follows them in `out` up
// to a multiple of eight is written, too.  The surround has its texels, or none is present.
void panorama_colors(const panorama *p, uint32_t x, uint32_t y, uint32_t count, float out[][4]);
void panorama_codes(const panorama *p, uint32_t x, uint32_t y, uint32_t count, const uint8_t *code,
                    uint8_t out[][4]);

#endif
