// PNG (ISO/IEC 15948), writing: small files through libspng, fast ones through png_fast.c.
#include "image/png_write.h"

#include "base/log.h"

#include <spng.h>
#include <stdlib.h>
#include <string.h>

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
        error = spng_set_option(png, SPNG_IMG_COMPRESSION_LEVEL, compression);
    if (!error)
        error = spng_encode_image(png, NULL, 0, SPNG_FMT_PNG,
                                  SPNG_ENCODE_PROGRESSIVE | SPNG_ENCODE_FINALIZE);
    return error;
}

// The library looks into `room`, one for each note, until all is written.
static int set_notes(spng_ctx *png, const note_chunk *notes, size_t count,
                     struct spng_unknown_chunk *room)
{
    for (size_t i = 0; i < count; i++) {
        memcpy(room[i].type, notes[i].type, 4);
        room[i].data = notes[i].data;
        room[i].length = notes[i].size;
        room[i].location = SPNG_AFTER_IHDR;
    }
    return count ? spng_set_unknown_chunks(png, room, (uint32_t)count) : 0;
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

static ag_status write_small(const ag_log *log, const char *name, const ag_image *image,
                             bool opaque, const ag_image_save_options *options,
                             const note_chunk *notes, file_writer *out)
{
    sink to = { out, AG_OK };
    struct spng_unknown_chunk *room = calloc(options->note_count + 1, sizeof *room);
    spng_ctx *png = room ? spng_ctx_new(SPNG_CTX_ENCODER) : NULL;
    int error = png ? spng_set_png_stream(png, put, &to) : SPNG_EMEM;
    if (!error)
        error = set_notes(png, notes, options->note_count, room);
    if (!error)
        error = begin(png, image, opaque, options->compression);
    if (!error)
        error = encode_rows(png, image, opaque);
    spng_ctx_free(png);
    free(room);
    if (to.status)
        return to.status;
    if (error)
        return log_fail(log, error == SPNG_EMEM ? AG_ERROR_MEMORY : AG_ERROR_UNSUPPORTED,
                        "%s: cannot be written as PNG: %s", name, spng_strerror(error));
    return AG_OK;
}

// Measured on rendered pictures of 1024 x 1024: one filter and runs take a tenth of the
// time of a choice among all filters and zlib's search, for files of about the same size.
ag_status image_encode_png(const ag_log *log, const char *name, const ag_image *image,
                           const ag_image_save_options *options, file_writer *out)
{
    bool opaque = image_is_opaque(image);
    note_chunk *notes = note_chunks_create(options->notes, options->note_count);
    if (!notes)
        return log_fail(log, AG_ERROR_MEMORY, "%s: no memory to write it", name);
    ag_status status;
    if (options->compression <= 2 && image->width <= PNG_FAST_WIDTH_MAX)
        status = png_write_fast(log, name, image, opaque, options->compression == 1 ? 2 : 4, notes,
                                options->note_count, out);
    else
        status = write_small(log, name, image, opaque, options, notes, out);
    note_chunks_destroy(notes, options->note_count);
    return status;
}
