// The JSON and the pieces of a .glb that is written.
#include "base/array.h"
#include "scene/gltf_write.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// The decimal of few digits that is read back as `value`, else the value itself, of which
// the file's nine digits say enough; -0 becomes 0.  JSON has no infinity.
static double decimal(float value)
{
    char text[32];
    value = fminf(fmaxf(value, -FLT_MAX), FLT_MAX);
    if (fabsf(value) < 1e6f && floorf(value) == value)
        return (double)value + 0.0;
    snprintf(text, sizeof text, "%.6g", (double)value);
    double few = strtod(text, NULL);
    return (float)few == value ? few : (double)value;
}

void gltf_put(gltf_writer *w, json_t *object, const char *key, json_t *value)
{
    if (json_object_set_new_nocheck(object, key, value) != 0)
        w->no_memory = true;
}

json_t *gltf_numbers(gltf_writer *w, const float *values, size_t count)
{
    json_t *array = json_array();
    for (size_t i = 0; i < count; i++)
        if (json_array_append_new(array, json_real(decimal(values[i]))) != 0)
            w->no_memory = true;
    return array;
}

void gltf_put_floats(gltf_writer *w, json_t *object, const char *key, const float *values,
                     size_t count)
{
    gltf_put(w, object, key, gltf_numbers(w, values, count));
}

void gltf_put_float(gltf_writer *w, json_t *object, const char *key, float value)
{
    gltf_put(w, object, key, json_real(decimal(value)));
}

void gltf_put_index(gltf_writer *w, json_t *object, const char *key, size_t value)
{
    gltf_put(w, object, key, json_integer((json_int_t)value));
}

void gltf_put_word(gltf_writer *w, json_t *object, const char *key, const char *word)
{
    gltf_put(w, object, key, json_string_nocheck(word));
}

void gltf_put_name(gltf_writer *w, json_t *object, const char *name)
{
    json_t *string = name ? json_string(name) : NULL;
    if (string)
        gltf_put(w, object, "name", string);
}

void gltf_put_true(gltf_writer *w, json_t *object, const char *key)
{
    gltf_put(w, object, key, json_true());
}

void gltf_put_floats_unless(gltf_writer *w, json_t *object, const char *key, const float *values,
                            size_t count, const float *assumed)
{
    for (size_t i = 0; i < count; i++)
        if (values[i] != assumed[i]) {
            gltf_put_floats(w, object, key, values, count);
            return;
        }
}

void gltf_put_float_unless(gltf_writer *w, json_t *object, const char *key, float value,
                           float assumed)
{
    if (value != assumed)
        gltf_put_float(w, object, key, value);
}

void gltf_put_unless_empty(gltf_writer *w, json_t *object, const char *key, json_t *value)
{
    if (value && json_object_size(value) + json_array_size(value) == 0)
        json_decref(value);
    else
        gltf_put(w, object, key, value);
}

void gltf_put_extension_unless_empty(gltf_writer *w, json_t *object, const char *name,
                                     json_t *value)
{
    if (json_object_size(value) &&
        json_object_update(gltf_put_extension(w, object, name), value) != 0)
        w->no_memory = true;
    json_decref(value);
}

json_t *gltf_put_object(gltf_writer *w, json_t *object, const char *key)
{
    if (!json_object_get(object, key))
        gltf_put(w, object, key, json_object());
    return json_object_get(object, key);
}

json_t *gltf_put_extension(gltf_writer *w, json_t *object, const char *name)
{
    gltf_put_true(w, w->used, name);
    return gltf_put_object(w, gltf_put_object(w, object, "extensions"), name);
}

uint32_t gltf_append(gltf_writer *w, json_t *object, const char *key, json_t *item)
{
    if (!json_object_get(object, key))
        gltf_put(w, object, key, json_array());
    json_t *list = json_object_get(object, key);
    if (json_array_append_new(list, item) != 0) {
        w->no_memory = true;
        return 0;
    }
    return (uint32_t)json_array_size(list) - 1;
}

uint32_t gltf_add_view(gltf_writer *w, void *data, size_t size, int target)
{
    if (!data ||
        !array_reserve(&w->pieces, &w->pieces_capacity, w->pieces_count + 1, sizeof *w->pieces)) {
        free(data);
        w->no_memory = true;
        return 0;
    }
    w->pieces[w->pieces_count++] = (gltf_piece) { data, size };
    json_t *view = json_object();
    gltf_put_index(w, view, "buffer", 0);
    gltf_put_index(w, view, "byteOffset", w->bin_size);
    gltf_put_index(w, view, "byteLength", size);
    if (target)
        gltf_put_index(w, view, "target", (size_t)target);
    w->bin_size += (size + 3) / 4 * 4;
    return gltf_append(w, w->root, "bufferViews", view);
}
