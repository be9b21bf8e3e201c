// OpenEXR, writing: one part of zipped scanlines, whose channels are those of all layers.  Colours
// are multiplied by alpha, which is left out where it is 1 everywhere.  Half where that loses
// nothing in a layer, else float.
#include "image/codec.h"

#include "base/array.h"
#include "base/log.h"
#include "image/half.h"

#include <openexr.h>
#include <stdio.h>
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

// A layer on its way: its pixels are taken as `channels` names their first components.
typedef struct layer {
    const char *name;
    const ag_image *image;
    const char *channels;
    int channel_count;
    bool half, multiply; // colours by alpha
    float *rows;         // ROWS_PER_CHUNK of them, four values a pixel
    uint16_t *halves;    // the same
} layer;

static void load_rows(const layer *l, uint32_t y, uint32_t count)
{
    size_t pixels = (size_t)l->image->width * count;
    memcpy(l->rows, (const float *)l->image->pixels + (size_t)y * l->image->width * 4,
           pixels * 4 * sizeof *l->rows);
    for (size_t i = 0; i < pixels && l->multiply; i++)
        for (size_t c = 0; c < 3; c++)
            l->rows[4 * i + c] *= l->rows[4 * i + 3];
    if (l->half)
        half_from_floats(l->rows, l->halves, pixels * 4);
}

static bool fits_half(float value)
{
    return half_to_float(half_from_float(value)) == value;
}

// Whether all that is written of a layer can be halves.
static bool all_fit_half(const layer *l)
{
    size_t values = (size_t)l->image->width * 4, channels = (size_t)l->channel_count;
    for (uint32_t y = 0; y < l->image->height; y++) {
        load_rows(l, y, 1);
        for (size_t i = 0; i < values; i++)
            if (i % 4 < channels && !fits_half(l->rows[i]))
                return false;
    }
    return true;
}

static void layer_finish(layer *l)
{
    free(l->rows);
    free(l->halves);
}

// False when there is no memory.
static bool layer_init(layer *l, const ag_image_layer *from)
{
    size_t values = (size_t)from->image->width * ROWS_PER_CHUNK * 4;
    *l = (layer) {
        .name = from->name ? from->name : "",
        .image = from->image,
        .channels = from->channels ? from->channels : "RGBA",
        .rows = malloc(values * sizeof *l->rows),
        .halves = malloc(values * sizeof *l->halves),
    };
    if (!l->rows || !l->halves)
        return false;
    l->channel_count = (int)strlen(l->channels);
    if (l->channel_count == 4 && l->channels[3] == 'A') {
        l->multiply = !image_is_opaque(l->image);
        l->channel_count -= !l->multiply;
    }
    l->half = all_fit_half(l);
    return true;
}

typedef struct channel_name {
    char text[64];
} channel_name;

static channel_name name_channel(const layer *l, int channel)
{
    channel_name name;
    snprintf(name.text, sizeof name.text, "%s%s%c", l->name, *l->name ? "." : "",
             l->channels[channel]);
    return name;
}

// A file's layers, all of one size.
typedef struct layers {
    layer *items;
    size_t count;
} layers;

static exr_pixel_type_t pixel_type(const layer *l)
{
    return l->half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
}

