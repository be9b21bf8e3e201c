// OpenEXR, reading: one part, scanlines or tiles (of a mip-mapped file the largest
// level), channels R, G, B and A or Y of any type, through OpenEXRCore.
//
// OpenEXR's colours are multiplied by alpha ("Technical Introduction to OpenEXR"); they
// are divided by it here.
#include "image/codec.h"

#include "base/log.h"

#include <openexr.h>
#include <stdlib.h>
#include <string.h>

enum {
    WIDTH_MAX = 1 << 26,       // px: a row of floats has to be below 2^31 bytes
    PIXELS_PER_BYTE = 1 << 13, // zip at its best, twice over, on one half channel
    TILE_MAX = 1 << 14,        // px
};

typedef struct source {
    const ag_log *log;
    const char *name;
    const uint8_t *data;
    size_t size;
    char reason[256]; // the library's last sentence
} source;

static void *bounded_alloc(size_t size)
{
    return size <= (size_t)1 << 32 ? malloc(size) : NULL;
}

static int64_t read_bytes(exr_const_context_t exr, void *user, void *buffer, uint64_t size,
                          uint64_t offset, exr_stream_error_func_ptr_t error)
{
    (void)exr;
    (void)error;
    const source *s = user;
    if (offset >= s->size)
        return 0;
    uint64_t n = s->size - offset < size ? s->size - offset : size;
    memcpy(buffer, s->data + offset, n);
    return (int64_t)n;
}

static int64_t query_size(exr_const_context_t exr, void *user)
{
    (void)exr;
    return (int64_t)((source *)user)->size;
}

static void keep_reason(exr_const_context_t exr, exr_result_t code, const char *message)
{
    (void)code;
    void *user;
    if (!exr || exr_get_user_data(exr, &user) != EXR_ERR_SUCCESS || !user)
        return;
    source *s = user;
    size_t length = strnlen(message, sizeof s->reason - 1);
    for (size_t i = 0; i < length; i++) // file contents may be quoted
        s->reason[i] = message[i] >= ' ' && message[i] < 127 ? message[i] : '?';
    s->reason[length] = 0;
}

static ag_status fail(const source *s, exr_result_t code)
{
    return log_fail(s->log, code == EXR_ERR_OUT_OF_MEMORY ? AG_ERROR_MEMORY : AG_ERROR_FORMAT,
                    "%s: broken or cut-short OpenEXR: %s", s->name,
                    s->reason[0] ? s->reason : exr_get_default_error_message(code));
}

typedef struct layout {
    exr_attr_box2i_t window;
    uint32_t width, height;
    exr_storage_t storage;
    bool luminance;  // Y instead of R, G, B
    bool present[4]; // R (or Y), G, B, A
} layout;

// 0 to 3 for a channel that is wanted, else -1.
static int channel_slot(const layout *l, const char *name)
{
    if (l->luminance && strcmp(name, "Y") == 0)
        return 0;
    const char *found = name[0] && !name[1] ? strchr("RGBA", name[0]) : NULL;
    int slot = found ? (int)(found - "RGBA") : -1;
    return l->luminance && slot >= 0 && slot < 3 ? -1 : slot;
}

static ag_status read_channels(const source *s, exr_const_context_t exr, layout *l)
{
    const exr_attr_chlist_t *list;
    exr_result_t code = exr_get_channels(exr, 0, &list);
    if (code)
        return fail(s, code);
    bool color = false, chroma = false;
    for (int i = 0; i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *entry = &list->entries[i];
        const char *name = entry->name.str;
        color = color || (name[0] && !name[1] && strchr("RGB", name[0]));
        chroma = chroma || strcmp(name, "RY") == 0 || strcmp(name, "BY") == 0;
        l->luminance = l->luminance || strcmp(name, "Y") == 0;
        if (entry->x_sampling != 1 || entry->y_sampling != 1)
            return log_fail(s->log, AG_ERROR_UNSUPPORTED,
                            "%s: OpenEXR channel %.40s is subsampled; save the image as RGB",
                            s->name, name);
    }
    l->luminance = l->luminance && !color;
    for (int i = 0; i < list->num_channels; i++) {
        int slot = channel_slot(l, list->entries[i].name.str);
        if (slot >= 0)
            l->present[slot] = true;
    }
    if (!color && (!l->luminance || chroma))
        return log_fail(s->log, AG_ERROR_UNSUPPORTED,
                        "%s: the OpenEXR file has no channels R, G, B or Y alone; save it as RGB",
                        s->name);
    return AG_OK;
}

