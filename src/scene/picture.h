// What a picture is asked to be: its options checked, its view chosen.
#ifndef AG_SCENE_PICTURE_H
#define AG_SCENE_PICTURE_H

#include <argand/renderer.h>

#include "physics/white_balance.glsl"
#include "scene/scene.h"
#include "scene/view.h"

// Fill in the defaults; AG_ERROR_ARGUMENT on what is out of range.
AG_CHECK ag_status picture_check(const ag_scene *scene, ag_render_options *options);

// From light to what the picture has of it: exposed, and its white balanced.
rgb_matrix picture_exposure(const ag_render_options *options);

// The view of `camera` (NULL -> automatic) that has everything between its planes.
// AG_ERROR_ARGUMENT on a camera that is not sound.
AG_CHECK ag_status picture_view(const ag_scene *scene, const ag_camera_desc *camera,
                                const ag_render_options *options, view *v);

#endif
