// Cameras (spec 3.10): each looks along its node's -Z with +Y up; scale does not touch it.
// ARGAND_cameras (docs/gltf.md) keeps what rounding would lose.
#include "scene/gltf.h"
#include "scene/vector.h"

#include <float.h>
#include <math.h>
#include <string.h>

static ag_status read_depths(const gltf_at *at, ag_camera_desc *desc)
{
    gltf_at far_at = gltf_member(at, "zfar");
    ag_status status = gltf_float_in(at, "znear", 0.0f, FLT_MAX, &desc->near_m);
    if (!status)
        status = gltf_float_in(at, "zfar", 0.0f, FLT_MAX, &desc->far_m);
    if (!status && far_at.json && !(desc->far_m > desc->near_m))
        return gltf_fail(&far_at, AG_ERROR_FORMAT, "must be above znear");
    return status;
}

static ag_status read_perspective(const gltf_at *camera, ag_camera_desc *desc)
{
    gltf_at at, fov_at;
    ag_status status = gltf_object(camera, "perspective", &at);
    if (!status)
        status = gltf_require(&at, "yfov");
    if (!status)
        status = gltf_float(&at, "yfov", &desc->fov_y_rad);
    if (status)
        return status;
    fov_at = gltf_member(&at, "yfov");
    if (!(desc->fov_y_rad > 0.0f && desc->fov_y_rad < 3.1415926f))
        return gltf_fail(&fov_at, AG_ERROR_FORMAT, "%g is not between 0 and pi",
                         (double)desc->fov_y_rad);
    return read_depths(&at, desc);
}

static ag_status read_orthographic(const gltf_at *camera, ag_camera_desc *desc)
{
    gltf_at at, height_at;
    float half_height = 0.0f;
    ag_status status = gltf_object(camera, "orthographic", &at);
    if (!status)
        status = gltf_require(&at, "ymag");
    if (!status)
        status = gltf_float(&at, "ymag", &half_height);
    if (status)
        return status;
    height_at = gltf_member(&at, "ymag");
    half_height = fabsf(half_height);
    if (!(half_height > 0.0f && half_height < 1e18f))
        return gltf_fail(&height_at, AG_ERROR_FORMAT, "must not be zero or huge");
    desc->height_m = 2.0f * half_height;
    return read_depths(&at, desc);
}

// Where `world` puts the camera.  The target is a metre away, further where floats are
// too coarse for that.
static void place(const double world[16], ag_camera_desc *desc)
{
    double distance = 1.0, length = 0.0, up = 0.0;
    for (int i = 0; i < 3; i++) {
        distance = fmax(distance, 1e-3 * fabs(world[12 + i]));
        length += world[8 + i] * world[8 + i];
        up += world[4 + i] * world[4 + i];
    }
    for (int i = 0; i < 3; i++) {
        double back = length > 0.0 ? world[8 + i] / sqrt(length) : i == 2;
        desc->position[i] = (float)world[12 + i];
        desc->target[i] = (float)(world[12 + i] - distance * back);
        desc->up[i] = up > 0.0 ? (float)(world[4 + i] / sqrt(up)) : 0.0f;
    }
}

// Whether a view that was written beside a node is still that of the node: where it has been
// turned since, the node counts.
static bool agrees(const ag_camera_desc *desc, const float target[3], const float up[3])
{
    vec3 forward = vec3_unit(vec3_sub(vec3_from(desc->target), vec3_from(desc->position)));
    vec3 way = vec3_sub(vec3_from(target), vec3_from(desc->position));
    vec3 right = vec3_cross(forward, vec3_from(desc->up)), wanted = vec3_unit(vec3_from(up));
    vec3 off = vec3_sub(vec3_unit(way), forward);
    return vec3_dot(off, off) < 1e-6f && fabsf(vec3_dot(wanted, right)) < 1e-3f &&
           vec3_dot(wanted, vec3_from(desc->up)) > -1e-3f;
}

static ag_status read_argand(const gltf_at *camera, ag_camera_desc *desc)
{
    gltf_at at;
    bool fit_near = false, fit_far = false;
    float target[3], up[3];
    memcpy(target, desc->target, sizeof target);
    memcpy(up, desc->up, sizeof up);
    ag_status status = gltf_extension(camera, "ARGAND_cameras", &at);
    if (status || !at.json)
        return status;
    status = gltf_floats(&at, "target", 3, target);
    if (!status)
        status = gltf_floats(&at, "up", 3, up);
    if (!status)
        status = gltf_bool(&at, "fitNear", &fit_near);
    if (!status)
        status = gltf_bool(&at, "fitFar", &fit_far);
    desc->near_m = fit_near ? 0.0f : desc->near_m;
    desc->far_m = fit_far ? 0.0f : desc->far_m;
    if (!status && agrees(desc, target, up)) {
        memcpy(desc->target, target, sizeof target);
        memcpy(desc->up, up, sizeof up);
    }
    return status;
}

ag_status gltf_camera_add(gltf_file *file, uint32_t node)
{
    gltf_at root = gltf_root(file), cameras = gltf_member(&root, "cameras");
    gltf_at nodes = gltf_member(&root, "nodes"), node_at = gltf_item(&nodes, node);
    gltf_at at = gltf_item(&cameras, file->nodes[node].camera), type_at = gltf_member(&at, "type");
    ag_camera_desc desc = { 0 };
    const char *type = "";
    ag_status status = gltf_require(&at, "type");
    if (!status)
        status = gltf_string(&at, "type", &type);
    if (!status)
        status = gltf_string(&node_at, "name", &desc.name);
    if (!status)
        status = gltf_string(&at, "name", &desc.name);
    if (status)
        return status;
    if (strcmp(type, "perspective") == 0)
        status = read_perspective(&at, &desc);
    else if (strcmp(type, "orthographic") == 0)
        status = read_orthographic(&at, &desc);
    else
        return gltf_fail(&type_at, AG_ERROR_FORMAT, "\"%.20s\" is not a kind of camera", type);
    if (status)
        return status;
    place(file->nodes[node].world, &desc);
    status = read_argand(&at, &desc);
    if (status)
        return status;
    ag_camera camera;
    return ag_scene_add_camera(file->scene, &desc, &camera);
}
