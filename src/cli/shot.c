// From a request to a scene, a camera and a look.
//
// The environment's file is read on a second thread while the scene loads.
#include "shot.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static ag_status read_environment(void *context, const ag_log *log)
{
    shot *s = context;
    return ag_image_load(log, s->request->environment.path, &s->environment);
}

static ag_status load_scene(shot *s)
{
    const char *input = s->request->input;
    ag_status status = ag_scene_create(&s->log, &s->scene);
    if (status)
        return status;
    if (strncmp(input, "demo:", 5) == 0)
        return ag_scene_load_demo(s->scene, input + 5,
                                  s->request->correct ? AG_LOOK_ARGAND : AG_LOOK_TEXT);
    ag_load_options options = { .progress = console_progress(s->console),
                                .skip_images = s->request->draft };
    return ag_scene_load(s->scene, input, &options);
}

static ag_status add_lights(shot *s)
{
    const light_list *list = &s->request->lights;
    ag_light light;
    ag_status status = AG_OK;
    for (size_t i = 0; i < list->count && !status; i++)
        status = ag_scene_add_light(s->scene, &list->lights[i], &light);
    return status;
}

static ag_status set_environment(shot *s)
{
    const shot_request *r = s->request;
    if (!r->environment_given)
        return AG_OK; // the studio, or what a built-in scene brought along
    if (r->environment.kind == AG_ENVIRONMENT_IMAGE &&
        ag_image_format(s->environment) != AG_FORMAT_RGBA32F) {
        console_say(s->console, AG_LOG_ERROR,
                    "%s: holds a picture, not measured light; --env needs a Radiance .hdr or "
                    "OpenEXR .exr file",
                    r->environment.path);
        return AG_ERROR_FORMAT;
    }
    ag_environment_desc desc = {
        .kind = r->environment.kind,
        .image = s->environment,
        .rotation_rad = r->environment_rotation_rad,
        .intensity = r->environment_intensity,
    };
    ag_status status = ag_scene_set_environment(s->scene, &desc);
    ag_image_destroy(s->environment); // the scene has a copy
    s->environment = NULL;
    return status;
}

ag_status shot_open(shot *s, const shot_request *request, console *shown)
{
    *s = (shot) { .request = request, .console = shown, .log = console_log(shown) };
    console_stage(shown, "load", 0);
    if (request->environment.path)
        task_start(&s->reading, shown->level, read_environment, s);
    ag_status loaded = load_scene(s);
    ag_status read = task_join(&s->reading, shown);
    ag_status status = loaded ? loaded : read ? read : set_environment(s);
    return status ? status : add_lights(s);
}

void shot_finish(shot *s)
{
    ag_image_destroy(s->environment);
    ag_scene_destroy(s->scene);
    task_finish(&s->reading);
}

// The camera of this name, else of this index.
static bool find_camera(const ag_scene *scene, const char *wanted, ag_camera_desc *camera)
{
    for (size_t i = 0; ag_scene_camera(scene, i, camera); i++)
        if (camera->name && strcmp(camera->name, wanted) == 0)
            return true;
    uint32_t index;
    return value_index(wanted, &index) && ag_scene_camera(scene, index, camera);
}

static ag_status no_camera(shot *s)
{
    char list[512] = "";
    size_t used = 0, count = 0;
    ag_camera_desc camera;
    for (; ag_scene_camera(s->scene, count, &camera); count++) {
        if (used >= sizeof list)
            continue;
        const char *name = camera.name ? camera.name : "without a name";
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%zu (%s)", count ? ", " : "",
                                 count, name);
    }
    const char *file = s->request->input, *wanted = s->request->camera;
    if (count)
        console_say(s->console, AG_LOG_ERROR, "%s: has no camera '%s'; it has %s", file, wanted,
                    list);
    else
        console_say(s->console, AG_LOG_ERROR,
                    "%s: has no cameras; leave --camera out, or place one with --orbit", file);
    return AG_ERROR_ARGUMENT;
}

static ag_status choose_camera(shot *s, ag_camera_desc *camera)
{
    const shot_request *r = s->request;
    bool placed = r->orbit_given || r->target_given;
    // A built-in scene is seen as it was composed unless asked otherwise.
    bool composed = !placed && strncmp(r->input, "demo:", 5) == 0;
    if (r->camera) {
        if (!find_camera(s->scene, r->camera, camera))
            return no_camera(s);
    } else if (!composed || !ag_scene_camera(s->scene, 0, camera)) {
        ag_orbit orbit = {
            .theta_rad = r->orbit[0],
            .phi_rad = r->orbit[1],
            .radius_m = r->orbit[2],
            .target = { r->target[0], r->target[1], r->target[2] },
            .fov_y_rad = r->fov_rad,
        };
        float aspect = (float)r->size.width / (float)r->size.height;
        *camera = ag_scene_frame(s->scene, &orbit, aspect);
    }
    if (r->fov_rad > 0) {
        camera->fov_y_rad = r->fov_rad;
        camera->height_m = 0;
    }
    return AG_OK;
}

// A built-in scene's own look, and what was asked for before it.
static void set_look(const shot_request *r, ag_render_options *options)
{
    if (!r->correct && strncmp(r->input, "demo:", 5) == 0)
        ag_demo_look(r->input + 5, options);
    if (r->tonemap_given)
        options->tonemap = (ag_tonemap)r->tonemap;
    if (r->transfer_given)
        options->transfer = (ag_transfer)r->transfer;
}

// As it is asked for, or the scene's own.
static float set_exposure(const shot *s)
{
    const eye_request *e = &s->request->eye;
    float factor = e->exposure.factor > 0 ? e->exposure.factor : ag_scene_exposure(s->scene);
    return factor * exp2f(e->metering.compensation_ev);
}

ag_status shot_compose(shot *s, ag_format format, ag_camera_desc *camera,
                       ag_render_options *options)
{
    const shot_request *r = s->request;
    *options = (ag_render_options) {
        .width = r->size.width,
        .height = r->size.height,
        .format = format,
        .quality = (ag_quality)r->quality,
        .area_lights = (ag_area_lights)r->area_lights,
        .background = r->background.kind,
        .exposure = set_exposure(s),
        .white_balance_k = r->eye.white_balance[0],
        .white_balance_tint = r->eye.white_balance[1],
        .bloom = r->bloom,
        .progress = console_progress(s->console),
    };
    set_look(r, options);
    memcpy(options->background_color, r->background.color, sizeof options->background_color);
    return choose_camera(s, camera);
}
