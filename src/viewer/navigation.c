// Navigation: the camera in the user's hands.
#include "navigation.h"

#include <math.h>

static const double pi = 3.14159265358979324;
static const double default_fov = 0.785398163397448; // 45 degrees
static const double margin = 1.05;                   // empty frame around what is fitted
static const double transition_s = 0.2;
static const double inertia_s = 0.08; // of flying

// ---- Vectors ---------------------------------------------------------------

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double length(const double a[3])
{
    return sqrt(dot(a, a));
}

// a += factor b
static void add(double a[3], double factor, const double b[3])
{
    for (int i = 0; i < 3; i++)
        a[i] += factor * b[i];
}

// a - b
static void difference(const float a[3], const float b[3], double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (double)a[i] - (double)b[i];
}

static double clamp(double x, double low, double high)
{
    return fmin(fmax(x, low), high);
}

// ---- Poses -----------------------------------------------------------------

typedef struct axes {
    double right[3], up[3], back[3]; // unit; back is from the target to the eye
} axes;

static axes axes_of(const pose *p)
{
    double st = sin(p->theta), ct = cos(p->theta), sp = sin(p->phi), cp = cos(p->phi);
    double sr = sin(p->roll), cr = cos(p->roll);
    const double right[3] = { ct, 0, -st }, up[3] = { -cp * st, sp, -cp * ct };
    axes a = { .back = { sp * st, cp, sp * ct } };
    for (int i = 0; i < 3; i++) {
        a.right[i] = cr * right[i] - sr * up[i];
        a.up[i] = sr * right[i] + cr * up[i];
    }
    return a;
}

static void eye_of(const pose *p, double eye[3])
{
    axes a = axes_of(p);
    for (int i = 0; i < 3; i++)
        eye[i] = p->target[i] + p->distance * a.back[i];
}

// Turn the pose to look along -back, its head towards `up`.
static void orient(pose *p, const double back[3], const double up[3])
{
    p->phi = acos(clamp(back[1], -1, 1));
    p->theta = atan2(back[0], back[2]);
    p->roll = 0;
    if (hypot(back[0], back[2]) < 1e-6) // at a pole `up` alone tells theta, if anything does
        p->theta = back[1] > 0 ? atan2(-up[0], -up[2]) : atan2(up[0], up[2]);
    axes a = axes_of(p);
    double x = dot(up, a.right), y = dot(up, a.up);
    if (hypot(x, y) > 1e-6 * length(up))
        p->roll = atan2(x, y);
}

static double limit_distance(const navigation *n, double distance)
{
    return clamp(distance, 1e-4 * n->radius, 1e4 * n->radius);
}

// The camera's pose about the point on its line of sight that is nearest to the scene's centre; a
// perspective camera that has it behind itself keeps its own target.
static pose pose_from(const navigation *n, const ag_camera_desc *camera)
{
    pose p = { .fov_y = camera->fov_y_rad > 0.0f ? (double)camera->fov_y_rad : default_fov };
    double back[3], up[3], to_center[3];
    difference(camera->position, camera->target, back);
    double own = length(back), depth = 0;
    for (int i = 0; i < 3; i++) {
        back[i] = own > 0 ? back[i] / own : i == 2;
        up[i] = (double)camera->up[i];
        to_center[i] = n->center[i] - (double)camera->position[i];
    }
    if (length(up) == 0)
        up[1] = 1;
    orient(&p, back, up);
    depth = -dot(to_center, back);
    if (camera->height_m > 0.0f)
        p.distance = 0.5 * (double)camera->height_m / tan(0.5 * p.fov_y);
    else
        p.distance = depth = limit_distance(n, depth > 0.01 * n->radius ? depth : own);
    for (int i = 0; i < 3; i++)
        p.target[i] = (double)camera->position[i] - depth * back[i];
    return p;
}

// ---- State -----------------------------------------------------------------

void navigation_init(navigation *n)
{
    *n = (navigation) {
        .now = { .phi = 0.5 * pi, .distance = 3, .fov_y = default_fov },
        .width = 1,
        .height = 1,
        .radius = 1,
        .speed = 1,
    };
}

void navigation_resize(navigation *n, uint32_t width, uint32_t height)
{
    n->width = width ? (double)width : 1;
    n->height = height ? (double)height : 1;
}

void navigation_measure(navigation *n, const ag_scene_summary *scene)
{
    double size[3];
    difference(scene->bounds_max, scene->bounds_min, size);
    n->radius = 0.5 * length(size);
    if (!(n->radius > 0))
        n->radius = 1;
    for (int i = 0; i < 3; i++)
        n->center[i] = 0.5 * ((double)scene->bounds_min[i] + (double)scene->bounds_max[i]);
}

