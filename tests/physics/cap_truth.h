// The GGX lobe under a cap of constant radiance by plain quadrature, in double.
//
// Nothing is shared with shaders/physics: the integral runs over the slopes of the half vector,
// in the polar coordinates that make the distribution of normals uniform; along each meridian
// the light's and the horizon's ends are roots of quadratics, across them the meridians' range
// is cut where the outlines touch a meridian or meet each other.
#ifndef TESTS_PHYSICS_CAP_TRUTH_H
#define TESTS_PHYSICS_CAP_TRUTH_H

typedef struct cap_case {
    double v[3];    // towards the eye, unit, z up
    double axis[3]; // towards the light's centre, unit
    double sin_s;   // of the light's angular radius, <= 90 degrees
    double cos_s;
    double ax, ay; // alpha
} cap_case;

// Integral of D G2 / (4 NoV) (1 - v.h)^power over the light above the horizon, for radiance 1.
double cap_truth(const cap_case *c, int power);

// The tables' conditions: a view, a light and a lobe, and the directions from which that light is
// tried: a grid of the sky, a belt that the horizon cuts, and the surroundings of the mirror.
// `view_turn` = the eye's azimuth, for anisotropic lobes.  Fills `axes`, returns their number.
enum { CAP_AXES = 28 * 16 + 6 * 8 };
void cap_cell(cap_case *c, double roughness, double sin_s, double view_degrees, double anisotropy,
              double view_turn);
int cap_cell_axes(const cap_case *c, double axes[CAP_AXES][3]);

#endif
