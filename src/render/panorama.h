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

enum { PANORAMA_RUN = 8 };

// The colours of PANORAMA_RUN pixels from (x, y) on to the right, which may lie beyond the
// picture.  The surround has its texels, or none is present.
void panorama_run(const panorama *b, uint32_t x, uint32_t y, float colors[][4]);

#endif
