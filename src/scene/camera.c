// Cameras: those that are added, and the one that frames a scene by itself.
#include "base/array.h"
#include "base/log.h"
#include "scene/scene.h"
#include "scene/vector.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

static const float default_fov_rad = 0.785398163397f; // 45 degrees
static const float default_theta_rad = 0.6f, default_phi_rad = 1.25f;
static const double margin = 1.05; // empty frame around a fitted scene

// ---- Added cameras ---------------------------------------------------------

static bool numbers_are_sound(const ag_camera_desc *desc)
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
    if (!numbers_are_sound(desc) || vec3_is_zero(vec3_unit(view)))
        return log_fail(&scene->log, AG_ERROR_ARGUMENT,
                        "A camera needs finite numbers, a target away from its position, a field "
                        "of view below pi, and near below far.");
    ag_camera_desc made = *desc;
    fill_defaults(&made);
    char *name = desc->name ? strdup(desc->name) : NULL;
    if ((desc->name && !name) || !array_reserve(&scene->cameras, &scene->cameras_capacity,
                                                scene->cameras_count + 1, sizeof *scene->cameras)) {
        free(name);
        return log_fail(&scene->log, AG_ERROR_MEMORY, "There is no memory for a camera.");
    }
    made.name = name;
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

// A frame: `origin` and three unit axes, the last one from the target to the eye.
typedef struct frame {
    double origin[3];
    double axis[3][3];
} frame;

// The box corners of all instances, one after the other, in `frame`; 8 per instance.
static void corner_in_frame(const ag_scene *scene, size_t instance, unsigned corner, const frame *f,
                            double out[3])
{
    const scene_instance *shown = &scene->instances[instance];
    const scene_mesh *mesh = &scene->meshes[shown->mesh];
    double world[3];
    for (int row = 0; row < 3; row++) {
        world[row] = (double)shown->world[12 + row] - f->origin[row];
        for (int column = 0; column < 3; column++) {
            float p = corner >> column & 1u ? mesh->max[column] : mesh->min[column];
            world[row] += (double)shown->world[4 * column + row] * (double)p;
        }
    }
    for (int i = 0; i < 3; i++)
        out[i] = f->axis[i][0] * world[0] + f->axis[i][1] * world[1] + f->axis[i][2] * world[2];
}

// The smallest distance at which every corner p of every box lies inside a perspective view
// whose half extents at distance 1 are tx, ty: |p.x| <= (r - p.z) tx, so r >= p.z + |p.x| / tx,
// and likewise for y.
static double fitting_distance(const ag_scene *scene, const frame *f, double tx, double ty)
{
    double distance = 0.0, extent = 0.0;
    for (size_t i = 0; i < scene->instances_count; i++) {
        for (unsigned corner = 0; corner < 8; corner++) {
            double p[3];
            corner_in_frame(scene, i, corner, f, p);
            distance = fmax(distance, p[2] + fmax(fabs(p[0]) / tx, fabs(p[1]) / ty));
            extent = fmax(extent, fmax(fabs(p[2]), fmax(fabs(p[0]), fabs(p[1]))));
        }
    }
    if (extent == 0.0) // nothing, or a single point
        return 1.0;
    return fmax(distance, 1.1 * extent); // a line seen from its end has no width
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
