// HDR-FLIP: the greatest FLIP over all the exposures in which a picture shows something.
// Andersson et al. 2021.
#ifndef AG_IMAGE_HDR_FLIP_H
#define AG_IMAGE_HDR_FLIP_H

#include "image/picture.h"

// From where the brightest pixel is not yet white to where the median one is as bright, at
// most a stop apart as long as they are no more than HDR_EXPOSURES_MAX.
enum { HDR_EXPOSURES_MAX = 32 };
typedef struct hdr_exposures {
    float start, stop; // stops
    int count;
    float factor[HDR_EXPOSURES_MAX]; // on linear light
} hdr_exposures;

// AG_ERROR_MEMORY.
AG_CHECK ag_status hdr_exposures_init(const ag_log *log, const picture *reference,
                                      hdr_exposures *exposures);

// The tone curve: Narkowicz' (2015) of 0.6 v, clipped to [0, 1]; NaN -> 0.
static inline float hdr_tone(float v)
{
    v = v > 0 ? v < 1e6f ? 0.6f * v : 6e5f : 0;
    float out = v * (2.51f * v + 0.03f) / (v * (2.43f * v + 0.59f) + 0.14f);
    return out < 1 ? out : 1;
}

#endif
