// Whether a pixel pays for the lights that reach it, or for all: a floor under 32 to 1024 lights
// of mixed kinds, about four of which reach any place of it whatever their number.
//
//   bench_lights [SIZE]     px, both ways; default 512
//
// Prints the least milliseconds of five frames and their ratio to those of the fewest lights;
// then the same with one range for all, so that each place is reached by ever more of them.
#include <argand/argand.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SMALLEST = 32, STEPS = 6, FRAMES = 5 };

static const float side = 20; // m, of the floor

static unsigned dice = 1;

static float roll(float low, float high)
{
    dice = dice * 1664525u + 1013904223u;
    return low + (high - low) * (float)(dice >> 8) / 16777216.0f;
}

static ag_status add_floor(ag_scene *scene)
{
    const float h = side / 2;
    const float positions[] = { -h, 0, -h, -h, 0, h, h, 0, h, h, 0, -h };
    const float normals[] = { 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0 };
    const uint32_t indices[] = { 0, 1, 2, 0, 2, 3 };
    const ag_mesh_desc desc = { .positions = positions,
                                .normals = normals,
                                .vertex_count = 4,
                                .indices = indices,
                                .index_count = 6 };
    ag_mesh mesh;
    ag_instance instance;
    ag_material_desc look = ag_material_default();
    look.metallic = 0;
    look.roughness = 0.3f;
    ag_material material;
    ag_status status = ag_scene_add_mesh(scene, &desc, &mesh);
    if (!status)
        status = ag_scene_add_material(scene, &look, &material);
    if (!status)
        status = ag_scene_add_instance(scene, mesh, material, NULL, &instance);
    return status;
}

static ag_status add_lights(ag_scene *scene, unsigned count, float range)
{
    const ag_light_kind kinds[] = { AG_LIGHT_POINT, AG_LIGHT_SPHERE, AG_LIGHT_SPOT, AG_LIGHT_RECT };
    ag_status status = AG_OK;
    dice = 1;
    for (unsigned i = 0; i < count && !status; i++) {
        const ag_light_desc desc = {
            .kind = kinds[i % 4],
            .position = { roll(-side / 2, side / 2), 0.1f * range, roll(-side / 2, side / 2) },
            .direction = { 0, -1, 0 },
            .color = { roll(0, 1), roll(0, 1), roll(0, 1) },
            .intensity = range * range,
            .range_m = range,
            .radius_m = 0.05f * range,
            .width_m = 0.1f * range,
            .height_m = 0.1f * range,
        };
        ag_light light;
        status = ag_scene_add_light(scene, &desc, &light);
    }
    return status;
}

// Milliseconds; below 0 when it failed.
static double measure(ag_renderer *renderer, uint32_t size, unsigned count, float range)
{
    const ag_camera_desc camera = { .position = { 0, side * 0.6f, side * 0.8f } };
    const ag_environment_desc none = { .kind = AG_ENVIRONMENT_NONE };
    const ag_render_options options = { .width = size, .height = size };
    ag_scene *scene = NULL;
    double best = -1;
    ag_status status = ag_scene_create(NULL, &scene);
    if (!status)
        status = ag_scene_set_environment(scene, &none);
    if (!status)
        status = add_floor(scene);
    if (!status)
        status = add_lights(scene, count, range);
    for (int i = 0; i < FRAMES && !status; i++) {
        ag_image *image = NULL;
        ag_render_stats stats;
        status = ag_renderer_render(renderer, scene, &camera, &options, &image, &stats);
        ag_image_destroy(image);
        best = best < 0 || stats.frame_ms < best ? stats.frame_ms : best;
    }
    ag_scene_destroy(scene);
    return status ? -1 : best;
}

static int series(ag_renderer *renderer, uint32_t size, const char *what, bool constant)
{
    double first = 0;
    printf("%s\n", what);
    for (unsigned i = 0; i < STEPS; i++) {
        unsigned count = (unsigned)SMALLEST << i;
        float range = sqrtf(4 * side * side / (3.14159265f * (float)(constant ? SMALLEST : count)));
        double ms = measure(renderer, size, count, range);
        if (ms < 0)
            return 1;
        first = i ? first : ms;
        printf("  %4u lights of range %.2f m: %7.1f ms, %.2f times\n", count, (double)range, ms,
               ms / first);
    }
    return 0;
}

int main(int argc, char **argv)
{
    uint32_t size = argc > 1 ? (uint32_t)atoi(argv[1]) : 512;
    ag_device *device = NULL;
    ag_renderer *renderer = NULL;
    if (ag_device_create(NULL, &device) || ag_renderer_create(device, &renderer))
        return 1;
    int failed = series(renderer, size, "as many reach each place:", false);
    failed |= series(renderer, size, "ever more reach each place:", true);
    ag_renderer_destroy(renderer);
    ag_device_destroy(device);
    return failed;
}
