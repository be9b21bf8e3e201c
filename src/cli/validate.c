// argand validate: scenes in real time and by the reference, and a page that shows the difference.
#include "commands.h"
#include "output.h"
#include "validation_report.h"

#include <stdio.h>
#include <stdlib.h>

enum { SCENES_MOST = 64 };

typedef struct validate_request {
    shot_request shot; // first: shot_options lead into it; its input is that of the scene at hand
    const char *inputs[SCENES_MOST];
    size_t count;
    uint32_t spp;                   // 0 -> 64, or as many as `seconds` and `noise` allow
    float seconds, noise, max_flip; // 0 = not given
} validate_request;

typedef struct work {
    validate_request *request;
    console console;
    ag_device *device;
    ag_renderer *renderer;
    validation scenes[SCENES_MOST];
    size_t done; // of the scenes
    char stage[48];
} work;

// ---- What is asked -------------------------------------------------------------

#define FIELD(member) offsetof(validate_request, member)

static const option options[] = {
    { "--output", "-o", "FOLDER", "report", "where index.html goes; made where it is not there",
      FIELD(shot.output), value_text, NULL, 0 },
    { "--spp", NULL, "N", "256", "samples a pixel of the reference (64)", FIELD(spp), value_samples,
      NULL, 0 },
    { "--time", NULL, "SECONDS", "60", "end each reference after as long, parts after an eighth",
      FIELD(seconds), value_seconds, NULL, 0 },
    { "--noise", NULL, "X", "0.01", "end where the estimated relative error is below X",
      FIELD(noise), value_noise, NULL, 0 },
    { "--max-flip", NULL, "X", "0.1", "fail, the page being written, where FLIP is above X",
      FIELD(max_flip), value_at_least_0, NULL, 0 },
    { 0 },
};

static bool refuse(const char *why)
{
    fprintf(stderr, "argand: validate: %s\n", why);
    return false;
}

// All inputs, before the first of them takes its time.
static bool settle(validate_request *r)
{
    if (!r->count)
        return refuse("which files? Try: argand validate model.glb -o report");
    if (!r->shot.output)
        return refuse("where should the report go? Add: -o report");
    for (size_t i = 0; i < r->count; i++) {
        r->shot.input = r->inputs[i];
        if (!shot_request_settle(&r->shot, "validate", true))
            return false;
    }
    return true;
}

static bool parse(validate_request *r, int argc, char **argv, bool *help)
{
    *r = (validate_request) { .shot = shot_request_default() };
    option_set set = {
        .command = &command_validate,
        .fields = r,
        .operands = r->inputs,
        .operand_capacity = SCENES_MOST,
    };
    if (!options_parse(&set, argc, argv))
        return false;
    *help = set.help;
    r->count = set.operand_count;
    return set.help || settle(r);
}

// ---- Work ----------------------------------------------------------------------

static bool update(void *user, const char *stage, double fraction)
{
    work *w = user;
    (void)stage;
    console_stage_detail(&w->console, w->stage,
                         ((double)w->done + fraction) / (double)w->request->count,
                         w->request->shot.input);
    return true;
}

static ag_status open_device(work *w)
{
    const ag_log log = console_log(&w->console);
    const ag_device_desc desc = {
        .log = &log,
        .select = w->request->shot.device,
        .validate = w->request->shot.validate,
    };
    ag_status status = ag_device_create(&desc, &w->device);
    return status ? status : ag_renderer_create(w->device, &w->renderer);
}

static ag_status make_scene(work *w)
{
    validate_request *r = w->request;
    const ag_reference_goal goal = {
        .samples = r->spp || r->seconds > 0 || r->noise > 0 ? r->spp : 64,
        .seconds = (double)r->seconds,
        .noise = r->noise,
    };
    shot s;
    r->shot.input = r->inputs[w->done];
    snprintf(w->stage, sizeof w->stage, "%zu of %zu", w->done + 1, r->count);
    ag_status status = shot_open(&s, &r->shot, &w->console);
    if (!status)
        status = validation_make(&w->scenes[w->done], &s, w->renderer, &goal,
                                 (ag_progress) { .update = update, .user = w });
    shot_finish(&s);
    return status;
}

