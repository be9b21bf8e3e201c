// Pictures of linear light as they are shown.
#include <argand/renderer.h>

#include "base/log.h"
#include "base/threads.h"
#include "image/image.h"
#include "image/srgb.h"
#include "physics/display.glsl"

enum { ROWS = 64 }; // of one task

typedef struct display_job {
    const ag_image *from;
    ag_image *to;
    uint32_t tone; // of display.glsl
    bool backdrop;
    vec3 under; // display-linear
    srgb_encoder encoder;
} display_job;

static void show(const display_job *job, const float in[4], uint8_t out[4])
{
    vec3 c = display(job->tone, vec3(in[0], in[1], in[2]));
    float alpha = clamp(in[3], 0.0f, 1.0f);
    if (job->backdrop) {
        c = job->under + (clamp(c, 0.0f, 1.0f) - job->under) * alpha;
        alpha = 1;
    }
    for (int i = 0; i < 3; i++)
        out[i] = alpha > 0 ? srgb_encode(&job->encoder, c[i]) : 0;
    out[3] = (uint8_t)(alpha * 255 + 0.5f);
}

static void show_rows(void *context, size_t index)
{
    const display_job *job = context;
    size_t width = job->from->width, first = index * ROWS * width, all = width * job->from->height;
    const float *in = job->from->pixels;
    uint8_t *out = job->to->pixels;
    for (size_t i = first; i < first + ROWS * width && i < all; i++)
        show(job, in + 4 * i, out + 4 * i);
}

ag_status ag_image_display(const ag_log *log, const ag_image *linear, const ag_render_options *look,
                           ag_image **shown)
{
    *shown = NULL;
    if (linear->format != AG_FORMAT_RGBA32F || (unsigned)look->tonemap > AG_TONEMAP_AGX ||
        (unsigned)look->transfer > AG_TRANSFER_GAMMA_22)
        return log_fail(log, AG_ERROR_ARGUMENT,
                        "only a picture of floats can be shown, with a known tone curve");
    const float *c = look->background_color;
    display_job job = {
        .from = linear,
        .tone = (uint32_t)look->tonemap |
                (look->transfer == AG_TRANSFER_GAMMA_22 ? DISPLAY_GAMMA_22 : 0),
        .backdrop = look->background == AG_BACKGROUND_COLOR,
        .under = vec3(color_srgb_decode_channel(c[0]), color_srgb_decode_channel(c[1]),
                      color_srgb_decode_channel(c[2])),
    };
    ag_status status =
        image_allocate(log, "image", linear->width, linear->height, AG_FORMAT_RGBA8, &job.to);
    if (status)
        return status;
    srgb_encoder_init(&job.encoder);
    parallel_for((linear->height + ROWS - 1) / ROWS, show_rows, &job);
    *shown = job.to;
    return AG_OK;
}
