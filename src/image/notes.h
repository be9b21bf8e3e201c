// Notes: facts that are stored with an image.
#ifndef AG_IMAGE_NOTES_H
#define AG_IMAGE_NOTES_H

#include "image/image.h"

// AG_ERROR_ARGUMENT, after a sentence about the file `name`, unless keys and texts are sound.
AG_CHECK ag_status notes_check(const ag_log *log, const char *name, const ag_image_note *notes,
                               size_t count);

// A note as a chunk of PNG.
typedef struct note_chunk {
    const char *type; // "tEXt", or "iTXt" where the text is not ASCII
    uint8_t *data;
    size_t size;
} note_chunk;

// All of them, to be destroyed; NULL when there is no memory.
note_chunk *note_chunks_create(const ag_image_note *notes, size_t count);
void note_chunks_destroy(note_chunk *chunks, size_t count); // NULL is allowed

#endif
