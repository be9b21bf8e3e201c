// Cameras: those that are added, and the one that frames a scene by itself.
#include "base/array.h"
#include "base/log.h"
#include "scene/frame.h"
#include "scene/scene.h"
#include "scene/vector.h"

#include <float.h>

static const float default_fov_rad = 0.785398163397f; // 45 degrees
static const float default_theta_rad = 0.6f, default_phi_rad = 1.25f;
static const double margin = 1.05; // empty frame around a fitted scene

// ---- Added cameras ---------------------------------------------------------

bool scene_camera_is_sound(const ag_camera_desc *desc)
{
    const float scalars[] = { desc->fov_y_rad, desc->height_m, desc->near_m, desc->far_m };
    return all_finite(scalars, 4) && all_finite(desc->position, 3) && all_finite(desc->target, 3) &&
           all_finite(desc->up, 3) && desc->fov_y_rad >= 0.0f && desc->fov_y_rad < 3.14159265f &&
           desc->height_m >= 0.0f && desc->near_m >= 0.0f &&
           (desc->far_m == 0.0f || desc->far_m > desc->near_m);
}

static void fill_defaults(ag_camera_desc *desc)
{
    if (vec3_is_zero(vec3_from(desc->up)))
        desc->up[1] = 1.0f;
    if (desc->fov_y_rad == 0.0f && desc->height_m == 0.0f)
        desc->fov_y_rad = default_fov_rad;
}

ag_status ag_scene_add_camera(ag_scene *scene, const ag_camera_desc *desc, ag_camera *camera)
{
    *camera = (ag_camera) { 0 };
    vec3 view = vec3_sub(vec3_from(desc->target), vec3_from(desc->position));
    if (!scene_camera_is_sound(desc) || vec3_is_zero(vec3_unit(view)))
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "A camera needs finite numbers, a target away from its position, a field "
                        "of view below pi, and near below far.");
    ag_camera_desc made = *desc;
    fill_defaults(&made);
    made.name = NULL;
    if (!array_reserve(&scene->cameras, &scene->cameras_capacity, scene->cameras_count + 1,
                       sizeof *scene->cameras) ||
        !name_set(&made.name, desc->name))
        return log_fail(&scene->log, AG_ERROR_MEMORY, "There is no memory for a camera.");
    scene->cameras[scene->cameras_count++] = made;
    camera->id = (uint32_t)scene->cameras_count;
    scene->revision++;
    return AG_OK;
}

bool ag_scene_camera(const ag_scene *scene, size_t index, ag_camera_desc *desc)
{
    if (index >= scene->cameras_count)
        return false;
    *desc = scene->cameras[index];
    return true;
}

// ---- What a view sees of the scene -----------------------------------------

// What a perspective view must keep in front of it, its half extents at distance 1 being
// tx and ty.
typedef struct fit {
    double tx, ty;
    double distance; // of the eye from the target
    double nearest;  // of any point's z
    double extent;   // of any point's coordinate
} fit;

// A point p is inside if |x| <= (distance - z) tx, so distance >= z + |x| / tx; likewise y.
static void fit_point(fit *f, const affine *a, double x, double y, double z)
{
    double p[3];
    for (int i = 0; i < 3; i++)
        p[i] = a->m[i][0] * x + a->m[i][1] * y + a->m[i][2] * z + a->m[i][3];
    f->distance = fmax(f->distance, p[2] + fmax(fabs(p[0]) / f->tx, fabs(p[1]) / f->ty));
    f->nearest = fmax(f->nearest, p[2]);
    f->extent = fmax(f->extent, fmax(fabs(p[2]), fmax(fabs(p[0]), fabs(p[1]))));
}

static void fit_box(fit *f, const affine *a, const scene_mesh *mesh)
{
    for (unsigned corner = 0; corner < 8; corner++)
        fit_point(f, a, (double)(corner & 1u ? mesh->max : mesh->min)[0],
                  (double)(corner & 2u ? mesh->max : mesh->min)[1],
                  (double)(corner & 4u ? mesh->max : mesh->min)[2]);
}

