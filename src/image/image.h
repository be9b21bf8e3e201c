// The image behind ag_image, for the modules that make and read pixels.
#ifndef AG_IMAGE_IMAGE_H
#define AG_IMAGE_IMAGE_H

#include <argand/image.h>

enum { IMAGE_PIXELS_MAX = 1 << 28 };

struct ag_image {
    uint32_t width, height;
    ag_format format;
    void *pixels; // width * height * image_pixel_size(format) bytes, from malloc
};

size_t image_pixel_size(ag_format format);

// Make an image whose pixels are not yet anything.  AG_ERROR_UNSUPPORTED, and a sentence
// that begins with `name`, on a zero size or one above IMAGE_PIXELS_MAX.
AG_CHECK ag_status image_allocate(const ag_log *log, const char *name, uint32_t width,
                                  uint32_t height, ag_format format, ag_image **image);

// Whether every pixel's alpha is 255 (bytes) or 1 (floats).
bool image_is_opaque(const ag_image *image);

// A copy in the other format: bytes are taken as sRGB-coded, floats as linear; alpha is
// scaled only.  Floats are clipped to [0, 1], NaN becomes 0.
AG_CHECK ag_status image_convert(const ag_log *log, const ag_image *image, ag_format format,
                                 ag_image **out);

// A copy composited over white in the image's own numbers (bytes: coded, as a browser
// does; floats: linear), alpha 1.
AG_CHECK ag_status image_over_white(const ag_log *log, const ag_image *image, ag_image **out);

#endif
