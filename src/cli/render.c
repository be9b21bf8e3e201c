// argand render: from a file to a picture, where there is no device by path tracing.
//
// The device opens on a second thread while the scene loads (on a third the environment's
// file is read), so that the wall time is the longest of them.
#include "commands.h"
#include "expose.h"
#include "notes.h"
#include "output.h"
#include "render_report.h"
#include "shot.h"
#include "tracing.h"

#include <stdio.h>
#include <string.h>

typedef struct work {
    const shot_request *request;
    console console;
    ag_format format;
    shot shot;
    task opening;          // beside the loading
    ag_device *device;     // made by `opening`
    ag_renderer *renderer; // made by `opening`, or
    tracing tracing;       // where there is no device
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

// Does nothing on this machine suit "auto"?
static bool lacks_device(work *w)
{
    return task_wait(&w->opening) == AG_ERROR_DEVICE && strcmp(w->request->device, "auto") == 0 &&
           !w->request->validate;
}

// Everything that the picture needs, made side by side.
static ag_status prepare(work *w)
{
    task_start(&w->opening, w->console.level, open_device, w);
    ag_status status = shot_open(&w->shot, w->request, &w->console);
    ag_status opened = lacks_device(w) ? AG_OK : task_join(&w->opening, &w->console);
    w->report.device_ms = w->opening.ms;
    w->report.environment_ms = w->shot.reading.ms;
    if (status || opened)
        return status ? status : opened;
    // The scene is drawn once: its images need not be in memory twice.
    return w->renderer ? ag_renderer_take(w->renderer, w->shot.scene, &w->report.take_ms) : AG_OK;
}

static const char *why_no_device(const work *w)
{
    const console *said = &w->opening.console;
    for (size_t i = 0; i < said->kept_count; i++)
        if (said->kept[i].level == AG_LOG_ERROR)
            return said->kept[i].text;
    return "there is no Vulkan device";
}

static ag_status trace(work *w, const ag_camera_desc *camera, const ag_render_options *options)
{
    static const uint32_t samples[] = {
        [AG_QUALITY_FAST] = 16,
        [AG_QUALITY_DEFAULT] = 64,
        [AG_QUALITY_BEST] = 256,
    };
    ag_reference_goal goal = { .samples = samples[options->quality] };
    console_say(&w->console, AG_LOG_WARNING,
                "%s; the picture is path traced instead, with %u samples a pixel", why_no_device(w),
                goal.samples);
    ag_status status =
        tracing_run(&w->tracing, &w->console, w->shot.scene, camera, options, NULL, &goal);
    return status ? status : ag_reference_picture(w->tracing.reference, &w->picture);
}

static ag_status render(work *w)
{
    ag_camera_desc camera;
    ag_render_options options;
    ag_status status = shot_compose(&w->shot, w->format, &camera, &options);
    if (!status)
        status = expose(&w->shot, w->renderer, &camera, NULL, &options);
    if (status)
        return status;
    w->report.exposure = options.exposure;
    return w->renderer ? ag_renderer_render(w->renderer, w->shot.scene, &camera, &options,
                                            &w->picture, &w->report.stats)
                       : trace(w, &camera, &options);
}

static ag_status save(work *w)
{
    console_stage(&w->console, "encode", 0);
    double start = now_ms();
    notes said;
    ag_image_save_options save = notes_of_picture(&said, &w->request->eye, w->report.exposure);
    ag_status status = output_save(&w->console, w->picture, &save, w->request->output);
    w->report.encode_ms = now_ms() - start;
    return status;
}

static ag_status check_validation(work *w)
{
    uint32_t count = w->device ? ag_device_validation_messages(w->device) : 0;
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
    tracing_finish(&w->tracing);
    ag_renderer_destroy(w->renderer);
    ag_device_destroy(w->device);
    shot_finish(&w->shot);
    task_finish(&w->opening);
    console_finish(&w->console);
}

// What stands for a device and its figures where a picture was path traced.
static void report_tracing(render_report *report, const ag_reference_state *state)
{
    snprintf(report->device.name, sizeof report->device.name, "path tracer");
    report->device.kind = AG_DEVICE_CPU;
    report->stats.samples = state->samples;
    report->stats.bake_ms = state->prepare_ms;
    report->stats.frame_ms = state->trace_ms;
    report->stats.triangles = report->scene.triangles;
    report->stats.instances = (uint32_t)report->scene.instances;
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
    w->report.scene = ag_scene_summarize(w->shot.scene);
    if (w->renderer)
        w->report.device = *ag_device_describe(w->device);
    else
        report_tracing(&w->report, &w->tracing.state);
    status = check_validation(w);
    render_report_print(&w->report, w->request);
    return status;
}

static const option options[] = {
    { "--output", "-o", "FILE", "picture.png", "where the picture goes: .png .jpg .webp .exr .hdr",
      offsetof(shot_request, output), value_text, NULL, 0 },
    { 0 },
};

// False after one sentence; `*help` says that help was asked for instead.
static bool parse(shot_request *request, int argc, char **argv, bool *help)
{
    *request = shot_request_default();
    option_set set = {
        .command = &command_render,
        .fields = request,
        .operands = &request->input,
        .operand_capacity = 1,
    };
    if (!options_parse(&set, argc, argv))
        return false;
    *help = set.help;
    return set.help || shot_request_settle(request, "render", true);
}

static exit_code run(int argc, char **argv)
{
    double start = now_ms();
    shot_request request;
    bool help;
    if (!parse(&request, argc, argv, &help))
        return EXIT_USAGE;
    if (help) {
        help_command(&command_render);
        return EXIT_DONE;
    }
    work w = { .request = &request };
    console_init(&w.console, shot_log_level(&request), false);
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
        "it, or what the scene brings along; its own lights and those of --light always\n"
        "shine.  The picture appears whole or not at all.\n"
        "In .exr and .hdr it is linear light times the exposure, without a tone curve.\n"
        "Where there is no Vulkan device it is path traced, as by `argand reference`.\n",
    .options = { options, shot_scene_options, shot_options, eye_options, shot_device_options },
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
