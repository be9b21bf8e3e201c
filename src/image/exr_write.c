// OpenEXR, writing: one part of zipped scanlines, colours multiplied by alpha, which is
// left out where it is 1 everywhere.  Half where that loses nothing, else float.
#include "image/codec.h"

#include "base/array.h"
#include "base/log.h"
#include "image/half.h"

#include <openexr.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS_PER_CHUNK = 16 }; // of EXR_COMPRESSION_ZIP

// The file as it grows: the library writes its table of offsets last, back at the start.
typedef struct buffer {
    uint8_t *bytes;
    size_t size, capacity;
} buffer;

static int64_t write_bytes(exr_const_context_t exr, void *user, const void *data, uint64_t size,
                           uint64_t offset, exr_stream_error_func_ptr_t error)
{
    (void)exr;
    (void)error;
    buffer *b = user;
    size_t end = (size_t)(offset + size);
    if (!array_reserve(&b->bytes, &b->capacity, end, 1))
        return -1;
    if (offset > b->size)
        memset(b->bytes + b->size, 0, offset - b->size);
    memcpy(b->bytes + offset, data, size);
    b->size = end > b->size ? end : b->size;
    return (int64_t)size;
}

static void ignore_reason(exr_const_context_t exr, exr_result_t code, const char *message)
{
    (void)exr, (void)code, (void)message;
}

typedef struct form {
    bool half, opaque;
} form;

static void premultiply(const float *in, float *out, size_t pixels, bool opaque)
{
    memcpy(out, in, pixels * 4 * sizeof *in);
    for (size_t i = 0; i < pixels && !opaque; i++)
        for (size_t c = 0; c < 3; c++)
            out[4 * i + c] *= in[4 * i + 3];
}

static bool fits_half(const float *values, size_t count)
{
    size_t i = 0;
    while (i < count && half_to_float(half_from_float(values[i])) == values[i])
        i++;
    return i == count;
}

// Whether all of the image, as it is written, can be halves; `row` is room for a row.
static bool all_fit_half(const ag_image *image, bool opaque, float *row)
{
    size_t width = image->width;
    for (uint32_t y = 0; y < image->height; y++) {
        premultiply((const float *)image->pixels + y * width * 4, row, width, opaque);
        if (!fits_half(row, width * 4))
            return false;
    }
    return true;
}

static exr_result_t begin(exr_context_t exr, const ag_image *image, form f)
{
    int part;
    exr_result_t code = exr_add_part(exr, NULL, EXR_STORAGE_SCANLINE, &part);
    if (!code)
        code = exr_initialize_required_attr_simple(exr, part, (int)image->width, (int)image->height,
                                                   EXR_COMPRESSION_ZIP);
    exr_pixel_type_t type = f.half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
    static const char *const names[] = { "A", "B", "G", "R" };
    for (int i = f.opaque ? 1 : 0; i < 4 && !code; i++)
        code = exr_add_channel(exr, part, names[i], type, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    const exr_attr_chromaticities_t rec709 = { 0.64f, 0.33f, 0.30f,   0.60f,
                                               0.15f, 0.06f, 0.3127f, 0.3290f };
    if (!code)
        code = exr_attr_set_chromaticities(exr, part, "chromaticities", &rec709);
    return code ? code : exr_write_header(exr);
}

static exr_result_t encode_chunk(exr_context_t exr, exr_encode_pipeline_t *pipeline, uint32_t y,
                                 size_t width, form f, const void *rows)
{
    exr_chunk_info_t chunk;
    exr_result_t code = exr_write_scanline_chunk_info(exr, 0, (int)y, &chunk);
    bool first = !pipeline->context;
    if (!code)
        code = first ? exr_encoding_initialize(exr, 0, &chunk, pipeline)
                     : exr_encoding_update(exr, 0, &chunk, pipeline);
    if (code)
        return code;
    size_t bytes = f.half ? 2 : 4;
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[i];
        size_t slot = (size_t)(strchr("RGBA", channel->channel_name[0]) - "RGBA");
        channel->encode_from_ptr = (const uint8_t *)rows + slot * bytes;
        channel->user_data_type = f.half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = (int16_t)bytes;
        channel->user_pixel_stride = (int32_t)(4 * bytes);
        channel->user_line_stride = (int32_t)(width * 4 * bytes);
    }
    if (first)
        code = exr_encoding_choose_default_routines(exr, 0, pipeline);
    return code ? code : exr_encoding_run(exr, 0, pipeline);
}

// `rows` is room for ROWS_PER_CHUNK rows of floats, `halves` for as many halves.
static exr_result_t encode_rows(exr_context_t exr, const ag_image *image, form f, float *rows,
                                uint16_t *halves)
{
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t code = EXR_ERR_SUCCESS;
    size_t width = image->width;
    for (uint32_t y = 0; y < image->height && !code; y += ROWS_PER_CHUNK) {
        uint32_t left = image->height - y, count = left < ROWS_PER_CHUNK ? left : ROWS_PER_CHUNK;
        const float *pixels = (const float *)image->pixels + y * width * 4;
        premultiply(pixels, rows, count * width, f.opaque);
        if (f.half)
            half_from_floats(rows, halves, count * width * 4);
        code = encode_chunk(exr, &pipeline, y, width, f,
                            f.half ? (const void *)halves : (const void *)rows);
    }
    exr_encoding_destroy(exr, &pipeline);
    return code;
}

static exr_result_t encode(const ag_image *image, const char *name, buffer *out)
{
    size_t values = (size_t)image->width * ROWS_PER_CHUNK * 4;
    float *rows = malloc(values * sizeof *rows);
    uint16_t *halves = malloc(values * sizeof *halves);
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = ignore_reason;
    settings.user_data = out;
    settings.write_fn = write_bytes;
    settings.zip_level = 1; // a quarter of the time of the default 4, files 8 % larger
    exr_context_t exr = NULL;
    exr_result_t code = rows && halves ? EXR_ERR_SUCCESS : EXR_ERR_OUT_OF_MEMORY;
    if (!code)
        code = exr_start_write(&exr, name, EXR_WRITE_FILE_DIRECTLY, &settings);
    if (!code) {
        form f = { .opaque = image_is_opaque(image) };
        f.half = all_fit_half(image, f.opaque, rows);
        code = begin(exr, image, f);
        if (!code)
            code = encode_rows(exr, image, f, rows, halves);
    }
    exr_result_t finished = exr ? exr_finish(&exr) : EXR_ERR_SUCCESS;
    free(rows);
    free(halves);
    return code ? code : finished;
}

ag_status image_encode_exr(const ag_log *log, const char *name, const ag_image *image,
                           const ag_image_save_options *options, file_writer *out)
{
    (void)options;
    if (image->width > 1 << 24) // rows of 16 lines are counted in 32 bits by the library
        return log_fail(log, AG_ERROR_UNSUPPORTED,
                        "%s: an OpenEXR image is at most 2^24 pixels wide, not %u; choose .hdr",
                        name, image->width);
    buffer bytes = { 0 };
    exr_result_t code = encode(image, name, &bytes);
    ag_status status = code ? log_fail(log, AG_ERROR_MEMORY, "%s: cannot be written as OpenEXR: %s",
                                       name, exr_get_default_error_message(code))
                            : file_writer_put(out, bytes.bytes, bytes.size);
    free(bytes.bytes);
    return status;
}
