// What is seen behind the scene: the image by its definition, suns by their area.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "image/half.h"
#include "physics/display.glsl"
#include "render/panorama.h"

static const double pi = 3.14159265358979323846;

enum { W = 9, H = 5 }; // texels

static const float turn = 0.7f; // of the environment

// As surround.h says.
static void fill(uint16_t texels[H + 1][W + 2][4])
{
    uint32_t state = 7;
    for (int y = 0; y < H; y++) {
        for (int i = 0; i < W * 4; i++) {
            state = state * 1664525u + 1013904223u;
            float value = (float)(state >> 8) / 0x1p24f; // from denormal to large ones
            texels[y][1 + i / 4][i % 4] =
                half_from_float(i % 7 == 0 ? value * 1e-6f : value * value * 90);
        }
        memcpy(texels[y][0], texels[y][W], sizeof texels[y][0]);
        memcpy(texels[y][W + 1], texels[y][1], sizeof texels[y][0]);
    }
    memcpy(texels[H], texels[H - 1], sizeof texels[H]);
}

static double texel(uint16_t texels[H + 1][W + 2][4], int x, int y, int channel)
{
    y = y < 0 ? 0 : y >= H ? H - 1 : y;
    return (double)half_to_float(texels[y][1 + (x + W) % W][channel]);
}

// The middle at +X, the top at +Y, the right half towards +Z.
static double expected(uint16_t texels[H + 1][W + 2][4], const double d[3], int channel)
{
    double angle = (double)turn, length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    double x = cos(angle) * d[0] - sin(angle) * d[2], z = sin(angle) * d[0] + cos(angle) * d[2];
    double u = (0.5 + atan2(z, x) / (2 * pi)) * W - 0.5, v = acos(d[1] / length) / pi * H - 0.5;
    int i = (int)floor(u), k = (int)floor(v);
    double right = u - i, lower = v - k;
    return (texel(texels, i, k, channel) * (1 - right) + texel(texels, i + 1, k, channel) * right) *
               (1 - lower) +
           (texel(texels, i, k + 1, channel) * (1 - right) +
            texel(texels, i + 1, k + 1, channel) * right) *
               lower;
}

static gpu_frame frame_of(uint32_t size)
{
    return (gpu_frame) { .pixel = { 2 / (float)size, 2 / (float)size },
                         .environment_cos = cosf(turn),
                         .environment_sin = sinf(turn),
                         .environment_intensity = 2,
                         .seen = 1,
                         .red = { 0.5f, 0, 0 },
                         .green = { 0, 0.5f, 0 },
                         .blue = { 0.25f, 0, 0.5f } };
}

// Six views of 90 degrees see all directions.
static void the_image_is_where_it_belongs(void **state)
{
    enum { N = 40 };
    (void)state;
    uint16_t texels[H + 1][W + 2][4];
    fill(texels);
    const surround s = { .present = true, .texels = texels[0], .width = W, .height = H };
    gpu_frame frame = frame_of(N);
    const panorama p = { .surround = &s, .frame = &frame, .tone = GPU_TONE_LINEAR };
    for (int face = 0; face < 6; face++) {
        int a = face / 2, b = (a + 1) % 3, c = (a + 2) % 3;
        float axes[3][3] = { { 0 } };
        axes[0][a] = face % 2 ? -1 : 1;
        axes[1][b] = axes[2][c] = 1;
        memcpy(&frame.ray_center, axes[0], sizeof axes[0]);
        memcpy(&frame.ray_x, axes[1], sizeof axes[1]);
        memcpy(&frame.ray_y, axes[2], sizeof axes[2]);
        for (uint32_t y = 0; y < N; y++)
            for (uint32_t x = 0; x < N; x++) {
                float run[PANORAMA_RUN][4];
                panorama_colors(&p, x / 8 * 8, y, 8, run);
                double d[3];
                d[a] = (double)axes[0][a];
                d[b] = (x + 0.5) * 2 / N - 1;
                d[c] = (y + 0.5) * 2 / N - 1;
                double blue = expected(texels, d, 2), red = expected(texels, d, 0) + blue / 2;
                const float *color = run[x % 8];
                assert_true(fabs((double)color[0] - red) < 1e-3);
                assert_true(fabs((double)color[1] - expected(texels, d, 1)) < 1e-3);
                assert_true(fabs((double)color[2] - blue) < 1e-3);
                assert_true(color[3] == 1);
            }
    }
}

