// The energy of many bounces against a random walk on the microsurface, in double: Heitz,
// Hanika, d'Eon & Dachsbacher, Multiple-Scattering Microfacet BSDFs with the Smith Model, 2016.
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

// One way through the surface; returns how many facets it met.  `height` is C1, the share of the
// facets that lie below: a free path from it ends above all of them with probability C1^Lambda.
static int walk(double cosine, double alpha, double weight[F0_COUNT], uint64_t *state)
{
    direction d = { sqrt(1.0 - cosine * cosine), 0.0, -cosine };
    double height = 1.0;
    for (int met = 0; met < BOUNCES; met++) {
        double lambda = smith_lambda(d.z, alpha), free_path = 1.0 - draw(state);
        if (d.z > 0.0 && free_path <= pow(height, lambda))
            return met;
        height = fmin(height / pow(free_path, 1.0 / lambda), 1.0);
        double w = pow(1.0 - bounce(&d, alpha, state), 5.0);
        for (int f = 0; f < F0_COUNT; f++)
            weight[f] *= F0S[f] + (1.0 - F0S[f]) * w;
    }
    return BOUNCES;
}

static walked walk_all(double alpha)
{
    uint64_t state = 1;
    walked sum = { { 0.0 }, { 0.0 } };
    for (int i = 0; i < WALKS; i++) {
        double weight[F0_COUNT] = { 1.0, 1.0, 1.0, 1.0 };
        int met = walk(sqrt((i + 0.5) / WALKS), alpha, weight, &state);
        for (int f = 0; f < F0_COUNT && met < BOUNCES; f++) {
            sum.first[f] += met == 1 ? weight[f] / WALKS : 0.0;
            sum.all[f] += weight[f] / WALKS;
        }
    }
    return sum;
}

// The same of the surface: its table by quadrature.
static walked surface_all(double roughness, double f0)
{
    enum { EYES = 24 };
    walked sum = { { 0.0 }, { 0.0 } };
    for (int i = 0; i < EYES; i++) {
        double NoV = sqrt((i + 0.5) / EYES);
        albedo e = albedo_of(NoV, roughness * roughness, 60);
        float base = (float)f0;
        surface_material m = { .base_color = vec3(base, base, base), .metallic = 1.0f };
        m.roughness = (float)roughness;
        vec2 dfg = vec2((float)e.scale, (float)e.bias);
        surface s = surface_from_metallic_roughness(m, (float)NoV, dfg);
        sum.first[0] += (f0 * e.scale + e.bias) / EYES;
        sum.all[0] += (double)(s.single[0] + s.lambert[0]) / EYES;
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
            assert_near(ours.all[0], truth.all[f], 0.008);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_walk_keeps_all_light),
        cmocka_unit_test(bounces_return_what_the_walk_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
