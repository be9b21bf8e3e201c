// Pictures of built-in scenes, no farther from the path traced ones than their budgets allow.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kit.h"

#define OK(call) assert_int_equal(call, AG_OK)

enum { SIZE = 64, BLOCK = 4 }; // px

// A line of budgets.txt, which says what its columns are.
typedef struct budget {
    char scene[32], look[16], light[16];
    double error, flip;
    uint32_t samples;
} budget;

static bool next_budget(FILE *file, budget *b)
{
    char line[128];
    while (fgets(line, sizeof line, file)) {
        if (line[0] == '#' || line[0] == '\n')
            continue;
        assert_int_equal(sscanf(line, "%31s %15s %15s %lf %lf %u", b->scene, b->look, b->light,
                                &b->error, &b->flip, &b->samples),
                         6);
        return true;
    }
    return false;
}

static bool is_direct(const budget *b)
{
    return strcmp(b->light, "direct") == 0;
}

// ---- Two pictures ------------------------------------------------------------------

static ag_scene *load(const budget *b)
{
    ag_scene *scene;
    OK(ag_scene_create(NULL, &scene));
    OK(ag_scene_load_demo(scene, b->scene,
                          strcmp(b->look, "text") ? AG_LOOK_ARGAND : AG_LOOK_TEXT));
    return scene;
}

// Pixels of `best` are filtered as the reference's.  Under direct light only what surfaces send
// is compared: bodies of lights outshine all else, and differ at their edges.
static ag_render_options picture_options(const budget *b)
{
    return (ag_render_options) {
        .width = SIZE,
        .height = SIZE,
        .format = AG_FORMAT_RGBA32F,
        .quality = AG_QUALITY_BEST,
        .parts = is_direct(b) ? AG_PART_LIGHTS | AG_PART_DIFFUSE | AG_PART_SPECULAR : 0,
    };
}

static ag_camera_desc camera_of(const ag_scene *scene)
{
    ag_camera_desc camera;
    assert_true(ag_scene_camera(scene, 0, &camera));
    return camera;
}

static ag_image *trace(const ag_scene *scene, const budget *b, uint32_t seed)
{
    const ag_render_options picture = picture_options(b);
    const ag_camera_desc camera = camera_of(scene);
    const ag_reference_options options = {
        .direct_only = is_direct(b),
        .unshadowed = is_direct(b),
        .seed = seed,
    };
    const ag_reference_goal goal = { .samples = b->samples };
    ag_reference *reference;
    ag_image *image;
    OK(ag_reference_create(scene, &camera, &picture, &options, &reference));
    OK(ag_reference_trace(reference, &goal));
    OK(ag_reference_picture(reference, &image));
    ag_reference_destroy(reference);
    return image;
}

typedef struct measured {
    double error, flip;
} measured;

// Light of a square of pixels, and how far it is from another picture's, all channels summed.
// What is brighter than a screen counts as 1: else a highlight's few samples would decide.
static void add_block(const ag_image *wanted, const ag_image *image, int x, int y, double sum[2])
{
    const float(*a)[4] = ag_image_pixels(wanted), (*b)[4] = ag_image_pixels(image);
    for (int c = 0; c < 3; c++) {
        double light = 0, difference = 0;
        for (int k = 0; k < BLOCK * BLOCK; k++) {
            int i = (y + k / BLOCK) * SIZE + x + k % BLOCK;
            light += (double)fminf(a[i][c], 1);
            difference += (double)(fminf(b[i][c], 1) - fminf(a[i][c], 1));
        }
        sum[0] += light;
        sum[1] += fabs(difference);
    }
}

static measured apart(const ag_image *wanted, const ag_image *image, const ag_render_options *look)
{
    double sum[2] = { 0, 0 };
    for (int y = 0; y < SIZE; y += BLOCK)
        for (int x = 0; x < SIZE; x += BLOCK)
            add_block(wanted, image, x, y, sum);
    ag_image *shown[2];
    ag_difference d;
    OK(ag_image_display(NULL, wanted, look, &shown[0]));
    OK(ag_image_display(NULL, image, look, &shown[1]));
    OK(ag_image_compare(NULL, shown[0], shown[1], NULL, &d, NULL));
    ag_image_destroy(shown[0]);
    ag_image_destroy(shown[1]);
    return (measured) { sum[1] / sum[0], (double)d.flip };
}

static ag_image *mean_of(const ag_image *first, const ag_image *second)
{
    static float mean[SIZE * SIZE][4];
    const float(*a)[4] = ag_image_pixels(first), (*b)[4] = ag_image_pixels(second);
    for (int i = 0; i < SIZE * SIZE; i++)
        for (int c = 0; c < 4; c++)
            mean[i][c] = (a[i][c] + b[i][c]) / 2;
    const ag_image_desc desc = { SIZE, SIZE, AG_FORMAT_RGBA32F, mean };
    ag_image *image;
    OK(ag_image_create(NULL, &desc, &image));
    return image;
}

// The reference is the mean of two, whose difference is twice its noise.
static measured measure(ag_device *device, const budget *b, measured *noise)
{
    ag_scene *scene = load(b);
    ag_render_options picture = picture_options(b);
    const ag_camera_desc camera = camera_of(scene);
    ag_renderer *renderer;
    ag_image *real_time, *half[2] = { trace(scene, b, 1), trace(scene, b, 2) };
    OK(ag_renderer_create(device, &renderer));
    OK(ag_renderer_render(renderer, scene, &camera, &picture, &real_time, NULL));
    ag_renderer_destroy(renderer);
    ag_demo_look(b->scene, &picture);
    ag_image *truth = mean_of(half[0], half[1]);
    measured m = apart(truth, real_time, &picture);
    *noise = apart(half[0], half[1], &picture);
    noise->error /= 2;
    noise->flip /= 2;
    ag_image_destroy(half[0]);
    ag_image_destroy(half[1]);
    ag_image_destroy(truth);
    ag_image_destroy(real_time);
    ag_scene_destroy(scene);
    return m;
}

// ---- Budgets -----------------------------------------------------------------------

static bool within(const char *figure, double error, double noise, double allowed)
{
    const char *verdict = error > allowed         ? "ABOVE ITS BUDGET"
                          : error < 0.9 * allowed ? "well below its budget: lower it"
                                                  : "within its budget";
    print_message("    %s %.4f (noise %.4f), %s, %.4f\n", figure, error, noise, verdict, allowed);
    return error <= allowed;
}

static bool keeps(ag_device *device, const budget *b)
{
    measured noise, m = measure(device, b, &noise);
    print_message("%s, %s, %s\n", b->scene, b->look, b->light);
    bool error = within("error", m.error, noise.error, b->error);
    return within("flip", m.flip, noise.flip, b->flip) && error;
}

static void pictures_keep_their_budgets(void **state)
{
    budget b;
    bool all = true;
    int count = 0;
    FILE *file = fopen(BUDGETS, "r");
    assert_non_null(file);
    for (; next_budget(file, &b); count++)
        all &= keeps(*state, &b);
    fclose(file);
    assert_true(all && count > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = { KIT_TEST(pictures_keep_their_budgets) };
    return cmocka_run_group_tests_name("budgets", tests, kit_open, kit_close);
}
