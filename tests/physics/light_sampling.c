// Directions sampled towards lights of extent: their density, what they hit, and the light that
// they bring.
#include "light_case.h"

#include "physics/sampling.glsl"

#include "area_truth.h"
#include "chi_squared.h"
#include "near.h"

static const double TAU = 6.283185307179586;

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

static void unit3(const double a[3], double b[3])
{
    double length = sqrt(dot3(a, a));
    for (int k = 0; k < 3; k++)
        b[k] = a[k] / length;
}

static void direction(uint64_t *seed, double d[3])
{
    double z = 2 * chi_next(seed) - 1, phi = TAU * chi_next(seed), r = sqrt(1 - z * z);
    d[0] = r * cos(phi);
    d[1] = r * sin(phi);
    d[2] = z;
}

static bool is_flat(const light_case *l)
{
    return l->kind == LIGHT_RECT || l->kind == LIGHT_DISK || l->kind == LIGHT_TRIANGLE;
}

// ---- the cases ---------------------------------------------------------------

// How a light is seen.
enum {
    SEEN_SMALL,
    SEEN_FACING,
    SEEN_TILTED,
    SEEN_LARGE,
    SEEN_NEAR,
    SEEN_GRAZING,
    SEEN_STRIP,
    SEEN_INSIDE
};
enum { SEEN_COUNT = 8, LIGHTS = 6 * SEEN_COUNT * 2 };

// `size` of the half axes along x, `ratio` of y's; turned `tilt` from facing the place.
static light_case light_make(int kind, double size, double ratio, double tilt, uint64_t *seed)
{
    light_case l = { kind, { 0 }, { 0 }, { 0 }, kind == LIGHT_TUBE ? size * ratio : size };
    double any[3], e[3], f[3];
    direction(seed, l.c);
    direction(seed, any);
    cross3(l.c, any, e);
    unit3(e, e);
    cross3(e, l.c, f);
    for (int k = 0; k < 3; k++) {
        l.x[k] = size * (cos(tilt) * e[k] + sin(tilt) * l.c[k]);
        l.y[k] = size * ratio * f[k];
    }
    for (int k = 0; k < 3; k++) { // float's numbers in double
        l.c[k] = (double)(float)l.c[k];
        l.x[k] = (double)(float)l.x[k];
        l.y[k] = (double)(float)l.y[k];
    }
    l.radius = (double)(float)l.radius;
    return l;
}

static light_case light_turned(light_case l)
{
    for (int k = 0; k < 3; k++) {
        double x = l.x[k];
        l.x[k] = l.y[k];
        l.y[k] = x;
    }
    return l;
}

static light_case light_seen(int kind, int seen, bool slim, uint64_t *seed)
{
    double ratio = slim ? 0.1 : 0.8;
    bool sun = kind == LIGHT_SUN, tube = kind == LIGHT_TUBE;
    light_case strip = light_make(kind, 0.5, 0.002, 1.568, seed);
    switch (seen) {
    case SEEN_SMALL: return light_make(kind, slim ? 1e-3 : 0.02, ratio, 0.6, seed);
    case SEEN_FACING: return light_make(kind, 0.3, ratio, 0, seed);
    case SEEN_TILTED: return light_make(kind, 0.5, ratio, 1.1, seed);
    case SEEN_LARGE: return light_make(kind, slim ? 0.98 : 0.9, ratio, 0.5, seed);
    case SEEN_NEAR:
        return light_make(kind, sun ? 1.5 : 5, slim ? 0.15 : tube ? 0.1999 : 1, 0, seed);
    case SEEN_GRAZING: return light_make(kind, sun ? 0.00465 : 0.8, ratio, 1.52, seed);
    case SEEN_STRIP: return slim && !tube ? light_turned(strip) : strip;
    default: return light_make(kind, sun ? 1e-4 : 3, slim ? 0.5 : 1, 1.3, seed);
    }
}

static int lights(light_case out[LIGHTS])
{
    uint64_t seed = 5;
    for (int i = 0; i < LIGHTS; i++)
        out[i] = light_seen(i / 2 / SEEN_COUNT, i / 2 % SEEN_COUNT, i % 2, &seed);
    return LIGHTS;
}

// ---- the charts --------------------------------------------------------------

// Directions about an axis, up to an angle; or what is seen of a plane.
typedef struct chart {
    const light_case *light;
    bool flat;
    double height; // 1 - cos of that angle
    double axis[3], e[3], f[3];
    double origin[3], side_s[3], side_t[3]; // of the plane
} chart;

