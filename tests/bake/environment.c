// Baked environments against skies whose reflections are known.
#include "physics/environment.glsl"
#include "bake/cube.h"
#include "physics/sh.glsl"

#include "skies.h"

static bake_environment bake(const ag_image *image)
{
    bake_environment e;
    bool cached = true;
    assert_int_equal(bake_environment_make(NULL, image, &e, &cached), AG_OK);
    assert_false(cached);
    return e;
}

static void constant_sky(const double d[3], float rgb[3])
{
    (void)d;
    rgb[0] = 0.25f, rgb[1] = 1.0f, rgb[2] = 3.0f;
}

// Linear in the direction, each axis a channel.
static void axes_sky(const double d[3], float rgb[3])
{
    for (int i = 0; i < 3; i++)
        rgb[i] = (float)(1.0 + 0.9 * d[i]);
}

// White above, black below; a lobe of light about +X; and one about (1, 1, 1).
static void lobes_sky(const double d[3], float rgb[3])
{
    rgb[0] = d[1] > 0.0 ? 1.0f : 0.0f;
    rgb[1] = (float)fmax(d[0], 0.0);
    rgb[2] = (float)(10.0 * pow(fmax((d[0] + d[1] + d[2]) / sqrt(3.0), 0.0), 16.0));
}

