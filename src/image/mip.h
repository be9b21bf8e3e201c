// Smaller versions of images: mip chains of textures and halved float images.
//
// Level l is max(1, w >> l) x max(1, h >> l) texels, each the exact box average of the
// level before it, also where a size is odd: then a texel covers 2 + 1/n texels, and the
// outer ones count by the part of them that it covers.
#ifndef AG_IMAGE_MIP_H
#define AG_IMAGE_MIP_H

#include "image/image.h"

typedef enum image_mip_kind {
    IMAGE_MIP_LINEAR,      // data: each of the four channels by itself
    IMAGE_MIP_SRGB,        // colours: averaged in linear light, each by its alpha
    IMAGE_MIP_SRGB_OPAQUE, // the same where alpha means nothing: it becomes 255
    IMAGE_MIP_NORMAL,      // tangent-space normals 2 v / 255 - 1: averaged, of unit length again
} image_mip_kind;

// Levels of a full chain, the image itself among them: 1 + floor(log2(max(w, h))).
uint32_t image_mip_count(uint32_t width, uint32_t height);

// Bytes from the start of the buffer of image_mips() to level `level` >= 1; for
// image_mip_count() it is the size of the buffer.
size_t image_mip_offset(uint32_t width, uint32_t height, uint32_t level);

// All levels below the image itself, RGBA8, tightly packed, the larger ones first; the
// caller's to free().  NULL when there is no memory.  `image` is RGBA8.  One thread;
// 2048 x 2048 sRGB texels take some milliseconds.
void *image_mips(const ag_image *image, image_mip_kind kind);

// An RGBA32F image of max(1, w / 2) x max(1, h / 2) box averages.
AG_CHECK ag_status image_halve(const ag_log *log, const ag_image *image, ag_image **half);

#endif
