// docs/errata.md, lights: each printed form, written out here, misses a truth that the text of
// shaders/physics meets.
#define real double
#include "physics/ambient.glsl"
#include "physics/light_punctual.glsl"
#include "physics/light_representative.glsl"
#include "physics/light_sphere.glsl"
#include "physics/surface.glsl"

#include "albedo.h"
#include "cap_truth.h"
#include "errata.h"

static const double HALF_TURN = 3.14159265358979324;

static double radians(double degrees)
{
    return degrees * HALF_TURN / 180.0;
}

// A direction in the plane of x and z, `degrees` off the normal z.
static vec3 at(double degrees)
{
    return vec3(sin(radians(degrees)), 0.0, cos(radians(degrees)));
}

// A light whose centre is at distance 1 and at `degrees`, with radius s.
static light_cap cap_at(double degrees, double s)
{
    return light_cap_sphere(at(degrees), s);
}

// The form factor over that of a small facing light, by quadrature over the cap: integral of the
// clamped cosine over pi s^2.
static double cosine_truth(double degrees, double s)
{
    enum { STEPS = 800 };
    double least = sqrt(1.0 - s * s), sum = 0.0;
    vec3 axis = at(degrees), up = at(degrees + 90.0);
    for (int i = 0; i < STEPS * STEPS; i++) {
        double z = 1.0 - (1.0 - least) * (i % STEPS + 0.5) / STEPS, r = sqrt(1.0 - z * z);
        double phi = HALF_TURN * (i / STEPS + 0.5) / STEPS;
        sum += fmax(z * axis[2] + r * cos(phi) * up[2], 0.0);
    }
    return sum * 2.0 * (1.0 - least) / (STEPS * (double)STEPS * s * s);
}

static cap_case cap_of(double view, double light, double s, double alpha)
{
    vec3 v = at(view), l = at(light);
    cap_case c = { { v[0], v[1], v[2] }, { l[0], l[1], l[2] }, s, sqrt(1.0 - s * s), alpha, alpha };
    return c;
}

// ---- The point light ----------------------------------------------------------------------------

// 23: a light of flux 1 has the intensity 1 / 4 pi: what falls on a sphere around it is its flux.
static void intensity_is_not_flux(void **state)
{
    (void)state;
    double flux = 23.47, around = 2.0 * TURN * 9.0 * light_point(9.0, 0.0);
    assert_near(flux / (2.0 * TURN) * around, flux, 1e-6);
    assert_misses(flux * around, flux, 10.0 * flux);
}

// 24: a plane below a light catches half of its flux; with the first listing's cosine and the
// last one's, a quarter.
static void the_cosine_counts_once(void **state)
{
    (void)state;
    surface_material m = { .base_color = vec3(1.0, 1.0, 1.0), .roughness = 1.0 };
    surface s = surface_from_metallic_roughness(m, 1.0, vec2(0.0, 0.0));
    double once = 0.0, twice = 0.0;
    enum { STEPS = 2000 };
    for (int i = 0; i < STEPS; i++) { // rings of the plane z = -1, seen at equal steps of angle
        double t = HALF_TURN / 2.0 * (i + 0.5) / STEPS, r = tan(t), d2 = 1.0 + r * r;
        double area = TURN * r * d2 * HALF_TURN / 2.0 / STEPS;
        vec3 n = vec3(0.0, 0.0, 1.0), wi = vec3(sin(t), 0.0, cos(t));
        double received = surface_direct(s, n, n, wi)[0] * HALF_TURN * light_point(d2, 0.0);
        once += received * area;
        twice += received * cos(t) * area;
    }
    assert_near(once, TURN, 1e-3);
    assert_misses(twice, TURN, 3.0);
}

// ---- The sphere's light -------------------------------------------------------------------------

