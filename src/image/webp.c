// WebP (RFC 9649) through libwebp.
#include "image/codec.h"

#include "base/log.h"

#include <webp/decode.h>
#include <webp/encode.h>

enum { PIXELS_PER_BYTE = 4096, FREE_BYTES = 4096 };

static ag_status fail(const ag_log *log, const char *name, VP8StatusCode code)
{
    static const char *const text[] = {
        [VP8_STATUS_OK] = "no error",
        [VP8_STATUS_OUT_OF_MEMORY] = "no memory",
        [VP8_STATUS_INVALID_PARAM] = "invalid parameter",
        [VP8_STATUS_BITSTREAM_ERROR] = "a broken bit stream",
        [VP8_STATUS_UNSUPPORTED_FEATURE] = "an unsupported feature",
        [VP8_STATUS_SUSPENDED] = "the data end too early",
        [VP8_STATUS_USER_ABORT] = "aborted",
        [VP8_STATUS_NOT_ENOUGH_DATA] = "the data end too early",
    };
    ag_status status = code == VP8_STATUS_OUT_OF_MEMORY ? AG_ERROR_MEMORY : AG_ERROR_FORMAT;
    return log_fail(log, status, "%s: broken or cut-short WebP: %s", name, text[code]);
}

static ag_status decode(const ag_log *log, const char *name, const void *data, size_t size,
                        WebPDecoderConfig *config, ag_image **image)
{
    uint32_t width = (uint32_t)config->input.width, height = (uint32_t)config->input.height;
    ag_status status = image_allocate(log, name, width, height, AG_FORMAT_RGBA8, image);
    if (status)
        return status;
    config->output.colorspace = MODE_RGBA;
    config->output.is_external_memory = 1;
    config->output.u.RGBA.rgba = (*image)->pixels;
    config->output.u.RGBA.stride = (int)width * 4;
    config->output.u.RGBA.size = (size_t)width * height * 4;
    VP8StatusCode code = WebPDecode(data, size, config);
    if (code == VP8_STATUS_OK)
        return AG_OK;
    ag_image_destroy(*image);
    *image = NULL;
    return fail(log, name, code);
}

ag_status image_decode_webp(const ag_log *log, const char *name, const void *data, size_t size,
                            ag_image **image)
{
    *image = NULL;
    WebPDecoderConfig config;
    if (!WebPInitDecoderConfig(&config))
        return log_fail(log, AG_ERROR_UNSUPPORTED,
                        "%s: libwebp is not the one Argand was built "
                        "with",
                        name);
    VP8StatusCode code = WebPGetFeatures(data, size, &config.input);
    if (code != VP8_STATUS_OK)
        return fail(log, name, code);
    if (config.input.has_animation)
        return log_fail(log, AG_ERROR_UNSUPPORTED,
                        "%s: an animated WebP; save one of its pictures as a still", name);
    // One colour takes no bits, whatever the size: this much is let through for nothing.
    uint64_t width = (uint64_t)config.input.width, height = (uint64_t)config.input.height;
    if (!codec_size_is_plausible(width, height, size + FREE_BYTES, PIXELS_PER_BYTE))
        return codec_fail_size(log, name, "WebP", width, height, size);
    return decode(log, name, data, size, &config, image);
}

ag_status image_encode_webp(const ag_log *log, const char *name, const ag_image *image,
                            const ag_image_save_options *options, file_writer *out)
{
    if (image->width > WEBP_MAX_DIMENSION || image->height > WEBP_MAX_DIMENSION)
        return log_fail(log, AG_ERROR_UNSUPPORTED,
                        "%s: WebP holds at most %d x %d pixels, not %u x %u; choose .png", name,
                        WEBP_MAX_DIMENSION, WEBP_MAX_DIMENSION, image->width, image->height);
    uint8_t *bytes = NULL;
    size_t size = WebPEncodeRGBA(image->pixels, (int)image->width, (int)image->height,
                                 (int)image->width * 4, (float)options->quality, &bytes);
    ag_status status = size ? file_writer_put(out, bytes, size)
                            : log_fail(log, AG_ERROR_MEMORY,
                                       "%s: cannot be written as WebP: "
                                       "no memory",
                                       name);
    WebPFree(bytes);
    return status;
}
