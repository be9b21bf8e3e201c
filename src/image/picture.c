// A picture as it is compared: without alpha, over white, linear or sRGB-coded.
#include "image/picture.h"

#include "image/srgb.h"

#include <float.h>

void picture_init(picture *p, const ag_image *image)
{
    p->image = image;
    srgb_decoder_init(p->decoded);
}

// Of bytes, in [0, 1].
static void over_white(const uint8_t in[4], float rgb[3])
{
    float alpha = (float)in[3] / 255;
    for (int c = 0; c < 3; c++)
        rgb[c] = (float)in[c] / 255 * alpha + (1 - alpha);
}

static float finite(float v)
{
    return v > FLT_MAX ? FLT_MAX : v < -FLT_MAX ? -FLT_MAX : v == v ? v : 0;
}

static void linear_floats(const float in[4], float rgb[3])
{
    float alpha = in[3] >= 1 ? 1 : in[3] > 0 ? in[3] : 0;
    for (int c = 0; c < 3; c++)
        rgb[c] = finite(in[c]) * alpha + (1 - alpha);
}

void picture_linear(const picture *p, size_t index, float rgb[3])
{
    if (p->image->format == AG_FORMAT_RGBA32F) {
        linear_floats((const float *)p->image->pixels + 4 * index, rgb);
        return;
    }
    const uint8_t *in = (const uint8_t *)p->image->pixels + 4 * index;
    if (in[3] != 255)
        over_white(in, rgb);
    for (int c = 0; c < 3; c++)
        rgb[c] = in[3] == 255 ? p->decoded[in[c]] : (float)srgb_to_linear((double)rgb[c]);
}

void picture_coded(const picture *p, size_t index, float rgb[3])
{
    if (p->image->format == AG_FORMAT_RGBA8) {
        over_white((const uint8_t *)p->image->pixels + 4 * index, rgb);
        return;
    }
    linear_floats((const float *)p->image->pixels + 4 * index, rgb);
    for (int c = 0; c < 3; c++) {
        float clipped = rgb[c] > 0 ? rgb[c] < 1 ? rgb[c] : 1 : 0;
        rgb[c] = (float)srgb_from_linear((double)clipped);
    }
}
