// A clear sky without the sun's disk: Preetham, Shirley and Smits 1999, "A Practical Analytic
// Model for Daylight", appendix A.2, on Perez et al. 1993's distribution.
//
// Symbols: theta = angle from the zenith, gamma = angle from the sun, T = turbidity,
// Y = luminance, x, y = CIE chromaticity.
#include "scene/environment.h"

static const double turbidity = 3.0;                     // a clear day
static const double sun_theta = 0.85, sun_azimuth = 2.2; // rad, from +X towards +Z

// Not the model's own, but such that white paper lying on the ground has a radiance of 0.8.
static const double zenith_luminance = 0.6;

typedef struct perez {
    double a, b, c, d, e;
} perez;

// Preetham et al. 1999, A.2: the distribution's parameters are linear in T.
static const double slope[3][5] = {
    { 0.1787, -0.3554, -0.0227, 0.1206, -0.0670 },   // Y
    { -0.0193, -0.0665, -0.0004, -0.0641, -0.0033 }, // x
    { -0.0167, -0.0950, -0.0079, -0.0441, -0.0109 }, // y
};
static const double offset[3][5] = {
    { -1.4630, 0.4275, 5.3251, -2.5771, 0.3703 },
    { -0.2592, 0.0008, 0.2125, -0.8989, 0.0452 },
    { -0.2608, 0.0092, 0.2102, -1.6537, 0.0529 },
};

// The zenith's chromaticity is cubic in the sun's angle and quadratic in T.
static const double zenith_xy[2][3][4] = {
    { { 0.00166, -0.00375, 0.00209, 0.0 },
      { -0.02903, 0.06377, -0.03202, 0.00394 },
      { 0.11693, -0.21196, 0.06052, 0.25886 } },
    { { 0.00275, -0.00610, 0.00317, 0.0 },
      { -0.04214, 0.08970, -0.04153, 0.00516 },
      { 0.15346, -0.26756, 0.06670, 0.26688 } },
};

static perez perez_of(int channel)
{
    double v[5];
    for (int i = 0; i < 5; i++)
        v[i] = slope[channel][i] * turbidity + offset[channel][i];
    return (perez) { v[0], v[1], v[2], v[3], v[4] };
}

static double perez_at(perez p, double cos_theta, double gamma)
{
    double cos_gamma = cos(gamma);
    return (1.0 + p.a * exp(p.b / cos_theta)) *
           (1.0 + p.c * exp(p.d * gamma) + p.e * cos_gamma * cos_gamma);
}

static double zenith_chromaticity(const double m[3][4])
{
    double s = sun_theta, sum = 0.0;
    for (int row = 0; row < 3; row++)
        sum = sum * turbidity + ((m[row][0] * s + m[row][1]) * s + m[row][2]) * s + m[row][3];
    return sum;
}

// XYZ to linear Rec. 709 (IEC 61966-2-1).
static vec3 rec709_from_xyy(double x, double y, double luminance)
{
    double big_x = luminance * x / y, big_z = luminance * (1.0 - x - y) / y;
    double r = 3.2406 * big_x - 1.5372 * luminance - 0.4986 * big_z;
    double g = -0.9689 * big_x + 1.8758 * luminance + 0.0415 * big_z;
    double b = 0.0557 * big_x - 0.2040 * luminance + 1.0570 * big_z;
    return (vec3) { (float)fmax(r, 0.0), (float)fmax(g, 0.0), (float)fmax(b, 0.0) };
}

// What does not depend on the direction.
typedef struct heaven {
    perez distribution[3]; // Y, x, y
    double zenith[3];      // the same at the zenith, over the distribution there
    vec3 sun;
} heaven;

static heaven make_heaven(void)
{
    heaven h = { .sun = { (float)(sin(sun_theta) * cos(sun_azimuth)), (float)cos(sun_theta),
                          (float)(sin(sun_theta) * sin(sun_azimuth)) } };
    const double zenith[3] = { zenith_luminance, zenith_chromaticity(zenith_xy[0]),
                               zenith_chromaticity(zenith_xy[1]) };
    for (int i = 0; i < 3; i++) {
        h.distribution[i] = perez_of(i);
        h.zenith[i] = zenith[i] / perez_at(h.distribution[i], 1.0, sun_theta);
    }
    return h;
}

static vec3 look_up(const heaven *h, vec3 d)
{
    double cos_theta = fmax((double)d.y, 0.01);
    double gamma = acos(fmin(fmax((double)vec3_dot(d, h->sun), -1.0), 1.0));
    double v[3];
    for (int i = 0; i < 3; i++)
        v[i] = h->zenith[i] * perez_at(h->distribution[i], cos_theta, gamma);
    return rec709_from_xyy(v[1], v[2], v[0]);
}

static vec3 look(const void *context, vec3 d)
{
    static const vec3 ground = { 0.21f, 0.20f, 0.18f };
    float seen = fminf(fmaxf(0.5f + d.y * 40.0f, 0.0f), 1.0f); // a soft horizon
    if (seen == 0.0f)
        return ground;
    return vec3_add(vec3_scale(look_up(context, d), seen), vec3_scale(ground, 1.0f - seen));
}

ag_status sky_create(const ag_log *log, ag_image **image)
{
    heaven h = make_heaven();
    return environment_paint(log, look, &h, image);
}
