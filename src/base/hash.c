// A fast 64-bit hash of bytes, for cache keys; not for adversaries.
//
// Eight bytes a step through the finaliser of SplitMix64 (Steele, Lea, Flood 2014,
// fig. 19 with Stafford's mix 13), chained.
#include "base/hash.h"

#include <string.h>

static uint64_t mix(uint64_t x)
{
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

uint64_t hash_bytes(const void *data, size_t size, uint64_t seed)
{
    const unsigned char *bytes = data;
    uint64_t h = mix(seed + 0x9e3779b97f4a7c15u + size);
    for (; size >= 8; bytes += 8, size -= 8) {
        uint64_t word;
        memcpy(&word, bytes, 8);
        h = mix(h ^ word) + 0x9e3779b97f4a7c15u;
    }
    uint64_t tail = 0;
    memcpy(&tail, bytes, size);
    return mix(h ^ tail);
}
