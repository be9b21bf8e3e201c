// Frame times: the same picture over and over on an open device.
//
//   bench_frames FILE|demo:NAME [ENV.hdr] [SIZE] [FRAMES] [DEVICE]
//
// Prints the first frame apart (it compiles) and the minimum and median of the others.
#include <argand/argand.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static ag_status load(ag_scene *scene, const char *input, const char *environment)
{
    ag_status status = strncmp(input, "demo:", 5) == 0
                           ? ag_scene_load_demo(scene, input + 5, AG_LOOK_ARGAND)
                           : ag_scene_load(scene, input, NULL);
    if (status || !environment || strcmp(environment, "-") == 0)
        return status;
    ag_image *image;
    status = ag_image_load(NULL, environment, &image);
    if (status)
        return status;
    const ag_environment_desc desc = { .kind = AG_ENVIRONMENT_IMAGE, .image = image };
    status = ag_scene_set_environment(scene, &desc);
    ag_image_destroy(image);
    return status;
}

static ag_status measure(ag_renderer *renderer, const ag_scene *scene, uint32_t size, int frames)
{
    const ag_render_options options = { .width = size, .height = size };
    ag_camera_desc camera;
    bool has_camera = ag_scene_camera(scene, 0, &camera);
    double *ms = calloc((size_t)frames, sizeof *ms);
    ag_render_stats stats = { 0 };
    for (int i = 0; i < frames; i++) {
        ag_image *image;
        ag_status status = ag_renderer_render(renderer, scene, has_camera ? &camera : NULL,
                                              &options, &image, &stats);
        if (status) {
            free(ms);
            return status;
        }
        ag_image_destroy(image);
        ms[i] = stats.frame_ms;
    }
    double first = ms[0];
    qsort(ms + 1, (size_t)frames - 1, sizeof *ms, compare);
    printf("first %.1f ms, then min %.1f ms, median %.1f ms over %d frames of %ux%u, "
           "%u draws, %llu triangles\n",
           first, ms[1], ms[1 + (frames - 1) / 2], frames - 1, size, size, stats.draws,
           (unsigned long long)stats.triangles);
    free(ms);
    return AG_OK;
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: %s FILE|demo:NAME [ENV.hdr|-] [SIZE] [FRAMES] [DEVICE]\n", argv[0]);
        return 2;
    }
    const ag_device_desc desc = { .select = argc > 5 ? argv[5] : "auto" };
    int frames = argc > 4 ? atoi(argv[4]) : 30;
    ag_device *device = NULL;
    ag_renderer *renderer = NULL;
    ag_scene *scene = NULL;
    ag_status status = ag_device_create(&desc, &device);
    if (!status)
        status = ag_renderer_create(device, &renderer);
    if (!status)
        status = ag_scene_create(NULL, &scene);
    if (!status)
        status = load(scene, argv[1], argc > 2 ? argv[2] : NULL);
    if (!status)
        printf("%s, %s: ", ag_device_describe(device)->name, argv[1]);
    if (!status)
        status = measure(renderer, scene, argc > 3 ? (uint32_t)atoi(argv[3]) : 1024,
                         frames < 2 ? 2 : frames);
    ag_scene_destroy(scene);
    ag_renderer_destroy(renderer);
    ag_device_destroy(device);
    return status ? 1 : 0;
}
