// Fuzz target: the PNG decoder, with the chunks' checksums made right, as nothing behind
// them would be reached otherwise.
#include "fuzz_image.h"

#include <string.h>

static uint32_t checksum(const uint8_t *data, size_t size)
{
    uint32_t v = 0xffffffff;
    for (size_t i = 0; i < size; i++) {
        v ^= data[i];
        for (int bit = 0; bit < 8; bit++)
            v = v >> 1 ^ (v & 1 ? 0xedb88320 : 0);
    }
    return ~v;
}

static void repair(uint8_t *data, size_t size)
{
    for (size_t at = 8; at + 12 <= size;) {
        const uint8_t *p = data + at;
        size_t length = (size_t)p[0] << 24 | (size_t)p[1] << 16 | (size_t)p[2] << 8 | p[3];
        if (length > size - at - 12)
            return;
        uint32_t crc = checksum(p + 4, length + 4);
        for (int i = 0; i < 4; i++)
            data[at + 8 + length + (size_t)i] = (uint8_t)(crc >> (24 - 8 * i));
        at += length + 12;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint8_t *copy = malloc(size ? size : 1);
    if (!copy)
        return 0;
    if (size)
        memcpy(copy, data, size);
    repair(copy, size);
    fuzz_decoder(image_decode_png, copy, size);
    free(copy);
    return 0;
}
