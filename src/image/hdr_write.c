// Radiance pictures (.hdr), writing, with the new run lengths (see hdr.c).
#include "image/codec.h"

#include "base/log.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WRITE_BYTES = 1 << 16 }; // at once, or a scanline

// A flat pixel of (1, 1, 1, ...) or (2, 2, ...) would be taken for a mark; it cannot occur,
// as the largest mantissa of ours is at least 128.
static void rgbe_from_floats(const float *in, uint8_t out[4])
{
    float v[3], largest = 0;
    for (int c = 0; c < 3; c++) { // NaN and negative -> 0; the format's end is 255 * 2^119
        v[c] = in[c] > 0 ? in[c] < 0x1.fep126f ? in[c] : 0x1.fep126f : 0;
        largest = v[c] > largest ? v[c] : largest;
    }
    memset(out, 0, 4);
    if (largest < 0x1p-126f)
        return;
    uint32_t bits;
    memcpy(&bits, &largest, sizeof bits);
    int exponent = (int)(bits >> 23) - 126; // of a fraction of 1/2 to 1
    if ((bits & 0x7fffff) >= 0x7f8000)      // 255.5 / 256 and more would round to 256
        exponent++;
    uint64_t scale_bits = (uint64_t)(1023 + 8 - exponent) << 52;
    double scale;
    memcpy(&scale, &scale_bits, sizeof scale);
    for (int c = 0; c < 3; c++)
        out[c] = (uint8_t)((double)v[c] * scale + 0.5);
    out[3] = (uint8_t)(exponent + 128);
}

static size_t run_length(const uint8_t *in, size_t left)
{
    size_t n = 1, most = left < 127 ? left : 127;
    while (n < most && in[n] == in[0])
        n++;
    return n;
}

// One channel of a scanline: runs of 4 or more, and what lies between them.
static uint8_t *encode_channel(const uint8_t *in, size_t length, uint8_t *out)
{
    for (size_t i = 0; i < length;) {
        size_t run = run_length(in + i, length - i);
        if (run >= 4) {
            *out++ = (uint8_t)(128 + run);
            *out++ = in[i];
            i += run;
            continue;
        }
        size_t start = i;
        do
            i += run;
        while (i < length && i - start < 124 && (run = run_length(in + i, length - i)) < 4);
        *out++ = (uint8_t)(i - start);
        memcpy(out, in + start, i - start);
        out += i - start;
    }
    return out;
}

// `planes` and `out` have room for 4 and 5 bytes a pixel, and 64.
static size_t encode_scanline(const float *in, uint32_t width, uint8_t *planes, uint8_t *out)
{
    bool flat = width < 8 || width > 32767;
    for (uint32_t x = 0; x < width; x++) {
        uint8_t pixel[4];
        rgbe_from_floats(in + (size_t)x * 4, pixel);
        if (flat)
            memcpy(out + (size_t)x * 4, pixel, 4);
        for (uint32_t c = 0; c < 4 && !flat; c++)
            planes[(size_t)c * width + x] = pixel[c];
    }
    if (flat)
        return (size_t)width * 4;
    uint8_t *end = out;
    *end++ = 2;
    *end++ = 2;
    *end++ = (uint8_t)(width >> 8);
    *end++ = (uint8_t)(width & 255);
    for (uint32_t c = 0; c < 4; c++)
        end = encode_channel(planes + (size_t)c * width, width, end);
    return (size_t)(end - out);
}

ag_status image_encode_hdr(const ag_log *log, const char *name, const ag_image *image,
                           const ag_image_save_options *options, file_writer *out)
{
    (void)options;
    size_t width = image->width, most = width * 5 + 64; // bytes of a scanline
    size_t room = most < WRITE_BYTES ? WRITE_BYTES : most, used = 0;
    uint8_t *planes = malloc(width * 4), *bytes = malloc(room + 128);
    ag_status status = AG_OK;
    if (!planes || !bytes)
        status = log_fail(log, AG_ERROR_MEMORY, "%s: no memory for a scanline", name);
    else
        used = (size_t)snprintf((char *)bytes, 128,
                                "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %u +X %u\n",
                                image->height, image->width);
    for (uint32_t y = 0; y < image->height && !status; y++) {
        const float *row = (const float *)image->pixels + y * width * 4;
        used += encode_scanline(row, image->width, planes, bytes + used);
        if (used + most <= room && y + 1 < image->height)
            continue;
        status = file_writer_put(out, bytes, used);
        used = 0;
    }
    free(planes);
    free(bytes);
    return status;
}
