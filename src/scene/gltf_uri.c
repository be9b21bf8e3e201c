// URIs: data URIs (RFC 2397, base64 of RFC 4648 section 4), and files in the glTF
// file's own folder and below.
#define _XOPEN_SOURCE 700 // realpath
#include "base/file.h"
#include "base/log.h"
#include "scene/gltf.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_LIMIT_GIB = 16 };

bool gltf_uri_is_data(const char *uri)
{
    return strncmp(uri, "data:", 5) == 0;
}

static int base64_value(char c)
{
    if (c >= 'A' && c <= 'Z')
        return c - 'A';
    if (c >= 'a' && c <= 'z')
        return c - 'a' + 26;
    if (c >= '0' && c <= '9')
        return c - '0' + 52;
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

// Decode `length` characters, a multiple of 4, padding included; false when they are
// not base64.
static bool base64_decode(const char *text, size_t length, uint8_t *out, size_t *size)
{
    size_t padding = 0;
    while (padding < 2 && padding < length && text[length - 1 - padding] == '=')
        padding++;
    *size = length / 4 * 3 - padding;
    size_t written = 0;
    for (size_t i = 0; i < length; i += 4) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 4; k++) {
            int value = i + k >= length - padding ? 0 : base64_value(text[i + k]);
            if (value < 0)
                return false;
            bits = bits << 6 | (uint32_t)value;
        }
        for (unsigned shift = 16; written < *size && shift <= 16; shift -= 8)
            out[written++] = (uint8_t)(bits >> shift);
    }
    return true;
}

static ag_status read_data(const gltf_file *file, const ag_log *log, const char *where,
                           const char *uri, void **data, size_t *size)
{
    static const char coding[] = ";base64";
    const char *comma = strchr(uri, ',');
    size_t head = comma ? (size_t)(comma - uri) : 0;
    if (head < sizeof coding - 1 ||
        strncmp(comma - (sizeof coding - 1), coding, sizeof coding - 1) != 0)
        return log_fail(log, AG_ERROR_FORMAT, "%s: %s: is a data URI that is not base64",
                        file->path, where);
    size_t length = strlen(comma + 1);
    uint8_t *bytes = malloc(length / 4 * 3 + 1);
    if (!bytes)
        return log_fail(log, AG_ERROR_MEMORY, "%s: %s: there is no memory for it", file->path,
                        where);
    if (length % 4 != 0 || !base64_decode(comma + 1, length, bytes, size)) {
        free(bytes);
        return log_fail(log, AG_ERROR_FORMAT, "%s: %s: its base64 is broken", file->path, where);
    }
    *data = bytes;
    return AG_OK;
}

static bool has_scheme(const char *uri)
{
    size_t length = strspn(uri, "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
                                "0123456789+-.");
    return length > 0 && uri[length] == ':';
}

static int hex_value(char c)
{
    static const char digits[] = "0123456789abcdef0123456789ABCDEF";
    const char *at = c ? strchr(digits, c) : NULL;
    return at ? (int)((at - digits) % 16) : -1;
}

// Decode %XX in place; false for a broken escape or a zero byte.
static bool percent_decode(char *text)
{
    char *to = text;
    for (const char *from = text; *from; from++) {
        char c = *from;
        if (c == '%') {
            int high = hex_value(from[1]), low = high < 0 ? -1 : hex_value(from[2]);
            if (low < 0 || high * 16 + low == 0)
                return false;
            c = (char)(high * 16 + low);
            from += 2;
        }
        *to++ = c;
    }
    *to = 0;
    return true;
}

// Whether "a/../../b" leaves the folder it starts in, whatever exists on disk.
static bool climbs_out(const char *path)
{
    long depth = 0;
    while (*path) {
        size_t length = strcspn(path, "/");
        if (length == 2 && memcmp(path, "..", 2) == 0)
            depth--;
        else if (length > 0 && !(length == 1 && path[0] == '.'))
            depth++;
        if (depth < 0)
            return true;
        path += length + (path[length] == '/');
    }
    return false;
}

ag_status gltf_uri_prepare(gltf_file *file)
{
    if (file->folder)
        return AG_OK;
    const char *slash = strrchr(file->path, '/');
    size_t length = slash ? (size_t)(slash - file->path) + 1 : 0;
    char *folder = slash ? strndup(file->path, length) : strdup(".");
    char *real = folder ? realpath(folder, NULL) : NULL;
    free(folder);
    size_t size = real ? strlen(real) : 0;
    char *ended = real ? realloc(real, size + 2) : NULL;
    if (!ended) {
        free(real);
        return log_fail(&file->log, AG_ERROR_FILE, "%s: its folder cannot be found: %s", file->path,
                        strerror(errno));
    }
    if (ended[size - 1] != '/')
        memcpy(ended + size, "/", 2);
    file->folder = ended;
    return AG_OK;
}

// The real path of `name`, links followed; NULL and a status when it may not be read.
static ag_status resolve(const gltf_file *file, const ag_log *log, const char *where,
                         const char *uri, const char *name, char **real)
{
    if (climbs_out(name))
        return log_fail(log, AG_ERROR_FORMAT, "%s: %s: \"%.200s\" climbs out of the file's folder",
                        file->path, where, uri);
    size_t folder = strlen(file->folder), length = strlen(name);
    char *joined = malloc(folder + length + 1);
    if (!joined)
        return log_fail(log, AG_ERROR_MEMORY, "%s: %s: there is no memory for it", file->path,
                        where);
    memcpy(joined, file->folder, folder);
    memcpy(joined + folder, name, length + 1);
    *real = realpath(joined, NULL);
    free(joined);
    if (!*real)
        return log_fail(log, AG_ERROR_FILE, "%s: %s: \"%.200s\" cannot be opened: %s", file->path,
                        where, uri, strerror(errno));
    if (strncmp(*real, file->folder, folder) != 0) {
        free(*real);
        *real = NULL;
        return log_fail(log, AG_ERROR_FORMAT,
                        "%s: %s: \"%.200s\" does not lie in the file's folder", file->path, where,
                        uri);
    }
    return AG_OK;
}

static ag_status read_named(const gltf_file *file, const ag_log *log, const char *where,
                            const char *uri, char *name, void **data, size_t *size)
{
    if (!percent_decode(name) || !name[0])
        return log_fail(log, AG_ERROR_FORMAT, "%s: %s: \"%.200s\" is not a file's name", file->path,
                        where, uri);
    if (name[0] == '/')
        return log_fail(log, AG_ERROR_FORMAT,
                        "%s: %s: \"%.200s\" is absolute; it must lie in the file's folder",
                        file->path, where, uri);
    char *real = NULL;
    ag_status status = resolve(file, log, where, uri, name, &real);
    if (status)
        return status;
    status = file_read(log, real, (size_t)FILE_LIMIT_GIB << 30, data, size);
    free(real);
    return status;
}

ag_status gltf_uri_read(const gltf_file *file, const ag_log *log, const char *where,
                        const char *uri, void **data, size_t *size)
{
    *data = NULL;
    *size = 0;
    if (gltf_uri_is_data(uri))
        return read_data(file, log, where, uri, data, size);
    if (has_scheme(uri))
        return log_fail(log, AG_ERROR_UNSUPPORTED,
                        "%s: %s: \"%.200s\" names a scheme; only data: and files are read",
                        file->path, where, uri);
    char *name = strdup(uri);
    if (!name)
        return log_fail(log, AG_ERROR_MEMORY, "%s: %s: there is no memory for it", file->path,
                        where);
    ag_status status = read_named(file, log, where, uri, name, data, size);
    free(name);
    return status;
}