// The library keeps channels in the order of their names.
static exr_result_t add_channels(exr_context_t exr, int part, const layer *l)
{
    exr_result_t code = EXR_ERR_SUCCESS;
    for (int i = 0; i < l->channel_count && !code; i++)
        code = exr_add_channel(exr, part, name_channel(l, i).text, pixel_type(l),
                               EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    return code;
}

static exr_result_t add_notes(exr_context_t exr, int part, const ag_image_save_options *options)
{
    exr_result_t code = EXR_ERR_SUCCESS;
    for (size_t i = 0; i < options->note_count && !code; i++) {
        const ag_image_note *note = &options->notes[i];
        code = note->text ? exr_attr_set_string(exr, part, note->key, note->text)
                          : exr_attr_set_float(exr, part, note->key, (float)note->number);
    }
    return code;
}

static exr_result_t begin(exr_context_t exr, const layers *all,
                          const ag_image_save_options *options)
{
    int part;
    const ag_image *first = all->items[0].image;
    exr_result_t code = exr_add_part(exr, NULL, EXR_STORAGE_SCANLINE, &part);
    if (!code)
        code = exr_initialize_required_attr_simple(exr, part, (int)first->width, (int)first->height,
                                                   EXR_COMPRESSION_ZIP);
    for (size_t i = 0; i < all->count && !code; i++)
        code = add_channels(exr, part, &all->items[i]);
    const exr_attr_chromaticities_t rec709 = { 0.64f, 0.33f, 0.30f,   0.60f,
                                               0.15f, 0.06f, 0.3127f, 0.3290f };
    if (!code)
        code = exr_attr_set_chromaticities(exr, part, "chromaticities", &rec709);
    if (!code)
        code = add_notes(exr, part, options);
    return code ? code : exr_write_header(exr);
}

static void point_channel(exr_coding_channel_info_t *channel, const layers *all)
{
    for (size_t i = 0; i < all->count; i++) {
        const layer *l = &all->items[i];
        for (int c = 0; c < l->channel_count; c++) {
            if (strcmp(channel->channel_name, name_channel(l, c).text) != 0)
                continue;
            int16_t bytes = l->half ? 2 : 4;
            const void *rows = l->half ? (const void *)l->halves : (const void *)l->rows;
            channel->encode_from_ptr = (const uint8_t *)rows + c * bytes;
            channel->user_data_type = (uint16_t)pixel_type(l);
            channel->user_bytes_per_element = bytes;
            channel->user_pixel_stride = 4 * bytes;
            channel->user_line_stride = (int32_t)l->image->width * 4 * bytes;
        }
    }
}

static exr_result_t encode_chunk(exr_context_t exr, exr_encode_pipeline_t *pipeline, uint32_t y,
                                 const layers *all)
{
    exr_chunk_info_t chunk;
    exr_result_t code = exr_write_scanline_chunk_info(exr, 0, (int)y, &chunk);
    bool first = !pipeline->context;
    if (!code)
        code = first ? exr_encoding_initialize(exr, 0, &chunk, pipeline)
                     : exr_encoding_update(exr, 0, &chunk, pipeline);
    if (code)
        return code;
    for (int i = 0; i < pipeline->channel_count; i++)
        point_channel(&pipeline->channels[i], all);
    if (first)
        code = exr_encoding_choose_default_routines(exr, 0, pipeline);
    return code ? code : exr_encoding_run(exr, 0, pipeline);
}

static exr_result_t encode_rows(exr_context_t exr, const layers *all)
{
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t code = EXR_ERR_SUCCESS;
    uint32_t height = all->items[0].image->height;
    for (uint32_t y = 0; y < height && !code; y += ROWS_PER_CHUNK) {
        uint32_t left = height - y;
        for (size_t i = 0; i < all->count; i++)
            load_rows(&all->items[i], y, left < ROWS_PER_CHUNK ? left : ROWS_PER_CHUNK);
        code = encode_chunk(exr, &pipeline, y, all);
    }
    exr_encoding_destroy(exr, &pipeline);
    return code;
}

static exr_result_t encode(const layers *all, const char *name,
                           const ag_image_save_options *options, buffer *out)
{
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = ignore_reason;
    settings.user_data = out;
    settings.write_fn = write_bytes;
    settings.zip_level = 1; // a quarter of the time of the default 4, files 8 % larger
    exr_context_t exr = NULL;
    exr_result_t code = exr_start_write(&exr, name, EXR_WRITE_FILE_DIRECTLY, &settings);
    if (!code)
        code = begin(exr, all, options);
    if (!code)
        code = encode_rows(exr, all);
    exr_result_t finished = exr ? exr_finish(&exr) : EXR_ERR_SUCCESS;
    return code ? code : finished;
}

static exr_result_t encode_all(const char *name, const ag_image_layer *from, size_t count,
                               const ag_image_save_options *options, buffer *out)
{
    layers all = { .items = calloc(count, sizeof *all.items), .count = count };
    bool enough = all.items;
    for (size_t i = 0; i < count && enough; i++)
        enough = layer_init(&all.items[i], &from[i]);
    exr_result_t code = enough ? encode(&all, name, options, out) : EXR_ERR_OUT_OF_MEMORY;
    for (size_t i = 0; i < count && all.items; i++)
        layer_finish(&all.items[i]);
    free(all.items);
    return code;
}

ag_status image_encode_exr_layers(const ag_log *log, const char *name, const ag_image_layer *from,
                                  size_t count, const ag_image_save_options *options,
                                  file_writer *out)
{
    uint32_t width = from[0].image->width;
    if (width > 1 << 24) // rows of 16 lines are counted in 32 bits by the library
        return log_fail(log, AG_ERROR_UNSUPPORTED,
                        "%s: an OpenEXR image is at most 2^24 pixels wide, not %u; choose .hdr",
                        name, width);
    buffer bytes = { 0 };
    exr_result_t code = encode_all(name, from, count, options, &bytes);
    ag_status status;
    if (code == EXR_ERR_ATTR_TYPE_MISMATCH) // the only one that is not memory's
        status =
            log_fail(log, AG_ERROR_ARGUMENT,
                     "%s: a note has the key of an attribute that every OpenEXR file has", name);
    else if (code)
        status = log_fail(log, AG_ERROR_MEMORY, "%s: cannot be written as OpenEXR: %s", name,
                          exr_get_default_error_message(code));
    else
        status = file_writer_put(out, bytes.bytes, bytes.size);
    free(bytes.bytes);
    return status;
}

ag_status image_encode_exr(const ag_log *log, const char *name, const ag_image *image,
                           const ag_image_save_options *options, file_writer *out)
{
    return image_encode_exr_layers(log, name, &(ag_image_layer) { .image = image }, 1, options,
                                   out);
}