// The plane of the tube's axis that faces the place: what lies nearer or farther by the radius,
// seen on it.  Seen from its end it is no plane's.
static void chart_plane_of_tube(const light_case *l, chart *h)
{
    double k[3], e[3], f[3], r = l->radius, size = sqrt(dot3(l->x, l->x));
    unit3(l->x, k);
    double middle = dot3(l->c, k), low = middle - size - r, high = middle + size + r;
    for (int i = 0; i < 3; i++)
        e[i] = l->c[i] - middle * k[i];
    double out = sqrt(dot3(e, e));
    if (out < 1.01 * r)
        return;
    double width = r * out / sqrt(out * out - r * r);
    low *= low < 0 ? out / (out - r) : out / (out + r);
    high *= high < 0 ? out / (out + r) : out / (out - r);
    cross3(k, e, f);
    h->flat = true;
    for (int i = 0; i < 3; i++) {
        h->side_s[i] = (high - low) * k[i];
        h->side_t[i] = 2.4 * width * f[i] / out;
        h->origin[i] = e[i] + low * k[i] - h->side_t[i] / 2;
    }
}

static chart chart_make(const light_case *l)
{
    chart h = { .light = l, .height = 2 };
    double pole[3] = { 0, 0, 1 }, d2 = dot3(l->c, l->c);
    unit3(l->c, h.axis);
    cross3(pole, h.axis, h.e);
    unit3(h.e, h.e);
    cross3(h.axis, h.e, h.f);
    // Lights end where cells do.
    double sine = l->kind == LIGHT_SUN ? sin(l->radius) : l->radius / sqrt(d2);
    if (l->kind == LIGHT_SPHERE || l->kind == LIGHT_SUN)
        h.height = sine < 1 ? fmin(1.2 * sine * sine / (1 + sqrt(1 - sine * sine)), 2) : 2;
    double reach =
        is_flat(l) ? sqrt(dot3(l->x, l->x) + dot3(l->y, l->y)) : sqrt(dot3(l->x, l->x)) + l->radius;
    if (l->kind == LIGHT_TRIANGLE || (is_flat(l) && reach < 1.2)) {
        bool corner = l->kind == LIGHT_TRIANGLE;
        h.flat = true;
        for (int k = 0; k < 3; k++) {
            h.side_s[k] = (corner ? 1 : 2) * 1.2 * l->x[k];
            h.side_t[k] = (corner ? 1 : 2) * 1.2 * l->y[k];
            h.origin[k] = l->c[k] + (corner ? 0.5 : 0) * (l->x[k] + l->y[k]) -
                          (h.side_s[k] + h.side_t[k]) / 2;
        }
    } else if (l->kind == LIGHT_TUBE && reach < 1) {
        h.height = reach * reach / (1 + sqrt(1 - reach * reach)); // of the sphere about it
        chart_plane_of_tube(l, &h);
    }
    return h;
}

static bool light_covers(const light_case *l, const double wi[3])
{
    if (l->kind == LIGHT_TUBE)
        return true; // its density says it
    if (l->kind != LIGHT_TRIANGLE)
        return light_hit_double(l, wi) > 0;
    // On one side of the three planes through the place and an edge.
    double b[3], c[3], n[3], side[3];
    for (int k = 0; k < 3; k++) {
        b[k] = l->c[k] + l->x[k];
        c[k] = l->c[k] + l->y[k];
    }
    cross3(l->c, b, n);
    side[0] = dot3(n, wi);
    cross3(b, c, n);
    side[1] = dot3(n, wi);
    double volume = dot3(n, l->c);
    cross3(c, l->c, n);
    side[2] = dot3(n, wi);
    for (int k = 0; k < 3; k++)
        if (side[k] * volume < 0)
            return false;
    return true;
}

static double chart_density(const void *of, double s, double t)
{
    const chart *h = of;
    double d[3], spread;
    if (h->flat) {
        double n[3];
        for (int k = 0; k < 3; k++)
            d[k] = h->origin[k] + s * h->side_s[k] + t * h->side_t[k];
        cross3(h->side_s, h->side_t, n);
        spread = fabs(dot3(n, d)) / pow(dot3(d, d), 1.5);
        unit3(d, d);
    } else {
        double drop = s * h->height, r = sqrt(drop * (2 - drop));
        for (int k = 0; k < 3; k++)
            d[k] = (1 - drop) * h->axis[k] + r * (cos(TAU * t) * h->e[k] + sin(TAU * t) * h->f[k]);
        spread = TAU * h->height;
    }
    return light_covers(h->light, d) ? spread * light_density_double(h->light, d) : 0;
}

