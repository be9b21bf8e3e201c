// Environments: what is kept, what is refused, and what the procedural ones look like.
#include "helpers.h"

#include "image/image.h"

static const double pi = 3.14159265358979;

static void set_kind(ag_scene *scene, ag_environment_kind kind)
{
    ag_environment_desc desc = { .kind = kind };
    assert_int_equal(ag_scene_set_environment(scene, &desc), AG_OK);
}

static const ag_image *open_environment(const ag_scene *scene)
{
    const ag_image *image;
    assert_int_equal(scene_environment_open(scene, &image), AG_OK);
    return image;
}

static void test_defaults_and_none(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    assert_int_equal(scene->environment_kind, AG_ENVIRONMENT_STUDIO);
    assert_true(scene->environment_intensity == 1.0f);
    assert_null(scene->environment); // made only when it is opened
    uint64_t revision = scene->environment_revision;
    set_kind(scene, AG_ENVIRONMENT_NONE);
    assert_true(scene->environment_revision > revision);
    assert_null(open_environment(scene));
    scene_environment_close(scene, NULL);
    ag_scene_destroy(scene);
}

static void test_images_are_copied_and_mended(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    float pixels[8] = { 1, NAN, -3, 1, INFINITY, 0.5f, 2, 1 };
    ag_image image = { 2, 1, AG_FORMAT_RGBA32F, pixels };
    ag_environment_desc desc = { AG_ENVIRONMENT_IMAGE, &image, 0.5f, 2.0f };
    assert_int_equal(ag_scene_set_environment(scene, &desc), AG_OK);
    pixels[0] = 7;
    const ag_image *kept = open_environment(scene);
    const float *p = kept->pixels;
    assert_true(p[0] == 1 && p[1] == 0 && p[2] == 0 && p[5] == 0.5f && p[6] == 2);
    assert_true(isfinite(p[4]) && p[4] > 1e9f);
    assert_true(scene->environment_rotation_rad == 0.5f && scene->environment_intensity == 2.0f);
    scene_environment_close(scene, kept);
    assert_ptr_equal(open_environment(scene), kept); // still there

    uint64_t before = scene->environment_revision;
    assert_int_equal(ag_scene_set_environment(scene, &desc), AG_OK); // another picture
    assert_true(scene->environment_revision > before);

    // Turning it changes neither the picture nor what it surrounds.
    uint64_t revision = scene->environment_revision;
    set_kind(scene, AG_ENVIRONMENT_SKY);
    assert_true(scene->environment_revision > revision);
    assert_null(scene->environment);
    revision = scene->environment_revision;
    uint64_t any = scene->revision;
    desc = (ag_environment_desc) { .kind = AG_ENVIRONMENT_SKY, .rotation_rad = 1 };
    assert_int_equal(ag_scene_set_environment(scene, &desc), AG_OK);
    assert_int_equal(scene->environment_revision, revision);
    assert_int_equal(scene->revision, any);
    ag_scene_destroy(scene);
}

static void test_refusals(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    uint8_t bytes[4] = { 0 };
    ag_image image = { 1, 1, AG_FORMAT_RGBA8, bytes };
    const ag_environment_desc bad[] = {
        { .kind = (ag_environment_kind)9 },
        { .kind = AG_ENVIRONMENT_IMAGE },
        { .kind = AG_ENVIRONMENT_IMAGE, .image = &image },
        { .kind = AG_ENVIRONMENT_SKY, .intensity = -1 },
        { .kind = AG_ENVIRONMENT_SKY, .intensity = NAN },
        { .kind = AG_ENVIRONMENT_SKY, .rotation_rad = INFINITY },
    };
    uint64_t revision = scene->environment_revision;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_int_equal(ag_scene_set_environment(scene, &bad[i]), AG_ERROR_ARGUMENT);
    assert_int_equal(s.count, sizeof bad / sizeof *bad);
    assert_int_equal(scene->environment_revision, revision);
    assert_int_equal(scene->environment_kind, AG_ENVIRONMENT_STUDIO);
    ag_scene_destroy(scene);
}

// ---- The procedural ones, measured -----------------------------------------

typedef struct direction {
    double d[3], weight; // steradians
} direction;

// The middle of every fourth pixel; u = 0.5 + atan2(z, x) / 2 pi, v = acos(y) / pi.
static direction direction_of(const ag_image *image, uint32_t x, uint32_t y)
{
    double phi = 2 * pi * ((x + 0.5) / image->width - 0.5);
    double theta = pi * (y + 0.5) / image->height;
    double area = 2 * pi * pi / ((double)image->width * image->height) * 16;
    return (direction) { { sin(theta) * cos(phi), cos(theta), sin(theta) * sin(phi) },
                         sin(theta) * area };
}

