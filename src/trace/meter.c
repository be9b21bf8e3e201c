// The exposure that the reference's light asks for.
#include <argand/eye.h>

#include "image/image.h"
#include "scene/metering.h"
#include "scene/scene.h"

enum { SAMPLES = 16 };

static ag_status trace(ag_reference *reference, ag_image **image)
{
    const ag_reference_goal goal = { .samples = SAMPLES };
    ag_status status = ag_reference_trace(reference, &goal);
    return status ? status : ag_reference_picture(reference, image);
}

ag_status ag_reference_meter(const ag_scene *scene, const ag_camera_desc *camera,
                             const ag_render_options *picture, const ag_reference_options *options,
                             const ag_metering *metering, float *ev100)
{
    const ag_render_options small = metering_picture(picture);
    ag_reference_options how = options ? *options : (ag_reference_options) { 0 };
    ag_reference *reference = NULL;
    ag_image *image = NULL;
    *ev100 = 0;
    how.clamp = 0; // which is of exposed light
    how.keep_aovs = false;
    ag_status status = ag_reference_create(scene, camera, &small, &how, &reference);
    if (!status)
        status = trace(reference, &image);
    if (!status)
        status = ag_image_meter(&scene->log, image, small.exposure, metering, ev100);
    ag_image_destroy(image);
    ag_reference_destroy(reference);
    return status;
}
