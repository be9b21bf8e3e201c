// The colours of an error map.
#include "image/heat.h"

// A fifth of the way apart.  Their CIE lightness is 0, 20, 40, 60, 80, 98, and between them off
// the straight line by less than 3: what looks twice as light is twice as wrong.
static const uint8_t stops[6][3] = { { 0, 0, 0 },      { 54, 22, 130 },   { 160, 46, 138 },
                                     { 240, 96, 111 }, { 253, 185, 113 }, { 255, 251, 206 } };

void heat_color(float error, uint8_t rgba[4])
{
    float at = error > 0 ? error < 1 ? 5 * error : 5 : 0;
    int i = at < 4 ? (int)at : 4;
    float part = at - (float)i;
    for (int c = 0; c < 3; c++)
        rgba[c] = (uint8_t)((float)stops[i][c] * (1 - part) + (float)stops[i + 1][c] * part + 0.5f);
    rgba[3] = 255;
}
