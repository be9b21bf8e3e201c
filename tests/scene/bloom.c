// Bloom: no light is lost, and what it does to a point is what the CIE says the eye does.
#include "helpers.h"

static const float HEIGHT_DEGREES = 45;

static ag_image *make(uint32_t width, uint32_t height, const float color[4])
{
    float(*p)[4] = malloc(sizeof(float[4]) * width * height);
    for (uint32_t i = 0; i < width * height; i++)
        memcpy(p[i], color, sizeof *p);
    const ag_image_desc desc = { width, height, AG_FORMAT_RGBA32F, p };
    ag_image *image;
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    free(p);
    return image;
}

static float *at(const ag_image *image, uint32_t x, uint32_t y)
{
    return (float *)(uintptr_t)ag_image_pixels(image) + 4 * ((size_t)y * ag_image_width(image) + x);
}

// Black but for a square of light whose upper left corner is (x, y).
static ag_image *make_light(uint32_t width, uint32_t height, uint32_t x, uint32_t y, uint32_t size)
{
    ag_image *image = make(width, height, (const float[4]) { 0, 0, 0, 1 });
    for (uint32_t i = 0; i < size * size; i++)
        memcpy(at(image, x + i % size, y + i / size), (const float[4]) { 1000, 500, 10, 1 }, 16);
    return image;
}

static ag_image *bloom(ag_image *image, float share)
{
    ag_image *out;
    assert_int_equal(ag_image_bloom(NULL, image, share, &out), AG_OK);
    ag_image_destroy(image);
    return out;
}

static double sum_of(const ag_image *image)
{
    double sum = 0;
    for (uint32_t i = 0; i < ag_image_width(image) * ag_image_height(image); i++)
        sum += (double)at(image, i, 0)[0];
    return sum;
}

static void assert_relative(double value, double expected, double tolerance)
{
    if (!(fabs(value - expected) <= tolerance * fabs(expected)))
        fail_msg("%.9g is not %.9g within %g of it", value, expected, tolerance);
}

// ---- Light ---------------------------------------------------------------------

static void light_is_kept(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = { { 1280, 720 }, { 513, 385 }, { 300, 511 }, { 256, 256 } };
    for (int i = 0; i < 4; i++)
        for (int share = 1; share <= 5; share += 4) {
            uint32_t w = sizes[i][0], h = sizes[i][1];
            ag_image *image = bloom(make_light(w, h, w / 2, h / 2, 3), (float)share / 5);
            assert_relative(sum_of(image), 9000, 4e-5 * share);
            ag_image_destroy(image);
        }
}

// What would leave at an edge comes back as from a mirror.
static void edges_are_mirrors(void **state)
{
    (void)state;
    enum { W = 256, H = 128 };
    for (uint32_t corner = 0; corner < 4; corner++) {
        uint32_t x = corner % 2 ? W - 5 : 2, y = corner / 2 ? H - 4 : 1;
        ag_image *image = bloom(make_light(W, H, x, y, 3), 1);
        assert_relative(sum_of(image), 9000, 1e-4);
        ag_image_destroy(image);
    }
}

static void even_stays_even(void **state)
{
    (void)state;
    static const uint32_t sizes[][2] = {
        { 1, 1 }, { 2, 1 }, { 3, 777 }, { 1025, 5 }, { 37, 41 }, { 320, 200 },
    };
    const float color[4] = { 0.7f, 1e-3f, 1e4f, 1 };
    for (int i = 0; i < 6; i++) {
        ag_image *image = bloom(make(sizes[i][0], sizes[i][1], color), 1);
        for (uint32_t k = 0; k < sizes[i][0] * sizes[i][1]; k++) {
            for (int c = 0; c < 3; c++)
                assert_relative((double)at(image, k, 0)[c], (double)color[c], 2e-6);
            assert_true(at(image, k, 0)[3] == 1);
        }
        ag_image_destroy(image);
    }
}

static void none_is_the_same(void **state)
{
    (void)state;
    ag_image *light = make_light(64, 48, 7, 9, 5), *image;
    assert_int_equal(ag_image_bloom(NULL, light, 0, &image), AG_OK);
    assert_memory_equal(at(image, 0, 0), at(light, 0, 0), 64 * 48 * 16);
    ag_image_destroy(light);
    ag_image_destroy(image);
}

// ---- Shape ---------------------------------------------------------------------

// Between the pixels, from the middle of pixel (x, y).
static double ring(const ag_image *image, uint32_t x, uint32_t y, double radius, double angle)
{
    double px = x + radius * cos(angle), py = y + radius * sin(angle);
    uint32_t x0 = (uint32_t)px, y0 = (uint32_t)py;
    double fx = px - x0, fy = py - y0;
    return (1 - fy) *
               ((1 - fx) * (double)*at(image, x0, y0) + fx * (double)*at(image, x0 + 1, y0)) +
           fy * ((1 - fx) * (double)*at(image, x0, y0 + 1) +
                 fx * (double)*at(image, x0 + 1, y0 + 1));
}

