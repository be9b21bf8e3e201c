// See cap_truth.h.
#include "cap_truth.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

// Nodes and weights on [0, 1]: Gauss-Legendre, with the ends' square roots taken out by
// x = (1 - cos(pi t)) / 2.
enum { NODES = 20, DEPTH = 9 };

typedef struct rule {
    double x[NODES], w[NODES];
} rule;

typedef struct integral {
    const cap_case *c;
    const rule *r;
    int power;
    double length_v; // of the stretched v
    double reach;    // cos_s + axis.v
    double mirror;   // the light's form at the normal: > 0 if it contains the mirror direction
} integral;

static double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void rule_make(rule *r)
{
    for (int i = 0; i < NODES; i++) {
        double x = cos(PI * (i + 0.75) / (NODES + 0.5)), slope = 1;
        for (int step = 0; step < 20; step++) {
            double p0 = 1, p1 = x;
            for (int n = 2; n <= NODES; n++) {
                double p2 = ((2 * n - 1) * x * p1 - (n - 1) * p0) / n;
                p0 = p1;
                p1 = p2;
            }
            slope = NODES * (x * p1 - p0) / (x * x - 1);
            x -= p1 / slope;
        }
        double t = 0.5 * (1 + x);
        r->x[i] = 0.5 * (1 - cos(PI * t));
        r->w[i] = 0.5 * PI * sin(PI * t) / ((1 - x * x) * slope * slope);
    }
}

// Over t0 < t < t1 of one sign, the slopes being t * g.
static double along(const integral *p, const double g[2], double t0, double t1)
{
    const cap_case *c = p->c;
    double b0 = atan(t0), b1 = atan(t1), sum = 0;
    for (int i = 0; i < NODES; i++) {
        double b = b0 + (b1 - b0) * p->r->x[i], t = tan(b);
        double h[3] = { t * g[0], t * g[1], 1 };
        double vh = dot3(c->v, h), h2 = dot3(h, h), l[3];
        for (int k = 0; k < 3; k++)
            l[k] = 2 * vh / h2 * h[k] - c->v[k];
        if (l[2] <= 0)
            continue;
        double length_l =
            sqrt(c->ax * c->ax * l[0] * l[0] + c->ay * c->ay * l[1] * l[1] + l[2] * l[2]);
        double g2 = 2 * l[2] * c->v[2] / (p->length_v * l[2] + length_l * c->v[2]);
        double f = p->power ? pow(1 - vh / sqrt(h2), p->power) : 1;
        sum += p->r->w[i] * fabs(sin(b)) * cos(b) * vh * g2 * f;
    }
    return sum * (b1 - b0) / (PI * c->v[2]);
}

// The ends in t of what is lit and above the horizon; returns the number of intervals.
static int ends(const integral *p, const double g[2], double interval[4])
{
    const cap_case *c = p->c;
    double gg = g[0] * g[0] + g[1] * g[1], vz = c->v[2];
    double vg = c->v[0] * g[0] + c->v[1] * g[1], ag = c->axis[0] * g[0] + c->axis[1] * g[1];
    double q = sqrt(vg * vg + vz * vz * gg);
    double up = vg > 0 ? (vg + q) / (vz * gg) : vz / (q - vg), down = -1 / (gg * up);
    // The light: f0 + 2 f1 t + f2 t^2 > 0.
    double f0 = p->mirror, f1 = vz * ag + vg * c->axis[2], f2 = 2 * vg * ag - p->reach * gg;
    double d = f1 * f1 - f0 * f2;
    if (d <= 0) {
        interval[0] = down;
        interval[1] = up;
        return f0 + f2 > 0;
    }
    double w = -(f1 + copysign(sqrt(d), f1));
    double r0 = w / f2, r1 = f0 / w, low = fmin(r0, r1), high = fmax(r0, r1);
    if (f2 < 0) {
        interval[0] = fmax(low, down);
        interval[1] = fmin(high, up);
        return interval[1] > interval[0];
    }
    int n = 0;
    if (low > down) {
        interval[0] = down;
        interval[1] = fmin(low, up);
        n++;
    }
    if (high < up) {
        interval[2 * n] = fmax(high, down);
        interval[2 * n + 1] = up;
        n++;
    }
    return n;
}

static double meridian(const integral *p, double phi)
{
    double g[2] = { p->c->ax * cos(phi), p->c->ay * sin(phi) }, interval[4], sum = 0;
    int n = ends(p, g, interval);
    for (int i = 0; i < n; i++) {
        double t0 = interval[2 * i], t1 = interval[2 * i + 1];
        if (t0 < 0 && t1 > 0)
            sum += along(p, g, t0, 0) + along(p, g, 0, t1);
        else
            sum += along(p, g, t0, t1);
    }
    return sum;
}

static double panel(const integral *p, double a, double b)
{
    double sum = 0;
    for (int i = 0; i < NODES; i++)
        sum += p->r->w[i] * meridian(p, a + (b - a) * p->r->x[i]);
    return sum * (b - a);
}

