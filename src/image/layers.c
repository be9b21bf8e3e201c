// Writing images as the layers of one OpenEXR file.
#include "image/codec.h"

#include "base/log.h"
#include "image/notes.h"

#include <string.h>
#include <strings.h>

enum { NAME_MAX_LENGTH = 29 }; // with a dot and a letter, what every reader takes

static bool ends_in_exr(const char *path)
{
    size_t length = strlen(path);
    return length >= 4 && strcasecmp(path + length - 4, ".exr") == 0;
}

static bool is_letter(char c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

// One to four letters, none of them twice.
static bool channels_are_sound(const char *channels)
{
    size_t length = strlen(channels);
    for (size_t i = 0; i < length; i++)
        if (!is_letter(channels[i]) || strchr(channels + i + 1, channels[i]))
            return false;
    return length >= 1 && length <= 4;
}

static const char *name_of(const ag_image_layer *layer)
{
    return layer->name ? layer->name : "";
}

static bool name_is_taken(const ag_image_layer *layers, size_t index)
{
    for (size_t i = 0; i < index; i++)
        if (strcmp(name_of(&layers[i]), name_of(&layers[index])) == 0)
            return true;
    return false;
}

// What is wrong with a layer, to stand behind its name; NULL when nothing is.
static const char *complaint(const ag_image_layer *layers, size_t index)
{
    const ag_image_layer *l = &layers[index];
    if (l->image->format != AG_FORMAT_RGBA32F)
        return "is of bytes, not of floats";
    if (l->image->width != layers->image->width || l->image->height != layers->image->height)
        return "is not as large as the first";
    if (strlen(name_of(l)) > NAME_MAX_LENGTH)
        return "has a name above 29 bytes";
    if (name_is_taken(layers, index))
        return "is there twice";
    if (l->channels && !channels_are_sound(l->channels))
        return "has channels that are not one to four different letters";
    return NULL;
}

static ag_status check(const ag_log *log, const ag_image_layer *layers, size_t count,
                       const char *path)
{
    if (!ends_in_exr(path))
        return log_fail(log, AG_ERROR_ARGUMENT, "%s: only .exr has layers", path);
    if (count == 0)
        return log_fail(log, AG_ERROR_ARGUMENT, "%s: there are no layers to write", path);
    for (size_t i = 0; i < count; i++) {
        const char *wrong = complaint(layers, i);
        if (wrong)
            return log_fail(log, AG_ERROR_ARGUMENT, "%s: layer '%s' %s", path, name_of(&layers[i]),
                            wrong);
    }
    return AG_OK;
}

ag_status ag_image_save_layers(const ag_log *log, const ag_image_layer *layers, size_t count,
                               const char *path, const ag_image_save_options *options)
{
    ag_image_save_options o = options ? *options : (ag_image_save_options) { 0 };
    ag_status status = check(log, layers, count, path);
    if (!status)
        status = notes_check(log, path, o.notes, o.note_count);
    file_writer *writer;
    if (!status)
        status = file_writer_open(log, path, &writer);
    if (status)
        return status;
    status = image_encode_exr_layers(log, path, layers, count, &o, writer);
    if (!status)
        return file_writer_commit(writer);
    file_writer_abandon(writer);
    return status;
}
