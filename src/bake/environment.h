// An environment prepared for shading: a prefiltered cube and irradiance in two forms.
#ifndef AG_BAKE_ENVIRONMENT_H
#define AG_BAKE_ENVIRONMENT_H

#include <argand/image.h>

typedef struct bake_environment {
    uint32_t size;      // px, edge of a face of mip 0; a power of two
    uint32_t mip_count; // mip m holds the environment filtered for environment_roughness(m)
    // RGBA half floats, nit: mip by mip, in each the faces +X -X +Y -Y +Z -Z, rows and
    // columns as Vulkan's cube maps have them.  From malloc.
    // After the last mip follow the six faces of the irradiance cube, the accurate form:
    // irradiance / pi (what a white Lambert surface reflects) for the normal at a texel.
    uint16_t *cube;
    size_t cube_bytes;
    // The radiance as order-2 spherical harmonics, the cheap form: the coefficients that
    // sh_irradiance() of physics/sh.glsl takes.  Errs by 5 % where light is uneven.
    float sh[9][3];
} bake_environment;

enum { BAKE_IRRADIANCE_SIZE = 32 }; // px, edge of a face of the irradiance cube

// Bytes from the start of the cube to face 0 of mip `mip`; for mip_count, to the
// irradiance cube.
size_t bake_environment_mip_offset(uint32_t size, uint32_t mip);

// Bytes of the cube in all.
size_t bake_environment_bytes(uint32_t size, uint32_t mip_count);

// Prepare an equirectangular RGBA32F image (centre = +X, top = +Y), on all cores, or
// find it in the disk cache; `*cached` tells which and may be NULL.
// The cache is no part of success: where it cannot be written there is a warning.
AG_CHECK ag_status bake_environment_make(const ag_log *log, const ag_image *equirect,
                                         bake_environment *out, bool *cached);

void bake_environment_finish(bake_environment *environment); // zero is allowed

#endif
