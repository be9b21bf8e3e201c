// What the examples share: a few shapes, and the way from a scene to a file.  It uses nothing
// but the public interface; copy what you need.
#ifndef KIT_H
#define KIT_H

#include <argand/argand.h>

#define KIT_PI 3.14159265f

// Every call that can fail says so by its status, and has already told the log why: a small
// program may simply end.
void check(ag_status status);

// ---- Pictures --------------------------------------------------------------

// Each example is run as: PROGRAM [FOLDER [SIZE]].
typedef struct kit {
    const char *folder;
    ag_render_options options; // set tonemap and transfer
    ag_device *device;
    ag_renderer *renderer;
} kit;

kit kit_open(int argc, char **argv);
// Write FOLDER/name.png and destroy the scene.
void kit_finish(kit *k, ag_scene *scene, const ag_camera_desc *camera, const char *name);
void kit_close(kit *k);

// ---- Scenes ----------------------------------------------------------------

// With a procedural environment, or AG_ENVIRONMENT_NONE.
ag_scene *make_scene(ag_environment_kind kind, float intensity);

ag_mesh make_ball(ag_scene *scene, float radius, unsigned segments);
ag_mesh make_ring(ag_scene *scene, float radius, float tube);
ag_mesh make_panel(ag_scene *scene, float width, float height); // faces +Z
ag_mesh make_box(ag_scene *scene, float half);

ag_material make_material(ag_scene *scene, ag_material_desc desc);
ag_material_desc paint(float red, float green, float blue, float metallic, float roughness);

void show(ag_scene *scene, ag_mesh mesh, ag_material material, float x, float y, float z);
// Tilted about X, then turned about Y.
void show_turned(ag_scene *scene, ag_mesh mesh, ag_material material, const float at[3], float turn,
                 float tilt);
void shine(ag_scene *scene, ag_light_desc light);

// A camera in front of all there is so far.
ag_camera_desc look_straight(const ag_scene *scene, float fov_y);

#endif
