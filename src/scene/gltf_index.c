// Indices of a primitive, turned into triangles (spec 3.7.2.1).
#include "scene/gltf.h"

#include <stdlib.h>

enum { // primitive.mode
    POINTS,
    LINES,
    LINE_LOOP,
    LINE_STRIP,
    TRIANGLES,
    TRIANGLE_STRIP,
    TRIANGLE_FAN,
};

// What the primitive draws: `indices` or, where that is NULL, 0, 1, 2, ...
typedef struct corner_list {
    uint32_t *indices; // owned
    size_t count;
} corner_list;

static uint32_t corner(const corner_list *corners, size_t i)
{
    return corners->indices ? corners->indices[i] : (uint32_t)i;
}

// The largest value of each type restarts primitives and may not occur.
static uint32_t restart_value(gltf_component component)
{
    return component == GLTF_UBYTE ? 0xFFu : component == GLTF_USHORT ? 0xFFFFu : 0xFFFFFFFFu;
}

static ag_status check_indices(const gltf_at *at, const gltf_accessor *accessor,
                               const corner_list *corners, size_t vertex_count)
{
    uint32_t restart = restart_value(accessor->component), largest = 0;
    for (size_t i = 0; i < corners->count; i++)
        largest = corners->indices[i] > largest ? corners->indices[i] : largest;
    if (largest < restart && largest < vertex_count)
        return AG_OK;
    size_t i = 0;
    while (corners->indices[i] < largest)
        i++;
    if (largest == restart)
        return gltf_fail(at, AG_ERROR_FORMAT, "index %zu is %u, which restarts primitives", i,
                         largest);
    return gltf_fail(at, AG_ERROR_FORMAT, "index %zu is %u, but there are only %zu vertices", i,
                     largest, vertex_count);
}

static ag_status read_corners(const gltf_at *primitive, size_t vertex_count, corner_list *corners)
{
    gltf_file *file = primitive->file;
    gltf_at at = gltf_member(primitive, "indices");
    uint32_t index = GLTF_NONE;
    ag_status status = gltf_index(primitive, "indices", file->accessor_count, "accessors", &index);
    if (status || index == GLTF_NONE) {
        corners->count = vertex_count;
        return status;
    }
    const gltf_accessor *accessor = &file->accessors[index];
    corners->count = accessor->count;
    status = gltf_charge(&at, &file->work_budget, accessor->count);
    if (status)
        return status;
    corners->indices = malloc(accessor->count * sizeof *corners->indices);
    if (!corners->indices)
        return gltf_no_memory(&at);
    status = gltf_accessor_uints(&at, accessor, 0, accessor->count, 1, corners->indices);
    return status ? status : check_indices(&at, accessor, corners, vertex_count);
}

// The corners of triangle `i` of a strip or a fan, in the specification's order.
static void triangle(const corner_list *corners, bool strip, size_t i, uint32_t out[3])
{
    out[0] = corner(corners, strip ? i : i + 1);
    out[1] = corner(corners, strip ? i + 1 + i % 2 : i + 2);
    out[2] = corner(corners, strip ? i + 2 - i % 2 : 0);
}

// Triangles without a surface join the parts of long strips: they are left out.
static ag_status unroll(const gltf_at *at, const corner_list *corners, bool strip,
                        gltf_geometry *geometry)
{
    size_t count = corners->count - 2;
    ag_status status = gltf_charge(at, &at->file->work_budget, 3 * count);
    if (status)
        return status;
    geometry->indices = malloc(3 * count * sizeof *geometry->indices);
    if (!geometry->indices)
        return gltf_no_memory(at);
    for (size_t i = 0; i < count; i++) {
        uint32_t *out = geometry->indices + geometry->index_count;
        triangle(corners, strip, i, out);
        if (out[0] != out[1] && out[1] != out[2] && out[2] != out[0])
            geometry->index_count += 3;
    }
    return AG_OK;
}

// Keep only the vertices from the first to the last that is used: several primitives may
// share long accessors.
static void narrow(gltf_geometry *geometry)
{
    uint32_t low = UINT32_MAX, high = 0;
    geometry->vertex_count = geometry->element_count;
    if (!geometry->indices || geometry->index_count == 0)
        return;
    for (size_t i = 0; i < geometry->index_count; i++) {
        uint32_t index = geometry->indices[i];
        low = index < low ? index : low;
        high = index > high ? index : high;
    }
    for (size_t i = 0; low > 0 && i < geometry->index_count; i++)
        geometry->indices[i] -= low;
    geometry->first = low;
    geometry->vertex_count = (size_t)high - low + 1;
}

static ag_status make_triangles(const gltf_at *primitive, uint64_t mode, corner_list *corners,
                                gltf_geometry *geometry)
{
    if (corners->count < 3) {
        gltf_warn_once(primitive, GLTF_WARNED_REST, "has too few vertices for a triangle");
        return AG_OK;
    }
    if (mode != TRIANGLES)
        return unroll(primitive, corners, mode == TRIANGLE_STRIP, geometry);
    if (corners->count % 3)
        gltf_warn_once(primitive, GLTF_WARNED_REST, "ends within a triangle; the rest is left out");
    geometry->indices = corners->indices;
    geometry->index_count = corners->count - corners->count % 3;
    corners->indices = NULL;
    return AG_OK;
}

ag_status gltf_triangles_read(const gltf_at *primitive, gltf_geometry *geometry)
{
    gltf_at mode_at = gltf_member(primitive, "mode");
    uint64_t mode = TRIANGLES;
    ag_status status = gltf_uint(primitive, "mode", TRIANGLE_FAN, &mode);
    if (status)
        return status;
    if (mode < TRIANGLES) {
        gltf_warn_once(&mode_at, GLTF_WARNED_MODE, "points and lines are not drawn");
        return AG_OK;
    }
    corner_list corners = { 0 };
    status = read_corners(primitive, geometry->element_count, &corners);
    if (!status)
        status = make_triangles(primitive, mode, &corners, geometry);
    free(corners.indices);
    if (status)
        return status;
    if (geometry->index_count > UINT32_MAX)
        return gltf_fail(primitive, AG_ERROR_UNSUPPORTED, "has more than 2^32 corners");
    narrow(geometry);
    return AG_OK;
}
