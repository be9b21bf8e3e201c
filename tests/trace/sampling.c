// Numbers and directions are drawn as they are said to be.
#include "stage.h"

#include "scene/scene.h"
#include "trace/emitters.h"
#include "trace/sampler.h"
#include "trace/sky.h"

// ---- Numbers -----------------------------------------------------------------------------

// Any aligned run of 2^m samples has one point in each box of 2^-a by 2^-(m - a).
static void assert_net(uint32_t seed, uint32_t set, uint32_t first, int m)
{
    uint8_t filled[256];
    for (int a = 0; a <= m; a++) {
        memset(filled, 0, sizeof filled);
        for (uint32_t i = 0; i < 1u << m; i++) {
            sampler s = { first + i, seed, set };
            vec2 u = sampler_pair(&s);
            uint32_t x = (uint32_t)(u[0] * (float)(1 << a));
            uint32_t y = (uint32_t)(u[1] * (float)(1 << (m - a)));
            assert_true(u[0] >= 0 && u[0] < 1 && u[1] >= 0 && u[1] < 1);
            assert_int_equal(filled[x << (m - a) | y]++, 0);
        }
    }
}

static void pairs_are_nets(void **state)
{
    (void)state;
    for (uint32_t k = 0; k < 24; k++)
        for (int m = 0; m <= 8; m++)
            assert_net(sampler_hash(k), k % 5, (k % 3) << m, m);
}

// Each sample of each pixel is uniform, and knows nothing of its next pair, nor of its neighbour.
static void numbers_are_uniform(void **state)
{
    (void)state;
    enum { SEEDS = 20000, CELLS = 8 };
    for (uint32_t index = 0; index < 3; index++) {
        double chi = 0, wanted = (double)SEEDS / (CELLS * CELLS);
        for (int way = 0; way < 4; way++) {
            uint32_t count[CELLS][CELLS] = { { 0 } };
            for (uint32_t k = 0; k < SEEDS; k++) {
                sampler s = { index, k, 0 }, other = { index, k + 1, 0 };
                vec2 a = sampler_pair(&s), b = sampler_pair(&s), c = sampler_pair(&other);
                float x = a[0], y = way == 0 ? a[1] : way == 1 ? b[0] : way == 2 ? b[1] : c[0];
                count[(int)(x * CELLS)][(int)(y * CELLS)]++;
            }
            chi = 0;
            for (int i = 0; i < CELLS * CELLS; i++)
                chi += pow(count[i / CELLS][i % CELLS] - wanted, 2) / wanted;
            // 63 degrees of freedom: within four standard deviations.
            assert_true(fabs(chi - 63) < 4 * sqrt(2 * 63.0));
        }
    }
}

// ---- Directions of the sky -----------------------------------------------------------------

static sky_look seen_at(const trace_sky *sky, vec3 direction)
{
    sky_look look = { .direction = direction };
    sky_at(sky, 1, &look);
    return look;
}

static sky_look drawn_by(const trace_sky *sky, float u, float v)
{
    const vec2 pair = { u, v };
    sky_look look;
    sky_sample(sky, 1, &pair, &look);
    return look;
}

static float noise(uint32_t *state)
{
    return (float)(sampler_hash(++*state) >> 8) * 0x1p-24f;
}

static ag_scene *noisy_sky(uint32_t wide, uint32_t high)
{
    ag_scene *scene = stage_dark();
    float(*pixels)[4] = malloc(sizeof(float[4]) * wide * high);
    uint32_t seed = 1;
    for (uint32_t i = 0; i < wide * high; i++)
        for (int c = 0; c < 4; c++)
            pixels[i][c] = powf(noise(&seed), 4);
    for (int c = 0; c < 3; c++)
        pixels[wide * high / 3][c] = (float)(wide * high) / 8;
    stage_surround_image(scene, wide, high, (const float(*)[4])pixels, 0.7f);
    free(pixels);
    return scene;
}

