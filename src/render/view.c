// A view on its way to the device: one camera, cut into tiles.
//
// View space: x right, y up, looking along -z.  Clip space is Vulkan's, y down, with
// depth reversed (1 at the near plane, 0 at the far one): a float depth buffer then has
// its digits where they are needed.
#include "render/view.h"

#include <cglm/cglm.h>
#include <string.h>

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