static const float *pixel(const ag_image *image, uint32_t x, uint32_t y)
{
    return (const float *)image->pixels + ((size_t)y * image->width + x) * 4;
}

// The radiance of white paper facing `normal`, and of all directions' mean where NULL.
static void paper(const ag_image *image, const double *normal, double out[3])
{
    out[0] = out[1] = out[2] = 0;
    for (uint32_t y = 2; y < image->height; y += 4) {
        for (uint32_t x = 2; x < image->width; x += 4) {
            direction d = direction_of(image, x, y);
            double c = 0.25;
            for (int i = 0; normal && i < 3; i++)
                c = (i ? c : 0) + d.d[i] * normal[i];
            for (int i = 0; c > 0 && i < 3; i++)
                out[i] += (double)pixel(image, x, y)[i] * c * d.weight / pi;
        }
    }
}

static void check_pixels(const ag_image *image)
{
    assert_int_equal(image->format, AG_FORMAT_RGBA32F);
    assert_int_equal(image->width, 2 * image->height);
    for (uint32_t y = 0; y < image->height; y++)
        for (uint32_t x = 0; x < image->width; x++)
            for (int i = 0; i < 3; i++)
                assert_true(pixel(image, x, y)[i] > 0.0f && pixel(image, x, y)[i] < 20.0f);
}

static void check_exposure(const ag_image *image)
{
    const double up[3] = { 0, 1, 0 }, down[3] = { 0, -1, 0 };
    double above[3], below[3], mean[3];
    paper(image, up, above);
    paper(image, down, below);
    paper(image, NULL, mean);
    assert_true(above[1] > 0.65 && above[1] < 0.9);
    assert_true(below[1] < 0.4 * above[1]);
    assert_true(mean[1] > 0.35 && mean[1] < 0.65);
    for (int i = 0; i < 60; i++) { // a spiral over the sphere
        double y = 1 - 2 * (i + 0.5) / 60, r = sqrt(1 - y * y), out[3];
        const double normal[3] = { r * cos(2.4 * i), y, r * sin(2.4 * i) };
        paper(image, normal, out);
        assert_true(out[1] < 1.0);
    }
}

static void test_studio(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    const ag_image *image = open_environment(scene);
    check_pixels(image);
    check_exposure(image);
    // Neutral on the whole.
    double mean[3];
    paper(image, NULL, mean);
    assert_near(mean[0] / mean[1], 1, 0.05);
    assert_near(mean[2] / mean[1], 1, 0.05);
    // The key light is to the left, above and in front, of a viewer who looks along -Z.
    const double key[3] = { -0.58, 0.52, 0.63 }, across[3] = { 0.58, 0.52, 0.63 };
    double lit[3], dim[3];
    paper(image, key, lit);
    paper(image, across, dim);
    assert_true(lit[1] > 1.3 * dim[1]);
    scene_environment_close(scene, image);
    ag_scene_destroy(scene);
}

static void test_sky(void **state)
{
    (void)state;
    sentences s = { 0 };
    ag_scene *scene = make_scene(&s);
    set_kind(scene, AG_ENVIRONMENT_SKY);
    const ag_image *image = open_environment(scene);
    check_pixels(image);
    check_exposure(image);
    // Brightest at the sun, which stands in the left half of a view along -Z; darkest and bluest
    // some 90 degrees away from it, on the other side of the zenith.
    direction brightest = { 0 }, darkest = { 0 };
    float high = 0, low = 1e9f, blueness = 0;
    for (uint32_t y = 2; y < image->height * 2 / 5; y += 4) {
        for (uint32_t x = 2; x < image->width; x += 4) {
            const float *p = pixel(image, x, y);
            if (p[1] > high) {
                high = p[1];
                brightest = direction_of(image, x, y);
            }
            if (p[1] < low) {
                low = p[1];
                blueness = p[2] / p[0];
                darkest = direction_of(image, x, y);
            }
        }
    }
    assert_near(acos(brightest.d[1]), 0.85, 0.05);
    assert_near(atan2(brightest.d[2], brightest.d[0]), 2.2, 0.05);
    double apart = 0;
    for (int i = 0; i < 3; i++)
        apart += brightest.d[i] * darkest.d[i];
    assert_near(acos(apart), pi / 2, 0.35);
    assert_true(blueness > 1.8f);
    scene_environment_close(scene, image);
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults_and_none),
        cmocka_unit_test(test_images_are_copied_and_mended),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_studio),
        cmocka_unit_test(test_sky),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
