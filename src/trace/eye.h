// Rays from the eye, a packet at a time.
#ifndef AG_TRACE_EYE_H
#define AG_TRACE_EYE_H

#include "scene/view.h"
#include "trace/world.h"

// One sample of a pixel in each lane.
typedef struct eye_samples {
    uint32_t x[WORLD_PACKET], y[WORLD_PACKET], index[WORLD_PACKET];
    uint32_t seed[WORLD_PACKET]; // of the pixel
} eye_samples;

// Each goes through a place of its pixel that the filter draws, that of quality `best`: a Gaussian
// of .47 px, cut at 1.5 px.  Takes the first set of the sample's numbers.
void eye_rays(const view *v, const eye_samples *samples, ray_packet *rays);

#endif
