// The image behind ag_image, for the modules that make and read pixels.
#ifndef AG_IMAGE_IMAGE_H
#define AG_IMAGE_IMAGE_H

#include <argand/image.h>

struct ag_image {
    uint32_t width, height;
    ag_format format;
    void *pixels; // width * height * image_pixel_size(format) bytes, from malloc
};

size_t image_pixel_size(ag_format format);

#endif
