// Procedural equirectangular environments.
#ifndef AG_SCENE_ENVIRONMENT_H
#define AG_SCENE_ENVIRONMENT_H

#include "scene/vector.h"
#include <argand/image.h>

// A neutral grey room with soft boxes, and a clear sky without its sun: RGBA32F, 1024 x 512.
// White paper turned to the brightest side has a radiance of 0.8.
AG_CHECK ag_status studio_create(const ag_log *log, ag_image **image);
AG_CHECK ag_status sky_create(const ag_log *log, ag_image **image);

// Make an image from radiance by direction; `radiance` is called on several threads.
AG_CHECK ag_status environment_paint(const ag_log *log, vec3 (*radiance)(vec3 direction),
                                     ag_image **image);

#endif