static ag_status write_page(work *w, const validation_report *report)
{
    char *page = NULL;
    size_t size;
    ag_status status = AG_ERROR_MEMORY;
    console_stage(&w->console, "write", 1);
    if (validation_report_page(report, &page, &size))
        status = output_write_page(&w->console, w->request->shot.output, page, size);
    else
        console_say(&w->console, AG_LOG_ERROR, "There is no memory for the page");
    free(page);
    console_clear(&w->console);
    return status;
}

static ag_status check_limits(work *w)
{
    uint32_t messages = ag_device_validation_messages(w->device);
    size_t above = 0, first = 0;
    for (size_t i = w->done; i-- > 0;)
        if (w->request->max_flip > 0 && w->scenes[i].coded.flip > w->request->max_flip) {
            above++;
            first = i;
        }
    if (above)
        console_say(&w->console, AG_LOG_ERROR, "FLIP is above %g in %zu of %zu scenes: %s, %.4f",
                    (double)w->request->max_flip, above, w->done, w->scenes[first].input,
                    (double)w->scenes[first].coded.flip);
    else if (messages && w->request->shot.validate)
        console_say(&w->console, AG_LOG_ERROR,
                    "The report is written, but the validation layer gave %u message%s", messages,
                    messages == 1 ? "" : "s");
    return above || (messages && w->request->shot.validate) ? AG_ERROR_DEVICE : AG_OK;
}

static ag_status make_report(work *w, double start)
{
    ag_status status = open_device(w);
    for (; w->done < w->request->count && !status; w->done += status == AG_OK)
        status = make_scene(w);
    if (status)
        return status;
    validation_report report = {
        .scenes = w->scenes,
        .count = w->done,
        .device = ag_device_describe(w->device)->name,
        .max_flip = w->request->max_flip,
        .total_ms = now_ms() - start,
    };
    status = write_page(w, &report);
    if (status)
        return status;
    validation_report_print(&report, &w->request->shot);
    return check_limits(w);
}

static void tear_down(work *w)
{
    console_clear(&w->console);
    for (size_t i = 0; i < w->request->count; i++)
        validation_finish(&w->scenes[i]);
    ag_renderer_destroy(w->renderer);
    ag_device_destroy(w->device);
    console_finish(&w->console);
}

static exit_code run(int argc, char **argv)
{
    double start = now_ms();
    validate_request request;
    bool help;
    if (!parse(&request, argc, argv, &help))
        return EXIT_USAGE;
    if (help) {
        help_command(&command_validate);
        return EXIT_DONE;
    }
    work w = { .request = &request };
    console_init(&w.console, shot_log_level(&request.shot), false);
    if (!request.shot.quiet)
        console_allow_bar(&w.console);
    bool done = output_check_folder(&w.console, request.shot.output) && !make_report(&w, start);
    tear_down(&w);
    return done ? EXIT_DONE : EXIT_FAILED;
}

const command command_validate = {
    .name = "validate",
    .operands = "FILE|demo:NAME... -o FOLDER",
    .about = "show how far real time is from the reference, and why",
    .lesson =
        "Makes each scene as `argand render` and as `argand reference` do, and writes one page,\n"
        "FOLDER/index.html, to look through in a browser: both pictures under a slider, the map\n"
        "of the error, the numbers, and the error by cause: each light, the environment, what\n"
        "glows, shadows and light between surfaces, each alone in both pictures, of 512 pixels\n"
        "at most.  The page is one file and needs no network; `?` tells its keys.\n"
        "The page appears whole or not at all, when all scenes are done.\n",
    .options = { options, shot_scene_options, shot_options, eye_options, shot_device_options },
    .more = lights_lesson,
    .examples =
        "  argand validate helmet.glb --env workshop.hdr -o report\n"
        "      64 samples a pixel; open report/index.html.\n"
        "  argand validate demo:spheres demo:grid demo:lights -o report --spp 256\n"
        "      Three scenes, with less noise.\n"
        "  argand validate chair.gltf -o report --max-flip 0.08 --json\n"
        "      For a machine: numbers on standard output, and exit code 1 above the limit.\n",
    .run = run,
};
