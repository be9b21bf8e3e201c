// Navigation: the camera in the user's hands.  Plain data: no window, no clock.
//
// The eye stands at target + distance (sin phi sin theta, cos phi, sin phi cos theta), as on an
// ag_orbit, and is rolled about its line of sight.  Pointers are px from the window's top left.
#ifndef VIEWER_NAVIGATION_H
#define VIEWER_NAVIGATION_H

#include <argand/scene.h>

typedef struct pose {
    double target[3]; // m
    double theta, phi, roll;
    double distance; // m, of the eye from the target
    double fov_y;    // rad
} pose;

typedef struct navigation {
    pose now;
    bool orthographic;        // as high as the perspective view at the target
    double width, height;     // px, of the window
    double center[3], radius; // m, of the scene
    ag_camera_desc taken;     // given back as it is until the first motion
    bool is_taken;

    pose from, to; // of a transition; there is one while `elapsed` is below `duration`
    double elapsed, duration;
    bool arrives; // at `taken`

    double wish[3];     // of flying: right, up, forward; each -1 .. 1
    double velocity[3]; // m/s, world space
    double speed;       // of flying, in half radii of the scene a second
} navigation;

// A view from the front at a scene of radius 1.
void navigation_init(navigation *n);

void navigation_resize(navigation *n, uint32_t width, uint32_t height);

// What speed and limits are measured by.
void navigation_measure(navigation *n, const ag_scene_summary *scene);

// Go on from a camera, at once: what navigation_camera() gives is it until something moves.  It
// turns about the point on its line of sight that is nearest to the scene's centre.
void navigation_take(navigation *n, const ag_camera_desc *camera);

// The camera, for ag_render and the like.
ag_camera_desc navigation_camera(const navigation *n);

// ---- By the pointer: from one place to another ------------------------------

// Around the target; the window's height is half a turn.
void navigation_turn(navigation *n, const double from[2], const double to[2]);

// In the picture's plane: what is at the target's depth stays under the pointer.
void navigation_pan(navigation *n, const double from[2], const double to[2]);

// Around the eye, as one looks about while flying.
void navigation_look(navigation *n, const double from[2], const double to[2]);

// Nearer by 1.1^steps, smoothly; what is under the pointer at the target's depth stays there.
void navigation_zoom(navigation *n, double steps, const double at[2]);

// ---- To a place, within .2 s -----------------------------------------------

typedef enum navigation_side {
    NAVIGATION_FRONT = 0, // from +Z
    NAVIGATION_BACK,
    NAVIGATION_RIGHT, // from +X
    NAVIGATION_LEFT,
    NAVIGATION_TOP, // from +Y
    NAVIGATION_BOTTOM,
} navigation_side;

// The same as navigation_take, in the end.
void navigation_go(navigation *n, const ag_camera_desc *camera);

void navigation_go_side(navigation *n, navigation_side side);

// Keep the direction; the whole scene fills the view, or a ball does.
void navigation_go_all(navigation *n, const ag_scene *scene);
void navigation_go_ball(navigation *n, const float center[3], float radius);

void navigation_set_orthographic(navigation *n, bool orthographic);

// ---- In time ---------------------------------------------------------------

// Fly: how much to the right, up (+Y) and forward, each -1 .. 1, until told otherwise.
void navigation_fly(navigation *n, double right, double up, double forward);

// Fly 1.25^steps times as fast.
void navigation_hurry(navigation *n, double steps);

// Let time pass.  Steps of any length lead to the same place.
void navigation_step(navigation *n, double seconds);

// Will another step move it?
bool navigation_moves(const navigation *n);

#endif
