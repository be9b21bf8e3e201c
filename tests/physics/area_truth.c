// See area_truth.h.
#include "area_truth.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#define PI 3.14159265358979323846

enum { NODES = 8, DEPTH = 14 };

typedef struct place {
    double l[3]; // unit
    double w;    // solid angle over the square's area
} place;

static double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross3(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static place place_flat(const area_case *c, double x, double y, double weight)
{
    double m[3], p[3];
    cross3(c->x, c->y, m);
    for (int k = 0; k < 3; k++)
        p[k] = c->centre[k] + x * c->x[k] + y * c->y[k];
    double p2 = dot3(p, p), n = sqrt(p2);
    place at = { { p[0] / n, p[1] / n, p[2] / n }, fmax(-dot3(p, m), 0) / (p2 * n) * weight };
    return at;
}

// Slices of the capsule by half planes through the line parallel to its axis through the point:
// each is a stadium, seen under the angles of the tangents at its two end circles.
static place place_tube(const area_case *c, double x, double y)
{
    double length = sqrt(dot3(c->x, c->x)), k[3], e[3], f[3];
    for (int i = 0; i < 3; i++)
        k[i] = c->x[i] / length;
    double mid = dot3(c->centre, k);
    for (int i = 0; i < 3; i++)
        e[i] = c->centre[i] - mid * k[i];
    double distance = sqrt(dot3(e, e));
    for (int i = 0; i < 3; i++)
        e[i] /= distance;
    cross3(k, e, f);
    // Half the turn around the axis from which the capsule is seen; square roots at its ends.
    double most = distance > c->radius ? asin(c->radius / distance) : PI / 2;
    double turn = PI * (x - 0.5), psi = distance > c->radius ? most * sin(turn) : turn;
    double dpsi = distance > c->radius ? most * PI * cos(turn) : PI;
    double out = distance * cos(psi), r = distance * sin(psi);
    r = sqrt(fmax(c->radius * c->radius - r * r, 0));
    double low = 10, high = -10;
    for (int end = -1; end <= 1; end += 2) {
        double z = mid + end * length, angle = atan2(z, out),
               half = asin(fmin(1, r / hypot(z, out)));
        low = fmin(low, angle - half);
        high = fmax(high, angle + half);
    }
    double b = low + (high - low) * y;
    place at;
    for (int i = 0; i < 3; i++)
        at.l[i] = sin(b) * k[i] + cos(b) * (cos(psi) * e[i] + sin(psi) * f[i]);
    at.w = dpsi * (high - low) * fabs(cos(b));
    return at;
}

static place place_at(const area_case *c, double x, double y)
{
    if (c->kind == AREA_TUBE)
        return place_tube(c, x, y);
    if (c->kind == AREA_QUAD)
        return place_flat(c, 2 * x - 1, 2 * y - 1, 4);
    double turn = PI * (x - 0.5), half = cos(turn); // chords
    return place_flat(c, sin(turn), half * (2 * y - 1), 2 * PI * half * half);
}

static void add(const area_case *c, double x, double y, double weight, double sum[3])
{
    place at = place_at(c, x, y);
    const double *l = at.l, *v = c->v;
    if (l[2] <= 0)
        return;
    double h[3] = { l[0] + v[0], l[1] + v[1], l[2] + v[2] }, h2 = dot3(h, h);
    double t = (pow(h[0] / c->ax, 2) + pow(h[1] / c->ay, 2) + h[2] * h[2]) / h2;
    double d = 1 / (PI * c->ax * c->ay * t * t);
    double sv = sqrt(pow(c->ax * v[0], 2) + pow(c->ay * v[1], 2) + v[2] * v[2]);
    double sl = sqrt(pow(c->ax * l[0], 2) + pow(c->ay * l[1], 2) + l[2] * l[2]);
    double f = weight * at.w * d * 0.5 * l[2] / (sv * l[2] + sl * v[2]);
    sum[0] += f;
    sum[1] += f * pow(1 - 0.5 * sqrt(h2), 5);
    sum[2] += weight * at.w * l[2] / PI;
}

static void refine(const area_case *c, const double node[2][NODES], double x, double y, double size,
                   int depth, double sum[3])
{
    static const double corner[5][2] = { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 1, 1 }, { 0.5, 0.5 } };
    place at[5];
    double reach = 0, low = 1, high = -1;
    for (int i = 0; i < 5; i++) {
        at[i] = place_at(c, x + corner[i][0] * size, y + corner[i][1] * size);
        low = fmin(low, at[i].l[2]);
        high = fmax(high, at[i].l[2]);
    }
    double *m = at[4].l, slope = 1e9;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++)
            reach = fmax(reach, 1.5 * fabs(at[i].l[k] - m[k]));
    // The distance to the peak less the piece's reach, in units of the lobe's width.
    double a = fmin(c->ax, c->ay), hx = m[0] + c->v[0], hy = m[1] + c->v[1], hz = m[2] + c->v[2];
    slope = fmax(hypot(hx / c->ax, hy / c->ay) - reach / a, 0) / fmax(hz, 1e-3);
    bool peaked = reach / (a * fmax(hz, 1e-2)) > 0.8 * sqrt(1 + slope * slope) || reach > 0.3;
    bool crossed = low < 0 && high > -reach && low < reach && depth < 6;
    if (depth < 2 || (depth < DEPTH && (peaked || (crossed && reach > 1e-4)))) {
        for (int i = 0; i < 4; i++)
            refine(c, node, x + 0.5 * size * corner[i][0], y + 0.5 * size * corner[i][1],
                   0.5 * size, depth + 1, sum);
        return;
    }
    for (int i = 0; i < NODES * NODES; i++)
        add(c, x + size * node[0][i / NODES], y + size * node[0][i % NODES],
            size * size * node[1][i / NODES] * node[1][i % NODES], sum);
}

