// What `argand render` was asked for.
#ifndef CLI_RENDER_OPTIONS_H
#define CLI_RENDER_OPTIONS_H

#include "lights.h"
#include "options.h"
#include "values.h"

#include <argand/argand.h>

typedef struct background_choice {
    ag_background kind;
    float color[3]; // sRGB-coded
} background_choice;

typedef struct environment_choice {
    ag_environment_kind kind;
    const char *path; // of an image; borrowed from argv
} environment_choice;

typedef struct render_request {
    const char *input; // a path, or "demo:NAME"
    const char *output;
    picture_size size;
    const char *camera; // name or index; NULL -> automatic
    float orbit[3];     // rad, rad, m; NAN = automatic
    float target[3];    // m; NAN = automatic
    float fov_rad;      // 0 = not given
    environment_choice environment;
    float environment_rotation_rad, environment_intensity;
    background_choice background;
    light_list lights;                           // besides those of the scene
    float exposure, ev100;                       // exposure 0 = the scene's
    int tonemap, transfer, quality, area_lights; // of the enumerations of these names
    bool correct;                                // a built-in scene not as its text has it
    const char *device;
    bool validate, json, quiet, verbose;
    bool orbit_given, target_given, exposure_given, ev100_given, tonemap_given, transfer_given;
    bool environment_given; // or its rotation, or its intensity
} render_request;

extern const option render_options[];

// Fill `request` from the arguments behind `render`.  False after one sentence; `*help`
// says that help was asked for instead.
bool render_request_parse(render_request *request, int argc, char **argv, bool *help);

#endif
