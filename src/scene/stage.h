// Builds the demo scenes: the first failure sticks, and all that follows does nothing.
#ifndef AG_SCENE_STAGE_H
#define AG_SCENE_STAGE_H

#include "scene/scene.h"
#include "scene/vector.h"

typedef struct stage {
    ag_scene *scene;
    ag_look look;
    ag_status status;
} stage;

ag_mesh stage_sphere(stage *s, float radius, unsigned segments, unsigned rings);
ag_mesh stage_panel(stage *s, float width, float height, float repeats);
ag_mesh stage_box(stage *s, vec3 half, float bevel);
ag_mesh stage_torus(stage *s, float radius, float tube);

// An RGBA8 texture, size x size, painted by `texel` from the middle (u, v) of each pixel.
ag_texture stage_texture(stage *s, unsigned size, void (*texel)(float u, float v, uint8_t out[4]));

ag_material stage_material(stage *s, ag_material_desc desc);
// The default material in one colour.
ag_material stage_paint(stage *s, vec3 color, float metallic, float roughness);

void stage_show(stage *s, ag_mesh mesh, ag_material material, vec3 at);
// Turned about +Y, and lying on its back where `tilt_rad` is -pi/2.
void stage_show_turned(stage *s, ag_mesh mesh, ag_material material, vec3 at, float turn_rad,
                       float tilt_rad);

void stage_light(stage *s, ag_light_desc desc);
void stage_environment(stage *s, ag_environment_kind kind);
void stage_surround(stage *s, ag_environment_kind kind, float intensity);
void stage_exposure(stage *s, float exposure);

// A camera that frames all there is so far, for square and wider pictures.
void stage_camera(stage *s, float theta_rad, float phi_rad, float fov_y_rad);
void stage_view(stage *s, ag_camera_desc desc); // or one that stands somewhere

#endif
