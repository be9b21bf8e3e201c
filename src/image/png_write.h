// The two ways in which PNG files are written.
#ifndef AG_IMAGE_PNG_WRITE_H
#define AG_IMAGE_PNG_WRITE_H

#include "image/codec.h"
#include "image/notes.h"

// Rows wider than this are left to the small way.
enum { PNG_FAST_WIDTH_MAX = 1 << 20 };

// Every row with PNG's filter number `filter` (2 Up, 4 Paeth), runs only; RGB if `opaque`.
AG_CHECK ag_status png_write_fast(const ag_log *log, const char *name, const ag_image *image,
                                  bool opaque, int filter, const note_chunk *notes,
                                  size_t note_count, file_writer *out);

#endif
