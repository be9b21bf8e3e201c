// The exposure of a picture where it is to be metered.
#ifndef CLI_EXPOSE_H
#define CLI_EXPOSE_H

#include "shot.h"

// After shot_compose, which has the others.  `renderer` meters it, or, where that is NULL, the
// reference as of `how` (NULL -> defaults).
ag_status expose(const shot *shot, ag_renderer *renderer, const ag_camera_desc *camera,
                 const ag_reference_options *how, ag_render_options *options);

#endif