enum { BINS_UP = 12, BINS_AROUND = 24, FINE = 24, DRAWN = 200000 };

static vec3 direction_at(double up, double around)
{
    double y = 1 - 2 * up, r = sqrt(fmax(1 - y * y, 0)), phi = 2 * pi * around;
    return vec3((float)(r * cos(phi)), (float)y, (float)(r * sin(phi)));
}

// Of each bin, by its density's integral.
static void assert_drawn_by_density(const trace_sky *sky)
{
    static double wanted[BINS_UP][BINS_AROUND], drawn[BINS_UP][BINS_AROUND];
    double all = 0, chi = 0, size = 4 * pi / (BINS_UP * FINE) / (BINS_AROUND * FINE);
    memset(wanted, 0, sizeof wanted);
    memset(drawn, 0, sizeof drawn);
    for (int i = 0; i < BINS_UP * FINE; i++)
        for (int k = 0; k < BINS_AROUND * FINE; k++) {
            vec3 d = direction_at((i + 0.5) / (BINS_UP * FINE), (k + 0.5) / (BINS_AROUND * FINE));
            wanted[i / FINE][k / FINE] += (double)seen_at(sky, d).density * size;
        }
    uint32_t seed = 9;
    for (int i = 0; i < DRAWN; i++) {
        float u = noise(&seed), v = noise(&seed);
        sky_look look = drawn_by(sky, u, v);
        double phi = atan2((double)look.direction[2], (double)look.direction[0]) / (2 * pi);
        int up = (int)((1 - (double)look.direction[1]) / 2 * BINS_UP);
        int around = (int)((phi < 0 ? phi + 1 : phi) * BINS_AROUND);
        drawn[up < BINS_UP ? up : BINS_UP - 1][around < BINS_AROUND ? around : 0]++;
        assert_true(fabsf(dot(look.direction, look.direction) - 1) < 1e-5f);
    }
    for (int i = 0; i < BINS_UP * BINS_AROUND; i++) {
        double p = wanted[i / BINS_AROUND][i % BINS_AROUND], n = p * DRAWN;
        all += p;
        // Bins have their own quadrature's error, too.
        chi += pow(drawn[i / BINS_AROUND][i % BINS_AROUND] - n, 2) / (n + 2e-5 * n * n + 1);
    }
    const double freedom = BINS_UP * BINS_AROUND - 1;
    assert_agrees("all of the density", ((estimate) { all, 0 }), 1, 0.003);
    assert_true(chi < freedom + 4 * sqrt(2 * freedom));
}

// That which is seen where it was drawn is what the sample says.
static void assert_seen_as_drawn(const trace_sky *sky)
{
    uint32_t seed = 5, differ = 0;
    for (int i = 0; i < 10000; i++) {
        float u = noise(&seed), v = noise(&seed);
        sky_look drawn = drawn_by(sky, u, v), seen = seen_at(sky, drawn.direction);
        // Rounding may put a direction at a cell's edge in the next cell.
        differ += fabsf(seen.density - drawn.density) > 1e-4f * drawn.density;
        assert_true(fabsf(seen.radiance[1] - drawn.radiance[1]) <
                    2e-2f * drawn.radiance[1] + 1e-3f);
    }
    assert_true(differ < 20);
}

static void skies_are_drawn_by_their_density(void **state)
{
    (void)state;
    const uint32_t sizes[][2] = { { 64, 32 }, { 7, 5 }, { 1, 1 } };
    for (int i = 0; i < 3; i++) {
        ag_scene *scene = noisy_sky(sizes[i][0], sizes[i][1]);
        trace_sky sky;
        OK(sky_init(scene, &sky));
        assert_drawn_by_density(&sky);
        assert_seen_as_drawn(&sky);
        sky_finish(&sky);
        ag_scene_destroy(scene);
    }
}

// ---- Directions to what shines ---------------------------------------------------------------

typedef double point[3];

