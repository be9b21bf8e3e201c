// Baked environments kept on disk, by the content they were made from.
#include "bake/cache.h"

#include "base/array.h"
#include "base/cache.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/threads.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static const char FOLDER[] = "environments";
static const char ENDING[] = ".argand-environment";
static const char TEMPORARY[] = ".tmp"; // what base/file.h writes before it renames

enum {
    HASH_CHUNK = 1 << 20,   // bytes
    HASH_CHUNKS_MAX = 4096, // the last one takes what is left
    STALE_AFTER = 3600,     // s: a temporary file of a process that died
};

typedef struct header {
    char magic[8];
    uint64_t key;
    uint64_t hash; // of the coefficients and the cube
    uint64_t cube_bytes;
    uint32_t size, mip_count;
    float sh[9][3];
    uint32_t unused; // no padding bytes
} header;
_Static_assert(sizeof(header) == 152, "the file's header has no holes");

static const char MAGIC[8] = "ARGENV1";

typedef struct hashing {
    const unsigned char *data;
    size_t size, count;
    uint64_t chunks[HASH_CHUNKS_MAX];
} hashing;

static void hash_chunk(void *context, size_t index)
{
    hashing *h = context;
    size_t start = index * HASH_CHUNK;
    size_t size = index + 1 == h->count ? h->size - start : HASH_CHUNK;
    h->chunks[index] = hash_bytes(h->data + start, size, 0);
}

uint64_t bake_cache_hash(const void *data, size_t size, uint64_t seed)
{
    hashing h = { .data = data, .size = size, .count = (size + HASH_CHUNK - 1) / HASH_CHUNK };
    if (h.count > HASH_CHUNKS_MAX)
        h.count = HASH_CHUNKS_MAX;
    parallel_for(h.count, hash_chunk, &h);
    return hash_bytes(h.chunks, h.count * sizeof *h.chunks, seed ^ size);
}

static uint64_t content_hash(const bake_environment *e)
{
    uint64_t seed = hash_bytes(e->sh, sizeof e->sh, 0);
    return bake_cache_hash(e->cube, e->cube_bytes, seed);
}

static bool entry_path(char path[CACHE_PATH_MAX], const char *folder, uint64_t key)
{
    int length =
        snprintf(path, CACHE_PATH_MAX, "%s/%016llx%s", folder, (unsigned long long)key, ENDING);
    return length > 0 && length < CACHE_PATH_MAX;
}

// Take an environment out of a file's bytes; false unless every one of them is right.
static bool decode(uint64_t key, const void *data, size_t bytes, bake_environment *out)
{
    header h;
    if (bytes < sizeof h)
        return false;
    memcpy(&h, data, sizeof h);
    if (memcmp(h.magic, MAGIC, sizeof MAGIC) != 0 || h.key != key ||
        h.cube_bytes != bytes - sizeof h || h.size > 4096 || h.mip_count > 13 ||
        h.cube_bytes != bake_environment_bytes(h.size, h.mip_count))
        return false;
    bake_environment e = { .size = h.size, .mip_count = h.mip_count };
    e.cube_bytes = (size_t)h.cube_bytes;
    memcpy(e.sh, h.sh, sizeof e.sh);
    e.cube = malloc(e.cube_bytes + 1);
    if (!e.cube)
        return false;
    memcpy(e.cube, (const char *)data + sizeof h, e.cube_bytes);
    if (content_hash(&e) != h.hash) {
        free(e.cube);
        return false;
    }
    *out = e;
    return true;
}

bool bake_cache_find(uint64_t key, bake_environment *out)
{
    char folder[CACHE_PATH_MAX], path[CACHE_PATH_MAX];
    if (!cache_directory(FOLDER, folder) || !entry_path(path, folder, key))
        return false;
    log_buffer ignored = { 0 }; // that it is not there is no error
    ag_log log = log_to_buffer(&ignored);
    void *data;
    size_t size;
    if (file_read(&log, path, BAKE_CACHE_LIMIT, &data, &size))
        return false;
    bool found = decode(key, data, size, out);
    free(data);
    if (found)
        utimensat(AT_FDCWD, path, NULL, 0); // used now; no harm if it cannot be noted
    return found;
}

