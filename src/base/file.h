// Whole files: read into memory, written beside their place and renamed.
#ifndef AG_BASE_FILE_H
#define AG_BASE_FILE_H

#include <argand/base.h>

// Read a whole regular file; `*data` is the caller's to free().  AG_ERROR_FILE when it
// cannot be opened, is a folder, or is above `limit` bytes.  One zero byte, not
// counted in `*size`, follows the data.
AG_CHECK ag_status file_read(const ag_log *log, const char *path, size_t limit, void **data,
                             size_t *size);

// Write a whole file, or nothing: the bytes go to a temporary file in the same folder,
// which is renamed when it is complete.
AG_CHECK ag_status file_write(const ag_log *log, const char *path, const void *data, size_t size);

// A writer for encoders that produce their bytes piece by piece.
typedef struct file_writer file_writer;
AG_CHECK ag_status file_writer_open(const ag_log *log, const char *path, file_writer **writer);
// One whose bytes stay in memory.
AG_CHECK ag_status file_writer_open_memory(const ag_log *log, const char *name,
                                           file_writer **writer);
AG_CHECK ag_status file_writer_put(file_writer *writer, const void *data, size_t size);
// Finish: rename into place.  The writer is gone after any of the three.
AG_CHECK ag_status file_writer_commit(file_writer *writer);
// Finish one in memory: `*data` is the caller's to free().
void file_writer_take(file_writer *writer, void **data, size_t *size);
void file_writer_abandon(file_writer *writer); // NULL is allowed

#endif
