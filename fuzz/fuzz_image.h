// What the fuzz targets of the image codecs share.
#ifndef FUZZ_IMAGE_H
#define FUZZ_IMAGE_H

#include "image/codec.h"

#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static inline void fuzz_ignore(void *user, ag_log_level level, const char *sentence)
{
    (void)user, (void)level, (void)sentence;
}

// An image or an error, never both or neither; what the image says of itself is there.
static inline int fuzz_decoder(image_decoder *decode, const uint8_t *data, size_t size)
{
    const ag_log log = { .write = fuzz_ignore };
    ag_image *image;
    ag_status status = decode(&log, "fuzz", data, size, &image);
    if ((status == AG_OK) != (image != NULL))
        abort();
    if (image) {
        const uint8_t *bytes = image->pixels;
        size_t last = (size_t)image->width * image->height * image_pixel_size(image->format) - 1;
        volatile uint8_t touched = (uint8_t)(bytes[0] ^ bytes[last]);
        (void)touched;
    }
    ag_image_destroy(image);
    return 0;
}

#endif
