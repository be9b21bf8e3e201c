// The exposure of a picture: the one asked for, the scene's, or a metered one.
#ifndef CLI_EXPOSE_H
#define CLI_EXPOSE_H

#include "shot.h"

// After shot_compose.  Where it is to be metered, `renderer` meters it, or, where that is NULL,
// the reference as of `how` (NULL -> defaults).
ag_status expose(const shot *shot, ag_renderer *renderer, const ag_camera_desc *camera,
                 const ag_reference_options *how, ag_render_options *options);

#endif
