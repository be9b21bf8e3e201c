// Growing arrays: `type *items; size_t count, capacity`.
#ifndef AG_BASE_ARRAY_H
#define AG_BASE_ARRAY_H

#include <stdbool.h>
#include <stddef.h>

// Make room for `wanted` items of `size` bytes; false when there is no memory, and
// then nothing changed.  `items` is the address of the array's pointer.
bool array_reserve(void *items, size_t *capacity, size_t wanted, size_t size);

#endif
