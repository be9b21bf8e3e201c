// Bytes on their way from host memory into device resources.
//
// Two staging slots take turns: while the device copies out of one, the host fills
// the other, so that the peak of memory stays small whatever is uploaded.
#ifndef AG_GPU_UPLOAD_H
#define AG_GPU_UPLOAD_H

#include "gpu/commands.h"

typedef struct gpu_upload_slot {
    gpu_commands commands;
    gpu_buffer staging;
} gpu_upload_slot;

typedef struct gpu_upload {
    gpu_device *device;
    gpu_upload_slot slots[2];
    uint32_t current;
    VkDeviceSize used; // of the current slot
} gpu_upload;

// Begin recording; until gpu_upload_end the device belongs to this upload.
AG_CHECK ag_status gpu_upload_begin(gpu_device *device, gpu_upload *upload);

AG_CHECK ag_status gpu_upload_buffer(gpu_upload *upload, const gpu_buffer *buffer,
                                     VkDeviceSize offset, const void *data, VkDeviceSize size);

// Before and after an image's levels: contents dropped, then ready to be sampled.
void gpu_upload_image_begin(gpu_upload *upload, const gpu_image *image);
void gpu_upload_image_end(gpu_upload *upload, const gpu_image *image);

// One level of one layer, rows without padding, `texel` bytes each.
AG_CHECK ag_status gpu_upload_image_level(gpu_upload *upload, const gpu_image *image, uint32_t mip,
                                          uint32_t layer, uint32_t texel, const void *data);

// Submit what is left; the device finishes it before anything submitted later.
AG_CHECK ag_status gpu_upload_end(gpu_upload *upload);
// Waits; zero is allowed.  After a failure, what was uploaded to may be destroyed only then.
void gpu_upload_finish(gpu_upload *upload);

#endif
