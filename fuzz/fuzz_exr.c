// Fuzz target: the OpenEXR decoder.
#include "fuzz_image.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    return fuzz_decoder(image_decode_exr, data, size);
}
