// Which triangle each sample of a picture shows, found by the host.
//
// For devices that are the processor itself: lavapipe takes a microsecond or more for a small
// triangle, a loop over the samples that it covers a tenth of that.  Samples are where Vulkan's
// standard pattern has them.
#ifndef AG_RENDER_RASTER_H
#define AG_RENDER_RASTER_H

#include <argand/base.h>

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    RASTER_BAND = 16, // rows that are drawn together
    RASTER_NONE = -1, // as an id: nothing
};

// Triangles that move together.
typedef struct raster_object {
    const float *positions; // of vertex 0, three
    size_t stride;          // bytes from a vertex to the next one
    const uint32_t *indices;
    uint32_t triangle_count;
    uint32_t id;      // of triangle 0; the others follow
    float clip[4][4]; // clip_from_object, column major; w >= z keeps what is before the near plane
    bool left, right; // which are drawn: those that turn left on the screen, and right
} raster_object;

typedef struct raster {
    uint32_t width, height, bands; // px
    uint32_t samples;              // of a pixel, 1 or 4
    uint32_t pitch;                // samples from a row to the next one: rows are full fours
    struct raster_chunk *chunks;   // in drawing order
    size_t chunk_count, chunk_capacity;
    struct raster_part *parts; // of all chunks
    size_t part_capacity;
    unsigned workers;
    float *depth; // of a band, for each worker
    size_t depth_capacity;
    struct raster_scratch *scratch; // for each worker
    size_t scratch_capacity;
} raster;

// Project, clip and sort the triangles of a picture.  On all cores.  False: no memory.  What was
// allocated for a picture before (or zero) is used again.
AG_CHECK bool raster_begin(raster *r, uint32_t width, uint32_t height, uint32_t samples,
                           const raster_object *objects, size_t count);
void raster_finish(raster *r); // zero is allowed

// Draw one band: the ids of the samples of the pixels of its rows, rows r->pitch apart.  Nearer
// ones win, among equals later ones; depth is 1 at the near plane and 0 at the far one.  `ids` is
// aligned to 16 bytes; `worker` is below r->workers, each at one band at a time.
void raster_band(const raster *r, uint32_t band, unsigned worker, uint32_t *ids);

#endif
