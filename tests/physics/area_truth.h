// The GGX lobe and the cosine under rectangles, disks and tubes of constant radiance by plain
// quadrature, in double.
//
// Nothing is shared with shaders/physics: the integral runs over the directions of the light,
// which a unit square parametrises; the square is quartered until a piece is small beside the
// lobe's width at that place.
#ifndef TESTS_PHYSICS_AREA_TRUTH_H
#define TESTS_PHYSICS_AREA_TRUTH_H

#include <stdbool.h>

enum { AREA_QUAD, AREA_DISK, AREA_TUBE };

typedef struct area_case {
    int kind;
    double v[3];      // towards the eye, unit, z up
    double ax, ay;    // alpha
    double centre[3]; // of the light, from the point
    double x[3];      // half axes; the light emits to the side of x cross y
    double y[3];
    double radius; // of a tube: a capsule about the segment centre +-x
} area_case;

// Over the light above the horizon, for radiance 1: the integral of D G2 / (4 NoV) in [0], of
// that times (1 - v.h)^5 in [1], of the cosine over pi in [2].
void area_truth(const area_case *c, double result[3]);

// A view and a lobe, as cap_cell has them.
void area_cell(area_case *c, int kind, double roughness, double view_degrees, double anisotropy,
               double view_turn);

// Places the light in a direction (unit) at distance 1: half axes `size * spread` and `size`, or
// half length and radius of a tube; `roll` turns it about the line of sight, `tilt` raises its
// long axis towards that line (0: it faces the point).
void area_place(area_case *c, const double axis[3], double size, double spread, double tilt,
                double roll);

// Is it wholly above the horizon?
bool area_is_whole(const area_case *c);

#endif