static bool in_transition(const navigation *n)
{
    return n->elapsed < n->duration;
}

// The user takes over, from where it is now.
static void begin(navigation *n)
{
    n->duration = 0;
    n->is_taken = false;
}

void navigation_take(navigation *n, const ag_camera_desc *camera)
{
    begin(n);
    for (int i = 0; i < 3; i++)
        n->velocity[i] = 0;
    n->now = pose_from(n, camera);
    n->orthographic = camera->height_m > 0.0f;
    n->taken = *camera;
    n->taken.name = NULL; // not ours
    n->is_taken = true;
}

ag_camera_desc navigation_camera(const navigation *n)
{
    if (n->is_taken)
        return n->taken;
    const pose *p = &n->now;
    axes a = axes_of(p);
    double away = p->distance;
    ag_camera_desc camera = { .fov_y_rad = (float)p->fov_y };
    if (n->orthographic) { // from outside of the scene; the picture is the same
        double aside[3];
        for (int i = 0; i < 3; i++)
            aside[i] = p->target[i] - n->center[i];
        away += length(aside) + 2 * n->radius;
        camera.fov_y_rad = 0.0f;
        camera.height_m = (float)(2 * p->distance * tan(0.5 * p->fov_y));
    }
    for (int i = 0; i < 3; i++) {
        camera.target[i] = (float)p->target[i];
        camera.position[i] = (float)(p->target[i] + away * a.back[i]);
        camera.up[i] = (float)a.up[i];
    }
    return camera;
}

// ---- By the pointer --------------------------------------------------------

// m in the target's plane a pixel
static double pixel_size(const navigation *n, const pose *p)
{
    return 2 * p->distance * tan(0.5 * p->fov_y) / n->height;
}

static void rotate(navigation *n, const double from[2], const double to[2])
{
    double right = pi * (to[0] - from[0]) / n->height, down = pi * (to[1] - from[1]) / n->height;
    double sr = sin(n->now.roll), cr = cos(n->now.roll);
    n->now.theta = remainder(n->now.theta - (cr * right - sr * down), 2 * pi);
    n->now.phi = clamp(n->now.phi - (sr * right + cr * down), 0, pi);
}

void navigation_turn(navigation *n, const double from[2], const double to[2])
{
    begin(n);
    rotate(n, from, to);
}

void navigation_look(navigation *n, const double from[2], const double to[2])
{
    begin(n);
    double eye[3];
    eye_of(&n->now, eye);
    rotate(n, from, to);
    axes a = axes_of(&n->now);
    for (int i = 0; i < 3; i++)
        n->now.target[i] = eye[i] - n->now.distance * a.back[i];
}

// Move the target in its plane as far as the pixels from `from` to `to` are apart there.
static void slide(const navigation *n, pose *p, const double from[2], const double to[2],
                  double factor)
{
    axes a = axes_of(p);
    factor *= pixel_size(n, p);
    add(p->target, factor * (to[0] - from[0]), a.right);
    add(p->target, -factor * (to[1] - from[1]), a.up);
}

void navigation_pan(navigation *n, const double from[2], const double to[2])
{
    begin(n);
    slide(n, &n->now, from, to, -1);
}

static void go(navigation *n, pose to, double seconds)
{
    n->from = n->now;
    n->to = to;
    n->elapsed = 0;
    n->duration = seconds;
    n->is_taken = n->arrives = false;
    for (int i = 0; i < 3; i++)
        n->velocity[i] = 0;
}

void navigation_zoom(navigation *n, double steps, const double at[2])
{
    pose p = in_transition(n) ? n->to : n->now;
    double distance = limit_distance(n, p.distance * pow(1.1, -steps));
    const double middle[2] = { 0.5 * n->width, 0.5 * n->height };
    slide(n, &p, middle, at, 1 - distance / p.distance);
    p.distance = distance;
    go(n, p, 0.5 * transition_s);
}

// ---- To a place ------------------------------------------------------------

void navigation_go(navigation *n, const ag_camera_desc *camera)
{
    go(n, pose_from(n, camera), transition_s);
    n->orthographic = camera->height_m > 0.0f;
    n->taken = *camera;
    n->taken.name = NULL;
    n->arrives = true;
}

