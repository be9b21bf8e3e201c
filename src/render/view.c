// Where the eye is and what it sees: one camera, cut into tiles.
//
// View space: x right, y up, looking along -z.  Clip space is Vulkan's, y down, with
// depth reversed (1 at the near plane, 0 at the far one): a float depth buffer then has
// its digits where they are needed.
#include "render/view.h"

#include <cglm/cglm.h>
#include <float.h>
#include <string.h>

static void basis(const ag_camera_desc *camera, view *v)
{
    vec3 eye, target, up, forward, right;
    memcpy(eye, camera->position, sizeof eye);
    memcpy(target, camera->target, sizeof target);
    memcpy(up, camera->up, sizeof up);
    if (glm_vec3_norm2(up) == 0.0f)
        glm_vec3_copy((vec3) { 0, 1, 0 }, up);
    glm_vec3_sub(target, eye, forward);
    if (glm_vec3_norm2(forward) == 0.0f)
        glm_vec3_copy((vec3) { 0, 0, -1 }, forward);
    glm_vec3_normalize(forward);
    glm_vec3_cross(forward, up, right);
    if (glm_vec3_norm2(right) < 1e-12f) // looking along `up`: any right will do
        glm_vec3_cross(forward, fabsf(forward[2]) < 0.9f ? (vec3) { 0, 0, -1 } : (vec3) { 1, 0, 0 },
                       right);
    glm_vec3_normalize(right);
    glm_vec3_cross(right, forward, up);
    memcpy(v->eye, eye, sizeof eye);
    memcpy(v->forward, forward, sizeof forward);
    memcpy(v->right, right, sizeof right);
    memcpy(v->up, up, sizeof up);
}

float view_depth(const view *v, const float point[3])
{
    float depth = 0;
    for (int i = 0; i < 3; i++)
        depth += (point[i] - v->eye[i]) * v->forward[i];
    return depth;
}

// Planes around what is visible, where the camera does not give its own.
static void fit_depth(const ag_camera_desc *camera, const float min[3], const float max[3], view *v)
{
    float nearest = FLT_MAX, farthest = 0;
    for (int i = 0; i < 8 && min; i++) {
        const float corner[3] = { i & 1 ? max[0] : min[0], i & 2 ? max[1] : min[1],
                                  i & 4 ? max[2] : min[2] };
        float depth = view_depth(v, corner);
        nearest = depth < nearest ? depth : nearest;
        farthest = depth > farthest ? depth : farthest;
    }
    if (farthest <= 0) // nothing before the eye
        nearest = farthest = 1;
    v->far_m = camera->far_m > 0 ? camera->far_m : farthest * 1.01f;
    v->near_m = camera->near_m > 0 ? camera->near_m : nearest * 0.99f;
    if (camera->near_m > 0 || v->orthographic)
        return; // an orthographic one may have any sign
    if (v->near_m < v->far_m * 1e-5f)
        v->near_m = v->far_m * 1e-5f;
}

view view_make(const ag_camera_desc *camera, uint32_t width, uint32_t height, const float min[3],
               const float max[3])
{
    view v = { .width = width, .height = height, .orthographic = camera->height_m > 0 };
    basis(camera, &v);
    float fov = camera->fov_y_rad > 0 ? camera->fov_y_rad : GLM_PI_4f;
    v.half_y = v.orthographic ? camera->height_m / 2 : tanf(fov / 2);
    v.half_x = v.half_y * (float)width / (float)height;
    fit_depth(camera, min, max, &v);
    if (v.far_m <= v.near_m)
        v.far_m = v.near_m + fabsf(v.near_m) * 0.01f + 1e-6f;
    return v;
}

void view_include(view *v, const ag_camera_desc *camera, const float center[3], float radius)
{
    float depth = view_depth(v, center), nearest = 0.99f * (depth - radius);
    if (!(camera->far_m > 0))
        v->far_m = fmaxf(v->far_m, 1.01f * (depth + radius));
    // What is far costs the near no precision: depth is reversed, in floats.
    if (!(camera->near_m > 0) && nearest < v->near_m)
        v->near_m = v->orthographic ? nearest : fmaxf(nearest, fminf(v->near_m, v->far_m * 1e-5f));
}

// clip_from_view for the whole picture.
static void project(const view *v, mat4 clip)
{
    float n = v->near_m, f = v->far_m;
    glm_mat4_zero(clip);
    clip[0][0] = 1 / v->half_x;
    clip[1][1] = -1 / v->half_y;
    if (v->orthographic) {
        clip[2][2] = 1 / (f - n);
        clip[3][2] = f / (f - n);
        clip[3][3] = 1;
    } else {
        clip[2][2] = n / (f - n);
        clip[3][2] = f * n / (f - n);
        clip[2][3] = -1;
    }
}

void view_frame(const view *v, view_rect tile, const float jitter[2], gpu_frame *frame)
{
    mat4 clip, cut = GLM_MAT4_IDENTITY_INIT;
    mat4 view_from_world = {
        { v->right[0], v->up[0], -v->forward[0], 0 },
        { v->right[1], v->up[1], -v->forward[1], 0 },
        { v->right[2], v->up[2], -v->forward[2], 0 },
        { 0, 0, 0, 1 },
    };
    glm_translate(view_from_world, (vec3) { -v->eye[0], -v->eye[1], -v->eye[2] });
    project(v, clip);

    // The tile's centre in the picture's clip space, and its share of it.
    float share_x = (float)tile.width / (float)v->width;
    float share_y = (float)tile.height / (float)v->height;
    float x = 2 * ((float)tile.x + jitter[0]) / (float)v->width + share_x - 1;
    float y = 2 * ((float)tile.y + jitter[1]) / (float)v->height + share_y - 1;
    cut[0][0] = 1 / share_x;
    cut[1][1] = 1 / share_y;
    cut[3][0] = -x / share_x;
    cut[3][1] = -y / share_y;
    glm_mat4_mul(cut, clip, clip);
    glm_mat4_mul(clip, view_from_world, clip);
    memcpy(&frame->clip_from_world, clip, sizeof clip);

    float rays[3][3];
    for (int i = 0; i < 3; i++) {
        rays[0][i] = v->forward[i];
        if (!v->orthographic)
            rays[0][i] += x * v->half_x * v->right[i] - y * v->half_y * v->up[i];
        rays[1][i] = share_x * v->half_x * v->right[i];
        rays[2][i] = -share_y * v->half_y * v->up[i];
    }
    const float *f = v->forward, *eye = v->eye;
    frame->depth = (float4) { f[0], f[1], f[2], -(f[0] * eye[0] + f[1] * eye[1] + f[2] * eye[2]) };
    memcpy(&frame->eye, v->eye, sizeof v->eye);
    memcpy(&frame->ray_center, rays[0], sizeof rays[0]);
    memcpy(&frame->ray_x, rays[1], sizeof rays[1]);
    memcpy(&frame->ray_y, rays[2], sizeof rays[2]);
    frame->pixel = (float2) { 2 / (float)tile.width, 2 / (float)tile.height };
    frame->orthographic = v->orthographic ? 1 : 0;
}
