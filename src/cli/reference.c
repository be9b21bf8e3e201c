// argand reference: the same picture, path traced.
#include "commands.h"
#include "expose.h"
#include "notes.h"
#include "output.h"
#include "reference_report.h"
#include "shot.h"

enum { AOV_COUNT = AG_AOV_INDIRECT + 1 };

typedef struct work {
    const reference_request *request;
    console console;
    ag_format format;
    shot shot;
    ag_image *picture;
    ag_image *aovs[AOV_COUNT]; // those that are wanted
    reference_report report;   // and the reference itself
} work;

static ag_status trace(work *w)
{
    const reference_request *r = w->request;
    ag_camera_desc camera;
    ag_render_options picture;
    ag_status status = shot_compose(&w->shot, w->format, &camera, &picture);
    if (status)
        return status;
    picture.parts = r->parts;
    ag_reference_options options = {
        .max_bounces = r->max_bounces,
        .direct_only = r->bounces_given && r->max_bounces == 0,
        .unshadowed = r->unshadowed,
        .clamp = r->clamp,
        .seed = r->seed,
        .keep_aovs = r->aovs != 0,
        .estimator = (ag_estimator)r->estimator,
    };
    ag_reference_goal goal = {
        .samples = r->spp,
        .seconds = (double)r->seconds,
        .noise = r->noise,
    };
    status = expose(&w->shot, NULL, &camera, &options, &picture);
    w->report.exposure = picture.exposure;
    if (status)
        return status;
    return tracing_run(&w->report.tracing, &w->console, w->shot.scene, &camera, &picture, &options,
                       &goal);
}

static ag_status collect(work *w)
{
    const ag_reference *reference = w->report.tracing.reference;
    ag_status status = ag_reference_picture(reference, &w->picture);
    for (int aov = 0; aov < AOV_COUNT && !status; aov++)
        if (w->request->aovs >> aov & 1)
            status = ag_reference_aov(reference, (ag_aov)aov, &w->aovs[aov]);
    return status;
}

// The picture without a name, and what else is known under its own.
static size_t list_layers(const work *w, ag_image_layer layers[AOV_COUNT + 1])
{
    static const ag_image_layer named[AOV_COUNT] = {
        [AG_AOV_ALBEDO] = { "albedo", NULL, "RGB" },
        [AG_AOV_NORMAL] = { "normal", NULL, "XYZ" },
        [AG_AOV_DEPTH] = { "depth", NULL, "Z" },
        [AG_AOV_DIRECT] = { "direct", NULL, "RGB" },
        [AG_AOV_INDIRECT] = { "indirect", NULL, "RGB" },
    };
    size_t count = 0;
    layers[count++] = (ag_image_layer) { .image = w->picture };
    for (int aov = 0; aov < AOV_COUNT; aov++)
        if (w->aovs[aov]) {
            layers[count] = named[aov];
            layers[count++].image = w->aovs[aov];
        }
    return count;
}

static ag_status save(work *w)
{
    console_stage(&w->console, "encode", 0);
    double start = now_ms();
    ag_image_layer layers[AOV_COUNT + 1];
    size_t count = list_layers(w, layers);
    const char *path = w->request->shot.output;
    notes said;
    ag_image_save_options save = notes_of_picture(&said, &w->request->shot.eye, w->report.exposure);
    ag_status status = count > 1 ? output_save_layers(&w->console, layers, count, &save, path)
                                 : output_save(&w->console, w->picture, &save, path);
    w->report.encode_ms = now_ms() - start;
    return status;
}

static ag_status make_picture(work *w, double start)
{
    ag_status status = shot_open(&w->shot, &w->request->shot, &w->console);
    w->report.environment_ms = w->shot.reading.ms;
    if (!status)
        status = trace(w);
    if (!status)
        status = collect(w);
    if (!status)
        status = save(w);
    console_clear(&w->console);
    if (status)
        return status;
    w->report.total_ms = now_ms() - start;
    w->report.scene = ag_scene_summarize(w->shot.scene);
    reference_report_print(&w->report, w->request);
    return AG_OK;
}

static void tear_down(work *w)
{
    for (int aov = 0; aov < AOV_COUNT; aov++)
        ag_image_destroy(w->aovs[aov]);
    ag_image_destroy(w->picture);
    tracing_finish(&w->report.tracing);
    shot_finish(&w->shot);
    console_finish(&w->console);
}

static exit_code run(int argc, char **argv)
{
    double start = now_ms();
    reference_request request;
    bool help;
    if (!reference_request_parse(&request, argc, argv, &help))
        return EXIT_USAGE;
    if (help) {
        help_command(&command_reference);
        return EXIT_DONE;
    }
    work w = { .request = &request };
    console_init(&w.console, shot_log_level(&request.shot), false);
    if (!request.shot.quiet)
        console_allow_bar(&w.console);
    output_verdict verdict = output_check(&w.console, request.shot.output, &w.format);
    ag_status status = verdict == OUTPUT_FINE ? make_picture(&w, start) : AG_OK;
    tear_down(&w);
    if (verdict == OUTPUT_UNKNOWN_KIND)
        return EXIT_USAGE;
    return verdict == OUTPUT_FINE && !status ? EXIT_DONE : EXIT_FAILED;
}

const command command_reference = {
    .name = "reference",
    .operands = "FILE|demo:NAME -o PICTURE",
    .about = "make the same picture by path tracing, on the processor",
    .lesson =
        "What `argand render` approximates is computed here by following light: shadows, light\n"
        "between surfaces, lights of any extent, the environment.  Scene, camera, environment,\n"
        "lights and look are those of `argand render`; no Vulkan device is needed.\n"
        "The picture is noisy, half as much with four times as many samples.  It ends at 64\n"
        "samples a pixel, or at the first of --spp, --time and --noise that are given.\n"
        "Ctrl-C ends it too, and the picture is written with what has been gathered; a second\n"
        "one ends at once.  The same --seed gives the same bytes on any number of cores.\n",
    .options = { reference_options, shot_scene_options, shot_options, eye_options },
    .more = lights_lesson,
    .examples = "  argand reference helmet.glb -o helmet.png\n"
                "      64 samples a pixel.\n"
                "  argand reference helmet.glb -o helmet.png --noise 0.01 --time 600\n"
                "      Until the noise is below 1 %, and no longer than ten minutes.\n"
                "  argand reference helmet.glb -o helmet.exr --spp 256 --aov albedo,normal,depth\n"
                "      One OpenEXR file with the picture and three layers, for a denoiser say.\n"
                "  argand reference demo:spheres -o direct.png --max-bounces 0 --unshadowed\n"
                "      As `argand render` sees it: straight from the lights, without shadows.\n",
    .run = run,
};
