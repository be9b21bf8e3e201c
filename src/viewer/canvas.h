// A canvas: pixels that shapes are laid over.
#ifndef VIEWER_CANVAS_H
#define VIEWER_CANVAS_H

#include <stddef.h>
#include <stdint.h>

// RGBA8, rows from the top, straight alpha; sRGB-coded and mixed as such.
typedef struct canvas {
    uint8_t *pixels; // borrowed: [height][width][4]
    uint32_t width, height;
} canvas;

typedef struct color {
    uint8_t r, g, b, a;
} color;

typedef struct box {
    float x, y, width, height; // px, from the top left
} box;

// A color over the box with round corners; edges are smooth at any fraction of a pixel.
void canvas_fill(const canvas *c, box shape, float radius, color over);

// A color over the pixels from (x, y) on, as dense as the mask says (rows `stride` bytes apart).
// What lies outside the canvas is left out.
void canvas_mask(const canvas *c, int x, int y, const uint8_t *mask, int width, int height,
                 ptrdiff_t stride, color over);

#endif
