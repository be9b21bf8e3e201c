// Light of a scene as linear pictures, in real time and by the reference.
#ifndef CLI_WAYS_H
#define CLI_WAYS_H

#include "shot.h"

// A picture.  Noise stays in its `mean`; where it has any there are two halves of it, each with
// noise of its own, in which it can be told from what is the same in both.
typedef struct side {
    ag_image *mean;
    ag_image *half[2]; // NULL where there is no noise
} side;

typedef struct ways {
    side real_time, reference;
} ways;

typedef struct maker {
    shot *shot;
    ag_renderer *renderer;
    ag_camera_desc camera;
    ag_render_options look; // how pictures are shown
    ag_reference_goal goal; // of both halves together
    double done, doing;     // fractions of all work: before the next picture is traced, and by it
} maker;

// What a linear picture of the look's light is asked for with.
ag_render_options maker_linear(const maker *maker);

// By the renderer.  `frame_ms` may be NULL.
ag_status maker_draw(const maker *maker, const ag_render_options *options, ag_image **image,
                     double *frame_ms);

// By the reference, of the whole light or only straight and with nothing in its way.  `seconds`
// is a factor on the goal's.
ag_status maker_trace(maker *maker, const ag_render_options *options, bool direct, double seconds,
                      side *side, ag_reference_state *state);

// From two halves, which it takes over, also on failure.
ag_status side_from_halves(const ag_log *log, ag_image *const halves[2], side *side);

const ag_image *side_half(const side *side, int half); // the mean where there are none
void ways_finish(ways *ways);

#endif
