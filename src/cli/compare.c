// argand compare: how far apart two pictures are.
#include "commands.h"
#include "json.h"
#include "notes.h"
#include "output.h"
#include "values.h"

#include <math.h>
#include <stdio.h>

typedef struct compare_request {
    const char *pictures[2]; // the reference first
    const char *output;      // or NULL
    float max_flip, pixels_per_degree;
    bool max_given, json;
} compare_request;

static const char *read_ppd(const char *value, void *field)
{
    const char *complaint = value_factor(value, field);
    if (complaint)
        return complaint;
    float ppd = *(float *)field;
    return ppd >= 10 && ppd <= 500 ? NULL : "is not between 10 and 500";
}

#define FIELD(member) offsetof(compare_request, member)

static const option options[] = {
    { "--output", "-o", "FILE", "heat.png", "the error map: black is alike, pale yellow is not",
      FIELD(output), value_text, NULL, 0 },
    { "--max-flip", NULL, "X", "0.05", "fail when the mean FLIP is above", FIELD(max_flip),
      value_at_least_0, NULL, FIELD(max_given) },
    { "--ppd", NULL, "N", "67", "pixels per degree of visual angle (67.02)",
      FIELD(pixels_per_degree), read_ppd, NULL, 0 },
    { "--json", NULL, NULL, "", "print one JSON object", FIELD(json), NULL, NULL, 0 },
    { 0 },
};

typedef struct work {
    const compare_request *request;
    console console;
    ag_image *pictures[2], *heat;
    ag_difference difference;
} work;

static ag_status load(work *w)
{
    ag_log log = console_log(&w->console);
    ag_status status = AG_OK;
    for (int i = 0; i < 2 && !status; i++)
        status = ag_image_load(&log, w->request->pictures[i], &w->pictures[i]);
    return status;
}

// What the library would refuse, with the names of the files.
static ag_status check_pair(work *w)
{
    const ag_image *a = w->pictures[0], *b = w->pictures[1];
    const char *const *names = w->request->pictures;
    if (ag_image_width(a) != ag_image_width(b) || ag_image_height(a) != ag_image_height(b)) {
        console_say(&w->console, AG_LOG_ERROR,
                    "%s has %ux%u pixels and %s %ux%u; only pictures of one size can be compared",
                    names[0], ag_image_width(a), ag_image_height(a), names[1], ag_image_width(b),
                    ag_image_height(b));
        return AG_ERROR_ARGUMENT;
    }
    if (ag_image_format(a) == ag_image_format(b))
        return AG_OK;
    int floats = ag_image_format(a) == AG_FORMAT_RGBA32F ? 0 : 1;
    console_say(&w->console, AG_LOG_ERROR,
                "%s is linear light in floats and %s colours in bytes, with a tone curve in "
                "between; render both as .exr, or both as .png",
                names[floats], names[1 - floats]);
    return AG_ERROR_ARGUMENT;
}

static ag_status measure(work *w)
{
    ag_log log = console_log(&w->console);
    ag_compare_options how = { .pixels_per_degree = w->request->pixels_per_degree };
    ag_status status = ag_image_compare(&log, w->pictures[0], w->pictures[1], &how, &w->difference,
                                        w->request->output ? &w->heat : NULL);
    notes said;
    ag_image_save_options save = notes_of_map(&said);
    if (!status && w->heat)
        status = output_save(&w->console, w->heat, &save, w->request->output);
    return status;
}

static void print_text(const work *w)
{
    const ag_difference *d = &w->difference;
    bool floats = ag_image_format(w->pictures[0]) == AG_FORMAT_RGBA32F;
    printf("%s, %s: %ux%u pixels\n", w->request->pictures[0], w->request->pictures[1],
           ag_image_width(w->pictures[0]), ag_image_height(w->pictures[0]));
    printf("  FLIP         %.5f", (double)d->flip);
    if (floats)
        printf("  over %.1f to %.1f stops", (double)d->ev_start, (double)d->ev_stop);
    printf("\n  at most      %.5f", (double)d->flip_max);
    if (d->flip_max > 0)
        printf("  at %u,%u", d->worst_x, d->worst_y);
    printf("\n  RMSE linear  %.5f\n", d->rmse_linear);
    printf("  RMSE sRGB    %.5f\n", d->rmse_srgb);
    if (isinf(d->psnr_db))
        puts("  PSNR         without end: equal");
    else
        printf("  PSNR         %.2f dB\n", d->psnr_db);
    printf("  SSIM         %.5f\n", d->ssim);
}

