// A picture as a text: WebP in base64 (RFC 4648) in a data URI (RFC 2397).
#include "data_uri.h"

#include <stdio.h>
#include <stdlib.h>

static char *encode(const unsigned char *data, size_t size)
{
    static const char prefix[] = "data:image/webp;base64,";
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *text = malloc(sizeof prefix + (size + 2) / 3 * 4), *out = text;
    if (!text)
        return NULL;
    out += sprintf(out, "%s", prefix);
    for (size_t i = 0; i < size; i += 3) {
        size_t left = size - i;
        unsigned bits = (unsigned)data[i] << 16;
        bits |= left > 1 ? (unsigned)data[i + 1] << 8 : 0;
        bits |= left > 2 ? data[i + 2] : 0;
        *out++ = digits[bits >> 18];
        *out++ = digits[bits >> 12 & 63];
        *out++ = left > 1 ? digits[bits >> 6 & 63] : '=';
        *out++ = left > 2 ? digits[bits & 63] : '=';
    }
    *out = 0;
    return text;
}

ag_status data_uri_from_image(const ag_log *log, const ag_image *image, int quality, char **uri)
{
    const ag_image_save_options options = { .quality = quality };
    void *data;
    size_t size;
    *uri = NULL;
    ag_status status = ag_image_save_memory(log, image, "page.webp", &options, &data, &size);
    if (status)
        return status;
    *uri = encode(data, size);
    free(data);
    return *uri ? AG_OK : AG_ERROR_MEMORY;
}