// 3: L = I / R^2 gives pi times the light of a point of that intensity, and makes the highlight
// another light than the irradiance and the visible body.
static void a_sphere_has_the_radiance_of_its_intensity(void **state)
{
    (void)state;
    for (int i = 1; i <= 3; i++) {
        double s = 0.3 * i, intensity = 5.0, facing = cosine_truth(0.0, s) * HALF_TURN * s * s;
        // What L = I / (pi R^2) gives.
        assert_near(intensity / (HALF_TURN * s * s) * facing, intensity, 1e-4);
        assert_misses(intensity / (s * s) * facing, intensity, 2.0 * intensity);
        assert_near(light_cap_cosine(cap_at(0.0, s)), 1.0, 1e-6);
        // A mirror shows the body.
        vec2 seen = light_cap_ggx(cap_at(0.0, s), at(0.01), 0.002, 0.002);
        assert_near(seen[0] * s * s * HALF_TURN, 1.0, 1e-2);
    }
}

static double printed_form_factor(double h, double beta)
{
    double x = sqrt(h * h - 1.0), y = -x * (1.0 / tan(beta));
    if (h * cos(beta) > 1.0)
        return cos(beta) / (h * h);
    double q = sin(beta) * sqrt(1.0 - y * y);
    return (cos(beta) * acos(y) - x * q) / (HALF_TURN * h * h) + atan(q / x) / HALF_TURN;
}

// 4: right where the horizon cuts the light, nothing below it and inside it.
static void the_form_factor_is_total(void **state)
{
    (void)state;
    double s = 0.5, truth = cosine_truth(80.0, s);
    assert_near(printed_form_factor(1.0 / s, radians(80.0)) / (s * s), truth, 1e-4);
    assert_near(light_cap_cosine(cap_at(80.0, s)), truth, 1e-4);

    assert_near(cosine_truth(130.0, s), 0.0, 0.0);
    assert_near(light_cap_cosine(cap_at(130.0, s)), 0.0, 0.0);
    assert_true(isnan(printed_form_factor(1.0 / s, radians(130.0))));

    // Inside all of the sky is the light.
    assert_near(light_cap_cosine(cap_at(0.0, 1.25)), 1.0, 1e-6);
    assert_true(isnan(printed_form_factor(0.8, radians(30.0))));
    // dot(n, l) of two unit vectors may round to more than 1.
    assert_true(isnan(printed_form_factor(4.0, acos(nextafter(1.0, 2.0)))));
    light_cap cap = cap_at(0.0, 0.25);
    cap.axis[2] = nextafter(1.0, 2.0);
    assert_near(light_cap_cosine(cap), 1.0, 1e-9);
}

// 25: over the whole of the light's surface the integral is 0: its back counts as much as its
// front, with the other sign.  The front alone is the light.
static void only_the_front_shines(void **state)
{
    (void)state;
    enum { STEPS = 600 };
    double s = 0.5, whole = 0.0, front = 0.0;
    vec3 centre = at(20.0);
    for (int i = 0; i < STEPS * STEPS; i++) {
        double z = 1.0 - 2.0 * (i % STEPS + 0.5) / STEPS, r = sqrt(1.0 - z * z);
        double phi = TURN * (i / STEPS + 0.5) / STEPS;
        vec3 m = vec3(r * cos(phi), r * sin(phi), z), p = centre + s * m;
        double d2 = dot(p, p), cosines = p[2] * -dot(p, m) / (d2 * d2);
        double area = 2.0 * TURN * s * s / STEPS / STEPS / HALF_TURN;
        whole += cosines * area;
        front += fmax(p[2], 0.0) * fmax(-dot(p, m), 0.0) / (d2 * d2) * area;
    }
    assert_near(light_cap_cosine(cap_at(20.0, s)) * s * s, front, 1e-3);
    assert_near(whole, 0.0, 1e-3);
    assert_misses(whole, front, 0.2);
}

// ---- The representative point -------------------------------------------------------------------

// As printed but for the vector that is mirrored (5): the light's centre is at distance 1.
static vec3 representative(vec3 centre, vec3 mirror, double radius)
{
    vec3 c = dot(centre, mirror) * mirror - centre;
    return centre + fmin(radius / sqrt(dot(c, c)), 1.0) * c;
}

static double degrees_between(vec3 a, vec3 b)
{
    return acos(dot(normalize(a), normalize(b))) * 180.0 / HALF_TURN;
}

