// A fast 64-bit hash of bytes, for cache keys; not for adversaries.
#ifndef AG_BASE_HASH_H
#define AG_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

// Hash `size` bytes, continuing from `seed` (0 to begin).
uint64_t hash_bytes(const void *data, size_t size, uint64_t seed);

#endif
