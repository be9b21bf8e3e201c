// The colours of an error map.
#ifndef AG_IMAGE_HEAT_H
#define AG_IMAGE_HEAT_H

#include <stdint.h>

// sRGB-coded RGBA of an error in [0, 1] (clipped): black, violet, purple, red, orange, pale yellow.
void heat_color(float error, uint8_t rgba[4]);

#endif
