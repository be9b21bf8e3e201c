// What `argand validate` tells.
//
// The page is report.html, with the numbers as JSON and the pictures as WebP in base64 (RFC 4648)
// in the place that it leaves for them.
#include "validation_report.h"

#include "json.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char page[] = {
#include "report.html.inc"
};

// Of the lossy pictures of the page; all numbers are of the pictures before.
enum { QUALITY_WHOLE = 92, QUALITY_PART = 85 };

typedef struct writing {
    json json;
    const ag_log *log;
    bool pictures; // along with the numbers
    ag_status status;
} writing;

// ---- Pictures ------------------------------------------------------------------

static const char prefix[] = "data:image/webp;base64,";

static char *encode(const unsigned char *data, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *text = malloc(sizeof prefix + (size + 2) / 3 * 4), *out = text;
    if (!text)
        return NULL;
    out += sprintf(out, "%s", prefix);
    for (size_t i = 0; i < size; i += 3) {
        size_t left = size - i;
        unsigned bits = (unsigned)data[i] << 16;
        bits |= left > 1 ? (unsigned)data[i + 1] << 8 : 0;
        bits |= left > 2 ? data[i + 2] : 0;
        *out++ = digits[bits >> 18];
        *out++ = digits[bits >> 12 & 63];
        *out++ = left > 1 ? digits[bits >> 6 & 63] : '=';
        *out++ = left > 2 ? digits[bits & 63] : '=';
    }
    *out = 0;
    return text;
}

static void write_picture(writing *w, const char *key, const ag_image *image, int quality)
{
    const ag_image_save_options options = { .quality = quality };
    void *data;
    size_t size;
    if (!w->pictures || w->status)
        return;
    w->status = ag_image_save_memory(w->log, image, "page.webp", &options, &data, &size);
    if (w->status)
        return;
    char *text = encode(data, size);
    if (text)
        json_text(&w->json, key, text);
    else
        w->status = AG_ERROR_MEMORY;
    free(text);
    free(data);
}

static void write_pair(writing *w, const picture_pair *pair, int quality)
{
    write_picture(w, "real_time", pair->real_time, quality);
    write_picture(w, "reference", pair->reference, quality);
}

// ---- Numbers -------------------------------------------------------------------

static void write_cause(writing *w, const cause *c)
{
    json *j = &w->json;
    json_open(j, NULL, '{');
    json_text(j, "name", c->name);
    if (w->pictures)
        json_text(j, "about", c->about);
    json_real(j, "error", c->apart.error);
    json_real(j, "bias", c->apart.bias);
    json_real(j, "flip", (double)c->flip);
    write_pair(w, &c->shown, QUALITY_PART);
    json_close(j, '}');
}

static void write_worst(json *j, const ag_difference *d)
{
    json_open(j, "worst", '[');
    json_count(j, NULL, d->worst_x);
    json_count(j, NULL, d->worst_y);
    json_close(j, ']');
}

static void write_scene(writing *w, const validation *v)
{
    json *j = &w->json;
    json_open(j, NULL, '{');
    json_text(j, "input", v->input);
    json_count(j, "width", ag_image_width(v->heat));
    json_count(j, "height", ag_image_height(v->heat));
    json_real(j, "flip", (double)v->coded.flip);
    json_real(j, "flip_max", (double)v->coded.flip_max);
    write_worst(j, &v->coded);
    json_real(j, "hdr_flip", (double)v->linear.flip);
    json_real(j, "rmse_linear", v->linear.rmse_linear);
    json_real(j, "rmse_srgb", v->coded.rmse_srgb);
    json_real(j, "psnr_db", v->coded.psnr_db);
    json_real(j, "ssim", v->coded.ssim);
    json_real(j, "error", v->apart.error);
    json_real(j, "bias", v->apart.bias);
    json_real(j, "noise", (double)v->state.noise);
    json_count(j, "samples", v->state.samples);
    json_real(j, "frame_ms", v->frame_ms);
    json_real(j, "trace_ms", v->state.trace_ms);
    write_pair(w, &v->shown, QUALITY_WHOLE);
    write_picture(w, "heat", v->heat, QUALITY_WHOLE);
    json_open(j, "causes", '[');
    for (size_t i = 0; i < v->cause_count; i++)
        write_cause(w, &v->causes[i]);
    json_close(j, ']');
    json_close(j, '}');
}

static void write_report(writing *w, const validation_report *r)
{
    json *j = &w->json;
    json_open(j, NULL, '{');
    json_text(j, "argand", ag_version());
    json_text(j, "device", r->device);
    if (r->max_flip > 0)
        json_real(j, "max_flip", (double)r->max_flip);
    json_real(j, "total_ms", r->total_ms);
    json_open(j, "scenes", '[');
    for (size_t i = 0; i < r->count; i++)
        write_scene(w, &r->scenes[i]);
    json_close(j, ']');
    json_close(j, '}');
}

// ---- Out -----------------------------------------------------------------------

ag_status validation_report_page(const validation_report *r, const ag_log *log, char **out,
                                 size_t *size)
{
    const char *mark = strstr(page, "@DATA@");
    FILE *file = open_memstream(out, size);
    if (!file)
        return AG_ERROR_MEMORY;
    writing w = { .json.file = file, .log = log, .pictures = true };
    fwrite(page, 1, (size_t)(mark - page), file);
    write_report(&w, r);
    fputs(mark + strlen("@DATA@"), file);
    bool whole = !ferror(file);
    if (fclose(file) != 0 || !whole)
        w.status = AG_ERROR_MEMORY;
    if (w.status) {
        free(*out);
        *out = NULL;
    }
    return w.status;
}

static void print_line(const validation *v)
{
    printf("%s: FLIP %.4f, worst %.2f at %u,%u, PSNR %.1f dB, SSIM %.4f; light off by %.1f %%, "
           "noise %.1f %%\n",
           v->input, (double)v->coded.flip, (double)v->coded.flip_max, v->coded.worst_x,
           v->coded.worst_y, v->coded.psnr_db, v->coded.ssim, 100 * v->apart.error,
           100 * (double)v->state.noise);
}

void validation_report_print(const validation_report *r, const shot_request *request)
{
    if (request->json) {
        writing w = { .json.file = stdout };
        write_report(&w, r);
    } else if (!request->quiet) {
        for (size_t i = 0; i < r->count; i++)
            print_line(&r->scenes[i]);
        printf("%s: %zu scene%s in %.1f s\n", request->output, r->count, r->count == 1 ? "" : "s",
               r->total_ms / 1e3);
    }
}
