// Fuzz target: the WebP decoder.
#include "fuzz_image.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    return fuzz_decoder(image_decode_webp, data, size);
}
