// The pointer: what the mouse does.
#include "state.h"

#include <math.h>

static const double click_px = 4, split_px = 8, rest_s = 0.06, first_step_s = 1.0 / 60;

static bool on_split(const viewer *v, const double at[2])
{
    uint32_t width, height;
    screen_size(v->screen, &width, &height);
    double near = split_px * (double)screen_scale(v->screen);
    return v->truth.wanted && fabs(at[0] - v->truth.split * width) <= near;
}

static drag left_drag(viewer *v, const screen_event *e)
{
    if (on_split(v, e->at))
        return DRAG_SPLIT;
    if (v->picked.kind == PICK_LIGHT)
        picking_look(v, LOOK_PRESS, e->at); // it may be the light that is meant
    return e->modifiers & KEY_SHIFT ? DRAG_PAN : DRAG_TURN;
}

static void press(viewer *v, const screen_event *e)
{
    pointing *p = &v->pointing;
    if (p->drag)
        return; // one button at a time
    p->button = e->button;
    p->moved = false;
    for (int i = 0; i < 2; i++)
        p->from[i] = p->press[i] = e->at[i];
    p->drag = e->button == SCREEN_LEFT     ? left_drag(v, e)
              : e->button == SCREEN_MIDDLE ? DRAG_PAN
                                           : DRAG_LOOK;
}

static void release(viewer *v, const screen_event *e)
{
    pointing *p = &v->pointing;
    if (e->button != p->button)
        return;
    if (e->button == SCREEN_LEFT && p->drag && !p->moved)
        picking_look(v, LOOK_CLICK, e->at);
    if (p->drag == DRAG_LOOK)
        navigation_fly(&v->navigation, 0, 0, 0);
    p->drag = DRAG_NONE;
}

static void move_split(viewer *v, double x)
{
    uint32_t width, height;
    screen_size(v->screen, &width, &height);
    double split = width ? x / width : 0.5;
    v->truth.split = split < 0 ? 0 : split > 1 ? 1 : split;
    v->layers_stale = true;
}

static void move(viewer *v, const double at[2])
{
    pointing *p = &v->pointing;
    p->moved |= hypot(at[0] - p->press[0], at[1] - p->press[1]) >
                click_px * (double)screen_scale(v->screen);
    if (!p->moved)
        return;
    switch (p->drag) {
    case DRAG_NONE: return;
    case DRAG_TURN: navigation_turn(&v->navigation, p->from, at); break;
    case DRAG_PAN: navigation_pan(&v->navigation, p->from, at); break;
    case DRAG_LOOK: navigation_look(&v->navigation, p->from, at); break;
    case DRAG_SPLIT: move_split(v, at[0]); break;
    case DRAG_LIGHT: picking_drag(v, p->from, at); break;
    }
    p->from[0] = at[0];
    p->from[1] = at[1];
    if (p->drag != DRAG_SPLIT && p->drag != DRAG_LIGHT) {
        v->moved = v->now;
        viewer_redraw(v);
    }
}

static void turn_wheel(viewer *v, const screen_event *e)
{
    if (v->pointing.drag == DRAG_LOOK)
        navigation_hurry(&v->navigation, e->steps);
    else if (e->modifiers & KEY_CTRL)
        picking_strengthen(v, e->steps);
    else if (e->modifiers & KEY_SHIFT)
        picking_enlarge(v, e->steps);
    else
        navigation_zoom(&v->navigation, e->steps, e->at);
}

void pointer_event(viewer *v, const screen_event *e)
{
    if (e->kind == SCREEN_WHEEL)
        turn_wheel(v, e);
    else if (e->kind == SCREEN_BUTTON && e->down)
        press(v, e);
    else if (e->kind == SCREEN_BUTTON)
        release(v, e);
    else if (e->kind == SCREEN_MOTION && v->pointing.drag)
        move(v, e->at);
    if (e->kind == SCREEN_MOTION)
        v->rests_at = v->now + rest_s;
}

static void rest_on(viewer *v, selection what)
{
    what.hovers = true;
    if (what.kind != v->hovered.kind || what.index != v->hovered.index)
        v->layers_stale = true;
    v->hovered = what;
}

void pointer_found(viewer *v, look_use use, selection what)
{
    bool light = what.kind == PICK_LIGHT;
    if (use == LOOK_HOVER)
        rest_on(v, v->pointing.drag ? (selection) { 0 } : what);
    else if (use == LOOK_CLICK)
        picking_pick(v, what);
    else if (light && v->picked.kind == PICK_LIGHT && what.index == v->picked.index)
        v->pointing.drag = DRAG_LIGHT;
}

// ---- Steps -------------------------------------------------------------------

static double held(const viewer *v, char more, char less)
{
    return (screen_held(v->screen, more) ? 1.0 : 0.0) - (screen_held(v->screen, less) ? 1.0 : 0.0);
}

static void fly(viewer *v)
{
    if (v->pointing.drag == DRAG_LOOK)
        navigation_fly(&v->navigation, held(v, 'D', 'A'), held(v, 'E', 'Q'), held(v, 'W', 'S'));
}

static void hover(viewer *v)
{
    if (v->rests_at <= 0 || v->now < v->rests_at || picking_holds(v))
        return;
    v->rests_at = 0;
    double at[2];
    if (screen_pointer(v->screen, at) && !v->pointing.drag)
        picking_look(v, LOOK_HOVER, at);
    else
        pointer_found(v, LOOK_HOVER, (selection) { 0 });
}

void pointer_step(viewer *v)
{
    fly(v);
    // What has just begun to move did not move while nothing happened; but something is seen of it.
    bool moves = navigation_moves(&v->navigation);
    if (moves)
        navigation_step(&v->navigation, v->moving ? v->now - v->stepped : first_step_s);
    v->stepped = v->now;
    if (v->moving || moves) {
        v->moved = v->now;
        viewer_redraw(v);
    }
    v->moving = moves;
    hover(v);
}