static void chart_place(const chart *h, const double d[3], double place[2])
{
    if (h->flat) { // along the normals of the two planes through the place and a side
        double n[3], m[3];
        cross3(h->side_s, h->side_t, n);
        double to = dot3(n, h->origin) / dot3(n, d);
        for (int k = 0; k < 3; k++)
            m[k] = to * d[k] - h->origin[k];
        place[0] = dot3(m, h->side_s) / dot3(h->side_s, h->side_s);
        place[1] = dot3(m, h->side_t) / dot3(h->side_t, h->side_t);
        return;
    }
    double x = dot3(d, h->e), y = dot3(d, h->f), z = dot3(d, h->axis);
    double turn = atan2(y, x) / TAU;
    double drop = z > 0 ? (x * x + y * y) / (1 + z) : 1 - z;
    place[0] = drop / h->height;
    place[1] = turn - floor(turn);
}

static void chart_sample(const void *of, const double u[2], double place[2])
{
    const chart *h = of;
    vec3 wi = light_case_sample(h->light, vec2((float)u[0], (float)u[1])).direction;
    chart_place(h, (double[]) { (double)wi[0], (double)wi[1], (double)wi[2] }, place);
}

// ---- tests -------------------------------------------------------------------

static void lights_have_the_density_they_claim(void **state)
{
    (void)state;
    light_case all[LIGHTS];
    int count = lights(all);
    double least = 1 - pow(1 - 1e-3, 1.0 / count); // Sidak
    for (int i = 0; i < count; i++) {
        chart h = chart_make(&all[i]);
        chi_chart chi = { &h, chart_density, chart_sample };
        // A tube's two parts differ little.
        bool mixed = all[i].kind == LIGHT_TUBE && i % (2 * SEEN_COUNT) == 2 * SEEN_FACING;
        int samples = mixed ? 1500000 : 100000;
        double total, chance = chi_squared(&chi, samples, 31 + (uint64_t)i, &total);
        if (!(chance > least && fabs(total - 1) < 2e-3))
            print_error("light %d: kind %d, seen %d, chance %g, total %g\n", i, all[i].kind,
                        i / 2 % SEEN_COUNT, chance, total);
        assert_true(chance > least);
        assert_near(total, 1, 2e-3);
    }
}

// Every sample is a direction that hits, at its distance, and has the density of that direction.
// Rounding carries a few of a small light's across its outline.
static void samples_are_what_they_say(void **state)
{
    (void)state;
    enum { COUNT = 4000 };
    light_case all[LIGHTS];
    for (int i = 0; i < lights(all); i++) {
        const light_case *l = &all[i];
        int missed = 0;
        for (uint k = 0; k < COUNT; k++) {
            light_sample s = light_case_sample(l, sampling_hammersley(k, COUNT));
            float hit = light_case_hit(l, s.direction);
            assert_near((double)dot(s.direction, s.direction), 1, 1e-6);
            assert_true(s.distance > 0 && s.density > 0 && s.density < 1e12f);
            float density = light_case_density(l, s.direction);
            if (hit < 0 || density <= 0) {
                missed++;
                continue;
            }
            // A disk's and a tube's changes fast at the outline.
            double near = l->kind == LIGHT_DISK || l->kind == LIGHT_TUBE ? 0.02 : 2e-4;
            assert_near((double)(density / s.density), 1, near);
            if (l->kind != LIGHT_SUN)
                assert_near((double)(hit / s.distance), 1, 1e-3);
        }
        assert_true(missed <= (i / 2 % SEEN_COUNT == SEEN_STRIP ? COUNT / 100 : COUNT / 1000));
    }
}

// What rounding costs the densities.
static void float_is_enough(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int i = 0; i < 6 * 400; i++) {
        light_case l = light_make(i % 6, pow(10, -5 * chi_next(&seed)), 0.2 + chi_next(&seed),
                                  1.3 * chi_next(&seed), &seed);
        vec3 wi = light_case_sample(&l, vec2(0.3f, 0.6f)).direction;
        double d[3] = { (double)wi[0], (double)wi[1], (double)wi[2] };
        double exact = light_density_double(&l, d);
        // wi of a small disk or tube has rounded, and so have a small triangle's corners.
        bool all = l.kind == LIGHT_SPHERE || l.kind == LIGHT_SUN || l.kind == LIGHT_RECT;
        if (all || dot3(l.x, l.x) > 1e-7)
            assert_near((double)light_case_density(&l, wi), exact, 3e-3 * exact);
    }
}

