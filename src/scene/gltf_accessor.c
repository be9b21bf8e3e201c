// Accessors: typed arrays in buffer views (spec 3.6.2), checked once and read as floats
// or unsigned integers.
#include "scene/gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t component_size(gltf_component component)
{
    switch (component) {
    case GLTF_BYTE:
    case GLTF_UBYTE: return 1;
    case GLTF_SHORT:
    case GLTF_USHORT: return 2;
    case GLTF_UINT:
    case GLTF_FLOAT: return 4;
    }
    return 0;
}

static size_t element_size(const gltf_accessor *accessor)
{
    return accessor->columns * accessor->column_stride;
}

static ag_status read_component(const gltf_at *at, gltf_component *component)
{
    uint64_t value = 0;
    gltf_at place = gltf_member(at, "componentType");
    ag_status status = gltf_require(at, "componentType");
    if (!status)
        status = gltf_uint(at, "componentType", UINT32_MAX, &value);
    if (!status &&
        (value < GLTF_BYTE || value > GLTF_FLOAT || component_size((gltf_component)value) == 0))
        return gltf_fail(&place, AG_ERROR_FORMAT, "%llu is not a component type",
                         (unsigned long long)value);
    *component = (gltf_component)value;
    return status;
}

static ag_status read_type(const gltf_at *at, gltf_accessor *accessor)
{
    static const struct {
        const char *name;
        uint32_t rows, columns;
    } types[] = { { "SCALAR", 1, 1 }, { "VEC2", 2, 1 }, { "VEC3", 3, 1 }, { "VEC4", 4, 1 },
                  { "MAT2", 2, 2 },   { "MAT3", 3, 3 }, { "MAT4", 4, 4 } };
    gltf_at place = gltf_member(at, "type");
    const char *name = "";
    ag_status status = gltf_require(at, "type");
    if (!status)
        status = gltf_string(at, "type", &name);
    if (status)
        return status;
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++)
        if (strcmp(name, types[i].name) == 0) {
            accessor->rows = types[i].rows;
            accessor->columns = types[i].columns;
            size_t size = accessor->rows * component_size(accessor->component);
            accessor->column_stride = accessor->columns > 1 ? (size + 3) / 4 * 4 : size;
            return AG_OK;
        }
    return gltf_fail(&place, AG_ERROR_FORMAT, "\"%.20s\" is not an accessor type", name);
}

// Point at `count` elements of `size` bytes, `stride` apart, in a view that `at` names.
static ag_status locate(const gltf_at *at, uint64_t count, size_t size, size_t stride,
                        const uint8_t **data)
{
    gltf_file *file = at->file;
    uint32_t index = GLTF_NONE;
    uint64_t offset = 0;
    ag_status status = gltf_index(at, "bufferView", file->view_count, "buffer views", &index);
    if (!status)
        status = gltf_uint(at, "byteOffset", (uint64_t)1 << 53, &offset);
    if (status)
        return status;
    const gltf_view *view = &file->views[index];
    uint64_t needed = (count - 1) * stride + size; // below 2^32 * 2^8
    if (offset > view->size || needed > view->size - offset)
        return gltf_fail(at, AG_ERROR_FORMAT,
                         "%llu elements reach beyond the %zu bytes of bufferViews[%u]",
                         (unsigned long long)count, view->size, index);
    *data = view->data + offset;
    return AG_OK;
}

static uint32_t uint_at(const uint8_t *p, gltf_component component)
{
    uint16_t half;
    uint32_t word;
    switch (component) {
    case GLTF_UBYTE: return *p;
    case GLTF_USHORT: memcpy(&half, p, sizeof half); return half;
    default: memcpy(&word, p, sizeof word); return word;
    }
}

static bool is_unsigned(gltf_component component)
{
    return component == GLTF_UBYTE || component == GLTF_USHORT || component == GLTF_UINT;
}

static ag_status check_sparse_indices(const gltf_at *at, const gltf_accessor *accessor)
{
    size_t size = component_size(accessor->sparse_component);
    uint32_t before = 0;
    for (size_t i = 0; i < accessor->sparse_count; i++) {
        uint32_t index = uint_at(accessor->sparse_indices + i * size, accessor->sparse_component);
        if (index >= accessor->count || (i > 0 && index <= before))
            return gltf_fail(at, AG_ERROR_FORMAT,
                             "number %zu is %u: they must rise and stay below the count of %u", i,
                             index, accessor->count);
        before = index;
    }
    return AG_OK;
}