void navigation_go_side(navigation *n, navigation_side side)
{
    static const double quarters[][2] = { { 0, 1 },  { 2, 1 }, { 1, 1 },
                                          { -1, 1 }, { 0, 0 }, { 0, 2 } };
    pose p = in_transition(n) ? n->to : n->now;
    p.theta = 0.5 * pi * quarters[side][0];
    p.phi = 0.5 * pi * quarters[side][1];
    p.roll = 0;
    go(n, p, transition_s);
}

void navigation_go_all(navigation *n, const ag_scene *scene)
{
    pose p = in_transition(n) ? n->to : n->now;
    p.roll = 0;
    ag_orbit orbit = ag_orbit_auto();
    orbit.theta_rad = (float)p.theta;
    orbit.phi_rad = (float)p.phi;
    orbit.fov_y_rad = (float)p.fov_y;
    ag_camera_desc camera = ag_scene_frame(scene, &orbit, (float)(n->width / n->height));
    double back[3];
    difference(camera.position, camera.target, back);
    p.distance = length(back);
    for (int i = 0; i < 3; i++)
        p.target[i] = (double)camera.target[i];
    go(n, p, transition_s);
}

void navigation_go_ball(navigation *n, const float center[3], float radius)
{
    pose p = in_transition(n) ? n->to : n->now;
    double ty = tan(0.5 * p.fov_y), t = fmin(ty, ty * n->width / n->height);
    p.distance = limit_distance(n, margin * (double)radius / sin(atan(t)));
    for (int i = 0; i < 3; i++)
        p.target[i] = (double)center[i];
    go(n, p, transition_s);
}

void navigation_set_orthographic(navigation *n, bool orthographic)
{
    n->is_taken = n->arrives = false;
    n->orthographic = orthographic;
}

// ---- In time ---------------------------------------------------------------

// Between two poses: distance goes by factors, and the target with it, so that what keeps its
// place in the picture at both ends keeps it all the way.
static pose between(const pose *a, const pose *b, double u)
{
    double ratio = log(b->distance / a->distance);
    double w = fabs(ratio) > 1e-6 ? expm1(u * ratio) / expm1(ratio) : u;
    pose p = {
        .theta = a->theta + u * remainder(b->theta - a->theta, 2 * pi),
        .phi = a->phi + u * (b->phi - a->phi),
        .roll = a->roll + u * remainder(b->roll - a->roll, 2 * pi),
        .distance = a->distance * exp(u * ratio),
        .fov_y = a->fov_y + u * (b->fov_y - a->fov_y),
    };
    for (int i = 0; i < 3; i++)
        p.target[i] = a->target[i] + w * (b->target[i] - a->target[i]);
    return p;
}

static void advance_transition(navigation *n, double seconds)
{
    n->elapsed += seconds;
    double t = n->elapsed / n->duration;
    n->now = in_transition(n) ? between(&n->from, &n->to, t * t * (3 - 2 * t)) : n->to;
    if (!in_transition(n) && n->arrives)
        n->is_taken = true;
}

void navigation_fly(navigation *n, double right, double up, double forward)
{
    n->wish[0] = right;
    n->wish[1] = up;
    n->wish[2] = forward;
    if (length(n->wish) > 0)
        begin(n);
}

void navigation_hurry(navigation *n, double steps)
{
    n->speed = clamp(n->speed * pow(1.25, steps), 1e-3, 1e3);
}

// m/s that the user wishes for
static void wished_velocity(const navigation *n, double velocity[3])
{
    axes a = axes_of(&n->now);
    double factor = 0.5 * n->radius * n->speed / fmax(length(n->wish), 1);
    for (int i = 0; i < 3; i++)
        velocity[i] =
            factor * (n->wish[0] * a.right[i] - n->wish[2] * a.back[i] + (i == 1 ? n->wish[1] : 0));
}

// v' = (wished - v) / inertia, solved: exact for any step.
static void advance_flight(navigation *n, double seconds)
{
    double wished[3], gain = -expm1(-seconds / inertia_s);
    wished_velocity(n, wished);
    for (int i = 0; i < 3; i++) {
        double lag = n->velocity[i] - wished[i];
        n->now.target[i] += wished[i] * seconds + lag * inertia_s * gain;
        n->velocity[i] -= lag * gain;
    }
    if (length(n->wish) == 0 && length(n->velocity) < 1e-4 * n->radius)
        n->velocity[0] = n->velocity[1] = n->velocity[2] = 0;
}

void navigation_step(navigation *n, double seconds)
{
    if (!(seconds > 0))
        return;
    if (in_transition(n))
        advance_transition(n, seconds);
    else
        advance_flight(n, seconds);
}

bool navigation_moves(const navigation *n)
{
    return in_transition(n) || length(n->wish) > 0 || length(n->velocity) > 0;
}