static void fit_mesh(fit *f, const affine *a, const scene_mesh *mesh)
{
    for (uint32_t i = 0; i < mesh->index_count; i++) {
        const float *p = mesh->vertices[mesh->indices[i]].position;
        fit_point(f, a, (double)p[0], (double)p[1], (double)p[2]);
    }
}

// The smallest distance at which everything is inside.  Only instances whose box would move the
// eye further are looked at vertex by vertex; past a budget the box decides alone.
static double fitting_distance(const ag_scene *scene, const frame *f, double tx, double ty)
{
    size_t budget = (size_t)1 << 22; // corners
    fit all = { .tx = tx, .ty = ty };
    for (size_t i = 0; i < scene->instances_count; i++) {
        const scene_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        affine a = frame_from_mesh(f, scene->instances[i].world);
        fit boxed = all;
        fit_box(&boxed, &a, mesh);
        if (boxed.distance > all.distance && mesh->index_count <= budget) {
            budget -= mesh->index_count;
            fit_mesh(&all, &a, mesh);
        } else {
            all = boxed;
        }
    }
    if (all.extent == 0.0) // nothing, or a single point
        return 1.0;
    return fmax(all.distance, all.nearest + 0.001 * all.extent); // a line seen from its end
}

// ---- Framing ---------------------------------------------------------------

ag_orbit ag_orbit_auto(void)
{
    return (ag_orbit) { .theta_rad = NAN,
                        .phi_rad = NAN,
                        .radius_m = NAN,
                        .target = { NAN, NAN, NAN },
                        .fov_y_rad = default_fov_rad };
}

static void choose_target(const ag_scene *scene, ag_orbit *orbit)
{
    float min[3], max[3];
    scene_bounds(scene, min, max);
    for (int i = 0; i < 3; i++)
        if (!isfinite(orbit->target[i]))
            orbit->target[i] = 0.5f * min[i] + 0.5f * max[i];
}

// The axes of a camera on the orbit.  `up` is minus the derivative of the eye's direction by
// phi: the projection of +Y, defined at the poles too.
static frame orbit_frame(const ag_orbit *orbit)
{
    double st = sin((double)orbit->theta_rad), ct = cos((double)orbit->theta_rad);
    double sp = sin((double)orbit->phi_rad), cp = cos((double)orbit->phi_rad);
    return (frame) {
        .origin = { (double)orbit->target[0], (double)orbit->target[1], (double)orbit->target[2] },
        .axis = { { ct, 0.0, -st }, { -cp * st, sp, -cp * ct }, { sp * st, cp, sp * ct } },
    };
}

ag_camera_desc ag_scene_frame(const ag_scene *scene, const ag_orbit *orbit, float aspect)
{
    ag_orbit o = orbit ? *orbit : ag_orbit_auto();
    if (!isfinite(o.theta_rad))
        o.theta_rad = default_theta_rad;
    if (!isfinite(o.phi_rad))
        o.phi_rad = default_phi_rad;
    if (!(o.fov_y_rad > 0.0f && o.fov_y_rad < 3.14159265f))
        o.fov_y_rad = default_fov_rad;
    if (!(aspect > 0.0f && isfinite(aspect)))
        aspect = 1.0f;
    choose_target(scene, &o);
    frame f = orbit_frame(&o);
    double radius = (double)o.radius_m;
    if (!(radius >= 0.0 && isfinite(radius))) {
        double ty = tan(0.5 * (double)o.fov_y_rad) / margin;
        radius = fmin(fitting_distance(scene, &f, ty * (double)aspect, ty), 1e30);
    }
    ag_camera_desc camera = { .fov_y_rad = o.fov_y_rad };
    for (int i = 0; i < 3; i++) {
        // On the target itself the camera still looks the orbit's way.
        camera.target[i] = (float)(f.origin[i] - (radius > 0.0 ? 0.0 : f.axis[2][i]));
        camera.position[i] = (float)(f.origin[i] + radius * f.axis[2][i]);
        camera.up[i] = (float)f.axis[1][i];
    }
    return camera;
}
