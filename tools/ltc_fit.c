// The fit of one linearly transformed cosine to the GGX lobe: Heitz, Dupuy, Hill & Neubelt 2016,
// section 3 and their supplement.
//
// The cube of the difference is integrated over directions sampled for the lobe and for the cosine,
// both with their balance heuristic, and made small by Nelder & Mead's search.  Everything is in
// the frame of the mirror direction (z; x in the plane of incidence).
#define real double
#include "physics/microfacet.glsl"
#include "physics/sampling.glsl"

#include "ltc_fit.h"

enum {
    SIDE = 32,   // samples are SIDE azimuths of half the circle times SIDE heights
    FINE = 128,  // the same for the lobe's norm and mean direction
    STEPS = 400, // of the search, at most
    CORNERS = 4, // of its simplex
};

typedef struct lobe {
    double NoV, sine, alpha;
    vec3 wo;
    double norm, mean_x, mean_z; // mean direction, unit
    vec3 direction[SIDE * SIDE]; // sampled for the lobe
    double value[SIDE * SIDE], density[SIDE * SIDE];
    double cubes; // of the lobe, integrated
} lobe;

static double cube(double x)
{
    return x * x * x;
}

static vec3 to_mirror(const lobe *b, vec3 l)
{
    return vec3(b->NoV * l[0] + b->sine * l[2], l[1], b->NoV * l[2] - b->sine * l[0]);
}

static vec3 from_mirror(const lobe *b, vec3 l)
{
    return vec3(b->NoV * l[0] - b->sine * l[2], l[1], b->sine * l[0] + b->NoV * l[2]);
}

// The lobe times the cosine, and the density with which it is sampled.  `l` in the surface's frame.
static double lobe_value(const lobe *b, vec3 l, double *density)
{
    vec3 h = b->wo + l;
    double a2 = b->alpha * b->alpha;
    double d = h[2] > 0 ? microfacet_d_half(h[0] * h[0] + h[1] * h[1], h[2], a2) : 0;
    *density = d * microfacet_g1(b->NoV, a2) / (4 * b->NoV);
    return l[2] > 0 ? d * microfacet_v(b->NoV, l[2], a2) * l[2] : 0;
}

static vec3 sample_lobe(const lobe *b, int i, int side)
{
    vec2 u = vec2(0.5 * (i / side + 0.5) / side, (i % side + 0.5) / side);
    vec3 h = sampling_visible_normal(b->wo, b->alpha, u);
    return -reflect(b->wo, h);
}

static void lobe_make(lobe *b, double NoV, double alpha)
{
    *b = (lobe) { .NoV = NoV, .sine = sqrt(1 - NoV * NoV), .alpha = alpha };
    b->wo = vec3(b->sine, 0, NoV);
    double x = 0, z = 0;
    for (int i = 0; i < FINE * FINE; i++) {
        vec3 l = sample_lobe(b, i, FINE), local = to_mirror(b, l);
        double density, value = lobe_value(b, l, &density), w = value / density / (FINE * FINE);
        b->norm += w;
        x += w * local[0];
        z += w * local[2];
    }
    b->mean_x = x / hypot(x, z);
    b->mean_z = z / hypot(x, z);
    for (int i = 0; i < SIDE * SIDE; i++) {
        vec3 l = sample_lobe(b, i, SIDE);
        b->direction[i] = to_mirror(b, l);
        b->value[i] = lobe_value(b, l, &b->density[i]);
        b->cubes += cube(b->value[i]) / b->density[i] / (SIDE * SIDE);
    }
}

// Where the cosine's direction o goes, not normalised.
static vec3 transform(const lobe *b, ltc_shape s, vec3 o)
{
    double x = b->alpha * (s.x * o[0] + s.shear * o[2]), y = b->alpha * s.y * o[1];
    return vec3(b->mean_z * x + b->mean_x * o[2], y, b->mean_z * o[2] - b->mean_x * x);
}

// The transformed cosine's density towards l.  Heitz et al. 2016, eq. 1 and its appendix A.
static double cosine_density(const lobe *b, ltc_shape s, vec3 l)
{
    double x = b->mean_z * l[0] - b->mean_x * l[2], z = b->mean_x * l[0] + b->mean_z * l[2];
    if (z <= 0)
        return 0;
    double ox = (x / b->alpha - s.shear * z) / s.x, oy = l[1] / b->alpha / s.y;
    double length2 = ox * ox + oy * oy + z * z;
    return z / (PI * length2 * length2 * s.x * s.y * b->alpha * b->alpha);
}

