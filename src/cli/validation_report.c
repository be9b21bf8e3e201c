// What `argand validate` tells.
//
// The page is report.html, with the numbers and the pictures as JSON in the place that it leaves
// for them.
#include "validation_report.h"

#include "exposure_report.h"
#include "json.h"

#include <stdio.h>
#include <string.h>

static const char page[] = {
#include "report.html.inc"
};

// ---- Numbers -------------------------------------------------------------------

static void write_pair(json *j, const picture_pair *pair)
{
    json_text(j, "real_time", pair->real_time);
    json_text(j, "reference", pair->reference);
}

static void write_apart(json *j, const linear_difference *d)
{
    json_real(j, "error", d->error);
    json_real(j, "bias", d->bias);
    json_real(j, "rms", d->rms);
}

static void write_cause(json *j, const cause *c, bool pictures)
{
    json_open(j, NULL, '{');
    json_text(j, "name", c->name);
    write_apart(j, &c->apart);
    json_real(j, "flip", (double)c->flip);
    if (pictures) {
        json_text(j, "about", c->about);
        write_pair(j, &c->shown);
    }
    json_close(j, '}');
}

static void write_worst(json *j, const ag_difference *d)
{
    json_open(j, "worst", '[');
    json_count(j, NULL, d->worst_x);
    json_count(j, NULL, d->worst_y);
    json_close(j, ']');
}

static void write_scene(json *j, const validation *v, bool pictures)
{
    json_open(j, NULL, '{');
    json_text(j, "input", v->input);
    json_count(j, "width", v->width);
    json_count(j, "height", v->height);
    report_exposure(j, v->exposure);
    json_real(j, "flip", (double)v->coded.flip);
    json_real(j, "flip_max", (double)v->coded.flip_max);
    write_worst(j, &v->coded);
    json_real(j, "hdr_flip", (double)v->linear.flip);
    json_real(j, "rmse_linear", v->linear.rmse_linear);
    json_real(j, "rmse_srgb", v->coded.rmse_srgb);
    json_real(j, "psnr_db", v->coded.psnr_db);
    json_real(j, "ssim", v->coded.ssim);
    write_apart(j, &v->apart);
    json_real(j, "noise", (double)v->state.noise);
    json_count(j, "samples", v->state.samples);
    json_real(j, "frame_ms", v->frame_ms);
    json_real(j, "trace_ms", v->state.trace_ms);
    if (pictures) {
        write_pair(j, &v->shown);
        json_text(j, "heat", v->heat);
    }
    json_open(j, "causes", '[');
    for (size_t i = 0; i < v->cause_count; i++)
        write_cause(j, &v->causes[i], pictures);
    json_close(j, ']');
    json_close(j, '}');
}

static void write_report(json *j, const validation_report *r, bool pictures)
{
    json_open(j, NULL, '{');
    json_text(j, "argand", ag_version());
    json_text(j, "device", r->device);
    if (r->max_flip > 0)
        json_real(j, "max_flip", (double)r->max_flip);
    json_real(j, "total_ms", r->total_ms);
    json_open(j, "scenes", '[');
    for (size_t i = 0; i < r->count; i++)
        write_scene(j, &r->scenes[i], pictures);
    json_close(j, ']');
    json_close(j, '}');
}

// ---- Out -----------------------------------------------------------------------

bool validation_report_page(const validation_report *r, char **out, size_t *size)
{
    const char *mark = strstr(page, "@DATA@");
    FILE *file = open_memstream(out, size);
    if (!file)
        return false;
    json j = { .file = file };
    fwrite(page, 1, (size_t)(mark - page), file);
    write_report(&j, r, true);
    fputs(mark + strlen("@DATA@"), file);
    bool whole = !ferror(file);
    return fclose(file) == 0 && whole;
}

static void print_line(const validation *v)
{
    printf("%s: FLIP %.4f, worst %.2f at %u,%u, PSNR %.1f dB, SSIM %.4f; light off by %.1f %% "
           "(RMS), noise %.1f %%\n",
           v->input, (double)v->coded.flip, (double)v->coded.flip_max, v->coded.worst_x,
           v->coded.worst_y, v->coded.psnr_db, v->coded.ssim, 100 * v->apart.rms,
           100 * (double)v->state.noise);
}

void validation_report_print(const validation_report *r, const shot_request *request)
{
    if (request->json) {
        json j = { .file = stdout };
        write_report(&j, r, false);
    } else if (!request->quiet) {
        for (size_t i = 0; i < r->count; i++)
            print_line(&r->scenes[i]);
        printf("%s: %zu scene%s in %.1f s\n", request->output, r->count, r->count == 1 ? "" : "s",
               r->total_ms / 1e3);
    }
}
