// The environment on the device: what lights the surfaces, and what is seen behind them.
#ifndef AG_RENDER_SURROUND_H
#define AG_RENDER_SURROUND_H

#include "gpu/upload.h"
#include "scene/scene.h"

#include "interop/scene.glsl"

// Who shows it behind the scene.
typedef enum surround_shown {
    SURROUND_HIDDEN,
    SURROUND_BY_DEVICE,
    SURROUND_BY_HOST
} surround_shown;

typedef struct surround {
    bool present;           // false: black, and the images are stand-ins
    gpu_image cube;         // prefiltered
    gpu_image irradiance;   // cube of irradiance / pi
    gpu_image image;        // equirectangular; a stand-in until it is needed
    bool has_image;         // the image is the real one
    uint32_t width, height; // of the environment
    // The same as half floats, rows surround_pitch(width) apart, of which the first texel is the
    // last one again and the last the first one; one row more, as the last.  NULL until needed.
    uint16_t (*texels)[4];
    gpu_image dfg;
    gpu_image ltc;
    float sh[9][3];
} surround;

static inline size_t surround_pitch(uint32_t width)
{
    return width + 2ul;
}

// `equirect` NULL: none.
// On failure what is half made stays for surround_destroy, after the upload is finished: the
// device may still be copying into it.
AG_CHECK ag_status surround_create(gpu_device *device, const ag_image *equirect,
                                   surround_shown shown, gpu_upload *upload, bool *cached,
                                   double *bake_ms, surround *s);
void surround_destroy(gpu_device *device, surround *s); // zero is allowed

// Whether it can be shown so, and what makes it so: `equirect` is as it was created from.
bool surround_shows(const surround *s, surround_shown shown);
AG_CHECK ag_status surround_show(gpu_device *device, const ag_image *equirect, surround_shown shown,
                                 gpu_upload *upload, surround *s);

// The environment's part of a frame.
void surround_frame(const surround *s, const ag_scene *scene, gpu_frame *frame);

#endif
