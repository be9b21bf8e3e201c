// Places in a glTF file, and typed values there.
#include "base/log.h"
#include "scene/gltf.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

gltf_at gltf_root(gltf_file *file)
{
    return (gltf_at) { .file = file, .json = file->root };
}

gltf_at gltf_member(const gltf_at *object, const char *key)
{
    return (gltf_at) { object->file, object, key, 0, json_object_get(object->json, key) };
}

gltf_at gltf_item(const gltf_at *array, size_t index)
{
    return (gltf_at) { array->file, array, NULL, index, json_array_get(array->json, index) };
}

size_t gltf_length(const gltf_at *array)
{
    return json_array_size(array->json);
}

// Write "accessors[3].count"; the root itself is empty.
static size_t write_place(const gltf_at *at, char *text, size_t size)
{
    if (!at->up) {
        text[0] = 0;
        return 0;
    }
    size_t used = write_place(at->up, text, size);
    if (at->key)
        snprintf(text + used, size - used, "%s%s", used ? "." : "", at->key);
    else
        snprintf(text + used, size - used, "[%zu]", at->index);
    return used + strlen(text + used);
}

static void report(const gltf_at *at, ag_log_level level, const char *format, va_list args)
{
    char place[256], sentence[512];
    size_t used = write_place(at, place, sizeof place);
    vsnprintf(sentence, sizeof sentence, format, args);
    log_write(&at->file->log, level, "%s: %s%s%s", at->file->path, place, used ? ": " : "",
              sentence);
}

ag_status gltf_fail(const gltf_at *at, ag_status status, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    report(at, AG_LOG_ERROR, format, args);
    va_end(args);
    return status;
}

void gltf_warn(const gltf_at *at, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    report(at, AG_LOG_WARNING, format, args);
    va_end(args);
}

void gltf_warn_once(const gltf_at *at, unsigned bit, const char *format, ...)
{
    if (at->file->warned & bit)
        return;
    at->file->warned |= bit;
    va_list args;
    va_start(args, format);
    report(at, AG_LOG_WARNING, format, args);
    va_end(args);
}

ag_status gltf_no_memory(const gltf_at *at)
{
    return gltf_fail(at, AG_ERROR_MEMORY, "there is no memory for it");
}

ag_status gltf_require(const gltf_at *object, const char *key)
{
    gltf_at at = gltf_member(object, key);
    return at.json ? AG_OK : gltf_fail(&at, AG_ERROR_FORMAT, "is missing");
}

ag_status gltf_object(const gltf_at *object, const char *key, gltf_at *value)
{
    *value = gltf_member(object, key);
    if (value->json && !json_is_object(value->json))
        return gltf_fail(value, AG_ERROR_FORMAT, "is not an object");
    return AG_OK;
}

ag_status gltf_array(const gltf_at *object, const char *key, gltf_at *value)
{
    *value = gltf_member(object, key);
    if (value->json && !json_is_array(value->json))
        return gltf_fail(value, AG_ERROR_FORMAT, "is not an array");
    if (gltf_length(value) >= GLTF_NONE)
        return gltf_fail(value, AG_ERROR_UNSUPPORTED, "has too many items");
    return AG_OK;
}

ag_status gltf_objects(const gltf_at *object, const char *key, gltf_at *value)
{
    ag_status status = gltf_array(object, key, value);
    for (size_t i = 0; !status && i < gltf_length(value); i++) {
        gltf_at item = gltf_item(value, i);
        if (!json_is_object(item.json))
            status = gltf_fail(&item, AG_ERROR_FORMAT, "is not an object");
    }
    return status;
}

ag_status gltf_bool(const gltf_at *object, const char *key, bool *value)
{
    gltf_at at = gltf_member(object, key);
    if (!at.json)
        return AG_OK;
    if (!json_is_boolean(at.json))
        return gltf_fail(&at, AG_ERROR_FORMAT, "is neither true nor false");
    *value = json_is_true(at.json);
    return AG_OK;
}

ag_status gltf_string(const gltf_at *object, const char *key, const char **value)
{
    gltf_at at = gltf_member(object, key);
    if (!at.json)
        return AG_OK;
    if (!json_is_string(at.json))
        return gltf_fail(&at, AG_ERROR_FORMAT, "is not a string");
    *value = json_string_value(at.json);
    return AG_OK;
}

