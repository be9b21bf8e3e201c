// argand render: from a file to a picture.
//
// The device opens on a second thread and the environment's file is read on a third while
// the scene loads, so that the wall time is the longest of the three.
#include "commands.h"
#include "output.h"
#include "render_report.h"
#include "task.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct work {
    const render_request *request;
    console console;
    ag_log log;
    ag_format format;
    ag_scene *scene;
    task opening, reading; // the two threads beside the loading
    ag_device *device;     // made by `opening`
    ag_renderer *renderer; // made by `opening`
    ag_image *environment; // made by `reading`
    ag_image *picture;
    render_report report;
} work;

static ag_status open_device(void *context, const ag_log *log)
{
    work *w = context;
    ag_device_desc desc = {
        .log = log,
        .select = w->request->device,
        .validate = w->request->validate,
    };
    ag_status status = ag_device_create(&desc, &w->device);
    return status ? status : ag_renderer_create(w->device, &w->renderer);
}

static ag_status read_environment(void *context, const ag_log *log)
{
    work *w = context;
    return ag_image_load(log, w->request->environment.path, &w->environment);
}

static ag_status load_scene(work *w)
{
    const char *input = w->request->input;
    ag_status status = ag_scene_create(&w->log, &w->scene);
    if (status)
        return status;
    if (strncmp(input, "demo:", 5) == 0)
        return ag_scene_load_demo(w->scene, input + 5,
                                  w->request->correct ? AG_LOOK_ARGAND : AG_LOOK_TEXT);
    ag_load_options options = { .progress = console_progress(&w->console) };
    return ag_scene_load(w->scene, input, &options);
}

static ag_status add_lights(work *w)
{
    const light_list *list = &w->request->lights;
    ag_light light;
    ag_status status = AG_OK;
    for (size_t i = 0; i < list->count && !status; i++)
        status = ag_scene_add_light(w->scene, &list->lights[i], &light);
    return status;
}

static ag_status set_environment(work *w)
{
    const render_request *r = w->request;
    if (!r->environment_given)
        return AG_OK; // the studio, or what a built-in scene brought along
    if (r->environment.kind == AG_ENVIRONMENT_IMAGE &&
        ag_image_format(w->environment) != AG_FORMAT_RGBA32F) {
        console_say(&w->console, AG_LOG_ERROR,
                    "%s: holds a picture, not measured light; --env needs a Radiance .hdr or "
                    "OpenEXR .exr file",
                    r->environment.path);
        return AG_ERROR_FORMAT;
    }
    ag_environment_desc desc = {
        .kind = r->environment.kind,
        .image = w->environment,
        .rotation_rad = r->environment_rotation_rad,
        .intensity = r->environment_intensity,
    };
    ag_status status = ag_scene_set_environment(w->scene, &desc);
    ag_image_destroy(w->environment); // the scene has a copy
    w->environment = NULL;
    return status;
}

// Everything that the renderer needs, made side by side.
static ag_status prepare(work *w)
{
    ag_log_level level = w->console.level;
    console_stage(&w->console, "load", 0);
    task_start(&w->opening, level, open_device, w);
    if (w->request->environment.path)
        task_start(&w->reading, level, read_environment, w);
    ag_status loaded = load_scene(w);
    ag_status read = task_join(&w->reading, &w->console);
    ag_status opened = task_join(&w->opening, &w->console);
    w->report.device_ms = w->opening.ms;
    w->report.environment_ms = w->reading.ms;
    ag_status status = loaded ? loaded : read ? read : opened ? opened : set_environment(w);
    if (!status)
        status = add_lights(w);
    // The scene is drawn once: its images need not be in memory twice.
    return status ? status : ag_renderer_take(w->renderer, w->scene, &w->report.take_ms);
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

static ag_status no_camera(work *w)
{
    char list[512] = "";
    size_t used = 0, count = 0;
    ag_camera_desc camera;
    for (; ag_scene_camera(w->scene, count, &camera); count++) {
        if (used >= sizeof list)
            continue;
        const char *name = camera.name ? camera.name : "without a name";
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%zu (%s)", count ? ", " : "",
                                 count, name);
    }
    const char *file = w->request->input, *wanted = w->request->camera;
    if (count)
        console_say(&w->console, AG_LOG_ERROR, "%s: has no camera '%s'; it has %s", file, wanted,
                    list);
    else
        console_say(&w->console, AG_LOG_ERROR,
                    "%s: has no cameras; leave --camera out, or place one with --orbit", file);
    return AG_ERROR_ARGUMENT;
}

static ag_status choose_camera(work *w, ag_camera_desc *camera)
{
    const render_request *r = w->request;
    bool placed = r->orbit_given || r->target_given;
    // A built-in scene is seen as it was composed unless asked otherwise.
    bool composed = !placed && strncmp(r->input, "demo:", 5) == 0;
    if (r->camera) {
        if (!find_camera(w->scene, r->camera, camera))
            return no_camera(w);
    } else if (!composed || !ag_scene_camera(w->scene, 0, camera)) {
        ag_orbit orbit = {
            .theta_rad = r->orbit[0],
            .phi_rad = r->orbit[1],
            .radius_m = r->orbit[2],
            .target = { r->target[0], r->target[1], r->target[2] },
            .fov_y_rad = r->fov_rad,
        };
        float aspect = (float)r->size.width / (float)r->size.height;
        *camera = ag_scene_frame(w->scene, &orbit, aspect);
    }
    if (r->fov_rad > 0) {
        camera->fov_y_rad = r->fov_rad;
        camera->height_m = 0;
    }
    return AG_OK;
}