// 5: reflect() takes the vector that arrives.
static void reflect_takes_what_arrives(void **state)
{
    (void)state;
    vec3 n = vec3(0.0, 0.0, 1.0), v = at(60.0), right = reflect(-v, n), printed = reflect(v, n);
    assert_near(dot(right, n), dot(v, n), 1e-12);    // on this side, at the same angle,
    assert_near(cross(right + v, n)[1], 0.0, 1e-12); // in the same plane
    assert_misses(dot(printed, n), dot(v, n), 0.9);
    // A light behind the ray is drawn to its line, away from the ray.
    vec3 centre = vec3(cos(radians(100.0)), sin(radians(100.0)), 0.0), ray = vec3(1.0, 0.0, 0.0);
    vec3 project = light_representative_pull(centre, 0.5, ray);
    assert_near(degrees_between(project, ray), 100.0, 1e-6);
    assert_true(degrees_between(representative(centre, ray, 0.5), ray) > 105.0);
}

// 26: nearest to the line is not nearest in angle, which is what the lobe sees.
static void nearest_is_by_angle(void **state)
{
    (void)state;
    cap_case c = cap_of(30.0, 30.0, 0.5, 0.2); // 60 degrees off the ray
    vec2 project = light_cap_ggx(cap_at(30.0, 0.5), at(30.0), 0.2, 0.2);
    assert_near(project[0] * HALF_TURN * 0.25 / cap_truth(&c, 0), 1.0, 0.02);
    vec3 ray = vec3(1.0, 0.0, 0.0), centre = vec3(0.5, sin(radians(60.0)), 0.0);
    double least = 180.0;
    for (int i = 0; i < 100000; i++) { // the light's points in the plane of ray and centre
        double t = TURN * i / 100000;
        least = fmin(least, degrees_between(centre + vec3(0.5 * cos(t), 0.5 * sin(t), 0.0), ray));
    }
    assert_near(least, 30.0, 1e-3);
    assert_misses(degrees_between(representative(centre, ray, 0.5), ray), least, 6.0);
}

// 27: intensity over the squared distance of the representative point, which may be as near as
// the light's surface, is not what the light gives.
static void the_point_does_not_come_nearer(void **state)
{
    (void)state;
    double s = 0.5, truth = cosine_truth(0.0, s);
    vec3 p = representative(at(80.0), vec3(0.0, 0.0, 1.0), s);
    assert_near(light_cap_cosine(cap_at(0.0, s)), truth, 1e-4);
    assert_misses(1.0 / dot(p, p), truth, 2.0);
}

// 6: a light whose representative point has set still shines above the horizon.
static void a_setting_light_is_seen(void **state)
{
    (void)state;
    double s = 0.2;
    cap_case c = cap_of(1.0, 95.0, s, 1.0);
    double truth = cap_truth(&c, 0) / (HALF_TURN * s * s);
    vec2 project = light_cap_ggx(cap_at(95.0, s), at(1.0), 1.0, 1.0);
    assert_near(project[0] / truth, 1.0, 0.02);
    vec3 p = representative(at(95.0), at(-1.0), s);
    double printed = p[2] < 0.0 ? 0.0 : truth;
    assert_misses(printed / truth, 1.0, 0.5);
}

// The printed lobe with 2, 3 and 5 put right, per irradiance of a surface facing the light.
static double printed_lobe(double view, vec3 centre, double s, double alpha, bool nearer)
{
    vec3 v = at(view), p = representative(centre, at(-view), s);
    double d2 = dot(p, p), prime = fmin(alpha + s / (2.0 * sqrt(d2)), 1.0);
    vec3 l = p / sqrt(d2), h = normalize(l + v);
    if (l[2] <= 0.0)
        return 0.0;
    double f = h[2] * h[2] * (alpha * alpha - 1.0) + 1.0, g2 = albedo_g2(v[2], l[2], alpha * alpha);
    double d = alpha * alpha / (HALF_TURN * f * f) * alpha * alpha / (prime * prime);
    return d * g2 / (4.0 * fmax(v[2], 1e-2)) / (nearer ? d2 : 1.0);
}

