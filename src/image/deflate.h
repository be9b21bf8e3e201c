// Deflate (RFC 1951) for speed: dynamic Huffman codes and runs of one byte, no search.
//
// Made for filtered PNG rows, where it packs about as well as zlib at its fast levels in a
// fraction of their time: what repeats there is mostly a run of zeros.
#ifndef AG_IMAGE_DEFLATE_H
#define AG_IMAGE_DEFLATE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Room that deflate_runs() may need for `size` bytes.
size_t deflate_bound(size_t size);

// One block that is not the last, ending on a whole byte, so that such pieces can be made
// side by side and put one behind the other.  `tokens` is room for `size` of them, `out`
// for deflate_bound(size) bytes.  Returns the bytes written.
size_t deflate_runs(const uint8_t *data, size_t size, uint16_t *tokens, uint8_t *out);

// The last block, empty: 5 bytes.  Returns 5.
size_t deflate_end(uint8_t *out);

// Adler-32 (RFC 1950) of `size` more bytes after those of `adler` (1 to begin).
uint32_t deflate_adler(uint32_t adler, const uint8_t *data, size_t size);

// ... of two pieces, the second of `size` bytes.
uint32_t deflate_adler_join(uint32_t first, uint32_t second, size_t size);

#endif
