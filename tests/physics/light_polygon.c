// The form factor of a rectangle against quadrature over its area.
#include "physics/light_polygon.glsl"

#include "near.h"

typedef struct rectangle {
    double centre[3], u[3], v[3]; // half sides
} rectangle;

static double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double next(uint *state)
{
    *state = *state * 747796405u + 2891336453u;
    uint word = ((*state >> ((*state >> 28) + 4u)) ^ *state) * 277803737u;
    return ((word >> 22) ^ word) / 4294967296.0;
}

// Corners in the order that faces the side to which u x v points.
static double form_factor(const rectangle *r)
{
    vec3 p[4];
    for (int i = 0; i < 4; i++) {
        double su = i == 1 || i == 2 ? 1 : -1, sv = i >= 2 ? 1 : -1;
        for (int k = 0; k < 3; k++)
            p[i][k] = (float)(r->centre[k] + su * r->u[k] + sv * r->v[k]);
    }
    return (double)light_quad_form_factor(p[0], p[1], p[2], p[3]);
}

// Midpoints: integral of cos cos' / (pi r^2) over the front's area above the horizon.
static double by_area(const rectangle *r, int n)
{
    double m[3] = { r->u[1] * r->v[2] - r->u[2] * r->v[1], r->u[2] * r->v[0] - r->u[0] * r->v[2],
                    r->u[0] * r->v[1] - r->u[1] * r->v[0] };
    double sum = 0;
    for (int i = 0; i < n * n; i++) {
        double a = 2 * (i / n + 0.5) / n - 1, b = 2 * (i % n + 0.5) / n - 1, p[3];
        for (int k = 0; k < 3; k++)
            p[k] = r->centre[k] + a * r->u[k] + b * r->v[k];
        double p2 = dot3(p, p);
        sum += fmax(p[2], 0) * fmax(-dot3(p, m), 0) / (p2 * p2);
    }
    return sum * 4 / n / n / 3.14159265358979324;
}

static void random_rectangle(uint *seed, rectangle *r)
{
    for (int k = 0; k < 3; k++) {
        r->centre[k] = 4 * next(seed) - 2;
        r->u[k] = 2 * next(seed) - 1;
        r->v[k] = 2 * next(seed) - 1;
    }
    double uv = dot3(r->u, r->v) / dot3(r->u, r->u);
    for (int k = 0; k < 3; k++)
        r->v[k] -= uv * r->u[k];
}

static void rectangles_light_as_their_area_does(void **state)
{
    (void)state;
    uint seed = 7;
    int cut = 0, front = 0;
    for (int i = 0; i < 400; i++) {
        rectangle r;
        random_rectangle(&seed, &r);
        double gap = 1.5 * (sqrt(dot3(r.u, r.u)) + sqrt(dot3(r.v, r.v)));
        for (int k = 0; k < 3; k++) // never so near that midpoints would not do
            r.centre[k] *= 1 + gap / sqrt(dot3(r.centre, r.centre));
        double expected = by_area(&r, 120);
        assert_near(form_factor(&r), expected, 2e-4);
        front += expected > 1e-4;
        double reach = fabs(r.u[2]) + fabs(r.v[2]);
        cut += expected > 1e-4 && fabs(r.centre[2]) < reach;
    }
    assert_true(front > 80 && cut > 20);
}

// A ceiling that fills the half space above, a wall that fills half of it.
static void endless_rectangles_fill_what_they_should(void **state)
{
    (void)state;
    rectangle ceiling = { { 0, 0, 1 }, { 0, 1e4, 0 }, { 1e4, 0, 0 } };
    assert_near(form_factor(&ceiling), 1, 1e-3);
    rectangle wall = { { 1, 0, 0 }, { 0, 1e4, 0 }, { 0, 0, -1e4 } };
    assert_near(form_factor(&wall), 0.5, 1e-3);
    rectangle behind = { { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 } };
    assert_near(form_factor(&behind), 0, 0);
}

// As books on heat transfer have it: a parallel rectangle with a corner above the point,
// (X/A atan(Y/A) + Y/B atan(X/B)) / 2 pi with A^2 = 1 + X^2, B^2 = 1 + Y^2.
static void a_parallel_rectangle_is_the_textbook_one(void **state)
{
    (void)state;
    for (int i = 1; i <= 10; i++) {
        double x = 0.3 * i, y = 2.0 / i, a = sqrt(1 + x * x), b = sqrt(1 + y * y);
        rectangle r = { { x / 2, y / 2, 1 }, { 0, y / 2, 0 }, { x / 2, 0, 0 } };
        double expected = (x / a * atan(y / a) + y / b * atan(x / b)) / (2 * 3.14159265358979324);
        assert_near(form_factor(&r), expected, 1e-6);
    }
}

static void no_rectangle_breaks_it(void **state)
{
    (void)state;
    uint seed = 23;
    for (int i = 0; i < 100000; i++) {
        rectangle r;
        random_rectangle(&seed, &r);
        int odd = i % 8;
        for (int k = 0; k < 3; k++) {
            double corner = odd == 0 ? r.u[k] + r.v[k] : odd == 1 ? r.u[k] : 0;
            r.centre[k] = odd <= 2 ? corner : r.centre[k]; // the point on a corner, an edge, inside
            r.u[k] *= odd == 3 ? 0 : odd == 4 ? 1e-8 : 1;  // a line, nearly a line
            r.v[k] *= odd == 4 ? 1e-8 : odd == 5 ? 1e6 : 1;
        }
        if (odd == 6)
            r.centre[2] = r.u[2] = r.v[2] = 0; // in the surface's plane
        double f = form_factor(&r);
        assert_true(f >= 0 && f <= 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rectangles_light_as_their_area_does),
        cmocka_unit_test(endless_rectangles_fill_what_they_should),
        cmocka_unit_test(a_parallel_rectangle_is_the_textbook_one),
        cmocka_unit_test(no_rectangle_breaks_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
