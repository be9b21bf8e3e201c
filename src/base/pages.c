// Large pages for large blocks of memory.
#define _DEFAULT_SOURCE
#include "base/pages.h"

#include <stdint.h>
#include <sys/mman.h>

void pages_prefer_large(void *memory, size_t size)
{
#ifdef MADV_HUGEPAGE
    const uintptr_t large = 2u << 20;
    uintptr_t begin = ((uintptr_t)memory + large - 1) / large * large;
    uintptr_t end = ((uintptr_t)memory + size) / large * large;
    if (memory && begin < end) // only whole large pages of this block
        madvise((void *)begin, end - begin, MADV_HUGEPAGE);
#else
    (void)memory;
    (void)size;
#endif
}