static ag_status check_compression(const source *s, exr_const_context_t exr)
{
    exr_compression_t kind;
    exr_result_t code = exr_get_compression(exr, 0, &kind);
    if (code)
        return fail(s, code);
    if (kind == EXR_COMPRESSION_DWAA || kind == EXR_COMPRESSION_DWAB) // not in OpenEXRCore 3.1
        return log_fail(s->log, AG_ERROR_UNSUPPORTED,
                        "%s: OpenEXR's compression DWA%c cannot be read; save it as ZIP or PIZ",
                        s->name, kind == EXR_COMPRESSION_DWAA ? 'A' : 'B');
    return AG_OK;
}

static ag_status read_layout(const source *s, exr_const_context_t exr, layout *l)
{
    int parts = 0;
    exr_result_t code = exr_get_count(exr, &parts);
    if (!code && parts != 1)
        return log_fail(s->log, AG_ERROR_UNSUPPORTED,
                        "%s: an OpenEXR file of %d parts; save the one wanted by itself", s->name,
                        parts);
    if (!code)
        code = exr_get_storage(exr, 0, &l->storage);
    if (!code && l->storage != EXR_STORAGE_SCANLINE && l->storage != EXR_STORAGE_TILED)
        return log_fail(s->log, AG_ERROR_UNSUPPORTED,
                        "%s: a deep OpenEXR file; flatten it to an image", s->name);
    if (!code)
        code = exr_get_data_window(exr, 0, &l->window);
    if (code)
        return fail(s, code);
    int64_t width = (int64_t)l->window.max.x - l->window.min.x + 1;
    int64_t height = (int64_t)l->window.max.y - l->window.min.y + 1;
    if (width < 1 || height < 1 || width > WIDTH_MAX ||
        !codec_size_is_plausible((uint64_t)width, (uint64_t)height, s->size, PIXELS_PER_BYTE))
        return codec_fail_size(s->log, s->name, "OpenEXR", width < 1 ? 0 : (uint64_t)width,
                               height < 1 ? 0 : (uint64_t)height, s->size);
    l->width = (uint32_t)width;
    l->height = (uint32_t)height;
    ag_status status = check_compression(s, exr);
    return status ? status : read_channels(s, exr, l);
}

// Decode one chunk into the rectangle whose first pixel is `out`.
static exr_result_t decode_chunk(exr_const_context_t exr, const exr_chunk_info_t *chunk,
                                 exr_decode_pipeline_t *pipeline, const layout *l, float *out)
{
    bool first = !pipeline->context;
    exr_result_t code = first ? exr_decoding_initialize(exr, 0, chunk, pipeline)
                              : exr_decoding_update(exr, 0, chunk, pipeline);
    if (code)
        return code;
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[i];
        int slot = channel_slot(l, channel->channel_name);
        channel->decode_to_ptr = slot < 0 ? NULL : (uint8_t *)(out + slot);
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_pixel_stride = 4 * sizeof(float);
        channel->user_line_stride = (int32_t)(l->width * 4 * sizeof(float));
    }
    if (first)
        code = exr_decoding_choose_default_routines(exr, 0, pipeline);
    return code ? code : exr_decoding_run(exr, 0, pipeline);
}

static exr_result_t decode_scanlines(exr_const_context_t exr, exr_decode_pipeline_t *pipeline,
                                     const layout *l, float *pixels)
{
    int32_t step;
    exr_result_t code = exr_get_scanlines_per_chunk(exr, 0, &step);
    for (uint32_t y = 0; y < l->height && !code; y += (uint32_t)step) {
        exr_chunk_info_t chunk;
        code = exr_read_scanline_chunk_info(exr, 0, l->window.min.y + (int)y, &chunk);
        if (!code &&
            (chunk.start_y != l->window.min.y + (int)y || chunk.height < 1 || chunk.height > step ||
             (uint32_t)chunk.height > l->height - y || (uint32_t)chunk.width != l->width))
            code = EXR_ERR_CORRUPT_CHUNK;
        if (!code)
            code = decode_chunk(exr, &chunk, pipeline, l, pixels + (size_t)y * l->width * 4);
    }
    return code;
}