static double error_at(const lobe *b, ltc_shape s, vec3 l, double value, double density)
{
    double fit = cosine_density(b, s, l);
    return cube(fabs(value - b->norm * fit)) / fmax(density + fit, 1e-300);
}

static double error_of(const lobe *b, ltc_shape s)
{
    double sum = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        sum += error_at(b, s, b->direction[i], b->value[i], b->density[i]);
        vec2 u = vec2((i % SIDE + 0.5) / SIDE, 0.5 * (i / SIDE + 0.5) / SIDE);
        vec3 l = normalize(transform(b, s, sampling_cosine(u)));
        double density, value = lobe_value(b, from_mirror(b, l), &density);
        sum += error_at(b, s, l, value, density);
    }
    return sum / (SIDE * SIDE);
}

// ---- the search: widths in logarithms, the shear as it is ---------------------------------------

typedef struct corner {
    double p[3], error;
} corner;

static ltc_shape shape_of(const lobe *b, const double p[3])
{
    if (b->NoV == 1) // round, and straight up
        return (ltc_shape) { exp(p[0]), exp(p[0]), 0 };
    return (ltc_shape) { exp(p[0]), exp(p[1]), p[2] };
}

static corner corner_at(const lobe *b, const double from[3], const double to[3], double t)
{
    corner c;
    for (int k = 0; k < 3; k++)
        c.p[k] = from[k] + t * (to[k] - from[k]);
    c.error = error_of(b, shape_of(b, c.p));
    return c;
}

static void sort(corner s[CORNERS])
{
    for (int i = 1; i < CORNERS; i++) {
        for (int j = i; j > 0 && s[j].error < s[j - 1].error; j--) {
            corner t = s[j];
            s[j] = s[j - 1];
            s[j - 1] = t;
        }
    }
}

// One step of Nelder & Mead 1965 with their factors 1, 2, 1/2, 1/2; the best corner is the first.
static void step(const lobe *b, corner s[CORNERS])
{
    corner *worst = &s[CORNERS - 1];
    double middle[3] = { 0 };
    for (int i = 0; i < CORNERS - 1; i++)
        for (int k = 0; k < 3; k++)
            middle[k] += s[i].p[k] / (CORNERS - 1);
    corner next = corner_at(b, middle, worst->p, -1);
    if (next.error < s[0].error) {
        corner far = corner_at(b, middle, worst->p, -2);
        next = far.error < next.error ? far : next;
    } else if (next.error >= s[CORNERS - 2].error) {
        corner inside = corner_at(b, middle, next.error < worst->error ? next.p : worst->p, 0.5);
        if (inside.error < fmin(next.error, worst->error)) {
            next = inside;
        } else {
            for (int i = 1; i < CORNERS; i++)
                s[i] = corner_at(b, s[0].p, s[i].p, 0.5);
            sort(s);
            return;
        }
    }
    *worst = next;
    sort(s);
}

static ltc_shape search(const lobe *b, ltc_shape start, double *error)
{
    double p[3] = { log(start.x), log(start.y), start.shear };
    corner s[CORNERS];
    for (int i = 0; i < CORNERS; i++) {
        double q[3] = { p[0], p[1], p[2] };
        if (i)
            q[i - 1] += 0.1;
        s[i] = corner_at(b, q, q, 0);
    }
    sort(s);
    for (int i = 0; i < STEPS && s[CORNERS - 1].error > s[0].error * (1 + 1e-9); i++)
        step(b, s);
    *error = s[0].error;
    return shape_of(b, s[0].p);
}

ltc_shape ltc_fit_smooth(double NoV)
{
    return (ltc_shape) { 2, 2 * NoV, 0 };
}

ltc_entry ltc_fit(double NoV, double alpha, ltc_shape start)
{
    lobe b;
    lobe_make(&b, NoV, alpha);
    ltc_entry e = { .norm = b.norm };
    double error;
    e.shape = search(&b, start, &error);
    e.residual = cbrt(error / b.cubes);
    // The inverse times alpha y, turned back from the mean direction.
    double ratio = e.shape.y / e.shape.x, pull = -ratio * e.shape.shear;
    e.m[0] = ratio * b.mean_z + pull * alpha * b.mean_x;
    e.m[1] = pull * b.mean_z - ratio * b.mean_x / alpha;
    e.m[2] = e.shape.y * b.mean_x;
    e.m[3] = e.shape.y * b.mean_z;
    return e;
}
