// Path tracing with a bar that tells samples, noise and the time left.  An interrupt ends it,
// and what has been gathered stays; a second one ends the process.
#ifndef CLI_TRACING_H
#define CLI_TRACING_H

#include "console.h"

typedef struct tracing {
    ag_reference *reference;
    ag_reference_state state; // how far it came
    bool interrupted;
} tracing;

// Gather samples until `goal`; its progress is not looked at.  The others as
// ag_reference_create has them.  An interrupt before the first sample ends the process.
// Whether it fails or not, finish with tracing_finish.
ag_status tracing_run(tracing *tracing, console *console, const ag_scene *scene,
                      const ag_camera_desc *camera, const ag_render_options *picture,
                      const ag_reference_options *options, const ag_reference_goal *goal);
void tracing_finish(tracing *tracing);

#endif
