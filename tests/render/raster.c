// The host's rasteriser, against half planes in exact arithmetic.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "render/raster.h"

enum { W = 37, H = 41 }; // px

static const double x4[4] = { 0.375, 0.875, 0.125, 0.625 };
static const double y4[4] = { 0.125, 0.375, 0.625, 0.875 };

static uint32_t random_bits(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

// Corners in px and depth; clip space is made of them so that nothing is rounded.
static raster_object object_of(const float (*corners)[3], const uint32_t *indices, uint32_t count)
{
    raster_object o = {
        .positions = corners[0],
        .stride = sizeof *corners,
        .indices = indices,
        .triangle_count = count,
        .clip = { { 2.0f / W, 0, 0, 0 }, { 0, 2.0f / H, 0, 0 }, { 0, 0, 1, 0 }, { -1, -1, 0, 1 } },
        .left = true,
        .right = true,
    };
    return o;
}

// The ids of all samples, rows without gaps.
static uint32_t *draw(uint32_t samples, const raster_object *objects, size_t count)
{
    raster r = { 0 };
    assert_true(raster_begin(&r, W, H, samples, objects, count));
    uint32_t *padded = malloc((size_t)r.pitch * r.bands * RASTER_BAND * 4);
    uint32_t *ids = malloc((size_t)W * H * samples * 4);
    for (uint32_t band = 0; band < r.bands; band++)
        raster_band(&r, band, 0, padded + (size_t)band * RASTER_BAND * r.pitch);
    for (uint32_t y = 0; y < H; y++)
        memcpy(ids + (size_t)y * W * samples, padded + (size_t)y * r.pitch, W * samples * 4);
    raster_finish(&r);
    free(padded);
    return ids;
}

static void sample_at(uint32_t samples, int i, double *x, double *y)
{
    int pixel = i / (int)samples, s = i % (int)samples;
    *x = pixel % W + (samples == 1 ? 0.5 : x4[s]);
    *y = pixel / W + (samples == 1 ? 0.5 : y4[s]);
}

// How far a point is inside of all three edges, px; negative outside.
static double depth_inside(const float c[3][3], double x, double y)
{
    double least = 1e9, area = 0;
    for (int i = 0; i < 3; i++) {
        const float *a = c[i], *b = c[(i + 1) % 3];
        area += (double)a[0] * (double)b[1] - (double)b[0] * (double)a[1];
    }
    for (int i = 0; i < 3; i++) {
        const float *a = c[i], *b = c[(i + 1) % 3];
        double dx = (double)b[0] - (double)a[0], dy = (double)b[1] - (double)a[1];
        double e = dx * (y - (double)a[1]) - dy * (x - (double)a[0]);
        least = fmin(least, (area > 0 ? e : -e) / hypot(dx, dy));
    }
    return least;
}

static void samples_inside_are_covered(void **state)
{
    (void)state;
    static const uint32_t indices[3] = { 0, 1, 2 };
    uint32_t seed = 1;
    for (int n = 0; n < 400; n++) {
        float c[3][3];
        float size = n % 4 == 0 ? 3 : n % 4 == 1 ? 300 : 60;
        for (int i = 0; i < 3; i++) {
            c[i][0] = ((float)(random_bits(&seed) % 4096) / 4096 - 0.5f) * size + 18;
            c[i][1] = ((float)(random_bits(&seed) % 4096) / 4096 - 0.5f) * size + 20;
            c[i][2] = 0.5f;
        }
        uint32_t samples = n % 2 ? 4 : 1;
        const raster_object o = object_of(c, indices, 1);
        uint32_t *ids = draw(samples, &o, 1);
        for (int i = 0; i < (int)(W * H * samples); i++) {
            double x, y;
            sample_at(samples, i, &x, &y);
            double inside = depth_inside(c, x, y);
            if (fabs(inside) > 1e-4)
                assert_int_equal(ids[i], inside > 0 ? 0 : UINT32_MAX);
        }
        free(ids);
    }
}

// A net of triangles whose corners often lie on samples: none is left out, and each sample is
// covered by one triangle alone, whatever the order.
static void nets_are_tight(void **state)
{
    (void)state;
    enum { N = 13 };
    float points[N][N][3];
    uint32_t indices[(N - 1) * (N - 1) * 6], *out = indices, seed = 7;
    for (int y = 0; y < N; y++)
        for (int x = 0; x < N; x++) {
            points[y][x][0] = (float)x * 4 - 4 + (float)(random_bits(&seed) % 17) / 8;
            points[y][x][1] = (float)y * 4 - 4 + (float)(random_bits(&seed) % 17) / 8;
            points[y][x][2] = 0.5f;
        }
    for (uint32_t y = 0; y + 1 < N; y++)
        for (uint32_t x = 0; x + 1 < N; x++) {
            uint32_t a = y * N + x, b = a + 1, c = a + N, d = c + 1;
            const uint32_t corners[6] = { a, b, c, c, b, d };
            memcpy(out, corners, sizeof corners);
            out += 6;
        }
    uint32_t count = (N - 1) * (N - 1) * 2, drawn = 0;
    const raster_object all = object_of(&points[0][0], indices, count);
    for (uint32_t samples = 1; samples <= 4; samples += 3) {
        uint32_t *ids = draw(samples, &all, 1), *hits = calloc(W * H * samples, 4);
        for (uint32_t i = 0; i < count; i++) {
            const raster_object one = object_of(&points[0][0], indices + i * 3, 1);
            uint32_t *alone = draw(samples, &one, 1);
            for (uint32_t s = 0; s < W * H * samples; s++)
                hits[s] += alone[s] == 0;
            free(alone);
        }
        for (uint32_t s = 0; s < W * H * samples; s++) {
            assert_int_equal(hits[s], 1);
            drawn += ids[s] != UINT32_MAX;
        }
        assert_int_equal(drawn, W * H * samples);
        drawn = 0;
        free(ids);
        free(hits);
    }
}

// Two sheets that cut through each other: each is seen where it is nearer.
static void nearer_ones_win(void **state)
{
    (void)state;
    const float points[6][3] = { { -90, -90, 0.2f }, { 150, -90, 0.8f }, { 20, 200, 0.5f },
                                 { -90, -90, 0.7f }, { 150, -90, 0.1f }, { 20, 200, 0.4f } };
    const uint32_t indices[6] = { 0, 1, 2, 3, 4, 5 };
    const raster_object both = object_of(points, indices, 2);
    uint32_t *ids = draw(4, &both, 1);
    for (int i = 0; i < W * H * 4; i++) {
        double x, y, depth[2];
        sample_at(4, i, &x, &y);
        for (int t = 0; t < 2; t++) { // by barycentric coordinates
            const float(*c)[3] = points + 3 * t;
            double v = (y + 90) / 290, u = (x + 90 - v * 110) / 240;
            depth[t] = (double)c[0][2] + u * ((double)c[1][2] - (double)c[0][2]) +
                       v * ((double)c[2][2] - (double)c[0][2]);
        }
        if (fabs(depth[0] - depth[1]) > 1e-5)
            assert_int_equal(ids[i], depth[1] > depth[0]);
    }
    free(ids);
}

static void winding_chooses(void **state)
{
    (void)state;
    const float points[3][3] = { { -90, -90, 0.5f }, { 150, -90, 0.5f }, { 20, 200, 0.5f } };
    const uint32_t turns[2][3] = { { 0, 1, 2 }, { 0, 2, 1 } }; // right, left: y points down
    for (int i = 0; i < 2; i++)
        for (int which = 0; which < 4; which++) {
            raster_object o = object_of(points, turns[i], 1);
            o.left = which & 1;
            o.right = which & 2;
            uint32_t *ids = draw(1, &o, 1);
            assert_int_equal(ids[20 * W + 20], (i == 1 ? o.left : o.right) ? 0 : UINT32_MAX);
            free(ids);
        }
}

// A floor from far behind the eye to far before it, in perspective: it fills what is below the
// horizon and nothing above.
static void floors_reach_the_horizon(void **state)
{
    (void)state;
    const float points[4][3] = {
        { -500, 1, -500 }, { 500, 1, -500 }, { 500, 1, 500 }, { -500, 1, 500 }
    };
    const uint32_t indices[6] = { 0, 1, 2, 0, 2, 3 };
    const float near = 0.1f;
    raster_object o = object_of(points, indices, 2);
    const float clip[4][4] = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 0, 1 }, { 0, 0, near, 0 } };
    memcpy(o.clip, clip, sizeof clip);
    uint32_t *ids = draw(4, &o, 1);
    for (int i = 0; i < W * H * 4; i++) {
        double x, y;
        sample_at(4, i, &x, &y);
        double down = y / H * 2 - 1; // of a ray that goes 1 forward
        bool floor = down > 1.0 / 500;
        if (fabs(down - 1.0 / 500) > 1e-4)
            assert_int_equal(ids[i] != UINT32_MAX, floor);
    }
    free(ids);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_inside_are_covered),
        cmocka_unit_test(nets_are_tight),
        cmocka_unit_test(nearer_ones_win),
        cmocka_unit_test(winding_chooses),
        cmocka_unit_test(floors_reach_the_horizon),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
