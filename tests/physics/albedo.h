// The albedo of the GGX lobe by brute quadrature in double, from the papers' formulas
// written out here and not from the text under test.
#ifndef TESTS_PHYSICS_ALBEDO_H
#define TESTS_PHYSICS_ALBEDO_H

#include <math.h>

typedef struct albedo {
    double scale, bias; // of f0 and of f90
} albedo;

static inline double albedo_g2(double NoV, double NoL, double a2)
{
    double lv = (sqrt(1.0 + a2 * (1.0 / (NoV * NoV) - 1.0)) - 1.0) / 2.0;
    double ll = (sqrt(1.0 + a2 * (1.0 / (NoL * NoL) - 1.0)) - 1.0) / 2.0;
    return 1.0 / (1.0 + lv + ll);
}

// Over the half vectors, by the distribution's inverse (midpoints, steps^2 of them, denser
// towards the flat ones, which grazing eyes see); the light's solid angle is 4 v.h times
// theirs.
static inline albedo albedo_of(double NoV, double alpha, int steps)
{
    double a2 = alpha * alpha, s = sqrt(1.0 - NoV * NoV);
    albedo sum = { 0.0, 0.0 };
    for (int i = 0; i < steps; i++) {
        double t = (i + 0.5) / steps, u = 1.0 - pow(1.0 - t, 3.0);
        double density = 3.0 * (1.0 - t) * (1.0 - t);
        double NoH = sqrt((1.0 - u) / (1.0 + (a2 - 1.0) * u)), sh = sqrt(1.0 - NoH * NoH);
        for (int k = 0; k < steps; k++) {
            double VoH = s * sh * cos(3.14159265358979324 * (k + 0.5) / steps) + NoV * NoH;
            double NoL = 2.0 * VoH * NoH - NoV;
            if (VoH <= 0.0 || NoL <= 0.0)
                continue;
            // D cos dh is uniform in u; the rest of D V cos_l 4 v.h / (D cos_h).
            double g = albedo_g2(NoV, NoL, a2) * VoH / (NoV * NoH) * density;
            double w = (1.0 - VoH) * (1.0 - VoH);
            w *= w * (1.0 - VoH);
            sum.scale += g * (1.0 - w);
            sum.bias += g * w;
        }
    }
    double n = (double)steps * steps;
    return (albedo) { sum.scale / n, sum.bias / n };
}

#endif
