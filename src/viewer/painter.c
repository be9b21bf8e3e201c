// The painter: the device, and the pictures on the screen.
#include "painter.h"

#include <stdlib.h>

struct painter {
    worker *worker;
    screen *screen;
    painter_desc desc;
    ag_log log;
    ag_device *device;
    ag_renderer *renderer;
    ag_window *window;
    paint_order order;
    paint_result result;
};

painter *painter_create(screen *s, crew *c, const painter_desc *desc)
{
    painter *p = calloc(1, sizeof *p);
    if (!p)
        return NULL;
    p->screen = s;
    p->desc = *desc;
    p->worker = worker_create(c);
    if (!p->worker) {
        free(p);
        return NULL;
    }
    p->log = crew_log(c, desc->level);
    return p;
}

static void close_device(painter *p)
{
    ag_window_destroy(p->window);
    ag_renderer_destroy(p->renderer);
    ag_device_destroy(p->device);
    p->window = NULL;
    p->renderer = NULL;
    p->device = NULL;
}

// What the device holds goes on the thread that it belongs to.
static ag_status close_job(void *context, worker *self)
{
    (void)self;
    close_device(context);
    return AG_OK;
}

void painter_close(painter *p)
{
    worker_stop(p->worker);
    worker_wait(p->worker);
    worker_start(p->worker, close_job, p);
    worker_wait(p->worker);
}

void painter_destroy(painter *p)
{
    if (!p)
        return;
    painter_close(p);
    worker_destroy(p->worker);
    ag_image_destroy(p->result.kept);
    free(p);
}

worker *painter_worker(painter *p)
{
    return p->worker;
}

static ag_status open_device(painter *p)
{
    const ag_device_desc device = {
        .log = &p->log, .select = p->desc.device, .validate = p->desc.validate, .windows = true
    };
    const ag_window_desc window = { .create_surface = screen_surface, .user = p->screen };
    ag_status status = ag_device_create(&device, &p->device);
    if (!status)
        status = ag_renderer_create(p->device, &p->renderer);
    return status ? status : ag_window_create(p->renderer, &window, &p->window);
}

static ag_status paint(painter *p)
{
    paint_order *o = &p->order;
    paint_result *result = &p->result;
    ag_status status = p->window ? AG_OK : open_device(p);
    if (!status && o->scene && o->meters)
        status = ag_renderer_meter(p->renderer, o->scene, &o->camera, &o->options, &o->metering,
                                   &result->ev100);
    if (!status && o->adapts)
        o->options.exposure = ag_exposure_from_ev100(result->ev100);
    if (!status)
        status =
            ag_window_show(p->window, o->scene, &o->camera, &o->options, &o->show, &result->stats);
    if (!status && o->scene && o->keeps)
        status = ag_window_picture(p->window, &result->kept);
    result->has_picture = !status && o->scene;
    return status;
}

static ag_status paint_job(void *context, worker *self)
{
    painter *p = context;
    double start = screen_time();
    p->order.options.progress = worker_progress(self);
    p->order.show.layers = p->order.layers;
    ag_status status = paint(p);
    if (status == AG_ERROR_DEVICE || !p->window)
        close_device(p); // lost, or opened halfway
    p->result.ms = (screen_time() - start) * 1e3;
    return status;
}

void painter_begin(painter *p, const paint_order *order)
{
    p->order = *order;
    p->result = (paint_result) { 0 };
    worker_start(p->worker, paint_job, p);
}

bool painter_collect(painter *p, ag_status *status, paint_result *result)
{
    if (!worker_collect(p->worker, status))
        return false;
    *result = p->result;
    p->result.kept = NULL;
    return true;
}

const ag_device_info *painter_device(const painter *p)
{
    return p->device ? ag_device_describe(p->device) : NULL;
}
