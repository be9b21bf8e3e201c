// Large pages for large blocks of memory.
#ifndef AG_BASE_PAGES_H
#define AG_BASE_PAGES_H

#include <stddef.h>

// Ask for large pages behind `size` bytes that are about to be written: the system then
// stops once for 2 MiB instead of once for 4 KiB, which for a few hundred MiB is a tenth
// of a second.  A wish, no more; small blocks are left alone.
void pages_prefer_large(void *memory, size_t size);

#endif