static ag_status read_sparse(const gltf_at *at, gltf_accessor *accessor)
{
    gltf_at sparse, indices, values, count_at;
    uint64_t count = 0;
    ag_status status = gltf_object(at, "sparse", &sparse);
    if (status || !sparse.json)
        return status;
    count_at = gltf_member(&sparse, "count");
    status = gltf_uint(&sparse, "count", accessor->count, &count);
    if (!status && count == 0)
        return gltf_fail(&count_at, AG_ERROR_FORMAT, "must be at least 1");
    if (!status)
        status = gltf_object(&sparse, "indices", &indices);
    if (!status)
        status = gltf_object(&sparse, "values", &values);
    if (!status)
        status = gltf_require(&indices, "bufferView");
    if (!status)
        status = gltf_require(&values, "bufferView");
    if (!status)
        status = read_component(&indices, &accessor->sparse_component);
    if (!status && !is_unsigned(accessor->sparse_component))
        return gltf_fail(&indices, AG_ERROR_FORMAT, "are not unsigned integers");
    size_t size = component_size(accessor->sparse_component);
    if (!status)
        status = locate(&indices, count, size, size, &accessor->sparse_indices);
    size = element_size(accessor);
    if (!status)
        status = locate(&values, count, size, size, &accessor->sparse_values);
    accessor->sparse_count = (uint32_t)count;
    return status ? status : check_sparse_indices(&indices, accessor);
}

static ag_status read_elements(const gltf_at *at, gltf_accessor *accessor)
{
    gltf_at view_at = gltf_member(at, "bufferView"), count_at = gltf_member(at, "count");
    accessor->stride = element_size(accessor);
    if (!view_at.json && accessor->count > at->file->vertex_budget)
        return gltf_fail(&count_at, AG_ERROR_FORMAT,
                         "%u zeros are more than a file of this size may ask for", accessor->count);
    if (!view_at.json)
        return AG_OK;
    uint32_t view = 0;
    ag_status status = gltf_index(at, "bufferView", at->file->view_count, "buffer views", &view);
    if (status)
        return status;
    size_t stride = at->file->views[view].stride;
    if (stride && stride < accessor->stride)
        return gltf_fail(at, AG_ERROR_FORMAT,
                         "its elements have %zu bytes, but bufferViews[%u].byteStride is %zu",
                         accessor->stride, view, stride);
    if (stride)
        accessor->stride = stride;
    return locate(at, accessor->count, element_size(accessor), accessor->stride, &accessor->data);
}

static ag_status read_accessor(const gltf_at *at, gltf_accessor *accessor)
{
    uint64_t count = 0;
    gltf_at count_at = gltf_member(at, "count");
    ag_status status = read_component(at, &accessor->component);
    if (!status)
        status = read_type(at, accessor);
    if (!status)
        status = gltf_bool(at, "normalized", &accessor->normalized);
    if (!status)
        status = gltf_require(at, "count");
    if (!status)
        status = gltf_uint(at, "count", GLTF_NONE - 1, &count);
    if (!status && count == 0)
        return gltf_fail(&count_at, AG_ERROR_FORMAT, "must be at least 1");
    accessor->count = (uint32_t)count;
    if (!status)
        status = read_elements(at, accessor);
    return status ? status : read_sparse(at, accessor);
}

ag_status gltf_accessors_read(gltf_file *file)
{
    gltf_at root = gltf_root(file), accessors;
    ag_status status = gltf_objects(&root, "accessors", &accessors);
    if (status)
        return status;
    file->accessors = calloc(gltf_length(&accessors) + 1, sizeof *file->accessors);
    if (!file->accessors)
        return gltf_no_memory(&root);
    file->accessor_count = gltf_length(&accessors);
    for (size_t i = 0; i < file->accessor_count && !status; i++) {
        gltf_at at = gltf_item(&accessors, i);
        status = read_accessor(&at, &file->accessors[i]);
    }
    return status;
}

// One component; normalised integers as spec 3.11.1 maps them.
static float float_at(const uint8_t *p, gltf_component component, bool normalized)
{
    int16_t integer;
    float real;
    switch (component) {
    case GLTF_BYTE:
        return normalized ? fmaxf((float)(int8_t)*p / 127.0f, -1.0f) : (float)(int8_t)*p;
    case GLTF_UBYTE: return normalized ? (float)*p / 255.0f : (float)*p;
    case GLTF_SHORT:
        memcpy(&integer, p, sizeof integer);
        return normalized ? fmaxf((float)integer / 32767.0f, -1.0f) : (float)integer;
    case GLTF_USHORT: {
        float value = (float)uint_at(p, component);
        return normalized ? value / 65535.0f : value;
    }
    case GLTF_UINT: {
        double value = uint_at(p, component);
        return (float)(normalized ? value / 4294967295.0 : value);
    }
    case GLTF_FLOAT: memcpy(&real, p, sizeof real); return real;
    }
    return 0.0f;
}

