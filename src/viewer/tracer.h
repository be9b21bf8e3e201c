// The tracer: the path traced picture of a view, growing beside the window's thread, one pass at
// a time.
#ifndef VIEWER_TRACER_H
#define VIEWER_TRACER_H

#include "worker.h"

#include <argand/argand.h>

typedef struct trace_order {
    const ag_scene *scene; // read while the tracer works, and kept until tracer_forget
    ag_camera_desc camera;
    ag_render_options picture; // RGBA8
    bool again;                // the view or the scene is another than last time
    const ag_image *beside;    // what to compare it with, of the same size; NULL -> nothing
} trace_order;

typedef struct trace_result {
    ag_image *picture; // RGBA8, a quarter as wide and high at first; the receiver's; may be NULL
    uint32_t samples;  // a pixel; 0 of the small one
    float noise;
    bool compared;
    float flip;
    bool cancelled;
} trace_result;

typedef struct tracer tracer;

tracer *tracer_create(crew *c, ag_log_level level); // NULL: no thread, no memory
void tracer_destroy(tracer *t);                     // NULL is allowed

worker *tracer_worker(tracer *t);

// Trace some more; the worker is not busy.
void tracer_begin(tracer *t, const trace_order *order);
bool tracer_collect(tracer *t, ag_status *status, trace_result *result);

// Let go of the scene; the worker is not busy.
void tracer_forget(tracer *t);

#endif
