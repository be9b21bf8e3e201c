// What of a picture is to be shaded: each surface once in each pixel that shows it.
//
// A sample's id has in the upper bits the number of an instance, in the lower `triangle_bits`
// that of a triangle of its mesh.  Samples on triangles that share a vertex are of one surface:
// whatever shading reads runs on across that vertex, or the mesh would have two of it.  Colours
// come back in the order of the list and are mixed.
#ifndef AG_RENDER_SHADE_LIST_H
#define AG_RENDER_SHADE_LIST_H

#include <argand/renderer.h>

#include "interop/scene.glsl"
#include "render/panorama.h"
#include "render/raster.h"

enum { SHADE_LISTS_MAX = 1024 };

// What an id's upper bits stand for.
typedef struct shade_source {
    uint32_t list; // where its places are listed, or list_count: `color` is known already
    uint32_t first_index, first_vertex; // of the mesh on the device
    const uint32_t *indices;            // of the mesh; NULL: all triangles are one surface
    float color[4];
} shade_source;

typedef struct shade_list {
    uint32_t triangle_bits;
    const shade_source *sources; // the last one stands for RASTER_NONE
    uint32_t source_count;
    uint32_t list_count; // at most SHADE_LISTS_MAX

    uint32_t width, height, samples; // as the raster's
    uint32_t bands;
    size_t pitch;      // from a row of ids to the next one
    uint32_t *ids;     // [height][pitch], of the samples of pixels; of one surface equal
    uint32_t *cursors; // [bands][list_count + 1]: where each band's part of a list is
    uint32_t *firsts;  // [list_count + 1]: where each list starts; the last one: how many places
    size_t ids_capacity, cursors_capacity, firsts_capacity;
} shade_list;

// Draw the raster, find the surfaces in each pixel and count them.  False: no memory.  What was
// allocated for a list before (or zero) is used again.
AG_CHECK bool shade_list_count(shade_list *list, const raster *r);
void shade_list_finish(shade_list *list); // zero is allowed

// Write all places, list after list.
void shade_list_write(const shade_list *list, gpu_listed *places);

// How colours become a picture.
typedef struct shade_mix {
    const uint16_t (*colors)[4]; // half floats, of the places in their order
    const panorama *background;  // what the last source shows; NULL: its own colour
    float backdrop[4];           // display-linear, premultiplied, where nothing covers
    uint32_t tone;               // curve still to be applied, or GPU_TONE_LINEAR
    float weight;                // of this frame in the sum
    float (*sum)[4];             // of frames; NULL: there is one
    bool first, last;            // of them
    ag_format format;
    void *pixels; // premultiplied, [height][width]
} shade_mix;

void shade_list_mix(const shade_list *list, const shade_mix *mix);

#endif
