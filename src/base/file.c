// Whole files: read into memory, written beside their place and renamed.
#include "base/file.h"

#include "base/log.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static ag_status read_all(const ag_log *log, const char *path, int fd, size_t size, void **data)
{
    char *bytes = malloc(size + 1);
    if (!bytes)
        return log_fail(log, AG_ERROR_MEMORY, "%s: no memory for %zu bytes", path, size);
    size_t done = 0;
    while (done < size) {
        ssize_t n = read(fd, bytes + done, size - done);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0) {
            free(bytes);
            return log_fail(log, AG_ERROR_FILE, "%s: cannot be read: %s", path,
                            n < 0 ? strerror(errno) : "it became shorter meanwhile");
        }
        done += (size_t)n;
    }
    bytes[size] = 0;
    *data = bytes;
    return AG_OK;
}

ag_status file_read(const ag_log *log, const char *path, size_t limit, void **data, size_t *size)
{
    *data = NULL;
    *size = 0;
    int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0)
        return log_fail(log, AG_ERROR_FILE, "%s: cannot be opened: %s", path, strerror(errno));
    ag_status status;
    struct stat st = { 0 };
    if (fstat(fd, &st) != 0 || !S_ISREG(st.st_mode))
        status = log_fail(log, AG_ERROR_FILE, "%s: is %s", path,
                          S_ISDIR(st.st_mode) ? "a folder" : "not a regular file");
    else if ((uint64_t)st.st_size > limit)
        status = log_fail(log, AG_ERROR_FILE, "%s: has %lld bytes, more than the limit of %zu",
                          path, (long long)st.st_size, limit);
    else
        status = read_all(log, path, fd, (size_t)st.st_size, data);
    close(fd);
    if (!status)
        *size = (size_t)st.st_size;
    return status;
}

struct file_writer {
    ag_log log;
    char *path;
    char *temporary;
    int fd;
    char *memory; // instead of a file
    size_t size, capacity;
};

static void writer_free(file_writer *writer)
{
    if (writer->fd >= 0)
        close(writer->fd);
    free(writer->path);
    free(writer->temporary);
    free(writer->memory);
    free(writer);
}

// The file that `path` stands for, through symbolic links, also where the last one points
// to a file that is not there yet; the caller's to free().
static char *follow_links(const char *path)
{
    char *at = strdup(path);
    for (int i = 0; i < 40 && at; i++) { // as many as the kernel follows
        char target[4096];
        ssize_t length = readlink(at, target, sizeof target - 1);
        if (length < 0)
            break; // no link
        target[length] = 0;
        const char *slash = strrchr(at, '/');
        size_t folder = *target == '/' || !slash ? 0 : (size_t)(slash - at) + 1;
        char *next = malloc(folder + (size_t)length + 1);
        if (next) {
            memcpy(next, at, folder);
            memcpy(next + folder, target, (size_t)length + 1);
        }
        free(at);
        at = next;
    }
    return at;
}

ag_status file_writer_open(const ag_log *log, const char *path, file_writer **out)
{
    *out = NULL;
    file_writer *writer = calloc(1, sizeof *writer);
    char *copy = follow_links(path); // a link stays a link
    size_t length = copy ? strlen(copy) : 0;
    char *temporary = malloc(length + 32);
    if (!writer || !copy || !temporary) {
        free(writer);
        free(copy);
        free(temporary);
        return log_fail(log, AG_ERROR_MEMORY, "%s: no memory to write it", path);
    }
    *writer = (file_writer) { log_resolve(log), copy, temporary, .fd = -1 };
    for (unsigned i = 0; i < 100; i++) { // a name of our own, whoever else writes there
        snprintf(temporary, length + 32, "%s.%ld-%u.tmp", copy, (long)getpid(), i);
        writer->fd = open(temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (writer->fd >= 0 || errno != EEXIST)
            break;
    }
    if (writer->fd < 0) {
        ag_status status =
            log_fail(log, AG_ERROR_FILE, "%s: cannot be created: %s", path, strerror(errno));
        writer_free(writer);
        return status;
    }
    *out = writer;
    return AG_OK;
}

ag_status file_writer_open_memory(const ag_log *log, const char *name, file_writer **out)
{
    *out = NULL;
    file_writer *writer = calloc(1, sizeof *writer);
    char *copy = strdup(name);
    if (!writer || !copy) {
        free(writer);
        free(copy);
        return log_fail(log, AG_ERROR_MEMORY, "%s: no memory to write it", name);
    }
    *writer = (file_writer) { log_resolve(log), copy, .fd = -1 };
    *out = writer;
    return AG_OK;
}

void file_writer_take(file_writer *writer, void **data, size_t *size)
{
    *data = writer->memory;
    *size = writer->size;
    writer->memory = NULL;
    writer_free(writer);
}

static ag_status append(file_writer *writer, const void *data, size_t size)
{
    if (size > writer->capacity - writer->size) {
        size_t capacity = 2 * (writer->size + size);
        char *grown = realloc(writer->memory, capacity);
        if (!grown)
            return log_fail(&writer->log, AG_ERROR_MEMORY, "%s: no memory to write it",
                            writer->path);
        writer->memory = grown;
        writer->capacity = capacity;
    }
    memcpy(writer->memory + writer->size, data, size);
    writer->size += size;
    return AG_OK;
}

ag_status file_writer_put(file_writer *writer, const void *data, size_t size)
{
    if (!writer->temporary)
        return append(writer, data, size);
    const char *bytes = data;
    while (size) {
        ssize_t n = write(writer->fd, bytes, size);
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0)
            return log_fail(&writer->log, AG_ERROR_FILE, "%s: cannot be written: %s", writer->path,
                            strerror(errno));
        bytes += n;
        size -= (size_t)n;
    }
    return AG_OK;
}

ag_status file_writer_commit(file_writer *writer)
{
    int closed = close(writer->fd);
    writer->fd = -1;
    if (closed != 0 || rename(writer->temporary, writer->path) != 0) {
        ag_status status = log_fail(&writer->log, AG_ERROR_FILE, "%s: cannot be written: %s",
                                    writer->path, strerror(errno));
        unlink(writer->temporary);
        writer_free(writer);
        return status;
    }
    writer_free(writer);
    return AG_OK;
}

void file_writer_abandon(file_writer *writer)
{
    if (!writer)
        return;
    if (writer->temporary)
        unlink(writer->temporary);
    writer_free(writer);
}

ag_status file_write(const ag_log *log, const char *path, const void *data, size_t size)
{
    file_writer *writer;
    ag_status status = file_writer_open(log, path, &writer);
    if (status)
        return status;
    status = file_writer_put(writer, data, size);
    if (status) {
        file_writer_abandon(writer);
        return status;
    }
    return file_writer_commit(writer);
}