// What a rough mirror shows of a sky: the lobe of half vectors about n, in rings of equal
// probability (Walter et al. 2007, eq. 35), light weighted by n.l.
static void reflect_sky(void (*sky)(const double d[3], float rgb[3]), const double n[3],
                        double roughness, double rgb[3])
{
    double a2 = pow(roughness, 4.0), weight = 0.0;
    double up[3] = { fabs(n[1]) < 0.9 ? 0.0 : 1.0, fabs(n[1]) < 0.9 ? 1.0 : 0.0, 0.0 };
    double t[3] = { up[1] * n[2] - up[2] * n[1], up[2] * n[0] - up[0] * n[2],
                    up[0] * n[1] - up[1] * n[0] };
    double length = sqrt(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
    for (int i = 0; i < 3; i++)
        t[i] /= length;
    double b[3] = { n[1] * t[2] - n[2] * t[1], n[2] * t[0] - n[0] * t[2],
                    n[0] * t[1] - n[1] * t[0] };
    rgb[0] = rgb[1] = rgb[2] = 0.0;
    for (int i = 0; i < 128; i++) {
        double u = (i + 0.5) / 128.0, c2 = (1.0 - u) / (1.0 + (a2 - 1.0) * u);
        double z = 2.0 * c2 - 1.0, s = 2.0 * sqrt(c2 * (1.0 - c2));
        for (int k = 0; k < 128 && z > 0.0; k++) {
            double phi = (k + 0.5) / 128.0 * 6.28318530717958648, d[3];
            for (int axis = 0; axis < 3; axis++)
                d[axis] = s * cos(phi) * t[axis] + s * sin(phi) * b[axis] + z * n[axis];
            float l[3];
            sky(d, l);
            for (int axis = 0; axis < 3; axis++)
                rgb[axis] += z * (double)l[axis];
            weight += z;
        }
    }
    for (int i = 0; i < 3; i++)
        rgb[i] /= weight;
}

static void sizes_follow_the_image(void **state)
{
    (void)state;
    const uint32_t widths[] = { 2, 512, 1024, 2000 }, sizes[] = { 128, 128, 256, 512 };
    for (int i = 0; i < 4; i++) {
        ag_image *image = sky_image(widths[i], constant_sky);
        bake_environment e = bake(image);
        assert_int_equal(e.size, sizes[i]);
        assert_int_equal(e.size >> (e.mip_count - 1), 8);
        assert_int_equal(e.cube_bytes, bake_environment_bytes(e.size, e.mip_count));
        bake_environment_finish(&e);
        ag_image_destroy(image);
    }
}

static void constant_stays_constant(void **state)
{
    (void)state;
    ag_image *image = sky_image(200, constant_sky); // no power of two
    bake_environment e = bake(image);
    float rgb[3];
    constant_sky(NULL, rgb);
    for (uint32_t mip = 0; mip < e.mip_count; mip++)
        for (uint32_t i = 0; i < 6 * (e.size >> mip) * (e.size >> mip); i++)
            for (int c = 0; c < 3; c++)
                assert_near((double)texel(&e, mip, 0, i % (e.size >> mip), i / (e.size >> mip), c),
                            (double)rgb[c], 0.001 * (double)rgb[c]);
    vec3 sh[9];
    for (int i = 0; i < 9; i++)
        sh[i] = vec3(e.sh[i][0], e.sh[i][1], e.sh[i][2]);
    vec3 irradiance = sh_irradiance(sh, normalize(vec3(0.3f, -0.8f, 0.2f)));
    for (int c = 0; c < 3; c++)
        assert_near((double)irradiance[c], (double)rgb[c], 1e-3 * (double)rgb[c]);
    bake_environment_finish(&e);
    ag_image_destroy(image);
}

static void first_mip_is_the_sky(void **state)
{
    (void)state;
    ag_image *image = sky_image(1024, axes_sky);
    bake_environment e = bake(image);
    for (uint32_t i = 0; i < 6 * 256 * 256; i += 37) {
        uint32_t face = i / (256 * 256), y = i / 256 % 256, x = i % 256;
        double d[3];
        float rgb[3];
        texel_direction(256, face, x, y, d);
        axes_sky(d, rgb);
        for (int c = 0; c < 3; c++)
            assert_near((double)texel(&e, 0, face, x, y, c), (double)rgb[c], 0.002);
    }
    bake_environment_finish(&e);
    ag_image_destroy(image);
}

// Every mip against quadrature; the bound is a few per cent of the brightest.
static void mips_are_the_lobe(void **state)
{
    (void)state;
    ag_image *image = sky_image(1024, lobes_sky);
    bake_environment e = bake(image);
    const double brightest[3] = { 1.0, 1.0, 10.0 };
    double squares = 0.0;
    int count = 0;
    for (uint32_t mip = 1; mip < e.mip_count; mip++) {
        uint32_t size = e.size >> mip;
        double m = (double)mip / (e.mip_count - 1), roughness = 1.0 - sqrt(1.0 - m);
        for (uint32_t i = 0; i < 40; i++) {
            uint32_t face = i % 6, x = (i * 7 + 1) % size, y = (i * 11 + 3) % size;
            double d[3], rgb[3];
            texel_direction(size, face, x, y, d);
            reflect_sky(lobes_sky, d, roughness, rgb);
            for (int c = 0; c < 3; c++) {
                double error = ((double)texel(&e, mip, face, x, y, c) - rgb[c]) / brightest[c];
                assert_near(error, 0.0, 0.04);
                squares += error * error;
                count++;
            }
        }
    }
    assert_true(sqrt(squares / count) < 0.008);
    bake_environment_finish(&e);
    ag_image_destroy(image);
}

// The irradiance cube against the cosine-weighted mean over 128 x 128 directions.
static void irradiance_cube_is_the_integral(void **state)
{
    (void)state;
    ag_image *image = sky_image(512, lobes_sky);
    bake_environment e = bake(image);
    const uint32_t size = BAKE_IRRADIANCE_SIZE;
    const uint16_t *diffuse = e.cube + bake_environment_mip_offset(e.size, e.mip_count) / 2;
    for (uint32_t i = 0; i < 60; i++) {
        uint32_t face = i % 6, x = (i * 7 + 1) % size, y = (i * 11 + 3) % size;
        double n[3], sum[3] = { 0 };
        texel_direction(size, face, x, y, n);
        for (uint32_t k = 0; k < 128 * 128; k++) { // the whole sphere by equal areas
            double z = 2.0 * (k / 128 + 0.5) / 128.0 - 1.0, s = sqrt(1.0 - z * z);
            double phi = (k % 128 + 0.5) / 128.0 * 6.28318530717958648;
            double d[3] = { s * cos(phi), s * sin(phi), z };
            double c = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
            float l[3];
            lobes_sky(d, l);
            for (int axis = 0; axis < 3; axis++)
                sum[axis] += fmax(c, 0.0) * (double)l[axis] * 4.0 / (128.0 * 128.0);
        }
        for (int c = 0; c < 3; c++) {
            float value = half_to_float(diffuse[4 * ((face * size + y) * size + x) + (uint32_t)c]);
            assert_near((double)value, sum[c], 0.005);
        }
    }
    bake_environment_finish(&e);
    ag_image_destroy(image);
}

static void irradiance_is_exact_for_half_a_sky(void **state)
{
    (void)state;
    ag_image *image = sky_image(512, lobes_sky);
    bake_environment e = bake(image);
    vec3 sh[9];
    for (int i = 0; i < 9; i++)
        sh[i] = vec3(e.sh[i][0], e.sh[i][1], e.sh[i][2]);
    for (int i = 0; i < 20; i++) {
        double a = 0.3 * i, b = 0.7 * i;
        vec3 n = vec3((float)(sin(a) * cos(b)), (float)cos(a), (float)(sin(a) * sin(b)));
        assert_near((double)sh_irradiance(sh, n)[0], 0.5 + 0.5 * cos(a), 0.003);
    }
    // Under a cosine lobe about n: 2 pi / 3 over pi; order 2 is off by 1/24 at most.
    assert_near((double)sh_irradiance(sh, vec3(1.0f, 0.0f, 0.0f))[1], 2.0 / 3.0, 0.045);
    bake_environment_finish(&e);
    ag_image_destroy(image);
}

// The power that comes through a mip, lm / m^2 if the image is in nit.
static double power(const bake_environment *e, uint32_t mip)
{
    uint32_t size = e->size >> mip;
    double sum = 0.0;
    for (uint32_t y = 0; y < size; y++)
        for (uint32_t x = 0; x < size; x++)
            for (uint32_t face = 0; face < 6; face++)
                sum += (double)texel(e, mip, face, x, y, 0) * cube_solid_angle(size, x, y);
    return sum;
}

// All the light in one pixel, wherever it is: no mip loses it, nor the harmonics.
static void one_pixel_keeps_its_energy(void **state)
{
    (void)state;
    const uint32_t width = 1024, height = 512;
    const uint32_t places[][2] = {
        { 512, 256 }, { 0, 100 }, { 700, 3 }, { 640, 255 }, { 99, 500 }
    };
    float *pixels = calloc((size_t)width * height, sizeof(float[4]));
    assert_non_null(pixels);
    for (int i = 0; i < 5; i++) {
        uint32_t x = places[i][0], y = places[i][1];
        float *p = pixels + 4 * ((size_t)y * width + x);
        p[0] = 50000.0f;
        double pi = 3.14159265358979324;
        double angle = 2.0 * pi / width * (cos(pi * y / height) - cos(pi * (y + 1) / height));
        ag_image *image;
        ag_image_desc desc = { width, height, AG_FORMAT_RGBA32F, pixels };
        assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
        bake_environment e = bake(image);
        double expected = 50000.0 * angle;
        assert_near((double)e.sh[0][0] / 0.28209479, expected, 0.01 * expected);
        for (uint32_t mip = 0; mip < e.mip_count; mip++)
            assert_near(power(&e, mip), expected, (mip == 0 ? 0.01 : 0.15) * expected);
        bake_environment_finish(&e);
        ag_image_destroy(image);
        p[0] = 0.0f;
    }
    free(pixels);
}

static void bad_pixels_do_no_harm(void **state)
{
    (void)state;
    const float values[] = { NAN, -NAN, INFINITY, -INFINITY, -5.0f, 3e38f, 1e-40f };
    float pixels[16 * 8][4];
    for (int i = 0; i < 16 * 8; i++)
        for (int c = 0; c < 4; c++)
            pixels[i][c] = values[(i + c) % 7];
    ag_image *image;
    ag_image_desc desc = { 16, 8, AG_FORMAT_RGBA32F, pixels };
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    bake_environment e = bake(image);
    for (size_t i = 0; i < e.cube_bytes / 2; i++)
        assert_true((e.cube[i] & 0x7c00) != 0x7c00 && !(e.cube[i] & 0x8000));
    for (int i = 0; i < 27; i++)
        assert_true(isfinite(e.sh[i / 3][i % 3]));
    bake_environment_finish(&e);
    ag_image_destroy(image);
}

static void shapes_without_sense_do_no_harm(void **state)
{
    (void)state;
    const uint32_t shapes[][2] = { { 1, 1 }, { 1, 300 }, { 4096, 1 }, { 3, 2 } };
    for (int i = 0; i < 4; i++) {
        ag_image *image;
        ag_image_desc desc = { shapes[i][0], shapes[i][1], AG_FORMAT_RGBA32F, NULL };
        assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
        bake_environment e = bake(image);
        assert_near((double)texel(&e, 0, 3, 5, 5, 1), 0.0, 0.0);
        bake_environment_finish(&e);
        ag_image_destroy(image);
    }
}

static void write_nothing(void *user, ag_log_level level, const char *sentence)
{
    (void)level;
    (void)sentence;
    ++*(int *)user;
}

static void bytes_are_refused(void **state)
{
    (void)state;
    int sentences = 0;
    ag_log log = { write_nothing, &sentences, AG_LOG_WARNING };
    ag_image *image;
    ag_image_desc desc = { 16, 8, AG_FORMAT_RGBA8, NULL };
    assert_int_equal(ag_image_create(NULL, &desc, &image), AG_OK);
    bake_environment e;
    assert_int_equal(bake_environment_make(&log, image, &e, NULL), AG_ERROR_ARGUMENT);
    assert_int_equal(sentences, 1);
    assert_null(e.cube);
    ag_image_destroy(image);
}

int main(void)
{
    setenv("ARGAND_NO_CACHE", "1", 1);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_follow_the_image),
        cmocka_unit_test(constant_stays_constant),
        cmocka_unit_test(first_mip_is_the_sky),
        cmocka_unit_test(mips_are_the_lobe),
        cmocka_unit_test(irradiance_cube_is_the_integral),
        cmocka_unit_test(irradiance_is_exact_for_half_a_sky),
        cmocka_unit_test(one_pixel_keeps_its_energy),
        cmocka_unit_test(bad_pixels_do_no_harm),
        cmocka_unit_test(shapes_without_sense_do_no_harm),
        cmocka_unit_test(bytes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
