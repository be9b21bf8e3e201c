// Writing images: the name's ending tells the codec.
#include "image/codec.h"

#include "base/log.h"
#include "image/notes.h"

#include <string.h>
#include <strings.h>

typedef struct codec {
    const char *ending;
    image_encoder *encode;
    ag_format format;
    bool has_alpha;
} codec;

static const codec codecs[] = {
    { ".png", image_encode_png, AG_FORMAT_RGBA8, true },
    { ".jpg", image_encode_jpeg, AG_FORMAT_RGBA8, false },
    { ".jpeg", image_encode_jpeg, AG_FORMAT_RGBA8, false },
    { ".webp", image_encode_webp, AG_FORMAT_RGBA8, true },
    { ".hdr", image_encode_hdr, AG_FORMAT_RGBA32F, false },
    { ".exr", image_encode_exr, AG_FORMAT_RGBA32F, true },
};

static const codec *find_codec(const char *path)
{
    const char *slash = strrchr(path, '/'), *ending = strrchr(slash ? slash : path, '.');
    for (size_t i = 0; ending && i < sizeof codecs / sizeof *codecs; i++)
        if (strcasecmp(ending, codecs[i].ending) == 0)
            return &codecs[i];
    return NULL;
}

// What the codec writes, made from what the caller has; `*made` is set where that is a
// new image, which is then the caller's to destroy.
static ag_status prepare(const ag_log *log, const ag_image *image, const codec *to, ag_image **made)
{
    *made = NULL;
    if (image->format != to->format) {
        ag_status status = image_convert(log, image, to->format, made);
        if (status)
            return status;
        image = *made;
    }
    if (to->has_alpha || image_is_opaque(image))
        return AG_OK;
    ag_image *opaque;
    ag_status status = image_over_white(log, image, &opaque);
    ag_image_destroy(*made);
    *made = opaque;
    return status;
}

// Into a writer that is finished afterwards or, on failure, gone.
static ag_status encode(const ag_log *log, const ag_image *image, const char *path,
                        const ag_image_save_options *options, file_writer *writer)
{
    const codec *to = find_codec(path);
    ag_image *made;
    ag_status status = prepare(log, image, to, &made);
    if (!status)
        status = to->encode(log, path, made ? made : image, options, writer);
    ag_image_destroy(made);
    if (status)
        file_writer_abandon(writer);
    return status;
}

// Whether that can be done at all; zeros among the options are filled in.
static ag_status check(const ag_log *log, const char *path, ag_image_save_options *o)
{
    const codec *to = find_codec(path);
    if (!to)
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "%s: the ending names no image format that can be written; it has to be "
                        ".png, .jpg, .jpeg, .webp, .hdr or .exr",
                        path);
    o->quality = o->quality ? o->quality : 92;
    o->compression = o->compression ? o->compression : 2;
    if (o->quality < 1 || o->quality > 100 || o->compression < 1 || o->compression > 9)
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "%s: quality %d (1 to 100) or compression %d (1 to 9) is out of range",
                        path, o->quality, o->compression);
    return notes_check(log, path, o->notes, o->note_count);
}

ag_status ag_image_save(const ag_log *log, const ag_image *image, const char *path,
                        const ag_image_save_options *options)
{
    ag_image_save_options filled = options ? *options : (ag_image_save_options) { 0 };
    file_writer *writer;
    ag_status status = check(log, path, &filled);
    if (!status)
        status = file_writer_open(log, path, &writer);
    if (!status)
        status = encode(log, image, path, &filled, writer);
    return status ? status : file_writer_commit(writer);
}

ag_status ag_image_save_memory(const ag_log *log, const ag_image *image, const char *name,
                               const ag_image_save_options *options, void **data, size_t *size)
{
    ag_image_save_options filled = options ? *options : (ag_image_save_options) { 0 };
    file_writer *writer;
    *data = NULL;
    *size = 0;
    ag_status status = check(log, name, &filled);
    if (!status)
        status = file_writer_open_memory(log, name, &writer);
    if (!status)
        status = encode(log, image, name, &filled, writer);
    if (!status)
        file_writer_take(writer, data, size);
    return status;
}
