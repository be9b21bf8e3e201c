// The environment as a light: what a direction shows, and directions drawn by their light.
#ifndef AG_TRACE_SKY_H
#define AG_TRACE_SKY_H

#include "physics/lang.glsl"
#include "scene/scene.h"
#include "trace/world.h"

// Running sums of one line of cells, and where to begin to look in them.
enum { SKY_GUIDES = 128 };
typedef struct sky_line {
    int count;
    const float *sums;      // [count + 1]
    const uint16_t *guides; // [SKY_GUIDES + 1]: the cells of even steps through the sum
} sky_line;

typedef struct trace_sky {
    const ag_scene *scene;
    const ag_image *image;         // NULL -> black everywhere
    ag_image *owned;               // the same, where the scene does not have it
    float intensity, cosine, sine; // of its rotation
    int columns, rows;             // of the distribution's cells
    float *sums;                   // [rows][columns + 1], then [rows + 1] of the rows themselves
    uint16_t *guides;              // [rows + 1][SKY_GUIDES + 1], in the same order
    float *heights;                // [rows + 1]: cosines from the zenith where rows begin
} trace_sky;

AG_CHECK ag_status sky_init(const ag_scene *scene, trace_sky *s);
void sky_finish(trace_sky *s); // zero is allowed

// Take the scene's rotation and intensity.
void sky_turn(const ag_scene *scene, trace_sky *s);

// A direction of the sky: its light, nit, bilinear between the image's pixels, and the density
// with which sky_sample() draws it, 1/sr.
typedef struct sky_look {
    vec3 direction; // unit, world space
    vec3 radiance;
    float density;
} sky_look;

// What it gives to a place, roughly: irradiance without shadows, the mean over all ways that it may
// face.
float sky_irradiance(const trace_sky *s);

// What the directions of a packet show, nit.
void sky_behind(const trace_sky *s, const ray_packet *rays, vec3 radiance[WORLD_PACKET]);

// Of up to SKY_MANY directions at a time: what each reads is not near, and is waited for together.
// Of a sky without an image nothing may be asked.
enum { SKY_MANY = 64 };
void sky_at(const trace_sky *s, size_t count, sky_look *looks); // of their directions
void sky_sample(const trace_sky *s, size_t count, const vec2 *u, sky_look *looks);

#endif
