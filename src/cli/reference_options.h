// What `argand reference` was asked for.
#ifndef CLI_REFERENCE_OPTIONS_H
#define CLI_REFERENCE_OPTIONS_H

#include "shot_options.h"

typedef struct reference_request {
    shot_request shot;           // first: shot_options lead into it
    uint32_t spp;                // 0 -> 64, or as many as `seconds` and `noise` allow
    float seconds, noise, clamp; // 0 = not given
    uint32_t max_bounces, seed;
    bool bounces_given, unshadowed;
    int estimator;  // an ag_estimator
    uint32_t parts; // ag_part, or-ed; 0 = all
    uint32_t aovs;  // 1 << ag_aov, or-ed
} reference_request;

extern const option reference_options[];

// Fill `request` from the arguments behind `reference`.  False after one sentence; `*help`
// says that help was asked for instead.
bool reference_request_parse(reference_request *request, int argc, char **argv, bool *help);

#endif
