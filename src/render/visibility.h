// What deferred frames keep: what can be seen, and on the device what is shaded of it.
#ifndef AG_RENDER_VISIBILITY_H
#define AG_RENDER_VISIBILITY_H

#include "render/bindings.h"
#include "render/body.h"
#include "render/shade_list.h"

typedef struct visibility {
    gpu_buffer places; // gpu_listed
    gpu_buffer colors; // half floats, four a place
    VkBufferView views[4];
    uint32_t triangle_bits; // of ids
    shade_source *sources;
    raster_object *objects;          // as many
    float (*bodies)[BODY_POINTS][3]; // of lights that have one
    float (*sum)[4];                 // of frames; NULL where there is one
    raster raster;                   // these two for what they allocate
    shade_list list;
} visibility;

void visibility_destroy(gpu_device *device, visibility *v); // zero is allowed

// Have room for so many sources, bodies, and pixels of a sum; what was there is lost.
AG_CHECK ag_status visibility_allocate(gpu_device *device, size_t sources, size_t bodies,
                                       size_t summed, visibility *v);

// Have room for `count` places and their colours, and bind them and the geometry.
AG_CHECK ag_status visibility_bind(gpu_device *device, const bindings *b,
                                   const gpu_buffer *vertices, const gpu_buffer *indices,
                                   const gpu_buffer *instances, uint32_t count, visibility *v);

#endif
