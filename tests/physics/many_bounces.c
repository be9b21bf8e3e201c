// The energy and the direction of many bounces against a random walk on the microsurface, in
// double: Heitz, Hanika, d'Eon & Dachsbacher, Multiple-Scattering Microfacet BSDFs with the Smith
// Model, 2016.
#include "physics/surface.glsl"

#include "albedo.h"
#include "near.h"

static const double ROUGHNESSES[] = { 0.3, 0.6, 0.8, 1.0 };
static const double F0S[] = { 0.3, 0.5, 0.8, 1.0 };
enum { ROUGHNESS_COUNT = 4, F0_COUNT = 4, WALKS = 100000, BOUNCES = 1000 };

typedef struct direction {
    double x, y, z;
} direction;

// Albedo towards all eyes, weighted by their cosine.
typedef struct walked {
    double first[F0_COUNT]; // of what leaves after one bounce
    double all[F0_COUNT];
} walked;

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
    double z = 1.0 - draw(state) * (1.0 + s.z), phi = 2.0 * 3.14159265358979324 * draw(state);
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

// One way through the surface, from `way` to that in which it leaves; returns how many facets it
// met. `height` is C1, the share of the facets that lie below: a free path from it ends above all
// of them with probability C1^Lambda.
static int walk(direction *way, double alpha, double weight[F0_COUNT], uint64_t *state)
{
    direction d = *way;
    double height = 1.0;
    for (int met = 0; met < BOUNCES; met++) {
        double lambda = smith_lambda(d.z, alpha), free_path = 1.0 - draw(state);
        *way = d;
        if (d.z > 0.0 && free_path <= pow(height, lambda))
            return met;
        height = fmin(height / pow(free_path, 1.0 / lambda), 1.0);
        double w = pow(1.0 - bounce(&d, alpha, state), 5.0);
        for (int f = 0; f < F0_COUNT; f++)
            weight[f] *= F0S[f] + (1.0 - F0S[f]) * w;
    }
    return BOUNCES;
}

// Into the surface, as seen from there.
static direction from_eye(double cosine)
{
    return (direction) { sqrt(1.0 - cosine * cosine), 0.0, -cosine };
}

static walked walk_all(double alpha)
{
    uint64_t state = 1;
    walked sum = { { 0.0 }, { 0.0 } };
    for (int i = 0; i < WALKS; i++) {
        double weight[F0_COUNT] = { 1.0, 1.0, 1.0, 1.0 };
        direction way = from_eye(sqrt((i + 0.5) / WALKS));
        int met = walk(&way, alpha, weight, &state);
        for (int f = 0; f < F0_COUNT && met < BOUNCES; f++) {
            sum.first[f] += met == 1 ? weight[f] / WALKS : 0.0;
            sum.all[f] += weight[f] / WALKS;
        }
    }
    return sum;
}

// Its table by quadrature.
static surface metal(double roughness, double f0, double NoV)
{
    albedo e = albedo_of(NoV, roughness * roughness, 60);
    float base = (float)f0;
    surface_material m = { .base_color = vec3(base, base, base), .metallic = 1.0f };
    m.roughness = (float)roughness;
    vec2 dfg = vec2((float)e.scale, (float)e.bias);
    return surface_from_metallic_roughness(m, (float)NoV, dfg);
}

// The same of the surface.
static walked surface_all(double roughness, double f0)
{
    enum { EYES = 24 };
    walked sum = { { 0.0 }, { 0.0 } };
    for (int i = 0; i < EYES; i++) {
        surface s = metal(roughness, f0, sqrt((i + 0.5) / EYES));
        sum.first[0] += (double)s.single[0] / EYES;
        sum.all[0] += (double)(s.single[0] + s.bounced[0]) / EYES;
    }
    return sum;
}

static void the_walk_keeps_all_light(void **state)
{
    (void)state;
    for (int r = 0; r < ROUGHNESS_COUNT; r++)
        assert_near(walk_all(ROUGHNESSES[r] * ROUGHNESSES[r]).all[F0_COUNT - 1], 1.0, 1e-9);
}

static void bounces_return_what_the_walk_does(void **state)
{
    (void)state;
    for (int r = 0; r < ROUGHNESS_COUNT; r++) {
        walked truth = walk_all(ROUGHNESSES[r] * ROUGHNESSES[r]);
        for (int f = 0; f < F0_COUNT; f++) {
            walked ours = surface_all(ROUGHNESSES[r], F0S[f]);
            assert_near(ours.first[0], truth.first[f], 0.004);
            assert_near(ours.all[0], truth.all[f], 0.006);
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
        double weight[F0_COUNT] = { 1.0, 1.0, 1.0, 1.0 };
        direction way = from_eye(NoV);
        int met = walk(&way, alpha, weight, &state);
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
        double x = r * cos(2.0 * 3.14159265358979324 * (i % STEPS + 0.5) / STEPS);
        double LoV = z * NoV - x * sqrt(1.0 - NoV * NoV);
        double f = (double)surface_base(s, (float)NoV, (float)z, (float)LoV, 0.5f)[0];
        assert_true(f >= 0.0);
        sum.up += f * z * 3.14159265358979324 / (STEPS * STEPS);
        sum.forwards += f * x * 3.14159265358979324 / (STEPS * STEPS);
    }
    return sum;
}

// Below roughness .5 the distribution is held, and little light is left.
static void bounces_leave_where_the_walk_does(void **state)
{
    (void)state;
    static const double rough[] = { 0.5, 0.6, 0.8, 1.0 }, eyes[] = { 0.2, 0.5, 0.9 };
    for (int i = 0; i < 12; i++) {
        double roughness = rough[i / 3], NoV = eyes[i % 3];
        moments truth[F0_COUNT] = { { 0.0, 0.0 } };
        walk_moments(roughness * roughness, NoV, truth);
        for (int f = 0; f < F0_COUNT; f++) {
            moments ours = surface_moments(metal(roughness, F0S[f], NoV), NoV);
            assert_near(ours.up, truth[f].up, 0.012);
            assert_near(ours.forwards, truth[f].forwards, 0.012);
        }
    }
}

static void none_is_negative(void **state)
{
    (void)state;
    for (int i = 0; i < 400; i++)
        surface_moments(metal(0.05 * (i % 20 + 1), 0.5, 0.01 + 0.049 * (i / 20)),
                        0.01 + 0.049 * (i / 20));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_walk_keeps_all_light),
        cmocka_unit_test(bounces_return_what_the_walk_does),
        cmocka_unit_test(bounces_leave_where_the_walk_does),
        cmocka_unit_test(none_is_negative),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