static void gauss(double node[2][NODES])
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
        node[0][i] = 0.5 * (1 + x);
        node[1][i] = 1 / ((1 - x * x) * slope * slope);
    }
}

void area_truth(const area_case *c, double result[3])
{
    double node[2][NODES];
    gauss(node);
    result[0] = result[1] = result[2] = 0;
    refine(c, node, 0, 0, 1, 0, result);
}

void area_cell(area_case *c, int kind, double roughness, double view_degrees, double anisotropy,
               double view_turn)
{
    double theta = view_degrees * PI / 180;
    memset(c, 0, sizeof *c);
    c->kind = kind;
    c->v[0] = sin(theta) * cos(view_turn);
    c->v[1] = sin(theta) * sin(view_turn);
    c->v[2] = cos(theta);
    c->ax = fmin(1, roughness * roughness * sqrt(anisotropy));
    c->ay = c->ax / anisotropy;
}

bool area_is_whole(const area_case *c)
{
    double reach = c->kind == AREA_TUBE   ? fabs(c->x[2]) + c->radius
                   : c->kind == AREA_DISK ? hypot(c->x[2], c->y[2])
                                          : fabs(c->x[2]) + fabs(c->y[2]);
    return c->centre[2] > reach;
}

void area_place(area_case *c, const double axis[3], double size, double spread, double tilt,
                double roll)
{
    double pole[3] = { 0, 0, 1 }, e[3], f[3], n[3];
    if (fabs(axis[2]) > 0.99)
        pole[0] = 1, pole[2] = 0;
    cross3(pole, axis, e);
    double length = sqrt(dot3(e, e));
    for (int k = 0; k < 3; k++)
        e[k] /= length;
    cross3(axis, e, f);
    for (int k = 0; k < 3; k++) {
        double a = cos(roll) * e[k] + sin(roll) * f[k], b = cos(roll) * f[k] - sin(roll) * e[k];
        e[k] = a;
        n[k] = b;
    }
    for (int k = 0; k < 3; k++) {
        c->centre[k] = axis[k];
        c->x[k] = size * spread * (cos(tilt) * e[k] + sin(tilt) * axis[k]);
        c->y[k] = -size * n[k];
    }
    c->radius = size;
}
