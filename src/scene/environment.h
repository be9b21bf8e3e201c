// Procedural equirectangular environments.
#ifndef AG_SCENE_ENVIRONMENT_H
#define AG_SCENE_ENVIRONMENT_H

#include "scene/vector.h"
#include <argand/image.h>

// A neutral grey room with soft boxes, and a clear sky without its sun: RGBA32F, 1024 x 512.
// White paper lying under either has a radiance of about 0.8, and of 1 at most elsewhere.
AG_CHECK ag_status studio_create(const ag_log *log, ag_image **image);
AG_CHECK ag_status sky_create(const ag_log *log, ag_image **image);

// Make an image from radiance by direction; `radiance` is called on several threads.
AG_CHECK ag_status environment_paint(const ag_log *log,
                                     vec3 (*radiance)(const void *context, vec3 direction),
                                     const void *context, ag_image **image);

#endif
