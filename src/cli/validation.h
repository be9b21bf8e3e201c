// One scene, made in real time and by the reference, and how far apart the two are and why.
#ifndef CLI_VALIDATION_H
#define CLI_VALIDATION_H

#include "linear.h"
#include "shot.h"

// As they are shown, in data URIs; all numbers are of the pictures before that.
typedef struct picture_pair {
    char *real_time, *reference;
} picture_pair;

// A part of the light, alone in both pictures.
typedef struct cause {
    char name[64];
    const char *about;
    picture_pair shown;
    linear_difference apart; // over the mean of the whole reference
    float flip;
} cause;

enum {
    CAUSE_LIGHTS = 8, // that many have a part each; of more, all but the first few share one
    CAUSES_MOST = CAUSE_LIGHTS + 5,
    CAUSE_SIZE = 512, // px, the larger side of a part's pictures at most
};

#define CAUSE_TIME 0.125 // of a goal's seconds

typedef struct validation {
    const char *input; // borrowed
    uint32_t width, height;
    float exposure; // of both pictures
    picture_pair shown;
    char *heat;
    ag_difference coded, linear; // of the pictures as shown, and of their light
    linear_difference apart;     // over the mean of the reference
    ag_reference_state state;
    double frame_ms;
    cause causes[CAUSES_MOST];
    size_t cause_count;
} validation;

// Make both pictures and all parts; `progress` hears fractions of the whole.  Finish it either
// way.
ag_status validation_make(validation *v, shot *shot, ag_renderer *renderer,
                          const ag_reference_goal *goal, ag_progress progress);
void validation_finish(validation *v);

#endif
