// What a picture is made of, from a request: the scene with its lights and environment, and
// the camera and look to make it with.
#ifndef CLI_SHOT_H
#define CLI_SHOT_H

#include "shot_options.h"
#include "task.h"

typedef struct shot {
    const shot_request *request;
    console *console; // both are borrowed
    ag_log log;
    ag_scene *scene;
    task reading;          // of the environment's file, beside the loading
    ag_image *environment; // made by `reading`
} shot;

// Load the scene and put lights and environment into it.  Whether it fails or not, finish
// with shot_finish.
ag_status shot_open(shot *shot, const shot_request *request, console *console);
void shot_finish(shot *shot);

// Where it is seen from, and how it is shown in `format`.  The camera's name is borrowed from
// the scene.
ag_status shot_compose(shot *shot, ag_format format, ag_camera_desc *camera,
                       ag_render_options *options);

#endif
