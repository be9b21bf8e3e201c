// The fit of one linearly transformed cosine to the GGX lobe.
#ifndef TOOLS_LTC_FIT_H
#define TOOLS_LTC_FIT_H

// What goes over the cosine before it is turned to the lobe's mean direction: the matrix
// ((x 0 shear) (0 y 0) (0 0 1)), its entries over alpha.
typedef struct ltc_shape {
    double x, y, shear;
} ltc_shape;

typedef struct ltc_entry {
    ltc_shape shape;
    double m[4];     // as shaders/physics/light_ltc.glsl describes the table
    double norm;     // integral of the lobe: its albedo
    double residual; // (integral |lobe - fit|^3 / integral lobe^3)^(1/3)
} ltc_entry;

// Exact as alpha tends to 0: half vectors deviate by alpha, mirrored directions by twice that in
// the plane of incidence and by 2 NoV times that across it.
ltc_shape ltc_fit_smooth(double NoV);

// Fit the entry of NoV and alpha, both in (0, 1], searching from `start`.
ltc_entry ltc_fit(double NoV, double alpha, ltc_shape start);

#endif
