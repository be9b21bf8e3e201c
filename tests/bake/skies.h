// Equirectangular images of skies that are known everywhere, for the tests of the bake.
#ifndef TESTS_BAKE_SKIES_H
#define TESTS_BAKE_SKIES_H

#include <argand/image.h>

#include "bake/environment.h"
#include "image/half.h"

#include "../physics/near.h"

#include <stdlib.h>

// The image of a sky: `radiance(d, rgb)` for the unit direction of each pixel.
static inline ag_image *sky_image(uint32_t width, void (*radiance)(const double d[3], float rgb[3]))
{
    uint32_t height = width / 2;
    float *pixels = calloc((size_t)width * height, sizeof(float[4]));
    assert_non_null(pixels);
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            // The definition: u = .5 + atan2(z, x) / 2 pi, v = acos(y) / pi.
            double phi = ((x + 0.5) / width - 0.5) * 6.28318530717958648;
            double theta = (y + 0.5) / height * 3.14159265358979324;
            double d[3] = { sin(theta) * cos(phi), cos(theta), sin(theta) * sin(phi) };
            float *p = pixels + 4 * ((size_t)y * width + x);
            radiance(d, p);
            p[3] = 1.0f;
        }
    }
    ag_image *image;
    ag_image_desc desc = { width, height, AG_FORMAT_RGBA32F, pixels };
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    free(pixels);
    return image;
}

// The unit direction of a texel's centre, from Vulkan's table: major axis, then s and t.
static inline void texel_direction(uint32_t size, uint32_t face, uint32_t x, uint32_t y,
                                   double d[3])
{
    double s = (2.0 * x + 1.0) / size - 1.0, t = (2.0 * y + 1.0) / size - 1.0;
    const double table[6][3] = { { 1, -t, -s }, { -1, -t, s },  { s, 1, t },
                                 { s, -1, -t }, { s, -t, 1.0 }, { -s, -t, -1 } };
    double length = sqrt(1.0 + s * s + t * t);
    for (int i = 0; i < 3; i++)
        d[i] = table[face][i] / length;
}

static inline float texel(const bake_environment *e, uint32_t mip, uint32_t face, uint32_t x,
                          uint32_t y, int channel)
{
    uint32_t size = e->size >> mip;
    const uint16_t *level = e->cube + bake_environment_mip_offset(e->size, mip) / 2;
    return half_to_float(level[4 * ((size_t)(face * size + y) * size + x) + (size_t)channel]);
}

#endif