static double dot_of(const point a, const point b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double volume(const point a, const point b, const point c)
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// Of a triangle from the origin, positive where its front is seen: van Oosterom & Strackee 1983.
static double solid_angle(const point a, const point b, const point c)
{
    double na = sqrt(dot_of(a, a)), nb = sqrt(dot_of(b, b)), nc = sqrt(dot_of(c, c));
    double below = na * nb * nc + dot_of(a, b) * nc + dot_of(b, c) * na + dot_of(c, a) * nb;
    return -2 * atan2(volume(a, b, c), below);
}

enum { SHINING = 12 };

// Triangles far and near, bright and dim, some of both sides; they face any way.
static ag_scene *shining(float positions[SHINING][3][3])
{
    ag_scene *scene = stage_dark();
    uint32_t seed = 3;
    for (int i = 0; i < SHINING; i++) {
        ag_material_desc glowing = stage_matte(0);
        stage_glow(&glowing, 0.1f + 10 * noise(&seed));
        glowing.double_sided = i % 3 == 0;
        for (int k = 0; k < 9; k++)
            positions[i][k / 3][k % 3] =
                (k < 3 ? 4 * noise(&seed) - 2 : positions[i][0][k % 3] + noise(&seed) - 0.5f);
        const ag_mesh_desc desc = { .positions = &positions[i][0][0], .vertex_count = 3 };
        ag_mesh mesh;
        OK(ag_scene_add_mesh(scene, &desc, &mesh));
        stage_show(scene, mesh, &glowing, NULL);
    }
    return scene;
}

static double angle_from(const float positions[3][3], const float from[3])
{
    point p[3];
    for (int k = 0; k < 9; k++)
        p[k / 3][k % 3] = (double)positions[k / 3][k % 3] - (double)from[k % 3];
    return solid_angle(p[0], p[1], p[2]);
}

// The mean of 1 / density over what is drawn of a triangle is its solid angle.
static void what_shines_is_drawn_by_its_density(void **state)
{
    (void)state;
    enum { COUNT = 100000 };
    const float places[3][3] = { { 0, 0, 0 }, { 1, -2, 0.5f }, { -9, 4, 3 } };
    float positions[SHINING][3][3];
    ag_scene *scene = shining(positions);
    world w;
    emitters e;
    OK(world_create(scene, NULL, &w));
    OK(emitters_init(&w, &e));
    for (int k = 0; k < 3; k++) {
        vec3 from = { places[k][0], places[k][1], places[k][2] };
        double sum[SHINING] = { 0 }, square[SHINING] = { 0 };
        uint32_t seed = 8;
        for (int i = 0; i < COUNT; i++) {
            emitter_found found;
            float pick = noise(&seed), u = noise(&seed), v = noise(&seed);
            if (!emitters_sample(&e, from, pick, vec2(u, v), &found))
                continue;
            size_t index = (size_t)(found.at.instance - w.instances);
            double weight = 1 / (double)found.density;
            sum[index] += weight;
            square[index] += weight * weight;
            float density = emitters_density(&e, &found.at, found.direction);
            assert_true(fabsf(density - found.density) <= 1e-3f * found.density);
        }
        for (int i = 0; i < SHINING; i++) {
            double angle = angle_from((const float(*)[3])positions[i], places[k]);
            double mean = sum[i] / COUNT;
            estimate drawn = { mean, sqrt(fmax(square[i] / COUNT - mean * mean, 0) / COUNT) };
            bool seen = angle > 0 || i % 3 == 0;
            if (seen || mean > 0) // backs may be drawn, or not
                assert_agrees("solid angle", drawn, fabs(angle), 1e-4 * fabs(angle));
        }
    }
    emitters_finish(&e);
    world_destroy(&w);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_are_nets),
        cmocka_unit_test(numbers_are_uniform),
        cmocka_unit_test(skies_are_drawn_by_their_density),
        cmocka_unit_test(what_shines_is_drawn_by_its_density),
    };
    return cmocka_run_group_tests_name("sampling", tests, NULL, NULL);
}
