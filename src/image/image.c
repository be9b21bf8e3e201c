// Images in host memory.
#include "image/image.h"

#include "base/log.h"
#include "base/pages.h"

#include <stdlib.h>
#include <string.h>

size_t image_pixel_size(ag_format format)
{
    return format == AG_FORMAT_RGBA32F ? 16 : 4;
}

static bool size_is_sound(uint32_t width, uint32_t height)
{
    return width && height && (uint64_t)width * height <= IMAGE_PIXELS_MAX;
}

ag_status image_allocate(const ag_log *log, const char *name, uint32_t width, uint32_t height,
                         ag_format format, ag_image **out)
{
    *out = NULL;
    if (!size_is_sound(width, height))
        return log_fail(log, AG_ERROR_UNSUPPORTED,
                        "%s: an image of %u x %u pixels; between 1 and 2^28 pixels are possible",
                        name, width, height);
    ag_image *image = malloc(sizeof *image);
    size_t size = (size_t)width * height * image_pixel_size(format);
    void *pixels = malloc(size);
    if (!image || !pixels) {
        free(image);
        free(pixels);
        return log_fail(log, AG_ERROR_MEMORY, "%s: no memory for an image of %u x %u pixels", name,
                        width, height);
    }
    pages_prefer_large(pixels, size);
    *image = (ag_image) { width, height, format, pixels };
    *out = image;
    return AG_OK;
}

ag_status ag_image_create(const ag_log *log, const ag_image_desc *desc, ag_image **out)
{
    *out = NULL;
    if (desc->format != AG_FORMAT_RGBA8 && desc->format != AG_FORMAT_RGBA32F)
        return log_fail(log, AG_ERROR_ARGUMENT, "image: %d is no pixel format", (int)desc->format);
    if (!size_is_sound(desc->width, desc->height))
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "image: %u x %u pixels; between 1 and 2^28 pixels are possible",
                        desc->width, desc->height);
    ag_status status = image_allocate(log, "image", desc->width, desc->height, desc->format, out);
    if (status)
        return status;
    size_t size = (size_t)desc->width * desc->height * image_pixel_size(desc->format);
    if (desc->pixels)
        memcpy((*out)->pixels, desc->pixels, size);
    else
        memset((*out)->pixels, 0, size);
    return AG_OK;
}

uint32_t ag_image_width(const ag_image *image)
{
    return image->width;
}

uint32_t ag_image_height(const ag_image *image)
{
    return image->height;
}

ag_format ag_image_format(const ag_image *image)
{
    return image->format;
}

const void *ag_image_pixels(const ag_image *image)
{
    return image->pixels;
}

void ag_image_destroy(ag_image *image)
{
    if (!image)
        return;
    free(image->pixels);
    free(image);
}
