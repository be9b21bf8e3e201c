// The exposure of a picture where it is to be metered.
#include "expose.h"

static ag_status meter(const shot *s, ag_renderer *renderer, const ag_camera_desc *camera,
                       const ag_reference_options *how, const ag_render_options *options,
                       float *ev100)
{
    const ag_metering *metering = &s->request->eye.metering;
    console_stage(s->console, "meter", 0);
    return renderer ? ag_renderer_meter(renderer, s->scene, camera, options, metering, ev100)
                    : ag_reference_meter(s->scene, camera, options, how, metering, ev100);
}

ag_status expose(const shot *s, ag_renderer *renderer, const ag_camera_desc *camera,
                 const ag_reference_options *how, ag_render_options *options)
{
    float ev100;
    if (!s->request->eye.exposure.automatic)
        return AG_OK;
    ag_status status = meter(s, renderer, camera, how, options, &ev100);
    options->exposure = ag_exposure_from_ev100(ev100);
    return status;
}
