// The energy and the direction of many bounces against a random walk on the microsurface, in
// double: Heitz, Hanika, d'Eon & Dachsbacher, Multiple-Scattering Microfacet BSDFs with the Smith
// Model, 2016.
#include "physics/surface.glsl"

#include "albedo.h"
#include "near.h"

static const double ROUGHNESSES[] = { 0.1, 0.3, 0.5, 0.6, 0.8, 1.0 };
static const double F0S[] = { 0.02, 0.1, 0.34, 0.5, 0.77, 1.0 };
enum { ROUGHNESS_COUNT = 6, F0_COUNT = 6, WALKS = 60000, BOUNCES = 1000 };
static const double TAU = 2.0 * 3.14159265358979324;

typedef struct direction {
    double x, y, z;
} direction;

// Albedo.
typedef struct walked {
    double first[F0_COUNT]; // of what leaves after one bounce
    double all[F0_COUNT];
} walked;

// A light without extent, and what comes from it, BRDF times cosine.
typedef struct lit {
    direction to;
    double sum[F0_COUNT];
} lit;

// SplitMix64 (Steele, Lea & Flood 2014), to [0, 1).
static double draw(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

// Smith's for GGX; of a direction down, -1 - Lambda of its opposite.
static double smith_lambda(double z, double alpha)
{
    double slope = alpha * sqrt(fmax(1.0 - z * z, 0.0)) / z;
    return 0.5 * (copysign(sqrt(1.0 + slope * slope), z) - 1.0);
}

static direction unit(direction d)
{
    double length = sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    return (direction) { d.x / length, d.y / length, d.z / length };
}

// Of the facets that `to` sees, as many from below as from above (Dupuy & Benyoub 2023).
static direction visible_normal(direction to, double alpha, uint64_t *state)
{
    direction s = unit((direction) { alpha * to.x, alpha * to.y, to.z });
    double z = 1.0 - draw(state) * (1.0 + s.z), phi = TAU * draw(state);
    double r = sqrt(fmax(1.0 - z * z, 0.0));
    return unit(
        (direction) { alpha * (r * cos(phi) + s.x), alpha * (r * sin(phi) + s.y), z + s.z });
}

// Reflects `d`, the way of the light; returns the cosine to the facet.
static double bounce(direction *d, double alpha, uint64_t *state)
{
    direction m = visible_normal((direction) { -d->x, -d->y, -d->z }, alpha, state);
    double c = fmax(-(d->x * m.x + d->y * m.y + d->z * m.z), 0.0);
    *d = unit((direction) { d->x + 2.0 * c * m.x, d->y + 2.0 * c * m.y, d->z + 2.0 * c * m.z });
    return fmin(c, 1.0);
}

static double rise(double cosine)
{
    return pow(1.0 - cosine, 5.0);
}

static double distribution(double z, double alpha)
{
    double a2 = alpha * alpha, f = 1.0 + (a2 - 1.0) * z * z;
    return z > 0.0 ? 2.0 * a2 / (TAU * f * f) : 0.0;
}

// The light that comes along `d` from the facet met there: of the facets that are seen, the
// share that sends it, times the chance that it has come down unhindered.
static void gather(lit *l, direction d, double alpha, double height, const double weight[F0_COUNT])
{
    direction h = unit((direction) { l->to.x - d.x, l->to.y - d.y, l->to.z - d.z });
    double w = rise(fmin(fabs(h.x * d.x + h.y * d.y + h.z * d.z), 1.0));
    double seen = 0.5 * (sqrt(d.z * d.z + alpha * alpha * (1.0 - d.z * d.z)) - d.z);
    double p = distribution(h.z, alpha) / (4.0 * seen) * pow(height, smith_lambda(l->to.z, alpha));
    for (int f = 0; f < F0_COUNT; f++)
        l->sum[f] += p * weight[f] * (F0S[f] + (1.0 - F0S[f]) * w);
}

// One way through the surface, from `way` to that in which it leaves; returns how many facets it
// met. `height` is C1, the share of the facets that lie below: a free path from it ends above all
// of them with probability C1^Lambda.  `l` may be NULL.
static int walk(direction *way, double alpha, double weight[F0_COUNT], lit *l, uint64_t *state)
{
    direction d = *way;
    double height = 1.0;
    for (int met = 0; met < BOUNCES; met++) {
        double lambda = smith_lambda(d.z, alpha), free_path = 1.0 - draw(state);
        *way = d;
        if (d.z > 0.0 && free_path <= pow(height, lambda))
            return met;
        height = fmin(height / pow(free_path, 1.0 / lambda), 1.0);
        if (l)
            gather(l, d, alpha, height, weight);
        double w = rise(bounce(&d, alpha, state));
        for (int f = 0; f < F0_COUNT; f++)
            weight[f] *= F0S[f] + (1.0 - F0S[f]) * w;
    }
    return BOUNCES;
}

static void whole(double weight[F0_COUNT])
{
    for (int f = 0; f < F0_COUNT; f++)
        weight[f] = 1.0;
}

// Into the surface, as seen from there.
static direction from_eye(double cosine)
{
    return (direction) { sqrt(1.0 - cosine * cosine), 0.0, -cosine };
}

static walked walk_all(double alpha, double NoV)
{
    uint64_t state = 1;
    walked sum = { { 0.0 }, { 0.0 } };
    for (int i = 0; i < WALKS; i++) {
        double weight[F0_COUNT];
        direction way = from_eye(NoV);
        whole(weight);
        int met = walk(&way, alpha, weight, NULL, &state);
        for (int f = 0; f < F0_COUNT && met < BOUNCES; f++) {
            sum.first[f] += met == 1 ? weight[f] / WALKS : 0.0;
            sum.all[f] += weight[f] / WALKS;
        }
    }
    return sum;
}

// `e` by quadrature.
static surface metal(albedo e, double roughness, double f0, double NoV)
{
    float base = (float)f0;
    surface_material m = { .base_color = vec3(base, base, base), .metallic = 1.0f };
    m.roughness = (float)roughness;
    vec2 dfg = vec2((float)e.scale, (float)e.bias);
    return surface_from_metallic_roughness(m, (float)NoV, dfg);
}

static void the_walk_keeps_all_light(void **state)
{
    (void)state;
    for (int r = 0; r < ROUGHNESS_COUNT; r++)
        assert_near(walk_all(ROUGHNESSES[r] * ROUGHNESSES[r], 0.4).all[F0_COUNT - 1], 1.0, 1e-9);
}

static void bounces_return_what_the_walk_does(void **state)
{
    (void)state;
    static const double eyes[] = { 0.1, 0.3, 0.5, 0.75, 0.97 };
    for (int i = 0; i < 5 * ROUGHNESS_COUNT; i++) {
        double roughness = ROUGHNESSES[i / 5], alpha = roughness * roughness, NoV = eyes[i % 5];
        walked truth = walk_all(alpha, NoV);
        albedo e = albedo_of(NoV, alpha, 60);
        for (int f = 0; f < F0_COUNT; f++) {
            surface s = metal(e, roughness, F0S[f], NoV);
            assert_near((double)s.single[0], truth.first[f], 0.006);
            assert_near((double)(s.single[0] + s.bounced[0]), truth.all[f],
                        0.016 * (truth.all[f] + 0.04));
        }
    }
}

// ---- Direction -----------------------------------------------------------------------

typedef struct moments {
    double up, forwards; // of the light that leaves after more than one bounce
} moments;

static void walk_moments(double alpha, double NoV, moments sums[F0_COUNT])
{
    uint64_t state = 2;
    for (int i = 0; i < WALKS; i++) {
        double weight[F0_COUNT];
        direction way = from_eye(NoV);
        whole(weight);
        int met = walk(&way, alpha, weight, NULL, &state);
        for (int f = 0; f < F0_COUNT && met > 1 && met < BOUNCES; f++) {
            sums[f].up += weight[f] * way.z / WALKS;
            sums[f].forwards += weight[f] * way.x / WALKS;
        }
    }
}

// A surface's, by quadrature of all that is not its lobe.
static moments surface_moments(surface s, double NoV)
{
    enum { STEPS = 48 };
    moments sum = { 0.0, 0.0 };
    for (int i = 0; i < STEPS * STEPS; i++) {
        double z = sqrt((i / STEPS + 0.5) / STEPS), r = sqrt(1.0 - z * z); // cosine-weighted
        double x = r * cos(TAU * (i % STEPS + 0.5) / STEPS);
        double LoV = z * NoV - x * sqrt(1.0 - NoV * NoV);
        double f = (double)surface_base(s, (float)NoV, (float)z, (float)LoV, 0.5f)[0];
        assert_true(f >= 0.0);
        sum.up += f * z * TAU / 2.0 / (STEPS * STEPS);
        sum.forwards += f * x * TAU / 2.0 / (STEPS * STEPS);
    }
    return sum;
}

// Below roughness .5 the distribution is held, and little light is left.
static void bounces_leave_where_the_walk_does(void **state)
{
    (void)state;
    static const double eyes[] = { 0.2, 0.5, 0.9 }, apart[] = { .01, .03, .012, .01, .006, .009 };
    for (int i = 0; i < 3 * ROUGHNESS_COUNT; i++) {
        double roughness = ROUGHNESSES[i / 3], NoV = eyes[i % 3];
        moments truth[F0_COUNT] = { { 0.0, 0.0 } };
        walk_moments(roughness * roughness, NoV, truth);
        albedo e = albedo_of(NoV, roughness * roughness, 60);
        for (int f = 0; f < F0_COUNT; f++) {
            moments ours = surface_moments(metal(e, roughness, F0S[f], NoV), NoV);
            assert_near(ours.up, truth[f].up, apart[i / 3]);
            assert_near(ours.forwards, truth[f].forwards, apart[i / 3]);
        }
    }
}

static void none_is_negative(void **state)
{
    (void)state;
    for (int i = 0; i < 400 * F0_COUNT; i++) {
        double roughness = 0.05 * (i % 20 + 1), NoV = 0.01 + 0.049 * (i / 20 % 20);
        albedo e = albedo_of(NoV, roughness * roughness, 8);
        surface_moments(metal(e, roughness, F0S[i / 400], NoV), NoV);
    }
}

// ---- Under one light ---------------------------------------------------------------

// A ball that is lit from `angle` to the eye, at a place of its disk of radius 1: the cosine of the
// eye, and the light in the place's frame, in which the eye is at -x.
typedef struct place {
    double NoV;
    direction light;
} place;

static place place_of(double radius, double phi, double angle)
{
    double c = sqrt(1.0 - radius * radius), side = sin(angle) * cos(phi);
    direction l = { -cos(angle) * radius - side * c, sin(angle) * sin(phi),
                    cos(angle) * c - side * radius };
    return (place) { c, unit(l) };
}

// Mean over the disk, by walks.
static lit walk_ball(double alpha, double angle)
{
    uint64_t state = 3;
    lit mean = { { 0.0, 0.0, 0.0 }, { 0.0 } };
    for (int i = 0; i < WALKS; i++) {
        place p = place_of(sqrt((i + 0.5) / WALKS), TAU * draw(&state), angle);
        double weight[F0_COUNT];
        direction way = from_eye(p.NoV);
        mean.to = p.light;
        whole(weight);
        if (p.light.z > 1e-3)
            walk(&way, alpha, weight, &mean, &state);
    }
    for (int f = 0; f < F0_COUNT; f++)
        mean.sum[f] /= WALKS;
    return mean;
}

static void add_ring(lit *mean, double roughness, double radius, double angle, int steps)
{
    double c = sqrt(1.0 - radius * radius);
    albedo e = albedo_of(c, roughness * roughness, 40);
    vec3 n = vec3(0.0f, 0.0f, 1.0f), wo = vec3(-(float)radius, 0.0f, (float)c);
    for (int f = 0; f < F0_COUNT; f++) {
        surface s = metal(e, roughness, F0S[f], c);
        for (int i = 0; i < steps; i++) {
            direction l = place_of(radius, TAU * (i + 0.5) / steps, angle).light;
            vec3 wi = vec3((float)l.x, (float)l.y, (float)l.z);
            mean->sum[f] += (double)surface_direct(s, n, wo, wi)[0] / steps;
        }
    }
}

static lit surface_ball(double roughness, double angle)
{
    enum { STEPS = 48 };
    lit mean = { { 0.0, 0.0, 0.0 }, { 0.0 } };
    for (int i = 0; i < STEPS; i++)
        add_ring(&mean, roughness, sqrt((i + 0.5) / STEPS), angle, STEPS);
    for (int f = 0; f < F0_COUNT; f++)
        mean.sum[f] /= STEPS;
    return mean;
}

// The darkest lean further than the distribution may.
static void balls_under_one_light_are_as_bright_as_by_walks(void **state)
{
    (void)state;
    static const double rough[] = { 0.5, 0.6, 0.8, 1.0 }, apart[] = { 0.027, 0.021, 0.016, 0.014 };
    for (int i = 0; i < 16; i++) {
        double roughness = rough[i / 4], angle = 0.4 * (i % 4);
        lit truth = walk_ball(roughness * roughness, angle);
        lit ours = surface_ball(roughness, angle);
        for (int f = 0; f < F0_COUNT; f++)
            assert_near(ours.sum[f] / truth.sum[f], 1.0, apart[i / 4] + (f == 0 ? 0.035 : 0.0));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_walk_keeps_all_light),
        cmocka_unit_test(bounces_return_what_the_walk_does),
        cmocka_unit_test(bounces_leave_where_the_walk_does),
        cmocka_unit_test(none_is_negative),
        cmocka_unit_test(balls_under_one_light_are_as_bright_as_by_walks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
