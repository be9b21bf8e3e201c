// Cameras on their way into a .glb (spec 3.10); ARGAND_cameras tells what their nodes cannot.
#include "scene/gltf_write.h"
#include "scene/view.h"

#include <math.h>

// A depth that is fitted must still lie before one that is given.
static float near_of(const ag_camera_desc *d, const view *v)
{
    float near = fmaxf(v->near_m, 0.0f);
    return d->far_m > 0.0f && near >= d->far_m ? 0.5f * d->far_m : near;
}

static void put_perspective(gltf_writer *w, json_t *camera, const ag_camera_desc *d, const view *v)
{
    json_t *made = gltf_put_object(w, camera, "perspective");
    gltf_put_word(w, camera, "type", "perspective");
    gltf_put_float(w, made, "yfov", d->fov_y_rad);
    gltf_put_float(w, made, "znear", near_of(d, v));
    if (d->far_m > 0.0f)
        gltf_put_float(w, made, "zfar", d->far_m);
}

static void put_orthographic(gltf_writer *w, json_t *camera, const ag_camera_desc *d, const view *v)
{
    json_t *made = gltf_put_object(w, camera, "orthographic");
    float near = near_of(d, v), far = fmaxf(v->far_m, 2.0f * near + 1.0f);
    gltf_put_word(w, camera, "type", "orthographic");
    gltf_put_float(w, made, "xmag", 0.5f * d->height_m);
    gltf_put_float(w, made, "ymag", 0.5f * d->height_m);
    gltf_put_float(w, made, "znear", near);
    gltf_put_float(w, made, "zfar", d->far_m > 0.0f ? d->far_m : far);
}

// glTF wants depths where Argand fits them to the scene, and has no word for the target.
static void put_argand(gltf_writer *w, json_t *camera, const ag_camera_desc *d)
{
    json_t *made = gltf_put_extension(w, camera, "ARGAND_cameras");
    gltf_put_floats(w, made, "target", d->target, 3);
    gltf_put_floats(w, made, "up", d->up, 3);
    if (d->near_m == 0.0f)
        gltf_put_true(w, made, "fitNear");
    if (d->far_m == 0.0f && d->height_m > 0.0f)
        gltf_put_true(w, made, "fitFar");
}

static void write_camera(gltf_writer *w, const ag_camera_desc *d, const float *min,
                         const float *max)
{
    view v = view_make(d, 1, 1, min, max);
    float world[16] = { [15] = 1.0f };
    for (int i = 0; i < 3; i++) {
        world[i] = v.right[i];
        world[4 + i] = v.up[i];
        world[8 + i] = -v.forward[i];
        world[12 + i] = d->position[i];
    }
    json_t *camera = json_object();
    uint32_t index = gltf_append(w, w->root, "cameras", camera);
    gltf_put_index(w, gltf_write_node(w, world, d->name), "camera", index);
    if (d->height_m > 0.0f)
        put_orthographic(w, camera, d, &v);
    else
        put_perspective(w, camera, d, &v);
    put_argand(w, camera, d);
}

void gltf_write_cameras(gltf_writer *w)
{
    float min[3], max[3];
    bool any = scene_bounds(w->scene, min, max);
    for (size_t i = 0; i < w->scene->cameras_count; i++)
        write_camera(w, &w->scene->cameras[i], any ? min : NULL, any ? max : NULL);
}
