// Baked environments kept on disk, by the content they were made from.
//
// One file an environment in the cache's folder (base/cache.h): written beside its place
// and renamed, so that any number of processes may use it at once; checked whole when it
// is read, and made again where it is damaged; 256 MiB in all, the longest unused removed.
// ARGAND_CACHE_DIR names another folder, ARGAND_NO_CACHE=1 means none.
#ifndef AG_BAKE_CACHE_H
#define AG_BAKE_CACHE_H

#include "bake/environment.h"

#include <stdbool.h>

#define BAKE_CACHE_LIMIT ((size_t)256 << 20) // bytes

// A hash of `size` bytes, on all cores.
uint64_t bake_cache_hash(const void *data, size_t size, uint64_t seed);

// Find what was stored under `key`.  False when it is not there or not whole.
bool bake_cache_find(uint64_t key, bake_environment *out);

// Store under `key`; a warning where that is not possible.
void bake_cache_store(const ag_log *log, uint64_t key, const bake_environment *environment);

// Remove the longest unused environments of `folder` until at most `limit` bytes are left.
void bake_cache_trim(const char *folder, size_t limit);

#endif
