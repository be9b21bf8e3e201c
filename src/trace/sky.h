// The environment as a light: what a direction shows, and directions drawn by their light.
#ifndef AG_TRACE_SKY_H
#define AG_TRACE_SKY_H

#include "physics/lang.glsl"
#include "scene/scene.h"

typedef struct trace_sky {
    const ag_scene *scene;
    const ag_image *image;         // NULL -> black everywhere
    float intensity, cosine, sine; // of its rotation
    // Cells of the distribution: rows from the top, each with its running sums.
    int columns, rows;
    float *row_sums;  // [rows + 1]
    float *cell_sums; // [rows][columns + 1]
} trace_sky;

AG_CHECK ag_status sky_init(const ag_scene *scene, trace_sky *s);
void sky_finish(trace_sky *s); // zero is allowed

// Radiance, nit, from a unit direction of the world; bilinear between the image's pixels.
vec3 sky_radiance(const trace_sky *s, vec3 direction);

// A direction, and its density in 1/sr.
vec3 sky_sample(const trace_sky *s, vec2 u, float *density);
float sky_density(const trace_sky *s, vec3 direction);

#endif