static void ends_of_the_square_are_directions(void **state)
{
    (void)state;
    const float end[] = { 0, 0.5f, 0.99999994f };
    uint64_t seed = 9;
    for (int i = 0; i < 20000; i++) {
        double size = pow(10, 9 * chi_next(&seed) - 6), ratio = pow(10, -4 * chi_next(&seed));
        light_case l = light_make(i % 6, size, ratio, TAU / 4 * chi_next(&seed), &seed);
        if (l.kind == LIGHT_SUN)
            l.radius = fmin(l.radius, 1.57);
        for (int k = 0; k < 3 && i % 5 == 0; k++) // the place at the centre, or in the plane
            l.c[k] = i % 2 ? 0.1 * l.x[k] + 2 * l.y[k] : l.kind == LIGHT_SUN ? l.c[k] : 0;
        if (dot3(l.c, l.c) <= 0 && l.kind != LIGHT_SPHERE && l.kind != LIGHT_TUBE)
            continue;
        light_sample s = light_case_sample(&l, vec2(end[i % 3], end[i / 3 % 3]));
        assert_near((double)dot(s.direction, s.direction), 1, 1e-5);
        assert_true(s.density >= 0 && s.density < 1e31f && s.distance > 0);
        float density = light_case_density(&l, s.direction);
        float hit = light_case_hit(&l, s.direction);
        assert_true(density >= 0 && density < 1e31f && hit > -1e30f);
    }
}

// ---- the light they bring ----------------------------------------------------

enum { POINTS = 1 << 14 };

// The mean of 1 / density.
static double solid_angle(const light_case *l)
{
    double sum = 0;
    for (uint k = 0; k < POINTS; k++)
        sum += 1 / (double)light_case_sample(l, sampling_hammersley(k, POINTS)).density;
    return sum / POINTS;
}

static void solid_angles_are_the_textbook_ones(void **state)
{
    (void)state;
    for (int i = 1; i < 40; i++) {
        double r = i < 20 ? pow(10, -0.2 * i) : 0.049 * (i - 19), x = 0.3 * i, y = 2.0 / i;
        double cap = TAU * 2 * pow(sin(asin(r) / 2), 2);
        light_case sphere = { LIGHT_SPHERE, { 0, 0.6, 0.8 }, { 0 }, { 0 }, r };
        assert_near(solid_angle(&sphere) / cap, 1, 1e-5);
        light_case sun = { LIGHT_SUN, { 0, 0.6, -0.8 }, { 0 }, { 0 }, asin(r) };
        assert_near(solid_angle(&sun) / cap, 1, 1e-5);
        // Seen along its axis, only an end.
        light_case tube = { LIGHT_TUBE, { 0, 1.8, 2.4 }, { 0, 1.2, 1.6 }, { 0 }, r };
        assert_near(solid_angle(&tube) / cap, 1, 1e-4);
        light_case disk = { LIGHT_DISK, { 0, 0, 1 }, { 0, r, 0 }, { r, 0, 0 }, 0 };
        assert_near(solid_angle(&disk) / (TAU * (1 - 1 / hypot(1, r))), 1, r < 0.1 ? 2e-3 : 1e-4);
        // A corner above the place.
        light_case rect = { LIGHT_RECT, { x / 2, y / 2, 1 }, { x / 2, 0, 0 }, { 0, y / 2, 0 }, 0 };
        assert_near(solid_angle(&rect), atan(x * y / sqrt(1 + x * x + y * y)), 1e-5);
        // The octant, cut at any height.
        light_case octant = { LIGHT_TRIANGLE, { 1, 0, 0 }, { -1, x, 0 }, { -1, 0, y }, 0 };
        assert_near(solid_angle(&octant) / (TAU / 4), 1, i < 10 ? 0.02 : 0.3);
    }
}

// Irradiance over pi, of radiance 1.
static double irradiance(const light_case *l)
{
    double sum = 0;
    for (uint k = 0; k < POINTS; k++) {
        light_sample s = light_case_sample(l, sampling_hammersley(k, POINTS));
        sum += (double)(max(s.direction[2], 0.0f) / s.density);
    }
    return sum / POINTS * 2 / TAU;
}

