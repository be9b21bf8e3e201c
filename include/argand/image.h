// Images in host memory, read from and written to files.
//
// Threads: an image is immutable after it is made, so that any number of threads
// may read it; distinct images are independent.
#ifndef ARGAND_IMAGE_H
#define ARGAND_IMAGE_H

#include <argand/base.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ag_image ag_image;

// Four channels, rows from the top, no padding between rows, straight alpha.
typedef enum ag_format {
    AG_FORMAT_RGBA8 = 0, // 8 bits each; sRGB-coded when it is a picture
    AG_FORMAT_RGBA32F,   // linear Rec. 709 floats: HDR, EXR
} ag_format;

typedef struct ag_image_desc {
    uint32_t width, height; // px, at least 1
    ag_format format;
    const void *pixels; // width * height * 4 channels, copied; NULL -> zeros
} ag_image_desc;

// Make an image.  AG_ERROR_ARGUMENT on a zero size or one above 2^28 pixels.
AG_CHECK ag_status ag_image_create(const ag_log *log, const ag_image_desc *desc, ag_image **image);

// Read PNG, JPEG, WebP (to RGBA8), Radiance HDR or OpenEXR (to RGBA32F).  What it
// is is told by its first bytes, never by its name.  NULL log -> stderr.  No colour
// profile or gamma is applied; EXR's colours are divided by alpha, HDR's values by the
// header's exposure.  AG_ERROR_FILE, _FORMAT (broken or cut short) or _UNSUPPORTED, where
// the sentence names what is.  Takes at most some 20 bytes a pixel, and the file.
AG_CHECK ag_status ag_image_load(const ag_log *log, const char *path, ag_image **image);

// The same from memory; `name` stands for the file in messages.
AG_CHECK ag_status ag_image_load_memory(const ag_log *log, const char *name, const void *data,
                                        size_t size, ag_image **image);

// A fact that is stored with an image: in PNG as a tEXt or iTXt chunk, in OpenEXR as an attribute
// of the header, a string or a float.  The other formats leave it out.
typedef struct ag_image_note {
    const char *key;  // 1 to 31 printable ASCII characters, spaces only single and between others
    const char *text; // UTF-8; NULL -> `number`
    double number;
} ag_image_note;

typedef struct ag_image_save_options {
    int quality;                // JPEG and WebP, 1 to 100; 0 -> 92
    int compression;            // PNG, 1 (fast) to 9 (small); 0 -> 2
    const ag_image_note *notes; // each key once
    size_t note_count;
} ag_image_save_options;

// Write an image; the name's ending chooses .png .jpg .jpeg .webp (from RGBA8)
// .hdr .exr (from RGBA32F).  The other format is converted: floats are clipped to
// [0, 1] and sRGB-coded, bytes are decoded.  JPEG and HDR have no alpha: it is
// composited over white, as a browser would.  OpenEXR keeps half floats where they
// lose nothing, else floats, and colours multiplied by alpha, as it demands.  The
// file appears whole or not at all: it is written beside its place and renamed.
// NULL options -> defaults.  AG_ERROR_ARGUMENT on an unknown ending, an option out of
// range or an unsound note, AG_ERROR_UNSUPPORTED where the format cannot hold the image's size,
// AG_ERROR_FILE where it cannot be written.
AG_CHECK ag_status ag_image_save(const ag_log *log, const ag_image *image, const char *path,
                                 const ag_image_save_options *options);

// The same into memory; the ending of `name` chooses, and it stands for the file in messages.
// `*data` is the caller's to free().
AG_CHECK ag_status ag_image_save_memory(const ag_log *log, const ag_image *image, const char *name,
                                        const ag_image_save_options *options, void **data,
                                        size_t *size);

// One layer of an OpenEXR file: its channels are "name.R" and so on, those of the layer without
// a name R, G, B, A, which is what ag_image_load reads.
typedef struct ag_image_layer {
    const char *name;      // at most 29 bytes; NULL or "" -> the picture itself
    const ag_image *image; // RGBA32F
    const char *channels;  // as its first ones are to be called, a letter each: "RGB", "XYZ", "Z";
                           // NULL -> "RGBA", whose colours are multiplied by alpha
} ag_image_layer;

// Write images of one size as the layers of one OpenEXR file, as ag_image_save does.
// AG_ERROR_ARGUMENT unless the path ends in .exr, there is a layer, sizes agree, all are RGBA32F,
// names differ and channels are one to four different letters.
AG_CHECK ag_status ag_image_save_layers(const ag_log *log, const ag_image_layer *layers,
                                        size_t count, const char *path,
                                        const ag_image_save_options *options);

AG_API uint32_t ag_image_width(const ag_image *image);
AG_API uint32_t ag_image_height(const ag_image *image);
AG_API ag_format ag_image_format(const ag_image *image);

// The first pixel of the top row.  Borrowed: lives as long as the image.
AG_API const void *ag_image_pixels(const ag_image *image);

// NULL is allowed.
AG_API void ag_image_destroy(ag_image *image);

#ifdef __cplusplus
}
#endif
#endif