static void print_numbers(json *j, const ag_difference *d)
{
    json_real(j, "flip", (double)d->flip);
    json_real(j, "flip_max", (double)d->flip_max);
    json_open(j, "worst", '[');
    json_count(j, NULL, d->worst_x);
    json_count(j, NULL, d->worst_y);
    json_close(j, ']');
    json_real(j, "ev_start", (double)d->ev_start);
    json_real(j, "ev_stop", (double)d->ev_stop);
    json_real(j, "rmse_linear", d->rmse_linear);
    json_real(j, "rmse_srgb", d->rmse_srgb);
    json_real(j, "psnr_db", d->psnr_db);
    json_real(j, "ssim", d->ssim);
}

static void print_json(const work *w)
{
    json j = { .file = stdout };
    json_open(&j, NULL, '{');
    json_text(&j, "reference", w->request->pictures[0]);
    json_text(&j, "picture", w->request->pictures[1]);
    json_text(&j, "heat", w->request->output);
    json_count(&j, "width", ag_image_width(w->pictures[0]));
    json_count(&j, "height", ag_image_height(w->pictures[0]));
    json_bool(&j, "hdr", ag_image_format(w->pictures[0]) == AG_FORMAT_RGBA32F);
    print_numbers(&j, &w->difference);
    json_close(&j, '}');
}

static exit_code judge(work *w)
{
    const compare_request *r = w->request;
    if (!r->max_given || w->difference.flip <= r->max_flip)
        return EXIT_DONE;
    console_say(&w->console, AG_LOG_ERROR, "%s: a FLIP of %.5f is above the limit of %g",
                r->pictures[1], (double)w->difference.flip, (double)r->max_flip);
    return EXIT_FAILED;
}

static exit_code compare(work *w)
{
    ag_status status = load(w);
    if (!status)
        status = check_pair(w);
    if (!status)
        status = measure(w);
    if (status)
        return EXIT_FAILED;
    if (w->request->json)
        print_json(w);
    else
        print_text(w);
    fflush(stdout);
    return judge(w);
}

static exit_code look_and_compare(const compare_request *request)
{
    work w = { .request = request };
    console_init(&w.console, AG_LOG_WARNING, false);
    ag_format format;
    output_verdict verdict = OUTPUT_FINE;
    if (request->output)
        verdict = output_check(&w.console, request->output, &format);
    exit_code code = verdict == OUTPUT_FINE           ? compare(&w)
                     : verdict == OUTPUT_UNKNOWN_KIND ? EXIT_USAGE
                                                      : EXIT_FAILED;
    ag_image_destroy(w.heat);
    ag_image_destroy(w.pictures[0]);
    ag_image_destroy(w.pictures[1]);
    console_finish(&w.console);
    return code;
}

static exit_code run(int argc, char **argv)
{
    compare_request request = { .output = NULL };
    option_set set = {
        .command = &command_compare,
        .fields = &request,
        .operands = request.pictures,
        .operand_capacity = 2,
    };
    if (!options_parse(&set, argc, argv))
        return EXIT_USAGE;
    if (set.help) {
        help_command(&command_compare);
        return EXIT_DONE;
    }
    if (set.operand_count < 2) {
        fputs("argand: compare: which two? Try: argand compare reference.png picture.png\n",
              stderr);
        return EXIT_USAGE;
    }
    return look_and_compare(&request);
}

const command command_compare = {
    .name = "compare",
    .operands = "REFERENCE PICTURE",
    .about = "tell how far apart two pictures are",
    .lesson =
        "FLIP is what a person notices who switches between the two at a distance: 0 for\n"
        "nothing, 1 for green against blue; its mean over the picture, and where it is most.\n"
        "Of bytes (.png, .jpg, .webp) it is LDR-FLIP; of floats (.exr, .hdr) HDR-FLIP, the most\n"
        "of it over all exposures that show something.  RMSE, PSNR and SSIM are the usual ones,\n"
        "of sRGB-coded values where nothing else is said.  What is transparent lies over white.\n"
        "More pixels per degree mean a greater distance, from which less is seen.\n",
    .options = { options },
    .examples = "  argand compare reference.exr picture.exr\n"
                "  argand compare reference.png picture.png -o heat.png\n"
                "      With a map of the errors.\n"
                "  argand compare golden.png new.png --max-flip 0.01 || echo worse\n"
                "      As a test: the exit code is 1 above the limit.\n"
                "  argand compare golden.png new.png --json | jq .flip\n",
    .run = run,
};
