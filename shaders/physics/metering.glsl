// Metering: the histogram of a picture's luminances.
#ifndef AG_PHYSICS_METERING_GLSL
#define AG_PHYSICS_METERING_GLSL

#include "physics/exposure.glsl"

// Bin 0 stands for black, each other one for a luminance, an eighth of a stop above the one
// before it; the first of them is EV100 -10.  Light between two goes to both, so that the sum over
// bins is that of the light: nothing is left out for being dark.
#define METER_BINS 256u

#define METER_FIRST_EV100 (-10.0f)
#define METER_LAST_EV100  21.75f

// As ag_meter of argand/eye.h.
#define METER_CENTER  0u
#define METER_AVERAGE 1u
#define METER_SPOT    2u

// What a pixel adds to `bin`, and to the one after it.
STRUCT(meter_share)
{
    uint bin, here, next;
};

static inline real meter_luminance(uint bin)
{
    return bin == 0u ? 0.0f
                     : exposure_metered_luminance(METER_FIRST_EV100 + to_real(bin - 1u) / 8.0f);
}

// `weight` in [0, 1]; a whole pixel is 4096.  The last bin has no next.
static inline meter_share meter_shares(real luminance, real weight)
{
    meter_share s;
    real first = exposure_metered_luminance(METER_FIRST_EV100);
    real last = exposure_metered_luminance(METER_LAST_EV100);
    luminance = clamp(luminance, 0.0f, last);
    real x = clamp(8.0f * log2(max(luminance, first) / first), 0.0f, to_real(METER_BINS - 2u));
    // In proportion to luminance, not to its logarithm: (2^(f/8) - 1) / (2^(1/8) - 1).
    real next = (exp2((x - floor(x)) / 8.0f) - 1.0f) / 0.0905077327f;
    bool dark = luminance < first;
    s.bin = dark ? 0u : 1u + to_uint(x);
    s.here = to_uint(4096.0f * weight + 0.5f);
    s.next = to_uint(to_real(s.here) * (dark ? luminance / first : next) + 0.5f);
    s.here -= s.next;
    return s;
}

// What of the picture counts, in px.
STRUCT(meter_pattern)
{
    uint meter; // METER_
    real x, y, radius; // of the disk, or the middle
    real shorter;      // side of the picture
};

// In [0, 1].  Centre-weighted: three quarters of the weight are within a quarter of the shorter
// side, a circle of 12 mm on a film 24 mm high.
static inline real meter_weight(meter_pattern p, real x, real y)
{
    real away2 = (x - p.x) * (x - p.x) + (y - p.y) * (y - p.y);
    if (p.meter == METER_CENTER)
        return exp2(-32.0f * away2 / (p.shorter * p.shorter));
    if (p.meter == METER_SPOT)
        return clamp(p.radius - sqrt(away2) + 0.5f, 0.0f, 1.0f);
    return 1.0f;
}

#endif
