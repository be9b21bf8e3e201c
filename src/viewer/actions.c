// Actions: what keys do.
#include "state.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const double split_step = 0.05;
static const float exposure_step_ev = 1.0f / 3, most_compensation_ev = 10, most_exposure = 1e9f;

// ---- Files -------------------------------------------------------------------

// A name that is free: that of the input, a number and an ending, in the current folder.
static bool free_name(const viewer *v, const char *ending, char path[INPUT_MAX])
{
    const char *name = v->shown.file[0] ? v->shown.file : "argand";
    if (strncmp(name, "demo:", 5) == 0)
        name += 5;
    const char *dot = strrchr(name, '.');
    int length = dot && dot != name ? (int)(dot - name) : (int)strlen(name);
    for (int i = 1; i < 10000; i++) {
        snprintf(path, INPUT_MAX, "%.*s-%03d%s", length, name, i, ending);
        if (access(path, F_OK) != 0)
            return true;
    }
    return false;
}

static ag_status save_picture(void *context, worker *self)
{
    (void)self;
    viewer *v = context;
    const ag_log log = crew_log(v->crew, v->setup->level);
    const ag_image_note notes[] = {
        { "Software", "argand", 0 },
        { "ev100", NULL, (double)v->saved_ev100 },
    };
    const ag_image_save_options options = { .notes = notes, .note_count = 2 };
    return ag_image_save(&log, v->saved, v->save_path, &options);
}

static ag_status save_scene(void *context, worker *self)
{
    viewer *v = context;
    (void)self; // the scene has its own log
    return ag_scene_save(v->document.scene, v->save_path);
}

static bool can_save(viewer *v, const char *ending)
{
    if (!v->document.scene)
        return false;
    if (worker_is_busy(v->saver)) {
        viewer_say(v, true, "%s is still being written", v->save_path);
        return false;
    }
    if (free_name(v, ending, v->save_path))
        return true;
    viewer_say(v, true, "there are too many files like %s", v->save_path);
    return false;
}

static void begin_save(viewer *v)
{
    if (v->drafted)
        viewer_say(v, true, "%s is not yet there with all its textures", v->shown.file);
    else if (can_save(v, ".glb"))
        worker_start(v->saver, save_scene, v);
}

void actions_keep(viewer *v, ag_image *picture)
{
    if (v->shoots && can_save(v, ".png")) {
        v->saved = picture;
        v->saved_ev100 = ag_ev100_from_exposure(v->ordered.options.exposure);
        worker_start(v->saver, save_picture, v);
    } else if (v->truth.wanted && !v->truth.beside && !v->truth.stale) {
        v->truth.beside = picture;
    } else {
        ag_image_destroy(picture);
    }
    v->shoots = false;
}

void actions_collect(viewer *v)
{
    ag_status status;
    if (!worker_collect(v->saver, &status))
        return;
    ag_image_destroy(v->saved);
    v->saved = NULL;
    if (!status) // else it has been said why
        viewer_say(v, false, "saved %s", v->save_path);
}

// ---- The look ------------------------------------------------------------------

static const char *const curve_names[] = {
    [AG_TONEMAP_NEUTRAL] = "neutral",
    [AG_TONEMAP_NONE] = "none",
    [AG_TONEMAP_REINHARD] = "Reinhard",
    [AG_TONEMAP_ACES] = "ACES",
    [AG_TONEMAP_ACES_NARKOWICZ] = "ACES (Narkowicz)",
    [AG_TONEMAP_AGX] = "AgX",
};
enum { CURVES = sizeof curve_names / sizeof *curve_names };

static const char *const meter_names[] = {
    [AG_METER_CENTER] = "centre",
    [AG_METER_AVERAGE] = "average",
    [AG_METER_SPOT] = "spot",
};

static void next_curve(viewer *v)
{
    ag_tonemap *curve = &v->document.look.tonemap;
    *curve = (ag_tonemap)((*curve + 1) % CURVES);
    viewer_say(v, false, "tone curve: %s", curve_names[*curve]);
    viewer_redraw(v);
}

static void next_meter(viewer *v)
{
    static const ag_meter next[] = { [AG_METER_AVERAGE] = AG_METER_CENTER,
                                     [AG_METER_CENTER] = AG_METER_SPOT,
                                     [AG_METER_SPOT] = AG_METER_AVERAGE };
    ag_meter *meter = &v->eye.metering.meter;
    *meter = next[*meter];
    v->eye.automatic = true;
    viewer_say(v, false, "metering: %s", meter_names[*meter]);
    viewer_redraw(v);
}

static void lock_exposure(viewer *v)
{
    eye *e = &v->eye;
    e->automatic = !e->automatic;
    e->ev100 = ag_ev100_from_exposure(e->exposure);
    e->target_ev100 = e->ev100;
    viewer_say(v, false, e->automatic ? "exposure: follows the light" : "exposure: held");
    viewer_redraw(v);
}

static void expose(viewer *v, float stops)
{
    eye *e = &v->eye;
    if (e->automatic) {
        float ev = e->metering.compensation_ev + stops;
        e->metering.compensation_ev = fminf(fmaxf(ev, -most_compensation_ev), most_compensation_ev);
        viewer_say(v, false, "exposure: %+.2f EV beside the meter",
                   (double)e->metering.compensation_ev);
    } else {
        e->exposure = fminf(fmaxf(e->exposure * exp2f(stops), 1 / most_exposure), most_exposure);
        viewer_say(v, false, "exposure: EV100 %+.2f", (double)ag_ev100_from_exposure(e->exposure));
    }
    viewer_redraw(v);
}