enum { DIRECTIONS = 64 };

static double ring_mean(const ag_image *image, uint32_t x, uint32_t y, double radius)
{
    double sum = 0;
    for (int i = 0; i < DIRECTIONS; i++)
        sum += ring(image, x, y, radius, 6.283185307 * i / DIRECTIONS) / DIRECTIONS;
    return sum;
}

// The CIE's general equation in full, for age 25 and pigment .5, in cd/m^2 for each lux.
static double cie_glare(double degrees)
{
    double age = 1 + pow(25 / 62.5, 4), p = 0.5;
    return 10 / pow(degrees, 3) + (5 / pow(degrees, 2) + 0.1 * p / degrees) * age + 2.5e-3 * p;
}

// .2 of the light is scattered as by an eye: around one pixel of 1 nit lies the veil of the lux
// that it sends.  Nearer than .25 and farther than 7 degrees the Gaussians end.
static void veil_is_the_eyes(void **state)
{
    (void)state;
    enum { SIZE = 1024 };
    ag_image *image = bloom(make_light(SIZE, SIZE, 509, 518, 1), 0.2f);
    double pixel = pow((double)HEIGHT_DEGREES / SIZE * 3.14159265 / 180, 2); // sr
    for (double degrees = 0.3; degrees < 6; degrees *= 1.15)
        assert_relative(ring_mean(image, 509, 518, degrees * SIZE / (double)HEIGHT_DEGREES),
                        1000 * pixel * cie_glare(degrees), 0.12);
    ag_image_destroy(image);
}

// A single pixel is the worst case, and the mirrored edges are far.
static void it_is_round(void **state)
{
    (void)state;
    ag_image *image = bloom(make_light(600, 512, 301, 239, 1), 1);
    for (double radius = 4; radius < 60; radius *= 1.2) {
        double mean = ring_mean(image, 301, 239, radius);
        for (int i = 0; i < DIRECTIONS; i++)
            assert_relative(ring(image, 301, 239, radius, 6.283185307 * i / DIRECTIONS), mean,
                            0.15);
    }
    ag_image_destroy(image);
}

// A quarter of a turn, and a mirror, change nothing.
static void it_is_symmetric(void **state)
{
    (void)state;
    enum { SIZE = 257 };
    ag_image *image = bloom(make_light(SIZE, SIZE, SIZE / 2, SIZE / 2, 1), 1);
    for (uint32_t y = 0; y < SIZE; y++)
        for (uint32_t x = 0; x < SIZE; x++) {
            double here = (double)*at(image, x, y);
            assert_relative((double)*at(image, y, SIZE - 1 - x), here, 1e-4);
            assert_relative((double)*at(image, SIZE - 1 - x, y), here, 1e-4);
        }
    ag_image_destroy(image);
}

// The same light in twice as many pixels has the same glow.
static void resolution_does_not_matter(void **state)
{
    (void)state;
    ag_image *small = bloom(make_light(480, 320, 200, 160, 6), 0.5f);
    ag_image *large = bloom(make_light(960, 640, 400, 320, 12), 0.5f);
    for (uint32_t y = 0; y < 320; y++)
        for (uint32_t x = 0; x < 480; x++) {
            double mean = 0, far = hypot(x - 202.5, y - 162.5);
            for (uint32_t i = 0; i < 4; i++)
                mean += (double)*at(large, 2 * x + i % 2, 2 * y + i / 2) / 4;
            if (far > 6) // outside the light itself
                assert_relative((double)*at(small, x, y), mean, far < 12 ? 0.2 : 0.1);
        }
    ag_image_destroy(small);
    ag_image_destroy(large);
}

// ---- Alpha and numbers ---------------------------------------------------------

static float over(const float pixel[4], int c, float background)
{
    return pixel[c] * pixel[3] + background * (1 - pixel[3]);
}

// First over an even background and then bloom, or the other way about.
static void alpha_is_scattered_with_light(void **state)
{
    (void)state;
    enum { W = 90, H = 70 };
    const float background = 0.6f;
    ag_image *cut = make(W, H, (const float[4]) { 0, 0, 0, 0 });
    ag_image *whole = make(W, H, (const float[4]) { background, background, background, 1 });
    for (uint32_t i = 0; i < 400; i++) {
        uint32_t x = 30 + i % 20, y = 20 + i / 20;
        const float p[4] = { (float)i, 2, 0.1f, (float)(i % 11) / 10 };
        memcpy(at(cut, x, y), p, sizeof p);
        for (int c = 0; c < 3; c++)
            at(whole, x, y)[c] = over(p, c, background);
    }
    cut = bloom(cut, 0.7f);
    whole = bloom(whole, 0.7f);
    for (uint32_t i = 0; i < W * H; i++)
        for (int c = 0; c < 3; c++)
            assert_relative((double)over(at(cut, i, 0), c, background), (double)at(whole, i, 0)[c],
                            1e-4);
    ag_image_destroy(cut);
    ag_image_destroy(whole);
}

