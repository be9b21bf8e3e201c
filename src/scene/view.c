// Where the eye is and what it sees.
//
// View space: x right, y up, looking along -z.
#include "scene/view.h"

#include "scene/vector.h"

#include <float.h>

static void basis(const ag_camera_desc *camera, view *v)
{
    vec3 eye = vec3_from(camera->position), up = vec3_from(camera->up);
    if (vec3_is_zero(up))
        up = (vec3) { 0, 1, 0 };
    vec3 forward = vec3_unit(vec3_sub(vec3_from(camera->target), eye));
    if (vec3_is_zero(forward))
        forward = (vec3) { 0, 0, -1 };
    vec3 right = vec3_cross(forward, up);
    if (vec3_dot(right, right) < 1e-12f) // looking along `up`: any right will do
        right =
            vec3_cross(forward, fabsf(forward.z) < 0.9f ? (vec3) { 0, 0, -1 } : (vec3) { 1, 0, 0 });
    right = vec3_unit(right);
    vec3_store(eye, v->eye);
    vec3_store(forward, v->forward);
    vec3_store(right, v->right);
    vec3_store(vec3_cross(right, forward), v->up);
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
    float fov = camera->fov_y_rad > 0 ? camera->fov_y_rad : 0.785398163f;
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

void view_ray(const view *v, float x, float y, float origin[3], float direction[3])
{
    float clip_x = 2 * x / (float)v->width - 1, clip_y = 1 - 2 * y / (float)v->height;
    vec3 off = vec3_add(vec3_scale(vec3_from(v->right), clip_x * v->half_x),
                        vec3_scale(vec3_from(v->up), clip_y * v->half_y));
    vec3 eye = vec3_from(v->eye), forward = vec3_from(v->forward);
    vec3_store(v->orthographic ? vec3_add(eye, off) : eye, origin);
    vec3_store(v->orthographic ? forward : vec3_unit(vec3_add(forward, off)), direction);
}

bool view_project(const view *v, const float point[3], float place[2])
{
    vec3 to = vec3_sub(vec3_from(point), vec3_from(v->eye));
    float depth = view_depth(v, point), scale = v->orthographic ? 1 : depth;
    if (!(depth > 0))
        return false;
    float x = vec3_dot(to, vec3_from(v->right)) / (scale * v->half_x);
    float y = vec3_dot(to, vec3_from(v->up)) / (scale * v->half_y);
    place[0] = (1 + x) / 2 * (float)v->width;
    place[1] = (1 - y) / 2 * (float)v->height;
    return isfinite(place[0]) && isfinite(place[1]);
}

ag_ray ag_camera_ray(const ag_camera_desc *camera, uint32_t width, uint32_t height, float x,
                     float y)
{
    view v = view_make(camera, width, height, NULL, NULL);
    ag_ray ray;
    view_ray(&v, x, y, ray.origin, ray.direction);
    return ray;
}

bool ag_camera_project(const ag_camera_desc *camera, uint32_t width, uint32_t height,
                       const float point[3], float place[2])
{
    view v = view_make(camera, width, height, NULL, NULL);
    return view_project(&v, point, place);
}
