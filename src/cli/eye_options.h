// How bright a picture is to be and what is white in it, as the command line says it.
#ifndef CLI_EYE_OPTIONS_H
#define CLI_EYE_OPTIONS_H

#include "options.h"

#include <argand/argand.h>

typedef struct exposure_choice {
    float factor; // 0 = the scene's own
    bool automatic;
} exposure_choice;

typedef struct eye_request {
    exposure_choice exposure;
    float ev100;
    float aperture, shutter_s, iso; // 0 = not given
    ag_metering metering;           // its compensation holds for every exposure
    float white_balance[2];         // kelvin (0 = not given), tint
    bool exposure_given, ev100_given, camera_given, metering_given;
} eye_request;

// For a struct that begins with a shot_request.
extern const option eye_options[];

// After parsing: fill in what follows from what was given; false after one sentence.
bool eye_settle(eye_request *eye);

#endif
