// PNG (ISO/IEC 15948) through libspng.
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

typedef struct sink {
    file_writer *out;
    ag_status status; // what the writer said and logged
} sink;

static int put(spng_ctx *png, void *user, void *bytes, size_t size)
{
    (void)png;
    sink *to = user;
    to->status = file_writer_put(to->out, bytes, size);
    return to->status ? SPNG_IO_ERROR : 0;
}

// The speed of both libraries lies in their searches.  Measured on rendered pictures:
// Paeth's filter alone with runs alone is four times as fast as the choice among all
// filters with full matching, at about the same size.
static int set_effort(spng_ctx *png, int compression)
{
    static const int run_lengths = 3; // zlib's Z_RLE
    bool fast = compression <= 2;
    int filters = compression == 1 ? SPNG_FILTER_CHOICE_UP
                  : fast           ? SPNG_FILTER_CHOICE_PAETH
                                   : SPNG_FILTER_CHOICE_ALL;
    int error = spng_set_option(png, SPNG_IMG_COMPRESSION_LEVEL, fast ? 1 : compression);
    if (!error)
        error = spng_set_option(png, SPNG_FILTER_CHOICE, filters);
    if (!error && fast)
        error = spng_set_option(png, SPNG_IMG_COMPRESSION_STRATEGY, run_lengths);
    return error;
}

static int begin(spng_ctx *png, const ag_image *image, bool opaque, int compression)
{
    struct spng_ihdr header = {
        .width = image->width,
        .height = image->height,
        .bit_depth = 8,
        .color_type = opaque ? SPNG_COLOR_TYPE_TRUECOLOR : SPNG_COLOR_TYPE_TRUECOLOR_ALPHA,
    };
    int error = spng_set_ihdr(png, &header);
    if (!error)
        error = spng_set_srgb(png, 0);
    if (!error)
        error = set_effort(png, compression);
    if (!error)
        error = spng_encode_image(png, NULL, 0, SPNG_FMT_PNG,
                                  SPNG_ENCODE_PROGRESSIVE | SPNG_ENCODE_FINALIZE);
    return error;
}

static void drop_alpha(const uint8_t *in, uint8_t *out, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++, in += 4, out += 3) {
        out[0] = in[0];
        out[1] = in[1];
        out[2] = in[2];
    }
}

// Opaque images are written without alpha.
static int encode_rows(spng_ctx *png, const ag_image *image, bool opaque)
{
    size_t width = image->width, bytes = width * (opaque ? 3 : 4);
    uint8_t *row = malloc(bytes);
    int error = row ? 0 : SPNG_EMEM;
    for (uint32_t y = 0; y < image->height && !error; y++) {
        const uint8_t *pixels = (const uint8_t *)image->pixels + y * width * 4;
        if (opaque)
            drop_alpha(pixels, row, width);
        error = spng_encode_row(png, opaque ? row : pixels, bytes);
    }
    free(row);
    return error == SPNG_EOI ? 0 : error;
}

ag_status image_encode_png(const ag_log *log, const char *name, const ag_image *image,
                           const ag_image_save_options *options, file_writer *out)
{
    sink to = { out, AG_OK };
    bool opaque = image_is_opaque(image);
    spng_ctx *png = spng_ctx_new(SPNG_CTX_ENCODER);
    int error = png ? spng_set_png_stream(png, put, &to) : SPNG_EMEM;
    if (!error)
        error = begin(png, image, opaque, options->compression);
    if (!error)
        error = encode_rows(png, image, opaque);
    spng_ctx_free(png);
    if (to.status)
        return to.status;
    if (error)
        return log_fail(log, error == SPNG_EMEM ? AG_ERROR_MEMORY : AG_ERROR_UNSUPPORTED,
                        "%s: cannot be written as PNG: %s", name, spng_strerror(error));
    return AG_OK;
}
