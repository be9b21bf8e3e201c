// What a meter makes of a picture.
#ifndef AG_SCENE_METERING_H
#define AG_SCENE_METERING_H

#include <argand/eye.h>

#include "physics/metering.glsl"

// Fill in the defaults; AG_ERROR_ARGUMENT on what is out of range.  NULL -> all of them.
AG_CHECK ag_status metering_check(const ag_log *log, const ag_metering *asked,
                                  ag_metering *metering);

// The picture that is metered in place of the one that is asked for (NULL -> defaults): small,
// linear, and at an exposure at which half floats hold all that the histogram does.
ag_render_options metering_picture(const ag_render_options *options);

meter_pattern metering_pattern(const ag_metering *metering, uint32_t width, uint32_t height);

// From what each bin holds, in any unit.
float metering_ev100(const ag_metering *metering, const uint64_t bins[METER_BINS]);

#endif
