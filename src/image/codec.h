// The codecs behind ag_image_load and ag_image_save, one or two files each.
#ifndef AG_IMAGE_CODEC_H
#define AG_IMAGE_CODEC_H

#include "base/file.h"
#include "image/image.h"

// Decode a file's bytes; `name` stands for the file in messages.
typedef ag_status image_decoder(const ag_log *log, const char *name, const void *data, size_t size,
                                ag_image **image);
AG_CHECK image_decoder image_decode_png;
AG_CHECK image_decoder image_decode_jpeg;
AG_CHECK image_decoder image_decode_webp;
AG_CHECK image_decoder image_decode_hdr;
AG_CHECK image_decoder image_decode_exr;

// Encode an image of the codec's own format (RGBA8: PNG, JPEG, WebP; RGBA32F: HDR, EXR) with
// options whose zeros have been filled in, and put the bytes to `out`.
typedef ag_status image_encoder(const ag_log *log, const char *name, const ag_image *image,
                                const ag_image_save_options *options, file_writer *out);
AG_CHECK image_encoder image_encode_png;
AG_CHECK image_encoder image_encode_jpeg;
AG_CHECK image_encoder image_encode_webp;
AG_CHECK image_encoder image_encode_hdr;
AG_CHECK image_encoder image_encode_exr;

// RGBA32F images of one size as the channels of one file; names and notes have been checked.
AG_CHECK ag_status image_encode_exr_layers(const ag_log *log, const char *name,
                                           const ag_image_layer *layers, size_t count,
                                           const ag_image_save_options *options,
                                           file_writer *out);

// A header may claim any size.  False, before any memory is taken, when `bytes` of a
// format that can at best hold `pixels_per_byte` cannot hold width x height.
static inline bool codec_size_is_plausible(uint64_t width, uint64_t height, uint64_t bytes,
                                           uint64_t pixels_per_byte)
{
    return width && height && width <= IMAGE_PIXELS_MAX && height <= IMAGE_PIXELS_MAX / width &&
           width * height <= bytes * pixels_per_byte;
}

// The sentence for it.
AG_CHECK ag_status codec_fail_size(const ag_log *log, const char *name, const char *kind,
                                   uint64_t width, uint64_t height, uint64_t bytes);

#endif