static double refine(const integral *p, double a, double b, double whole, int depth)
{
    double m = 0.5 * (a + b), left = panel(p, a, m), right = panel(p, m, b);
    if (depth >= DEPTH || fabs(left + right - whole) <= 1e-5 * (left + right))
        return left + right;
    return refine(p, a, m, left, depth + 1) + refine(p, m, b, right, depth + 1);
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Where meridians touch the light's outline, and where that meets the horizon.
static int breaks(const integral *p, double phi[5])
{
    const cap_case *c = p->c;
    int n = 0;
    double x = c->ax * (c->v[2] * c->axis[0] + c->v[0] * c->axis[2]);
    double y = c->ay * (c->v[2] * c->axis[1] + c->v[1] * c->axis[2]);
    double f0 = p->mirror;
    double a = x * x - f0 * c->ax * c->ax * (2 * c->v[0] * c->axis[0] - p->reach);
    double g = y * y - f0 * c->ay * c->ay * (2 * c->v[1] * c->axis[1] - p->reach);
    double b = x * y - f0 * c->ax * c->ay * (c->v[0] * c->axis[1] + c->v[1] * c->axis[0]);
    double d = b * b - a * g;
    if (d > 0) {
        double q = -(b + copysign(sqrt(d), b));
        phi[n++] = atan2(q, g);
        phi[n++] = atan2(a, q);
    }
    double flat = hypot(c->axis[0], c->axis[1]);
    if (flat > 1e-12 && fabs(c->axis[2]) < c->sin_s) {
        double m = c->cos_s / flat, k = sqrt(fmax(0, 1 - m * m));
        for (int side = -1; side <= 1; side += 2) {
            double hx = (m * c->axis[0] - side * k * c->axis[1]) / flat + c->v[0];
            double hy = (m * c->axis[1] + side * k * c->axis[0]) / flat + c->v[1];
            phi[n++] = atan2(hy / c->ay, hx / c->ax);
        }
    }
    phi[n++] = 0.1; // at least one
    for (int i = 0; i < n; i++) {
        phi[i] = fmod(phi[i], PI);
        phi[i] += phi[i] < 0 ? PI : 0;
    }
    qsort(phi, (size_t)n, sizeof *phi, compare);
    return n;
}

double cap_truth(const cap_case *c, int power)
{
    rule r;
    rule_make(&r);
    integral p = { .c = c, .r = &r, .power = power };
    p.length_v = sqrt(pow(c->ax * c->v[0], 2) + pow(c->ay * c->v[1], 2) + c->v[2] * c->v[2]);
    p.reach = c->cos_s + dot3(c->axis, c->v);
    double off[3] = { -c->v[0] - c->axis[0], -c->v[1] - c->axis[1], c->v[2] - c->axis[2] };
    p.mirror = c->sin_s * c->sin_s / (1 + c->cos_s) - 0.5 * dot3(off, off);
    double phi[6], sum = 0;
    int n = breaks(&p, phi);
    phi[n] = phi[0] + PI;
    for (int i = 0; i < n; i++)
        if (phi[i + 1] - phi[i] > 1e-13)
            sum += refine(&p, phi[i], phi[i + 1], panel(&p, phi[i], phi[i + 1]), 0);
    return sum;
}

void cap_cell(cap_case *c, double roughness, double sin_s, double view_degrees, double anisotropy,
              double view_turn)
{
    double theta = view_degrees * PI / 180;
    memset(c, 0, sizeof *c);
    c->v[0] = sin(theta) * cos(view_turn);
    c->v[1] = sin(theta) * sin(view_turn);
    c->v[2] = cos(theta);
    c->sin_s = sin_s;
    c->cos_s = sqrt((1 - sin_s) * (1 + sin_s));
    c->ax = fmin(1, roughness * roughness * sqrt(anisotropy));
    c->ay = c->ax / anisotropy;
}

// In the frame of the mirror direction: polar angle, azimuth from the plane of incidence.
static void near_mirror(const cap_case *c, double polar, double azimuth, double axis[3])
{
    double flat = fmax(hypot(c->v[0], c->v[1]), 1e-9);
    double side[3] = { -c->v[1] / flat, c->v[0] / flat, 0 };
    double up[3] = { c->v[0] / flat * c->v[2], c->v[1] / flat * c->v[2], flat };
    double mirror[3] = { -c->v[0], -c->v[1], c->v[2] };
    for (int k = 0; k < 3; k++)
        axis[k] =
            cos(polar) * mirror[k] + sin(polar) * (cos(azimuth) * up[k] + sin(azimuth) * side[k]);
}

int cap_cell_axes(const cap_case *c, double axes[CAP_AXES][3])
{
    int n = 0;
    double s = asin(c->sin_s), turn = atan2(-c->v[1], -c->v[0]);
    int turns = c->ax == c->ay ? 8 : 16; // half the sky by symmetry, or all
    double step = c->ax == c->ay ? PI / 7 : PI / 8;
    for (int j = 0; j < 28; j++) {
        for (int i = 0; i < turns; i++) {
            double up = j < 18 ? PI / 180 * (89.5 - 5 * j) : s * (-0.94 + 0.2 * (j - 18));
            if (j < 18 && up <= s)
                continue;
            axes[n][0] = cos(up) * cos(turn + i * step);
            axes[n][1] = cos(up) * sin(turn + i * step);
            axes[n++][2] = sin(up);
        }
    }
    for (int j = 0; j < 6 && n + 8 <= CAP_AXES; j++) {
        for (int i = 0; i < 8; i++) {
            near_mirror(c, (s + 2 * c->ax) * (j + 0.5) / 6, i * PI / 4 + 0.1, axes[n]);
            n += axes[n][2] > -0.97 * c->sin_s;
        }
    }
    return n;
}
