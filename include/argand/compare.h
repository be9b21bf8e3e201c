// How far apart two pictures are.
#ifndef ARGAND_COMPARE_H
#define ARGAND_COMPARE_H

#include <argand/base.h>
#include <argand/image.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ag_compare_options {
    float pixels_per_degree; // of visual angle; 0 -> 67.02, as FLIP's authors view pictures
} ag_compare_options;

// Bytes are taken as sRGB-coded.  Alpha is composited over white first, as coded (bytes) or
// linear (floats), as a browser would.  NaN counts as 0.
typedef struct ag_difference {
    // FLIP, what a person sees switching between the two: the mean and the greatest error, in
    // [0, 1].  Bytes: LDR-FLIP, Andersson et al. 2020.  Floats: HDR-FLIP, Andersson et al. 2021,
    // the greatest over the exposures from ev_start, where the reference's brightest pixel comes
    // out at 0.85, to ev_stop, where its median does (of those not black, where most are).
    float flip, flip_max;
    uint32_t worst_x, worst_y; // px from the upper left, where it is greatest
    float ev_start, ev_stop;   // stops; 0 of bytes
    double rmse_linear;        // of linear values, all three channels
    // Of sRGB-coded values in [0, 1]; floats are clipped.  PSNR in dB, INFINITY where equal.
    double rmse_srgb, psnr_db;
    double ssim; // of coded luma; Wang et al. 2004, Gaussian windows of 1.5 px
} ag_difference;

// Compare two images of one size and format, on all cores; floats take as long for each
// exposure as bytes take at once.  The error map is left in `*heat` (NULL -> not wanted) as RGBA8,
// from black by violet and orange to pale yellow, its lightness rising evenly.  NULL options ->
// defaults.  AG_ERROR_ARGUMENT where size or format differ, or pixels_per_degree is outside [10,
// 500].  Any number of threads may compare.
AG_CHECK ag_status ag_image_compare(const ag_log *log, const ag_image *reference,
                                    const ag_image *test, const ag_compare_options *options,
                                    ag_difference *difference, ag_image **heat);

#ifdef __cplusplus
}
#endif
#endif
