// Prints the error of the sphere light's highlight against quadrature: the tables of
// docs/sphere-light.md.
//
//   accuracy [ANISOTROPY [VIEW_TURN]]
//
// Each number is the RMS error over all light directions of a cell over the RMS of the truth, in
// percent; first for lights wholly above the horizon, then for lights that it cuts.
#include "physics/light_sphere.glsl"
#include "physics/microfacet.glsl"

#include "../tests/physics/cap_truth.h"

#include <stdio.h>
#include <stdlib.h>

typedef struct score {
    double error, truth, sum, sum_truth;
} score;

typedef double method(const cap_case *c, const double axis[3], double f0);

static vec3 to_vec3(const double a[3])
{
    return vec3((float)a[0], (float)a[1], (float)a[2]);
}

static double exact(const cap_case *c, const double axis[3], double f0)
{
    light_cap cap = { to_vec3(axis), (float)c->sin_s, (float)c->cos_s };
    vec2 x = light_cap_ggx(cap, to_vec3(c->v), (float)c->ax, (float)c->ay);
    return (f0 * (double)(x[0] - x[1]) + (double)x[1]) * (double)PI * c->sin_s * c->sin_s;
}

// Karis 2013: the point of the sphere nearest to the mirror ray stands for the sphere, the lobe's
// peak is lowered by (alpha / (alpha + sin_s / 2))^2; alpha is what roughness means, and the
// light's irradiance is right, as in lighting texts it often is not.  Isotropic only.
static double representative(const cap_case *c, const double axis[3], double f0)
{
    double mirror[3] = { -c->v[0], -c->v[1], c->v[2] }, l[3], cos_r = 0, length = 0;
    for (int k = 0; k < 3; k++)
        cos_r += mirror[k] * axis[k];
    double side2 = fmax(0.0, 1.0 - cos_r * cos_r);
    double pull = fmin(1.0, c->sin_s / sqrt(fmax(side2, 1e-12)));
    for (int k = 0; k < 3; k++) {
        l[k] = axis[k] + (cos_r * mirror[k] - axis[k]) * pull;
        length += l[k] * l[k];
    }
    for (int k = 0; k < 3; k++)
        l[k] /= sqrt(length);
    if (l[2] <= 0)
        return 0;
    vec3 h = to_vec3(c->v) + to_vec3(l);
    float a2 = (float)(c->ax * c->ax), h2 = dot(h, h);
    float d = microfacet_d_half(h[0] * h[0] + h[1] * h[1], h[2], a2);
    float v = microfacet_v((float)c->v[2], (float)l[2], a2);
    double spread = c->ax / fmin(1.0, c->ax + 0.5 * c->sin_s);
    double w = pow(1 - 0.5 * sqrt((double)h2), 5), f = f0 + (1 - f0) * w;
    return f * (double)(d * v) * l[2] * spread * spread * (double)PI * c->sin_s * c->sin_s;
}

static void print_cell(const cap_case *cell, method *approximate, double f0, score worst[2])
{
    static double axes[CAP_AXES][3];
    score s[2] = { 0 };
    int n = cap_cell_axes(cell, axes);
    for (int i = 0; i < n; i++) {
        cap_case c = *cell;
        for (int k = 0; k < 3; k++)
            c.axis[k] = axes[i][k];
        double plain = cap_truth(&c, 0), bent = f0 < 1 ? cap_truth(&c, 5) : 0;
        double truth = f0 < 1 ? f0 * (plain - bent) + bent : plain;
        double error = approximate(&c, axes[i], f0) - truth;
        score *part = &s[c.axis[2] <= c.sin_s];
        part->error += error * error;
        part->truth += truth * truth;
    }
    for (int k = 0; k < 2; k++) {
        double e = 100 * sqrt(s[k].error / s[k].truth);
        worst[k].error = fmax(worst[k].error, e);
        printf(k ? " %5.2f |" : " %5.2f", e);
    }
}

static void print_table(const char *name, method *approximate, double f0, double anisotropy,
                        double turn)
{
    const double roughness[] = { .05, .1, .2, .35, .5, .7, 1 },
                 radius[] = { .005, .05, .2, .5, .9 };
    const double view[] = { 1, 30, 60, 75, 85 };
    printf("\n%s, f0 = %g, alpha ratio %g\n\nroughness  R/d |", name, f0, anisotropy);
    for (int k = 0; k < 5; k++)
        printf(" %6.0f deg   |", view[k]);
    printf("\n");
    score worst[2] = { 0 };
    for (int i = 0; i < 35; i++) {
        printf("  %4.2f    %5.3f|", roughness[i / 5], radius[i % 5]);
        for (int k = 0; k < 5; k++) {
            cap_case c;
            cap_cell(&c, roughness[i / 5], radius[i % 5], view[k], anisotropy, turn);
            print_cell(&c, approximate, f0, worst);
        }
        printf("\n");
    }
    printf("worst cell: %.2f %% above the horizon, %.2f %% cut by it\n", worst[0].error,
           worst[1].error);
}

int main(int argc, char **argv)
{
    double anisotropy = argc > 1 ? atof(argv[1]) : 1, turn = argc > 2 ? atof(argv[2]) : 0;
    if (!(anisotropy >= 1 && anisotropy <= 100)) {
        fprintf(stderr, "usage: accuracy [ANISOTROPY in 1..100 [VIEW_TURN in radians]]\n");
        return 2;
    }
    print_table("closed form", exact, 1, anisotropy, turn);
    print_table("closed form", exact, 0.04, anisotropy, turn);
    if (anisotropy == 1)
        print_table("representative point", representative, 1, 1, 0);
    return 0;
}