// The places of a light around the surface.
static vec3 place(int i, int steps)
{
    double z = 1.0 - 2.0 * (i % steps + 0.5) / steps, r = sqrt(1.0 - z * z);
    double phi = TURN * (i / steps + 0.5) / steps;
    return vec3(r * cos(phi), r * sin(phi), z);
}

// What a light gives in the sum over all its places: it covers every direction with the radiance
// 1 / (pi s^2) from 2 pi (1 - cos s) of them, and of a white sky the lobe reflects its albedo.
static double energy_truth(double view, double s, double alpha)
{
    albedo e = albedo_of(cos(radians(view)), alpha, 200);
    return (e.scale + e.bias) * 2.0 * (1.0 - sqrt(1.0 - s * s)) / (s * s);
}

static double printed_energy(double view, double s, double alpha, bool nearer)
{
    enum { STEPS = 300 };
    double sum = 0.0;
    for (int i = 0; i < STEPS * STEPS; i++)
        sum += printed_lobe(view, place(i, STEPS), s, alpha, nearer) * 2.0 * TURN / STEPS / STEPS;
    return sum / energy_truth(view, s, alpha);
}

// 14: at alpha = s / 2 the peak is half of what it should be: in a small light's own scale the
// lobe has half of its normals within the light, and (alpha / alpha')^2 / (4 alpha^2) is 1 / 4.
static void the_normalisation_halves_the_peak(void **state)
{
    (void)state;
    double s = 0.02, alpha = 0.01;
    cap_case c = cap_of(0.5, -0.5, s, alpha);
    double truth = cap_truth(&c, 0) / (HALF_TURN * s * s);
    vec2 project = light_cap_ggx(cap_at(-0.5, s), at(0.5), alpha, alpha);
    assert_near(project[0] / truth, 1.0, 0.01);
    assert_near(printed_lobe(0.5, at(-0.5), s, alpha, true) / truth, 0.5, 0.01);
}

static double project_energy(double view, double s, double alpha)
{
    enum { STEPS = 100 };
    double sum = 0.0;
    for (int i = 0; i < STEPS * STEPS; i++) {
        light_cap cap = light_cap_sphere(place(i, STEPS), s);
        sum += light_cap_ggx(cap, at(view), alpha, alpha)[0] * 2.0 * TURN / STEPS / STEPS;
    }
    return sum / energy_truth(view, s, alpha);
}

static void the_normalisation_loses_and_makes_light(void **state)
{
    (void)state;
    assert_near(project_energy(1.0, 0.9, 0.25), 1.0, 0.01);
    assert_near(project_energy(80.0, 0.5, 0.09), 1.0, 0.01);
    assert_true(printed_energy(1.0, 0.9, 0.25, false) < 0.4);
    assert_true(printed_energy(80.0, 0.5, 0.09, false) > 3.0);
    assert_true(printed_energy(80.0, 0.9, 1.0, true) > 10.0); // with 27
}

// ---- Ambient light ------------------------------------------------------------------------------

// A sky of two halves about `axis`, integrated: the lower 0, the upper 1.
static double half_sky(vec3 axis, vec3 n)
{
    enum { STEPS = 400 };
    vec3 side = normalize(cross(n, vec3(0.3, -0.5, 0.8))), other = cross(n, side);
    double sum = 0.0;
    for (int i = 0; i < STEPS * STEPS; i++) {
        double z = sqrt((i % STEPS + 0.5) / STEPS), r = sqrt(1.0 - z * z);
        double phi = TURN * (i / STEPS + 0.5) / STEPS;
        vec3 l = r * cos(phi) * side + r * sin(phi) * other + z * n;
        sum += dot(l, axis) > 0.0 ? 1.0 : 0.0;
    }
    return sum / STEPS / STEPS;
}

static const vec3 WHITE = { 1.0, 1.0, 1.0 };
static const vec3 BLACK = { 0.0, 0.0, 0.0 };

