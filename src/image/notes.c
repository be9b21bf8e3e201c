// Notes: facts that are stored with an image.
#include "image/notes.h"

#include "base/log.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { KEY_MAX = 31, TEXT_MAX = 1 << 24 }; // OpenEXR's short names; bytes

// ISO/IEC 15948, 11.3.4.2: no space leads, ends or follows another.
static bool key_is_sound(const char *key)
{
    size_t length = key ? strlen(key) : 0;
    if (length == 0 || length > KEY_MAX || key[length - 1] == ' ')
        return false;
    for (size_t i = 0; i < length; i++)
        if (key[i] < ' ' || key[i] > '~' || (key[i] == ' ' && (i == 0 || key[i - 1] == ' ')))
            return false;
    return true;
}

static bool key_is_taken(const ag_image_note *notes, size_t index)
{
    for (size_t i = 0; i < index; i++)
        if (strcmp(notes[i].key, notes[index].key) == 0)
            return true;
    return false;
}

ag_status notes_check(const ag_log *log, const char *name, const ag_image_note *notes, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!key_is_sound(notes[i].key))
            return log_fail(log, AG_ERROR_ARGUMENT,
                            "%s: note %zu has no key of 1 to 31 printable characters", name, i);
        if (key_is_taken(notes, i))
            return log_fail(log, AG_ERROR_ARGUMENT, "%s: note '%s' is there twice", name,
                            notes[i].key);
        if (notes[i].text && strlen(notes[i].text) > TEXT_MAX)
            return log_fail(log, AG_ERROR_ARGUMENT, "%s: note '%s' is longer than 2^24 bytes", name,
                            notes[i].key);
    }
    return AG_OK;
}

static bool is_ascii(const char *text)
{
    for (; *text; text++)
        if (*text < 0)
            return false;
    return true;
}

static note_chunk make_chunk(const ag_image_note *note)
{
    char number[32];
    snprintf(number, sizeof number, "%.9g", note->number);
    const char *text = note->text ? note->text : number;
    bool ascii = is_ascii(text);
    // Behind the key: its zero, and in iTXt no compression, no language, no translated key.
    size_t key = strlen(note->key), zeros = ascii ? 1 : 5, length = strlen(text);
    note_chunk chunk = {
        .type = ascii ? "tEXt" : "iTXt",
        .data = calloc(1, key + zeros + length),
        .size = key + zeros + length,
    };
    if (chunk.data) {
        memcpy(chunk.data, note->key, key);
        memcpy(chunk.data + key + zeros, text, length);
    }
    return chunk;
}

note_chunk *note_chunks_create(const ag_image_note *notes, size_t count)
{
    note_chunk *chunks = calloc(count + 1, sizeof *chunks);
    bool sound = chunks;
    for (size_t i = 0; i < count && sound; i++) {
        chunks[i] = make_chunk(&notes[i]);
        sound = chunks[i].data;
    }
    if (sound)
        return chunks;
    note_chunks_destroy(chunks, count);
    return NULL;
}

void note_chunks_destroy(note_chunk *chunks, size_t count)
{
    for (size_t i = 0; i < count && chunks; i++)
        free(chunks[i].data);
    free(chunks);
}
