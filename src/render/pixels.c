// A tile's pixels on their way from the device into a picture.
#include "render/pixels.h"

#include "base/threads.h"
#include "image/image.h"
#include "physics/color.glsl"

#include <string.h>

enum { ROWS = 64 }; // of one task

typedef struct place_job {
    const char *from;
    view_rect tile;
    ag_image *picture;
} place_job;

static void straighten_bytes(uint8_t *pixel)
{
    if (pixel[3] == 255)
        return;
    if (pixel[3] == 0) {
        memset(pixel, 0, 4);
        return;
    }
    float alpha = (float)pixel[3] / 255;
    for (int i = 0; i < 3; i++) {
        float c = color_srgb_decode_channel((float)pixel[i] / 255) / alpha;
        pixel[i] = (uint8_t)(color_srgb_encode_channel(c < 1 ? c : 1) * 255 + 0.5f);
    }
}

static void straighten_floats(float *pixel)
{
    if (pixel[3] > 0 && pixel[3] < 1)
        for (int i = 0; i < 3; i++)
            pixel[i] /= pixel[3];
}

static void place_rows(void *context, size_t index)
{
    const place_job *job = context;
    size_t texel = image_pixel_size(job->picture->format), row = job->tile.width * texel;
    uint32_t end = (uint32_t)(index + 1) * ROWS;
    uint32_t width = job->tile.width, height = job->tile.height;
    if (width > job->picture->width - job->tile.x)
        width = job->picture->width - job->tile.x;
    if (height > job->picture->height - job->tile.y)
        height = job->picture->height - job->tile.y;
    for (uint32_t y = (uint32_t)index * ROWS; y < end && y < height; y++) {
        size_t place = (size_t)(job->tile.y + y) * job->picture->width + job->tile.x;
        char *to = (char *)job->picture->pixels + place * texel;
        memcpy(to, job->from + y * row, width * texel);
        for (uint32_t x = 0; x < width; x++)
            if (job->picture->format == AG_FORMAT_RGBA8)
                straighten_bytes((uint8_t *)to + x * 4);
            else
                straighten_floats((float *)(void *)to + x * 4);
    }
}

void pixels_place(const void *from, view_rect tile, ag_image *picture)
{
    place_job job = { from, tile, picture };
    parallel_for((tile.height + ROWS - 1) / ROWS, place_rows, &job);
}