static exr_result_t decode_tiles(exr_const_context_t exr, exr_decode_pipeline_t *pipeline,
                                 const layout *l, float *pixels)
{
    uint32_t w, h;
    exr_tile_level_mode_t level;
    exr_tile_round_mode_t round;
    exr_result_t code = exr_get_tile_descriptor(exr, 0, &w, &h, &level, &round);
    if (!code && (w < 1 || h < 1 || w > TILE_MAX || h > TILE_MAX))
        code = EXR_ERR_INVALID_ATTR;
    for (uint32_t y = 0; !code && y < l->height; y += h)
        for (uint32_t x = 0; !code && x < l->width; x += w) {
            exr_chunk_info_t chunk;
            code = exr_read_tile_chunk_info(exr, 0, (int)(x / w), (int)(y / h), 0, 0, &chunk);
            if (!code && (chunk.width < 1 || (uint32_t)chunk.width > l->width - x ||
                          chunk.height < 1 || (uint32_t)chunk.height > l->height - y))
                code = EXR_ERR_CORRUPT_CHUNK;
            if (!code)
                code =
                    decode_chunk(exr, &chunk, pipeline, l, pixels + ((size_t)y * l->width + x) * 4);
        }
    return code;
}

// What no channel filled: colours are 0, alpha is 1; and colours without their alpha.
static void complete(const layout *l, float *pixels)
{
    size_t count = (size_t)l->width * l->height;
    for (size_t i = 0; i < count; i++, pixels += 4) {
        for (int c = 0; c < 3; c++)
            pixels[c] = l->luminance ? pixels[0] : l->present[c] ? pixels[c] : 0;
        if (!l->present[3])
            pixels[3] = 1;
        else if (pixels[3] > 0 && pixels[3] != 1)
            for (int c = 0; c < 3; c++)
                pixels[c] /= pixels[3];
    }
}

static ag_status decode(source *s, exr_const_context_t exr, ag_image **image)
{
    layout l = { 0 };
    ag_status status = read_layout(s, exr, &l);
    if (!status)
        status = image_allocate(s->log, s->name, l.width, l.height, AG_FORMAT_RGBA32F, image);
    if (status)
        return status;
    float *pixels = (*image)->pixels;
    exr_decode_pipeline_t pipeline = EXR_DECODE_PIPELINE_INITIALIZER;
    exr_result_t code = l.storage == EXR_STORAGE_TILED
                            ? decode_tiles(exr, &pipeline, &l, pixels)
                            : decode_scanlines(exr, &pipeline, &l, pixels);
    exr_decoding_destroy(exr, &pipeline);
    if (code)
        return fail(s, code);
    complete(&l, pixels);
    return AG_OK;
}

ag_status image_decode_exr(const ag_log *log, const char *name, const void *data, size_t size,
                           ag_image **image)
{
    *image = NULL;
    source s = { .log = log, .name = name, .data = data, .size = size };
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = keep_reason;
    settings.alloc_fn = bounded_alloc;
    settings.free_fn = free;
    settings.user_data = &s;
    settings.read_fn = read_bytes;
    settings.size_fn = query_size;
    settings.max_image_width = WIDTH_MAX;
    settings.max_image_height = WIDTH_MAX;
    settings.max_tile_width = settings.max_tile_height = TILE_MAX;
    settings.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    exr_context_t exr = NULL;
    exr_result_t code = exr_start_read(&exr, name, &settings);
    ag_status status = code ? fail(&s, code) : decode(&s, exr, image);
    if (exr)
        exr_finish(&exr);
    if (status) {
        ag_image_destroy(*image);
        *image = NULL;
    }
    return status;
}
