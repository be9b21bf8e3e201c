// Images in the other format, and over white.
#include "image/image.h"
#include "image/srgb.h"

static void bytes_from_floats(const float *in, uint8_t *out, size_t pixels)
{
    srgb_encoder encoder;
    srgb_encoder_init(&encoder);
    for (size_t i = 0; i < pixels; i++, in += 4, out += 4) {
        for (int c = 0; c < 3; c++)
            out[c] = srgb_encode(&encoder, in[c]);
        float alpha = in[3] >= 1 ? 1 : in[3] > 0 ? in[3] : 0;
        out[3] = (uint8_t)(alpha * 255 + 0.5f);
    }
}

static void floats_from_bytes(const uint8_t *in, float *out, size_t pixels)
{
    float linear[256];
    srgb_decoder_init(linear);
    for (size_t i = 0; i < pixels; i++, in += 4, out += 4) {
        for (int c = 0; c < 3; c++)
            out[c] = linear[in[c]];
        out[3] = (float)in[3] / 255;
    }
}

static size_t pixel_count(const ag_image *image)
{
    return (size_t)image->width * image->height;
}

ag_status image_convert(const ag_log *log, const ag_image *image, ag_format format, ag_image **out)
{
    if (image->format == format) {
        ag_image_desc desc = { image->width, image->height, format, image->pixels };
        return ag_image_create(log, &desc, out);
    }
    ag_status status = image_allocate(log, "image", image->width, image->height, format, out);
    if (status)
        return status;
    if (format == AG_FORMAT_RGBA8)
        bytes_from_floats(image->pixels, (*out)->pixels, pixel_count(image));
    else
        floats_from_bytes(image->pixels, (*out)->pixels, pixel_count(image));
    return AG_OK;
}

bool image_is_opaque(const ag_image *image)
{
    size_t pixels = pixel_count(image), i = 0;
    if (image->format == AG_FORMAT_RGBA8) {
        const uint8_t *p = image->pixels;
        while (i < pixels && p[4 * i + 3] == 255)
            i++;
    } else {
        const float *p = image->pixels;
        while (i < pixels && p[4 * i + 3] == 1)
            i++;
    }
    return i == pixels;
}

static void bytes_over_white(const uint8_t *in, uint8_t *out, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++, in += 4, out += 4) {
        unsigned alpha = in[3];
        for (int c = 0; c < 3; c++)
            out[c] = (uint8_t)((in[c] * alpha + 255 * (255 - alpha) + 127) / 255);
        out[3] = 255;
    }
}

static void floats_over_white(const float *in, float *out, size_t pixels)
{
    for (size_t i = 0; i < pixels; i++, in += 4, out += 4) {
        float alpha = in[3] >= 1 ? 1 : in[3] > 0 ? in[3] : 0;
        for (int c = 0; c < 3; c++) // without colour where alpha is 0, even if that is infinite
            out[c] = (alpha > 0 ? in[c] * alpha : 0) + (1 - alpha);
        out[3] = 1;
    }
}

ag_status image_over_white(const ag_log *log, const ag_image *image, ag_image **out)
{
    ag_status status =
        image_allocate(log, "image", image->width, image->height, image->format, out);
    if (status)
        return status;
    if (image->format == AG_FORMAT_RGBA8)
        bytes_over_white(image->pixels, (*out)->pixels, pixel_count(image));
    else
        floats_over_white(image->pixels, (*out)->pixels, pixel_count(image));
    return AG_OK;
}