static void everything_stays_finite(void **state)
{
    (void)state;
    ag_image *image = make(64, 64, (const float[4]) { 0.5f, 0.5f, 0.5f, 1 });
    memcpy(at(image, 10, 10), (float[4]) { NAN, INFINITY, -INFINITY, 1 }, 16);
    memcpy(at(image, 40, 50), (float[4]) { 3e38f, -3e38f, 1, NAN }, 16);
    memcpy(at(image, 20, 50), (float[4]) { NAN, 1, 1, 7 }, 16);
    image = bloom(image, 0.3f);
    for (uint32_t i = 0; i < 64 * 64; i++)
        for (int c = 0; c < 4; c++)
            assert_true(isfinite(at(image, i, 0)[c]));
    assert_true(at(image, 10, 10)[1] > 1e29f);
    assert_true(at(image, 10, 10)[0] > 0 && at(image, 10, 10)[0] < 0.5f); // NaN is black
    ag_image_destroy(image);
}

static void refused(void **state)
{
    (void)state;
    sentences s = { 0 };
    const ag_log log = { .write = keep_sentence, .user = &s };
    const ag_image_desc desc = { .width = 2, .height = 2 };
    ag_image *bytes, *floats = make(2, 2, (const float[4]) { 0 }), *image;
    assert_int_equal(ag_image_create(NULL, &desc, &bytes), AG_OK);
    const float wrong[] = { -0.1f, 1.1f, NAN };
    for (int i = 0; i < 3; i++)
        assert_int_equal(ag_image_bloom(&log, floats, wrong[i], &image), AG_ERROR_ARGUMENT);
    assert_int_equal(ag_image_bloom(&log, bytes, 0.1f, &image), AG_ERROR_ARGUMENT);
    assert_null(image);
    assert_int_equal(s.count, 4);
    ag_image_destroy(bytes);
    ag_image_destroy(floats);
}

// ---- Order ---------------------------------------------------------------------

static ag_image *trace(const ag_scene *scene, const ag_render_options *options)
{
    const ag_reference_goal goal = { .samples = 2 };
    ag_reference *r;
    ag_image *image;
    assert_int_equal(ag_reference_create(scene, NULL, options, NULL, &r), AG_OK);
    assert_int_equal(ag_reference_trace(r, &goal), AG_OK);
    assert_int_equal(ag_reference_picture(r, &image), AG_OK);
    ag_reference_destroy(r);
    return image;
}

// The reference scatters linear light, and shows it then.
static void reference_scatters_light(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    assert_int_equal(ag_scene_load_demo(scene, "lights", AG_LOOK_TEXT), AG_OK);
    for (int background = 0; background <= AG_BACKGROUND_COLOR; background++) {
        ag_render_options shown = {
            .width = 48,
            .height = 32,
            .background = (ag_background)background,
            .background_color = { 0.2f, 0.5f, 0.9f },
            .bloom = 0.4f,
            .tonemap = AG_TONEMAP_AGX,
        };
        ag_render_options light = shown;
        light.format = AG_FORMAT_RGBA32F;
        light.bloom = 0;
        if (background == AG_BACKGROUND_COLOR)
            light.background = AG_BACKGROUND_TRANSPARENT;
        ag_image *linear = bloom(trace(scene, &light), 0.4f), *wanted, *got = trace(scene, &shown);
        assert_int_equal(ag_image_display(NULL, linear, &shown, &wanted), AG_OK);
        assert_memory_equal(ag_image_pixels(got), ag_image_pixels(wanted), 48 * 32 * 4);
        ag_image_destroy(linear);
        ag_image_destroy(wanted);
        ag_image_destroy(got);
    }
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_is_kept),
        cmocka_unit_test(edges_are_mirrors),
        cmocka_unit_test(even_stays_even),
        cmocka_unit_test(none_is_the_same),
        cmocka_unit_test(veil_is_the_eyes),
        cmocka_unit_test(it_is_round),
        cmocka_unit_test(it_is_symmetric),
        cmocka_unit_test(resolution_does_not_matter),
        cmocka_unit_test(alpha_is_scattered_with_light),
        cmocka_unit_test(everything_stays_finite),
        cmocka_unit_test(refused),
        cmocka_unit_test(reference_scatters_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
