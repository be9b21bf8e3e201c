// Reading images: the first bytes tell the codec.
#include "image/codec.h"

#include "base/log.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static bool starts_with(const void *data, size_t size, const char *magic, size_t length)
{
    return size >= length && memcmp(data, magic, length) == 0;
}

static image_decoder *find_decoder(const void *data, size_t size)
{
    if (starts_with(data, size, "\x89PNG\r\n\x1a\n", 8))
        return image_decode_png;
    if (starts_with(data, size, "\xff\xd8\xff", 3))
        return image_decode_jpeg;
    if (starts_with(data, size, "RIFF", 4) && size >= 12 &&
        memcmp((const char *)data + 8, "WEBP", 4) == 0)
        return image_decode_webp;
    if (starts_with(data, size, "#?", 2))
        return image_decode_hdr;
    if (starts_with(data, size, "\x76\x2f\x31\x01", 4))
        return image_decode_exr;
    return NULL;
}

ag_status ag_image_load_memory(const ag_log *log, const char *name, const void *data, size_t size,
                               ag_image **image)
{
    *image = NULL;
    image_decoder *decode = find_decoder(data, size);
    if (!decode)
        return log_fail(log, size ? AG_ERROR_UNSUPPORTED : AG_ERROR_FORMAT,
                        "%s: %s; PNG, JPEG, WebP, Radiance HDR and OpenEXR can be read", name,
                        size ? "its first bytes are those of no known image format" : "is empty");
    return decode(log, name, data, size, image);
}

ag_status ag_image_load(const ag_log *log, const char *path, ag_image **image)
{
    *image = NULL;
    void *data;
    size_t size;
    ag_status status = file_read(log, path, (size_t)1 << 32, &data, &size);
    if (status)
        return status;
    status = ag_image_load_memory(log, path, data, size, image);
    free(data);
    return status;
}

ag_status codec_fail_size(const ag_log *log, const char *name, const char *kind, uint64_t width,
                          uint64_t height, uint64_t bytes)
{
    if (!width || !height || width > IMAGE_PIXELS_MAX || height > IMAGE_PIXELS_MAX / width)
        return log_fail(log, AG_ERROR_UNSUPPORTED,
                        "%s: the %s header says %" PRIu64 " x %" PRIu64
                        " pixels; between 1 and 2^28 pixels are possible",
                        name, kind, width, height);
    return log_fail(log, AG_ERROR_FORMAT,
                    "%s: the %s header says %" PRIu64 " x %" PRIu64 " pixels, which %" PRIu64
                    " bytes cannot hold: the file is cut short or forged",
                    name, kind, width, height, bytes);
}
