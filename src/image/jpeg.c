// JPEG (ITU-T T.81) through libjpeg-turbo's TurboJPEG.
#include "image/codec.h"

#include "base/log.h"

#include <stdlib.h>
#include <string.h>
#include <turbojpeg.h>

// A block of 8 x 8 needs at least a bit of the first scan of a progressive file; four
// pixels stand under one chroma-subsampled luma block's share of it.
enum { PIXELS_PER_BYTE = 4 * 8 * 64 };

// Each scan of a progressive file passes over the whole image: no more than this in all.
static const uint64_t work_limit = (uint64_t)1 << 33; // px

static unsigned count_scans(const uint8_t *data, size_t size)
{
    unsigned count = 0;
    for (const uint8_t *p = data, *end = data + size; p && end - p >= 2;) {
        p = memchr(p, 0xff, (size_t)(end - p) - 1);
        if (p && *++p == 0xda)
            count++;
    }
    return count;
}

// Adobe's CMYK files, the only ones in use, store 255 for no ink.
static void rgba_from_cmyk(uint8_t *p, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++, p += 4) {
        unsigned key = p[3];
        for (int c = 0; c < 3; c++)
            p[c] = (uint8_t)((p[c] * key + 127) / 255);
        p[3] = 255;
    }
}

// libjpeg goes on after a flaw and fills in what is missing.  Only of flaws that touch no
// pixel is it enough to warn.  Of several it tells the first.
static bool is_harmless(const char *text)
{
    static const char *const parts[] = { "extraneous bytes", "JFIF revision", "Adobe color" };
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (strstr(text, parts[i]))
            return true;
    return false;
}

static ag_status judge(const ag_log *log, const char *name, tjhandle jpeg)
{
    const char *text = tjGetErrorStr2(jpeg);
    if (tjGetErrorCode(jpeg) == TJERR_WARNING && is_harmless(text)) {
        log_write(log, AG_LOG_WARNING, "%s: flawed JPEG: %s", name, text);
        return AG_OK;
    }
    return log_fail(log, AG_ERROR_FORMAT, "%s: broken or cut-short JPEG: %s", name, text);
}

static ag_status decode(const ag_log *log, const char *name, tjhandle jpeg, const uint8_t *data,
                        size_t size, ag_image **image)
{
    int width = 0, height = 0, subsampling, colorspace = TJCS_YCbCr;
    if (tjDecompressHeader3(jpeg, data, size, &width, &height, &subsampling, &colorspace) != 0 &&
        tjGetErrorCode(jpeg) == TJERR_FATAL)
        return judge(log, name, jpeg);
    if (width < 1 || height < 1)
        return log_fail(log, AG_ERROR_FORMAT, "%s: the JPEG ends before its picture", name);
    uint64_t w = (uint64_t)width, h = (uint64_t)height;
    if (!codec_size_is_plausible(w, h, size, PIXELS_PER_BYTE))
        return codec_fail_size(log, name, "JPEG", w, h, size);
    if (w * h * count_scans(data, size) > work_limit)
        return log_fail(log, AG_ERROR_UNSUPPORTED,
                        "%s: a JPEG of %d x %d pixels in %u scans; save "
                        "it with fewer",
                        name, width, height, count_scans(data, size));
    ag_status status =
        image_allocate(log, name, (uint32_t)width, (uint32_t)height, AG_FORMAT_RGBA8, image);
    if (status)
        return status;
    bool cmyk = colorspace == TJCS_CMYK || colorspace == TJCS_YCCK;
    if (tjDecompress2(jpeg, data, size, (*image)->pixels, width, width * 4, height,
                      cmyk ? TJPF_CMYK : TJPF_RGBA, TJFLAG_ACCURATEDCT | TJFLAG_LIMITSCANS) != 0)
        status = judge(log, name, jpeg);
    if (cmyk && !status)
        rgba_from_cmyk((*image)->pixels, (size_t)(w * h));
    return status;
}

ag_status image_decode_jpeg(const ag_log *log, const char *name, const void *data, size_t size,
                            ag_image **image)
{
    *image = NULL;
    tjhandle jpeg = tjInitDecompress();
    if (!jpeg)
        return log_fail(log, AG_ERROR_MEMORY, "%s: no memory for the JPEG decoder", name);
    ag_status status = decode(log, name, jpeg, data, size, image);
    if (status) {
        ag_image_destroy(*image);
        *image = NULL;
    }
    tjDestroy(jpeg);
    return status;
}

ag_status image_encode_jpeg(const ag_log *log, const char *name, const ag_image *image,
                            const ag_image_save_options *options, file_writer *out)
{
    if (image->width > 65500 || image->height > 65500) // libjpeg's JPEG_MAX_DIMENSION
        return log_fail(log, AG_ERROR_UNSUPPORTED,
                        "%s: JPEG holds at most 65500 x 65500 pixels, not %u x %u; choose .png",
                        name, image->width, image->height);
    tjhandle jpeg = tjInitCompress();
    if (!jpeg)
        return log_fail(log, AG_ERROR_MEMORY, "%s: no memory for the JPEG encoder", name);
    unsigned char *bytes = NULL;
    unsigned long size = 0;
    int subsampling = options->quality >= 90 ? TJSAMP_444 : TJSAMP_420;
    int error = tjCompress2(jpeg, image->pixels, (int)image->width, (int)image->width * 4,
                            (int)image->height, TJPF_RGBX, &bytes, &size, subsampling,
                            options->quality, TJFLAG_ACCURATEDCT);
    ag_status status =
        error ? log_fail(log, AG_ERROR_UNSUPPORTED, "%s: cannot be written as JPEG: %s", name,
                         tjGetErrorStr2(jpeg))
              : file_writer_put(out, bytes, size);
    tjFree(bytes);
    tjDestroy(jpeg);
    return status;
}
