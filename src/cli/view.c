// argand view: the scene in a window.
#include "commands.h"
#include "shot.h"
#include "viewer/viewer.h"

#include <stdio.h>
#include <string.h>

typedef struct view_request {
    shot_request shot;
    uint32_t frames;
    bool exits;
} view_request;

typedef struct view {
    const view_request *request;
    console said;  // on the main thread
    console hears; // what loading says, on its way to the viewer
} view;

#define FIELD(member) offsetof(view_request, member)

static const option view_options[] = {
    { "--frames", NULL, "N", "100",
      "draw N pictures as fast as they come, and say how long they took", FIELD(frames),
      value_whole, NULL, 0 },
    { "--exit", NULL, NULL, "", "close the window after --frames", FIELD(exits), NULL, NULL, 0 },
    { 0 },
};

// Called by the viewer, for the file that was named or another one.
static ag_status open_document(void *user, const char *input, bool draft, const ag_log *log,
                               const ag_progress *progress, viewer_document *document)
{
    view *v = user;
    shot_request request = v->request->shot;
    request.input = input;
    request.draft = draft;
    if (strcmp(input, v->request->shot.input) != 0)
        request.camera = NULL; // that of another file
    console_relay(&v->hears, log, progress);
    shot s;
    ag_status status = shot_open(&s, &request, &v->hears);
    if (!status)
        status = shot_compose(&s, AG_FORMAT_RGBA8, &document->camera, &document->look);
    if (!status)
        status = ag_scene_bake(s.scene, progress);
    if (!status) {
        document->auto_exposure = request.eye.exposure.automatic;
        document->metering = request.eye.metering;
        document->scene = s.scene;
        s.scene = NULL;
    }
    shot_finish(&s);
    return status;
}

static void print_report(const view *v, const viewer_report *report)
{
    if (v->request->shot.json)
        printf("{\"frames\": %u, \"median_frame_ms\": %.2f, \"first_pixels_ms\": %.1f, "
               "\"scene_shown_ms\": %.1f, \"answer_frames\": %u}\n",
               report->frames, report->median_frame_ms, report->first_pixels_ms,
               report->scene_shown_ms, report->answer_frames);
    else if (report->frames && !v->request->shot.quiet)
        printf("%u frames, %.1f ms each; the first pixels after %.0f ms, the scene after %.0f ms\n",
               report->frames, report->median_frame_ms, report->first_pixels_ms,
               report->scene_shown_ms);
}

// False after one sentence; `*help` says that help was asked for instead.
static bool parse(view_request *request, int argc, char **argv, bool *help)
{
    *request = (view_request) { .shot = shot_request_default() };
    request->shot.size = (picture_size) { 1280, 720 };
    option_set set = {
        .command = &command_view,
        .fields = request,
        .operands = &request->shot.input,
        .operand_capacity = 1,
    };
    if (!options_parse(&set, argc, argv))
        return false;
    *help = set.help;
    if (!set.help && request->exits && !request->frames) {
        fputs("argand: view: --exit needs the --frames after which to close the window\n", stderr);
        return false;
    }
    return set.help || shot_request_settle(&request->shot, "view", false);
}

static ag_status look(view *v)
{
    const view_request *r = v->request;
    const ag_log log = console_log(&v->said);
    const viewer_setup setup = {
        .open = open_document,
        .user = v,
        .input = r->shot.input,
        .log = &log,
        .level = shot_log_level(&r->shot),
        .device = r->shot.device,
        .validate = r->shot.validate,
        .width = r->shot.size.width,
        .height = r->shot.size.height,
        .frames = r->frames,
        .exits = r->exits,
    };
    viewer_report report;
    ag_status status = viewer_run(&setup, &report);
    if (!status)
        print_report(v, &report);
    if (status || !r->shot.validate || !report.validation_messages)
        return status;
    console_say(&v->said, AG_LOG_ERROR, "The validation layer gave %u message%s",
                report.validation_messages, report.validation_messages == 1 ? "" : "s");
    return AG_ERROR_DEVICE;
}

static exit_code run(int argc, char **argv)
{
    view_request request;
    bool help;
    if (!parse(&request, argc, argv, &help))
        return EXIT_USAGE;
    if (help) {
        help_command(&command_view);
        return EXIT_DONE;
    }
    view v = { .request = &request };
    console_init(&v.said, shot_log_level(&request.shot), false);
    console_init(&v.hears, shot_log_level(&request.shot), false);
    ag_status status = look(&v);
    console_finish(&v.hears);
    console_finish(&v.said);
    return status ? EXIT_FAILED : EXIT_DONE;
}

const command command_view = {
    .name = "view",
    .operands = "FILE|demo:NAME",
    .about = "look at a scene in a window, change its lights, compare it with its ground truth",
    .lesson =
        "The picture is that of `argand render` with the same options; --size is the window's.\n"
        "Drag to turn, press ? for all keys; R traces the paths of light beside the picture.\n"
        "The file is read again when it changes, and another one when it is dropped on the\n"
        "window.  What was changed is saved as .glb by F5, in the folder that argand runs in.\n",
    .options = { view_options, shot_scene_options, shot_options, eye_options, shot_device_options },
    .more = lights_lesson,
    .examples = "  argand view helmet.glb\n"
                "      The whole model in the studio.\n"
                "  argand view room.glb --camera 0 --exposure auto\n"
                "      From the file's own camera, as bright as an eye would have it.\n"
                "  argand view demo:sphere-lights --frames 100 --exit\n"
                "      How long a frame takes here.\n",
    .run = run,
};
