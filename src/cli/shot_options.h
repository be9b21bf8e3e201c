// What to make a picture of and how, as the command line says it: the options that
// commands share.
#ifndef CLI_SHOT_OPTIONS_H
#define CLI_SHOT_OPTIONS_H

#include "eye_options.h"
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

typedef struct shot_request {
    const char *input;  // a path, or "demo:NAME"
    const char *output; // each command has its own row for it
    picture_size size;
    const char *camera; // name or index; NULL -> automatic
    float orbit[3];     // rad, rad, m; NAN = automatic
    float target[3];    // m; NAN = automatic
    float fov_rad;      // 0 = not given
    environment_choice environment;
    float environment_rotation_rad, environment_intensity;
    background_choice background;
    light_list lights; // besides those of the scene
    eye_request eye;
    float bloom;
    int tonemap, transfer, quality, area_lights; // of the enumerations of these names
    bool draft;                                  // without the file's textures
    bool correct;                                // a built-in scene not as its text has it
    const char *device;
    bool validate, json, quiet, verbose;
    bool orbit_given, target_given, tonemap_given, transfer_given;
    bool environment_given; // or its rotation, or its intensity
} shot_request;

// The options that say what is in the scene, those that every command with pictures takes, and
// those of pictures on a device: for a struct that begins with a shot_request.
extern const option shot_scene_options[], shot_options[], shot_device_options[];

// What holds where nothing is given.
shot_request shot_request_default(void);

// After parsing: fill in what follows from what was given.  False after one sentence where
// it makes no sense, or where input or output is missing.
bool shot_request_settle(shot_request *request, const char *command, bool writes);

// The most talkative level that is wanted.
ag_log_level shot_log_level(const shot_request *request);

#endif