// 10: the sky does not turn with the lamp.
static void the_sky_has_its_own_axis(void **state)
{
    (void)state;
    vec3 axis = vec3(0.0, 1.0, 0.0), lamp = at(90.0), n = normalize(vec3(0.3, 0.9, 0.1));
    double truth = half_sky(axis, n), printed = (dot(n, lamp) + 1.0) / 2.0;
    assert_near(ambient_hemispheric(WHITE, BLACK, axis, n)[0], truth, 2e-3);
    assert_misses(printed, truth, 0.2);
}

// 11: without its y term a sky that is bright above lights floor and ceiling alike.
static void harmonics_have_a_y(void **state)
{
    (void)state;
    vec3 axis = vec3(0.0, 1.0, 0.0);
    ambient_light sky = ambient_from_hemispheric(WHITE, BLACK, axis);
    double truth = half_sky(axis, axis) - half_sky(axis, -axis);
    assert_near(ambient_at(sky, axis)[0] - ambient_at(sky, -axis)[0], truth, 2e-3);
    double printed = 0.0; // C + x Dx + z Dz of both
    assert_misses(printed, truth, 0.9);
}

// 28: AmbColor is l_C, the mean of l_A over all normals, and not l_A.
static void the_constant_is_the_mean(void **state)
{
    (void)state;
    vec3 axis = vec3(0.0, 1.0, 0.0);
    ambient_light sky = ambient_from_hemispheric(WHITE, BLACK, axis);
    double mean = 0.0;
    enum { STEPS = 8 };
    for (int i = 0; i < STEPS; i++) {
        double y = 1.0 - 2.0 * (i + 0.5) / STEPS;
        mean += half_sky(axis, vec3(sqrt(1.0 - y * y), y, 0.0)) / STEPS;
    }
    assert_near(sky.c0[0], mean, 1e-3);
    assert_misses(half_sky(axis, axis), mean, 0.4);
}

// 29: deviations greater than the constant make the printed sum negative; light is not.
static void no_light_is_negative(void **state)
{
    (void)state;
    ambient_light sky = { .c0 = 0.2 * WHITE, .cx = 0.5 * WHITE };
    vec3 n = vec3(-1.0, 0.0, 0.0);
    assert_near(ambient_at(sky, n)[0], 0.0, 0.0);
    assert_true(0.2 + n[0] * 0.5 < 0.0);
}

// 12: lights add: each gives what it gives alone.
static void every_light_has_its_own_colour(void **state)
{
    (void)state;
    surface_material m = { .base_color = WHITE, .roughness = 0.5 };
    surface s = surface_from_metallic_roughness(m, 1.0, vec2(0.0, 0.0));
    const double lights[4][2] = { { 10.0, 1.0 }, { -20.0, 0.0 }, { 40.0, 0.0 }, { -60.0, 0.0 } };
    vec3 n = vec3(0.0, 0.0, 1.0);
    double project = 0.0, printed = 0.0;
    for (int i = 0; i < 4; i++) {
        double each = surface_direct(s, n, n, at(lights[i][0]))[0];
        project += lights[i][1] * each;
        printed += lights[0][1] * each;
    }
    double truth = cos(radians(10.0)) / HALF_TURN; // three of them are dark
    assert_near(project, truth, 1e-3);
    assert_misses(printed, truth, 0.3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intensity_is_not_flux),
        cmocka_unit_test(the_cosine_counts_once),
        cmocka_unit_test(a_sphere_has_the_radiance_of_its_intensity),
        cmocka_unit_test(the_form_factor_is_total),
        cmocka_unit_test(only_the_front_shines),
        cmocka_unit_test(reflect_takes_what_arrives),
        cmocka_unit_test(nearest_is_by_angle),
        cmocka_unit_test(the_point_does_not_come_nearer),
        cmocka_unit_test(a_setting_light_is_seen),
        cmocka_unit_test(the_normalisation_halves_the_peak),
        cmocka_unit_test(the_normalisation_loses_and_makes_light),
        cmocka_unit_test(the_sky_has_its_own_axis),
        cmocka_unit_test(harmonics_have_a_y),
        cmocka_unit_test(the_constant_is_the_mean),
        cmocka_unit_test(no_light_is_negative),
        cmocka_unit_test(every_light_has_its_own_colour),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
