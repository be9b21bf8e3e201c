// Paints an equirectangular environment from a function of direction.
#include "base/threads.h"
#include "image/image.h"
#include "scene/environment.h"

enum { WIDTH = 1024, HEIGHT = 512 };

static const float pi = 3.14159265359f;

typedef struct painting {
    float *pixels;
    vec3 (*radiance)(const void *context, vec3 direction);
    const void *context;
    float cosine[WIDTH], sine[WIDTH]; // of each column's azimuth
} painting;

static void paint_row(void *context, size_t row)
{
    const painting *p = context;
    float theta = pi * ((float)row + 0.5f) / (float)HEIGHT;
    float *out = p->pixels + row * WIDTH * 4;
    for (int x = 0; x < WIDTH; x++, out += 4) {
        vec3 d = { sinf(theta) * p->cosine[x], cosf(theta), sinf(theta) * p->sine[x] };
        vec3_store(p->radiance(p->context, d), out);
        out[3] = 1.0f;
    }
}

ag_status environment_paint(const ag_log *log,
                            vec3 (*radiance)(const void *context, vec3 direction),
                            const void *context, ag_image **image)
{
    ag_image_desc desc = { .width = WIDTH, .height = HEIGHT, .format = AG_FORMAT_RGBA32F };
    ag_status status = ag_image_create(log, &desc, image);
    if (status != AG_OK)
        return status;
    painting p = { .pixels = (*image)->pixels, .radiance = radiance, .context = context };
    for (int x = 0; x < WIDTH; x++) {
        float azimuth = 2.0f * pi * (((float)x + 0.5f) / (float)WIDTH - 0.5f);
        p.cosine[x] = cosf(azimuth);
        p.sine[x] = sinf(azimuth);
    }
    parallel_for(HEIGHT, paint_row, &p);
    return AG_OK;
}
