// Writing images: the name's ending tells the codec.
#include "image/codec.h"

#include "base/log.h"

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

static ag_status write_file(const ag_log *log, const ag_image *image, const char *path,
                            const codec *to, const ag_image_save_options *options)
{
    file_writer *writer;
    ag_status status = file_writer_open(log, path, &writer);
    if (status)
        return status;
    status = to->encode(log, path, image, options, writer);
    if (status) {
        file_writer_abandon(writer);
        return status;
    }
    return file_writer_commit(writer);
}

ag_status ag_image_save(const ag_log *log, const ag_image *image, const char *path,
                        const ag_image_save_options *options)
{
    const codec *to = find_codec(path);
    if (!to)
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "%s: the ending names no image format that can be written; it has to be "
                        ".png, .jpg, .jpeg, .webp, .hdr or .exr",
                        path);
    ag_image_save_options filled = options ? *options : (ag_image_save_options) { 0 };
    filled.quality = filled.quality ? filled.quality : 92;
    filled.compression = filled.compression ? filled.compression : 2;
    if (filled.quality < 1 || filled.quality > 100 || filled.compression < 1 ||
        filled.compression > 9)
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "%s: quality %d (1 to 100) or compression %d (1 to 9) is out of range",
                        path, filled.quality, filled.compression);
    ag_image *made;
    ag_status status = prepare(log, image, to, &made);
    if (!status)
        status = write_file(log, made ? made : image, path, to, &filled);
    ag_image_destroy(made);
    return status;
}
