// Images on their way into textures: mips and packing on all cores, then the upload.
#ifndef AG_RENDER_TEXTURE_JOBS_H
#define AG_RENDER_TEXTURE_JOBS_H

#include "render/textures.h"

typedef struct texture_job {
    ag_image *image;
    gpu_image *target;
    texture_kind kind;
    // While the job runs: level 0, and those below it one after another, as uploaded.
    void *base, *mips;
} texture_job;

// Fill the targets.  Jobs on one image stand anywhere in the list.  `release`: free an
// image's pixels after its last job.
AG_CHECK ag_status texture_jobs_run(gpu_device *device, gpu_upload *upload, bool release,
                                    texture_job *jobs, size_t count);

#endif