// How one element becomes a row of the output.
typedef struct row_format {
    const gltf_accessor *accessor;
    size_t width; // of the output
    size_t used;  // components, at most `width`
    bool normalized;
} row_format;

static void read_row(const row_format *format, const uint8_t *element, float *row)
{
    const gltf_accessor *a = format->accessor;
    size_t size = component_size(a->component);
    for (size_t c = 0; c < format->used; c++)
        row[c] = float_at(element + c / a->rows * a->column_stride + c % a->rows * size,
                          a->component, format->normalized);
}

static void read_rows(const row_format *format, size_t first, size_t count, float *out)
{
    const gltf_accessor *a = format->accessor;
    size_t width = format->width, used = format->used;
    if (!a->data) {
        for (size_t i = 0; i < count; i++)
            memset(out + i * width, 0, used * sizeof *out);
        return;
    }
    const uint8_t *data = a->data + first * a->stride;
    if (a->component != GLTF_FLOAT)
        for (size_t i = 0; i < count; i++)
            read_row(format, data + i * a->stride, out + i * width);
    else if (used == width && a->stride == width * sizeof *out)
        memcpy(out, data, count * a->stride);
    else
        for (size_t i = 0; i < count; i++)
            memcpy(out + i * width, data + i * a->stride, used * sizeof *out);
}

// The first sparse element at or behind `first`.
static size_t sparse_lower_bound(const gltf_accessor *accessor, size_t first)
{
    size_t size = component_size(accessor->sparse_component), low = 0;
    size_t high = accessor->sparse_count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (uint_at(accessor->sparse_indices + middle * size, accessor->sparse_component) < first)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void replace_sparse(const row_format *format, size_t first, size_t count, float *out)
{
    const gltf_accessor *a = format->accessor;
    size_t size = component_size(a->sparse_component);
    for (size_t i = sparse_lower_bound(a, first); i < a->sparse_count; i++) {
        size_t index = uint_at(a->sparse_indices + i * size, a->sparse_component);
        if (index >= first + count)
            return;
        read_row(format, a->sparse_values + i * element_size(a),
                 out + (index - first) * format->width);
    }
}

bool gltf_all_finite(const float *values, size_t count)
{
    uint32_t largest = 0;
    for (size_t i = 0; i < count; i++) { // by the exponent, which vectorises
        uint32_t bits;
        memcpy(&bits, values + i, sizeof bits);
        bits &= 0x7FFFFFFFu;
        largest = bits > largest ? bits : largest;
    }
    return largest < 0x7F800000u;
}

void gltf_accessor_floats(const gltf_accessor *accessor, size_t first, size_t count, size_t width,
                          bool normalize, float *out)
{
    size_t components = (size_t)accessor->rows * accessor->columns;
    row_format format = { accessor, width, components < width ? components : width,
                          accessor->normalized || normalize };
    read_rows(&format, first, count, out);
    replace_sparse(&format, first, count, out);
}

ag_status gltf_accessor_uints(const gltf_at *at, const gltf_accessor *accessor, size_t first,
                              size_t count, size_t width, uint32_t *out)
{
    if (!is_unsigned(accessor->component) || accessor->rows != width || accessor->columns != 1)
        return gltf_fail(at, AG_ERROR_FORMAT, "accessors[%td] does not hold unsigned integers",
                         accessor - at->file->accessors);
    size_t size = component_size(accessor->component);
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < width; c++)
            out[i * width + c] =
                accessor->data ? uint_at(accessor->data + (first + i) * accessor->stride + c * size,
                                         accessor->component)
                               : 0;
    size_t index_size = component_size(accessor->sparse_component);
    for (size_t i = sparse_lower_bound(accessor, first); i < accessor->sparse_count; i++) {
        size_t index =
            uint_at(accessor->sparse_indices + i * index_size, accessor->sparse_component);
        if (index >= first + count)
            break;
        for (size_t c = 0; c < width; c++)
            out[(index - first) * width + c] =
                uint_at(accessor->sparse_values + (i * width + c) * size, accessor->component);
    }
    return AG_OK;
}
