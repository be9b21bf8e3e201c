// The painter: the device, and the pictures on the screen.  It works beside the window's thread,
// one order at a time, and reads the scene and the layers' images while it does.
#ifndef VIEWER_PAINTER_H
#define VIEWER_PAINTER_H

#include "screen.h"
#include "worker.h"

#include <argand/argand.h>

typedef struct painter_desc {
    const char *device; // as ag_device_desc.select
    bool validate;
    ag_log_level level; // of what it says
} painter_desc;

typedef struct paint_order {
    const ag_scene *scene; // NULL: the last picture again
    ag_camera_desc camera;
    ag_render_options options;
    ag_layer layers[AG_LAYERS_MAX];
    ag_show_options show; // `layers` are those above
    bool meters;          // also the light of the view
    ag_metering metering;
    bool adapts; // and is exposed as the meter says
    bool keeps;  // also brings the picture to the host
} paint_order;

typedef struct paint_result {
    ag_render_stats stats;
    double ms;        // of the whole order
    float ev100;      // if it was metered
    ag_image *kept;   // RGBA8; the receiver's
    bool has_picture; // of the scene
} paint_result;

typedef struct painter painter;

// The device is opened with the first order.  NULL: no thread, no memory.
painter *painter_create(screen *s, crew *c, const painter_desc *desc);
void painter_close(painter *p);   // the device, after the order that is at work
void painter_destroy(painter *p); // NULL is allowed

worker *painter_worker(painter *p);

// Begin an order; the worker is not busy.
void painter_begin(painter *p, const paint_order *order);

// True once after each order.  On AG_ERROR_DEVICE all is closed, and the next order opens it
// anew.
bool painter_collect(painter *p, ag_status *status, paint_result *result);

// Between orders; NULL before the first.
const ag_device_info *painter_device(const painter *p);

#endif
