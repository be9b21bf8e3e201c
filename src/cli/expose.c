// The exposure of a picture: the one asked for, the scene's, or a metered one.
#include "expose.h"

#include <math.h>

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
    const eye_request *e = &s->request->eye;
    float factor = e->exposure.factor > 0 ? e->exposure.factor : ag_scene_exposure(s->scene);
    options->exposure = factor * exp2f(e->metering.compensation_ev);
    if (!e->exposure.automatic)
        return AG_OK;
    float ev100;
    ag_status status = meter(s, renderer, camera, how, options, &ev100);
    options->exposure = ag_exposure_from_ev100(ev100);
    return status;
}