// A built-in scene's own look, and what was asked for before it.
static void set_look(const render_request *r, ag_render_options *options)
{
    if (!r->correct && strncmp(r->input, "demo:", 5) == 0)
        ag_demo_look(r->input + 5, options);
    if (r->tonemap_given)
        options->tonemap = (ag_tonemap)r->tonemap;
    if (r->transfer_given)
        options->transfer = (ag_transfer)r->transfer;
}

static ag_status render(work *w)
{
    const render_request *r = w->request;
    ag_camera_desc camera;
    ag_status status = choose_camera(w, &camera);
    if (status)
        return status;
    ag_render_options options = {
        .width = r->size.width,
        .height = r->size.height,
        .format = w->format,
        .quality = (ag_quality)r->quality,
        .area_lights = (ag_area_lights)r->area_lights,
        .background = r->background.kind,
        .exposure = r->exposure,
        .progress = console_progress(&w->console),
    };
    set_look(r, &options);
    memcpy(options.background_color, r->background.color, sizeof options.background_color);
    return ag_renderer_render(w->renderer, w->scene, &camera, &options, &w->picture,
                              &w->report.stats);
}

static ag_status save(work *w)
{
    console_stage(&w->console, "encode", 0);
    double start = now_ms();
    ag_status status = output_save(&w->console, w->picture, w->request->output);
    w->report.encode_ms = now_ms() - start;
    return status;
}

static ag_status check_validation(work *w)
{
    uint32_t count = ag_device_validation_messages(w->device);
    w->report.validation_messages = count;
    if (!w->request->validate || count == 0)
        return AG_OK;
    console_say(&w->console, AG_LOG_ERROR,
                "The picture is written, but the validation layer gave %u message%s", count,
                count == 1 ? "" : "s");
    return AG_ERROR_DEVICE;
}

static void tear_down(work *w)
{
    ag_image_destroy(w->picture);
    ag_image_destroy(w->environment);
    ag_renderer_destroy(w->renderer);
    ag_device_destroy(w->device);
    ag_scene_destroy(w->scene);
    task_finish(&w->reading);
    task_finish(&w->opening);
    console_finish(&w->console);
}

static ag_status make_picture(work *w, double start)
{
    ag_status status = prepare(w);
    if (!status)
        status = render(w);
    if (!status)
        status = save(w);
    console_clear(&w->console);
    if (status)
        return status;
    w->report.total_ms = now_ms() - start;
    w->report.scene = ag_scene_summarize(w->scene);
    w->report.device = *ag_device_describe(w->device);
    status = check_validation(w);
    render_report_print(&w->report, w->request);
    return status;
}

static exit_code run(int argc, char **argv)
{
    double start = now_ms();
    render_request request;
    bool help;
    if (!render_request_parse(&request, argc, argv, &help))
        return EXIT_USAGE;
    if (help) {
        help_command(&command_render);
        return EXIT_DONE;
    }
    work w = { .request = &request };
    ag_log_level level = request.verbose ? AG_LOG_DEBUG
                         : request.quiet ? AG_LOG_ERROR
                                         : AG_LOG_WARNING;
    console_init(&w.console, level, false);
    w.log = console_log(&w.console);
    if (!request.quiet)
        console_allow_bar(&w.console);
    output_verdict verdict = output_check(&w.console, request.output, &w.format);
    ag_status status = AG_OK;
    if (verdict == OUTPUT_FINE)
        status = make_picture(&w, start);
    tear_down(&w);
    if (verdict == OUTPUT_UNKNOWN_KIND)
        return EXIT_USAGE;
    return verdict == OUTPUT_FINE && !status ? EXIT_DONE : EXIT_FAILED;
}

const command command_render = {
    .name = "render",
    .operands = "FILE|demo:NAME -o PICTURE",
    .about = "make a picture of a glTF file or of a built-in scene",
    .lesson =
        "FILE is a glTF 2.0 file, .gltf with its files or .glb.  Without --camera the scene is\n"
        "framed automatically, from three quarters and slightly above; a built-in scene is\n"
        "seen from its own camera.  Without --env a procedural studio with soft boxes lights\n"
        "it, or what a built-in scene brings along; its own lights and those of --light always\n"
        "shine.  The picture appears whole or not at all.\n"
        "In .exr and .hdr it is linear light times the exposure, without a tone curve.\n",
    .options = render_options,
    .more = lights_lesson,
    .examples = "  argand render helmet.glb -o helmet.png\n"
                "      The whole model in the studio, 1024x1024 pixels.\n"
                "  argand render helmet.glb -o helmet.png --env workshop.hdr --size 1920x1080\n"
                "      Lit by a photograph of a place, which is also seen behind it.\n"
                "  argand render chair.gltf -o chair.webp --background transparent --quality best\n"
                "      Cut out for a page, with the cleanest edges.\n"
                "  argand render chair.gltf -o side.png --orbit 90,80,auto --fov 30\n"
                "      From +X, ten degrees above the horizon, as far away as it takes.\n"
                "  argand render lamp.glb -o lamp.exr --env none --ev100 8\n"
                "      Only the file's own lights, as linear floats for further work.\n"
                "  argand render chair.gltf -o lit.png --env none \\\n"
                "      --light 'sphere at=1,2,1 radius=0.2 intensity=20 color=1,.9,.8' \\\n"
                "      --light 'rect at=-2,1,0 to=0,0,0 width=1 height=2 intensity=3'\n"
                "      Under a warm lamp and a panel that faces the origin.\n",
    .run = run,
};
