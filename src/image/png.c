// PNG (ISO/IEC 15948), reading, through libspng.
#include "image/codec.h"

#include "base/log.h"

#include <spng.h>
#include <stdlib.h>

enum { CHUNK_LIMIT = 32 << 20 }; // bytes, of one ancillary chunk and of all of them inflated

static ag_status fail(const ag_log *log, const char *name, int error)
{
    ag_status status = error == SPNG_EMEM ? AG_ERROR_MEMORY : AG_ERROR_FORMAT;
    return log_fail(log, status, "%s: broken or cut-short PNG: %s", name, spng_strerror(error));
}

static uint64_t bits_per_pixel(const struct spng_ihdr *header)
{
    static const uint64_t channels[] = { 1, 0, 3, 1, 2, 0, 4 };
    return channels[header->color_type] * header->bit_depth;
}

// Deflate makes at most 1032 bytes of one.
static bool is_plausible(const struct spng_ihdr *header, size_t size)
{
    uint64_t bits = (uint64_t)header->width * header->height * bits_per_pixel(header);
    return codec_size_is_plausible(header->width, header->height, UINT64_MAX, 1) &&
           bits / 8 / 1032 <= size;
}

// To 8 bits, rounded as section 13.12 of the standard says: v / 257.
static void narrow(const uint16_t *in, uint8_t *out, size_t count)
{
    for (size_t i = 0; i < count; i++)
        out[i] = (uint8_t)((in[i] + 128u) / 257u);
}

static ag_status decode_deep(const ag_log *log, const char *name, spng_ctx *png, ag_image *image)
{
    size_t count = (size_t)image->width * image->height * 4;
    uint16_t *wide = malloc(count * 2);
    if (!wide)
        return fail(log, name, SPNG_EMEM);
    int error = spng_decode_image(png, wide, count * 2, SPNG_FMT_RGBA16, SPNG_DECODE_TRNS);
    if (!error)
        narrow(wide, image->pixels, count);
    free(wide);
    return error ? fail(log, name, error) : AG_OK;
}

static ag_status decode_pixels(const ag_log *log, const char *name, spng_ctx *png, int depth,
                               ag_image *image)
{
    if (depth == 16)
        return decode_deep(log, name, png, image);
    size_t size = (size_t)image->width * image->height * 4;
    int error = spng_decode_image(png, image->pixels, size, SPNG_FMT_RGBA8, SPNG_DECODE_TRNS);
    return error ? fail(log, name, error) : AG_OK;
}

static ag_status decode(const ag_log *log, const char *name, spng_ctx *png, size_t size,
                        ag_image **image)
{
    struct spng_ihdr header;
    int error = spng_get_ihdr(png, &header);
    if (error)
        return fail(log, name, error);
    if (!is_plausible(&header, size))
        return codec_fail_size(log, name, "PNG", header.width, header.height, size);
    ag_status status =
        image_allocate(log, name, header.width, header.height, AG_FORMAT_RGBA8, image);
    if (status)
        return status;
    status = decode_pixels(log, name, png, header.bit_depth, *image);
    if (!status && (error = spng_decode_chunks(png)) != 0) // to the end of the file
        status = fail(log, name, error);
    return status;
}

ag_status image_decode_png(const ag_log *log, const char *name, const void *data, size_t size,
                           ag_image **image)
{
    *image = NULL;
    spng_ctx *png = spng_ctx_new(0);
    int error = png ? spng_set_chunk_limits(png, CHUNK_LIMIT, CHUNK_LIMIT) : SPNG_EMEM;
    if (!error)
        error = spng_set_png_buffer(png, data, size);
    ag_status status = error ? fail(log, name, error) : decode(log, name, png, size, image);
    if (status) {
        ag_image_destroy(*image);
        *image = NULL;
    }
    spng_ctx_free(png);
    return status;
}