static ag_status write_entry(const ag_log *log, const char *path, uint64_t key,
                             const bake_environment *e)
{
    header h = { .key = key, .hash = content_hash(e), .cube_bytes = e->cube_bytes };
    h.size = e->size;
    h.mip_count = e->mip_count;
    memcpy(h.magic, MAGIC, sizeof MAGIC);
    memcpy(h.sh, e->sh, sizeof h.sh);
    file_writer *writer;
    ag_status status = file_writer_open(log, path, &writer);
    if (status)
        return status;
    status = file_writer_put(writer, &h, sizeof h);
    if (!status)
        status = file_writer_put(writer, e->cube, e->cube_bytes);
    if (!status)
        return file_writer_commit(writer);
    file_writer_abandon(writer);
    return status;
}

void bake_cache_store(const ag_log *log, uint64_t key, const bake_environment *environment)
{
    char folder[CACHE_PATH_MAX], path[CACHE_PATH_MAX];
    if (!cache_wanted())
        return;
    if (!cache_directory(FOLDER, folder) || !entry_path(path, folder, key)) {
        log_write(log, AG_LOG_WARNING,
                  "the environment is not cached: there is no folder for it that can be written; "
                  "set ARGAND_CACHE_DIR to one, or ARGAND_NO_CACHE=1");
        return;
    }
    log_buffer failure = { 0 };
    ag_log quiet = log_to_buffer(&failure);
    if (write_entry(&quiet, path, key, environment))
        log_write(log, AG_LOG_WARNING, "the environment is not cached: %s", failure.text);
    else
        bake_cache_trim(folder, BAKE_CACHE_LIMIT);
}

typedef struct entry {
    char name[64];
    struct timespec used;
    size_t bytes;
} entry;

static bool ends_with(const char *text, const char *ending)
{
    size_t length = strlen(text), tail = strlen(ending);
    return length >= tail && strcmp(text + length - tail, ending) == 0;
}

static int by_age(const void *a, const void *b)
{
    const struct timespec *x = &((const entry *)a)->used, *y = &((const entry *)b)->used;
    if (x->tv_sec != y->tv_sec)
        return x->tv_sec < y->tv_sec ? -1 : 1;
    return (x->tv_nsec > y->tv_nsec) - (x->tv_nsec < y->tv_nsec);
}

void bake_cache_trim(const char *folder, size_t limit)
{
    DIR *dir = opendir(folder);
    if (!dir)
        return;
    entry *entries = NULL;
    size_t count = 0, capacity = 0, total = 0;
    time_t now = time(NULL);
    for (struct dirent *d; (d = readdir(dir));) {
        struct stat st;
        bool whole = ends_with(d->d_name, ENDING);
        if ((!whole && !ends_with(d->d_name, TEMPORARY)) || strlen(d->d_name) >= 64 ||
            fstatat(dirfd(dir), d->d_name, &st, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISREG(st.st_mode))
            continue;
        if (!whole) {
            if (now - st.st_mtim.tv_sec > STALE_AFTER)
                unlinkat(dirfd(dir), d->d_name, 0);
            continue;
        }
        if (!array_reserve(&entries, &capacity, count + 1, sizeof *entries))
            break;
        entry *e = &entries[count++];
        memcpy(e->name, d->d_name, strlen(d->d_name) + 1); // below 64, see above
        e->used = st.st_mtim;
        e->bytes = (size_t)st.st_size;
        total += e->bytes;
    }
    if (count)
        qsort(entries, count, sizeof *entries, by_age);
    for (size_t i = 0; i < count && total > limit; i++) {
        unlinkat(dirfd(dir), entries[i].name, 0);
        total -= entries[i].bytes;
    }
    free(entries);
    closedir(dir);
}