void actions_describe(const viewer *v, hud_state *s)
{
    const eye *e = &v->eye;
    if (e->automatic)
        snprintf(s->exposure, sizeof s->exposure, "auto, %s %+.2f EV",
                 meter_names[e->metering.meter], (double)e->metering.compensation_ev);
    else
        snprintf(s->exposure, sizeof s->exposure, "held, × %.4g", (double)e->exposure);
    snprintf(s->look, sizeof s->look, "%s", curve_names[v->document.look.tonemap]);
}

// ---- The view ------------------------------------------------------------------

static void next_camera(viewer *v)
{
    ag_camera_desc camera;
    if (!v->document.scene || !ag_scene_camera(v->document.scene, 0, &camera)) {
        viewer_say(v, false, "the file has no cameras");
        return;
    }
    if (!ag_scene_camera(v->document.scene, v->camera, &camera)) {
        v->camera = 0;
        (void)ag_scene_camera(v->document.scene, 0, &camera);
    }
    viewer_say(v, false, "camera %u%s%s", v->camera, camera.name ? ": " : "",
               camera.name ? camera.name : "");
    v->camera++;
    navigation_go(&v->navigation, &camera);
}

static void frame_picked(viewer *v)
{
    const selection *s = v->picked.kind ? &v->picked : &v->hovered;
    if (s->kind)
        navigation_go_ball(&v->navigation, s->place, s->radius);
    else if (v->document.scene)
        navigation_go_all(&v->navigation, v->document.scene);
}

static void move_split(viewer *v, double by)
{
    double split = v->truth.split + by;
    v->truth.split = split < 0 ? 0 : split > 1 ? 1 : split;
    v->layers_stale = true;
}

static void toggle_truth(viewer *v)
{
    v->truth.wanted = !v->truth.wanted;
    v->truth.stale = true;
    v->layers_stale = true;
}

static void escape(viewer *v)
{
    if (v->shown.help)
        v->shown.help = false;
    else if (v->picked.kind)
        v->picked = (selection) { 0 };
    else
        v->quits = true;
    v->layers_stale = true;
}

static void look_at_scene(viewer *v, action a)
{
    navigation *n = &v->navigation;
    switch (a) {
    case ACTION_FRAME_ALL: navigation_go_all(n, v->document.scene); break;
    case ACTION_FIRST_VIEW: navigation_go(n, &v->document.camera); break;
    case ACTION_FRONT:
    case ACTION_BACK:
    case ACTION_RIGHT:
    case ACTION_LEFT:
    case ACTION_TOP:
    case ACTION_BOTTOM: navigation_go_side(n, (navigation_side)(a - ACTION_FRONT)); break;
    default: navigation_set_orthographic(n, !n->orthographic); break;
    }
    viewer_redraw(v);
}

static void change_thing(viewer *v, action a)
{
    double step = a == ACTION_STRONGER || a == ACTION_LARGER ? 1 : -1;
    if (a == ACTION_STRONGER || a == ACTION_WEAKER)
        picking_strengthen(v, step);
    else
        picking_enlarge(v, step);
}

static void toggle_bloom(viewer *v)
{
    float *bloom = &v->document.look.bloom;
    *bloom = *bloom > 0 ? 0 : 0.05f;
    viewer_say(v, false, *bloom > 0 ? "bloom: %.0f %% of the light" : "bloom: off",
               100 * (double)*bloom);
    viewer_redraw(v);
}

void actions_do(viewer *v, action a)
{
    switch (a) {
    case ACTION_NONE:
    case ACTION_COUNT: break;
    case ACTION_FRAME_ALL:
    case ACTION_FIRST_VIEW:
    case ACTION_FRONT:
    case ACTION_BACK:
    case ACTION_RIGHT:
    case ACTION_LEFT:
    case ACTION_TOP:
    case ACTION_BOTTOM:
    case ACTION_ORTHOGRAPHIC:
        if (v->document.scene)
            look_at_scene(v, a);
        break;
    case ACTION_FRAME_PICKED: frame_picked(v); break;
    case ACTION_NEXT_CAMERA: next_camera(v); break;
    case ACTION_NEXT_LIGHT: picking_next_light(v); break;
    case ACTION_STRONGER:
    case ACTION_WEAKER:
    case ACTION_LARGER:
    case ACTION_SMALLER: change_thing(v, a); break;
    case ACTION_BRIGHTER: expose(v, exposure_step_ev); break;
    case ACTION_DARKER: expose(v, -exposure_step_ev); break;
    case ACTION_LOCK_EXPOSURE: lock_exposure(v); break;
    case ACTION_METERING: next_meter(v); break;
    case ACTION_BLOOM: toggle_bloom(v); break;
    case ACTION_TONE_CURVE: next_curve(v); break;
    case ACTION_REFERENCE: toggle_truth(v); break;
    case ACTION_SPLIT_LEFT: move_split(v, -split_step); break;
    case ACTION_SPLIT_RIGHT: move_split(v, split_step); break;
    case ACTION_HELP: v->shown.help = !v->shown.help; break;
    case ACTION_STATUS: v->shown.status = !v->shown.status; break;
    case ACTION_FULL_SCREEN: screen_toggle_full(v->screen); break;
    case ACTION_SCREENSHOT: v->shoots = v->document.scene; break;
    case ACTION_SAVE: begin_save(v); break;
    case ACTION_RELOAD: document_load(v, v->loading.input, true); break;
    case ACTION_ESCAPE: escape(v); break;
    case ACTION_QUIT: v->quits = true; break;
    }
    v->layers_stale = true;
}