// An integer, also one written as 24.0 (spec 2.7.1 asks importers to take it).
static ag_status read_uint(const gltf_at *at, uint64_t max, uint64_t *value)
{
    if (json_is_integer(at->json)) {
        json_int_t integer = json_integer_value(at->json);
        if (integer < 0 || (uint64_t)integer > max)
            return gltf_fail(at, AG_ERROR_FORMAT,
                             "%" JSON_INTEGER_FORMAT " is not between 0 and %llu", integer,
                             (unsigned long long)max);
        *value = (uint64_t)integer;
        return AG_OK;
    }
    double real = json_is_real(at->json) ? json_real_value(at->json) : -1.0;
    if (!(real >= 0.0 && real < 9007199254740992.0) || floor(real) < real || (uint64_t)real > max)
        return gltf_fail(at, AG_ERROR_FORMAT, "is not a whole number between 0 and %llu",
                         (unsigned long long)max);
    *value = (uint64_t)real;
    return AG_OK;
}

ag_status gltf_uint(const gltf_at *object, const char *key, uint64_t max, uint64_t *value)
{
    gltf_at at = gltf_member(object, key);
    return at.json ? read_uint(&at, max, value) : AG_OK;
}

ag_status gltf_item_index(const gltf_at *item, size_t count, const char *what, uint32_t *index)
{
    uint64_t value = 0;
    ag_status status = read_uint(item, GLTF_NONE - 1, &value);
    if (status)
        return status;
    if (value >= count)
        return gltf_fail(item, AG_ERROR_FORMAT, "%llu is not one of the %zu %s",
                         (unsigned long long)value, count, what);
    *index = (uint32_t)value;
    return AG_OK;
}

ag_status gltf_index(const gltf_at *object, const char *key, size_t count, const char *what,
                     uint32_t *index)
{
    gltf_at at = gltf_member(object, key);
    return at.json ? gltf_item_index(&at, count, what, index) : AG_OK;
}

// Numbers beyond float's range would be infinite in the scene.
static ag_status read_number(const gltf_at *at, double *value)
{
    if (!json_is_number(at->json))
        return gltf_fail(at, AG_ERROR_FORMAT, "is not a number");
    double number = json_number_value(at->json);
    if (!(fabs(number) <= (double)FLT_MAX))
        return gltf_fail(at, AG_ERROR_FORMAT, "%g is too large", number);
    *value = number;
    return AG_OK;
}

ag_status gltf_item_float(const gltf_at *item, float *value)
{
    double number = 0;
    ag_status status = read_number(item, &number);
    if (!status)
        *value = (float)number;
    return status;
}

ag_status gltf_float(const gltf_at *object, const char *key, float *value)
{
    gltf_at at = gltf_member(object, key);
    return at.json ? gltf_item_float(&at, value) : AG_OK;
}

ag_status gltf_doubles(const gltf_at *object, const char *key, size_t count, double *values)
{
    gltf_at array;
    ag_status status = gltf_array(object, key, &array);
    if (status || !array.json)
        return status;
    if (gltf_length(&array) != count)
        return gltf_fail(&array, AG_ERROR_FORMAT, "has %zu numbers instead of %zu",
                         gltf_length(&array), count);
    double read[16] = { 0 };
    for (size_t i = 0; i < count && !status; i++) {
        gltf_at item = gltf_item(&array, i);
        status = read_number(&item, &read[i]);
    }
    if (!status)
        memcpy(values, read, count * sizeof *values);
    return status;
}

ag_status gltf_floats(const gltf_at *object, const char *key, size_t count, float *values)
{
    double read[16];
    for (size_t i = 0; i < count; i++)
        read[i] = (double)values[i];
    ag_status status = gltf_doubles(object, key, count, read);
    for (size_t i = 0; i < count && !status; i++)
        values[i] = (float)read[i];
    return status;
}

ag_status gltf_floats_in(const gltf_at *object, const char *key, size_t count, float min, float max,
                         float *values)
{
    gltf_at at = gltf_member(object, key);
    ag_status status =
        count == 1 ? gltf_float(object, key, values) : gltf_floats(object, key, count, values);
    for (size_t i = 0; i < count && !status; i++) {
        float kept = fminf(fmaxf(values[i], min), max);
        if (kept < values[i] || kept > values[i])
            gltf_warn_once(&at, GLTF_WARNED_RANGE, "%g is taken as %g", (double)values[i],
                           (double)kept);
        values[i] = kept;
    }
    return status;
}

ag_status gltf_float_in(const gltf_at *object, const char *key, float min, float max, float *value)
{
    return gltf_floats_in(object, key, 1, min, max, value);
}

ag_status gltf_extension(const gltf_at *object, const char *name, gltf_at *value)
{
    // The place of `extensions` is left out of the chain, which must outlive this call.
    gltf_at extensions;
    *value = gltf_member(object, name);
    ag_status status = gltf_object(object, "extensions", &extensions);
    value->json = status ? NULL : json_object_get(extensions.json, name);
    if (value->json && !json_is_object(value->json))
        return gltf_fail(value, AG_ERROR_FORMAT, "is not an object");
    return status;
}