static void area_lights_light_as_their_area_does(void **state)
{
    (void)state;
    const int kinds[] = { LIGHT_RECT, LIGHT_DISK, LIGHT_TUBE };
    uint64_t seed = 77;
    int cut = 0;
    for (int i = 0; i < 90; i++) {
        area_case c;
        double axis[3], truth[3];
        int kind = i % 3;
        area_cell(&c, kind == 0 ? AREA_QUAD : kind == 1 ? AREA_DISK : AREA_TUBE, 1, 0, 1, 0);
        direction(&seed, axis);
        area_place(&c, axis, 0.02 + 0.7 * chi_next(&seed), 1 + i % 4, 1.2 * chi_next(&seed), i);
        double outside = sqrt(dot3(c.x, c.x)) + c.radius;
        if (kind == 2 && outside > 0.95)
            continue;
        area_truth(&c, truth);
        light_case l = { kinds[kind], { 0 }, { 0 }, { 0 }, c.radius };
        for (int k = 0; k < 3; k++) {
            l.c[k] = c.centre[k];
            l.x[k] = c.x[k];
            l.y[k] = c.y[k];
        }
        assert_near(irradiance(&l), truth[2], 1e-3 * truth[2] + 1e-4);
        cut += truth[2] > 1e-3 && !area_is_whole(&c);
    }
    assert_true(cut > 20);
}

// Rings about the axis; of each, what is above the horizon.
static double cap_irradiance(double height, double sine)
{
    enum { RINGS = 2000 };
    double sum = 0, top = 1 - sqrt(1 - sine * sine);
    for (int i = 0; i < RINGS; i++) {
        double drop = top * (i + 0.5) / RINGS, c = 1 - drop, s = sqrt(drop * (2 - drop));
        double a = c * height, b = s * sqrt(1 - height * height); // a + b cos(turn)
        double turn = b <= fabs(a) ? (a > 0 ? TAU / 2 : 0) : acos(-a / b);
        sum += 2 * (a * turn + b * sin(turn)) * top / RINGS;
    }
    return sum * 2 / TAU;
}

static void caps_light_as_their_rings_do(void **state)
{
    (void)state;
    for (int i = 0; i < 60; i++) {
        double size = i % 6 == 0 ? 0.00465 : 0.19 * (i % 6), z = -0.9 + 0.19 * (i / 6);
        double sine = i % 2 ? sin(size) : size, expected = cap_irradiance(z, sine);
        light_case l = {
            i % 2 ? LIGHT_SUN : LIGHT_SPHERE, { sqrt(1 - z * z), 0, z }, { 0 }, { 0 }, size
        };
        assert_near(irradiance(&l), expected, 1e-3 * expected + 1e-4 * sine * sine);
    }
}

// Triangles against Lambert's sum over their edges.
static void triangles_light_as_their_edges_do(void **state)
{
    (void)state;
    uint64_t seed = 8;
    for (int i = 0; i < 40; i++) {
        light_case l = light_make(LIGHT_TRIANGLE, 0.6 * chi_next(&seed), 1, 0.7, &seed);
        l.c[2] = fabs(l.c[2]) + 0.7;
        double sum = 0, p[3][3];
        for (int k = 0; k < 3; k++) {
            p[0][k] = l.c[k];
            p[1][k] = l.c[k] + l.x[k];
            p[2][k] = l.c[k] + l.y[k];
        }
        for (int k = 0; k < 3; k++) {
            double n[3];
            cross3(p[k], p[(k + 1) % 3], n);
            double across = sqrt(dot3(n, n));
            sum += atan2(across, dot3(p[k], p[(k + 1) % 3])) * n[2] / across;
        }
        assert_near(irradiance(&l), fabs(sum) / TAU, 1e-3 * fabs(sum) / TAU);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_have_the_density_they_claim),
        cmocka_unit_test(samples_are_what_they_say),
        cmocka_unit_test(float_is_enough),
        cmocka_unit_test(ends_of_the_square_are_directions),
        cmocka_unit_test(solid_angles_are_the_textbook_ones),
        cmocka_unit_test(area_lights_light_as_their_area_does),
        cmocka_unit_test(caps_light_as_their_rings_do),
        cmocka_unit_test(triangles_light_as_their_edges_do),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