// The light of a sun is its radiance times the solid angle of its disk.
static void suns_are_as_large_as_they_should_be(void **state)
{
    enum { N = 64 };
    (void)state;
    const surround s = { 0 };
    gpu_frame frame = frame_of(N);
    frame.ray_center = (float3) { 0, 0, -1 };
    frame.ray_x = (float3) { 0.2f, 0, 0 };
    frame.ray_y = (float3) { 0, -0.2f, 0 };
    frame.first_body = 2;
    const gpu_light suns[2] = {
        { .direction = { 0, 0, 1 }, .radius = 0.1f, .radiance = { 3, 2, 1 } },
        { .direction = { 0, 0, -1 }, .radius = 0.1f, .radiance = { 9, 9, 9 } }, // behind the eye
    };
    const panorama p = { &s, &frame, suns, GPU_TONE_LINEAR };
    double sum = 0;
    for (uint32_t y = 0; y < N; y++)
        for (uint32_t x = 0; x < N; x += PANORAMA_RUN) {
            float run[PANORAMA_RUN][4];
            panorama_colors(&p, x, y, PANORAMA_RUN, run);
            for (uint32_t i = 0; i < PANORAMA_RUN; i++) {
                double at_x = 0.2 * ((x + i + 0.5) * 2 / N - 1),
                       at_y = 0.2 * ((y + 0.5) * 2 / N - 1);
                double angle = 0.16 / (N * N) * pow(1 + at_x * at_x + at_y * at_y, -1.5);
                sum += angle * (double)run[i][1];
            }
        }
    double disk = 2 * pi * (1 - sqrt(1 - 0.01));
    assert_true(fabs(sum - disk) < 2e-3 * disk); // radiance 2, factor .5
}

static void looking_along_one_line_all_is_alike(void **state)
{
    (void)state;
    uint16_t texels[H + 1][W + 2][4];
    fill(texels);
    const surround s = { .present = true, .texels = texels[0], .width = W, .height = H };
    gpu_frame frame = frame_of(16);
    frame.orthographic = 1;
    frame.ray_center = (float3) { 0.6f, -0.48f, 0.64f };
    frame.ray_x = (float3) { 1, 0, 0 };
    const panorama p = { .surround = &s, .frame = &frame, .tone = GPU_TONE_LINEAR };
    const double d[3] = { 0.6, -0.48, 0.64 };
    float run[PANORAMA_RUN][4];
    panorama_colors(&p, 8, 3, PANORAMA_RUN, run);
    for (uint32_t i = 0; i < PANORAMA_RUN; i++)
        assert_true(fabs((double)run[i][1] - expected(texels, d, 1)) < 1e-3);
}

// The codes are those of the colours; here they are the half floats themselves, cut to 8 bits.
static void codes_are_those_of_the_colors(void **state)
{
    (void)state;
    static uint8_t code[0x3c01];
    uint16_t texels[H + 1][W + 2][4];
    fill(texels);
    for (uint32_t i = 0; i < sizeof code; i++)
        code[i] = (uint8_t)(i >> 6);
    const surround s = { .present = true, .texels = texels[0], .width = W, .height = H };
    gpu_frame frame = frame_of(PANORAMA_RUN);
    frame.ray_center = (float3) { 1, 0, 0 };
    frame.ray_x = (float3) { 0, 0, 1 };
    frame.ray_y = (float3) { 0, -1, 0 };
    for (uint32_t tone = TONEMAP_NEUTRAL; tone <= TONEMAP_AGX; tone++) {
        const panorama linear = { .surround = &s, .frame = &frame, .tone = GPU_TONE_LINEAR };
        const panorama toned = { .surround = &s, .frame = &frame, .tone = tone };
        for (uint32_t y = 0; y < PANORAMA_RUN; y++) {
            float light[PANORAMA_RUN][4], run[PANORAMA_RUN][4];
            uint8_t codes[PANORAMA_RUN][4];
            panorama_colors(&linear, 0, y, PANORAMA_RUN, light);
            panorama_colors(&toned, 0, y, PANORAMA_RUN, run);
            panorama_codes(&toned, 0, y, PANORAMA_RUN, code, codes);
            for (uint32_t x = 0; x < PANORAMA_RUN; x++) {
                vec3 shown = display(tone, vec3(light[x][0], light[x][1], light[x][2]));
                for (int c = 0; c < 3; c++) {
                    assert_true(fabsf(run[x][c] - shown[c]) < 2e-6f);
                    float value = fminf(fmaxf(run[x][c], 0x1p-14f), 1);
                    assert_true(abs(codes[x][c] - code[half_from_float(value)]) <= 1);
                }
                assert_true(codes[x][3] == 255);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_image_is_where_it_belongs),
        cmocka_unit_test(suns_are_as_large_as_they_should_be),
        cmocka_unit_test(looking_along_one_line_all_is_alike),
        cmocka_unit_test(codes_are_those_of_the_colors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
