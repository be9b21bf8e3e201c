// Whether time grows in step with the file: glTF files of n, 2n, 4n, 8n nodes, and of as
// many times more triangles, loaded and rendered at 256x256.
//
//   bench_scale [FOLDER]     where the files are written and removed; default /tmp
//
// Prints milliseconds and how much more than eight times the smallest the largest took:
// 1.0 is linear, 8.0 would be quadratic.
#include <argand/argand.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

// A triangle, once for each of `nodes` nodes on a square lattice.
static void write_nodes(FILE *f, unsigned nodes)
{
    unsigned side = (unsigned)ceil(sqrt((double)nodes));
    fprintf(f, "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[");
    for (unsigned i = 0; i < nodes; i++)
        fprintf(f, "%s%u", i ? "," : "", i);
    fprintf(f, "]}],\"nodes\":[");
    for (unsigned i = 0; i < nodes; i++)
        fprintf(f, "%s{\"mesh\":0,\"translation\":[%u,%u,0]}", i ? "," : "", i % side, i / side);
    fprintf(f, "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
               "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
               "\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]}],"
               "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,"
               "\"uri\":\"data:application/octet-stream;base64,"
               "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}");
}

// A lattice of side x side squares, two triangles each, in a .glb: positions and indices.
static void write_triangles(FILE *f, unsigned triangles)
{
    unsigned side = (unsigned)sqrt(triangles / 2.0), row = side + 1;
    unsigned vertices = row * row, indices = side * side * 6;
    unsigned bytes = vertices * 12 + indices * 4;
    char json[1024];
    int length = snprintf(
        json, sizeof json,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
        "\"indices\":1}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%u,"
        "\"type\":\"VEC3\",\"min\":[0,0,-1],\"max\":[%u,%u,1]},{\"bufferView\":1,"
        "\"componentType\":5125,\"count\":%u,\"type\":\"SCALAR\"}],\"bufferViews\":[{\"buffer\":0,"
        "\"byteLength\":%u},{\"buffer\":0,\"byteOffset\":%u,\"byteLength\":%u}],"
        "\"buffers\":[{\"byteLength\":%u}]}",
        vertices, side, side, indices, vertices * 12, vertices * 12, indices * 4, bytes);
    while (length % 4)
        json[length++] = ' ';
    const uint32_t header[] = { 0x46546c67, 2, 28 + (uint32_t)length + bytes, (uint32_t)length,
                                0x4e4f534a };
    const uint32_t chunk[] = { bytes, 0x004e4942 };
    fwrite(header, 4, 5, f);
    fwrite(json, 1, (size_t)length, f);
    fwrite(chunk, 4, 2, f);
    for (unsigned i = 0; i < vertices; i++) {
        const float p[3] = { (float)(i % row), (float)(i / row), sinf((float)i * 0.1f) };
        fwrite(p, 4, 3, f);
    }
    for (unsigned i = 0; i < side * side; i++) {
        const uint32_t a = i / side * row + i % side;
        const uint32_t corners[] = { a, a + 1, a + row + 1, a, a + row + 1, a + row };
        fwrite(corners, 4, 6, f);
    }
}

// Milliseconds to load and draw a file; below 0 when it failed.
static double measure(ag_renderer *renderer, const char *path)
{
    const ag_render_options options = { .width = 256, .height = 256 };
    ag_scene *scene;
    ag_image *image = NULL;
    double start = now_ms();
    ag_status status = ag_scene_create(NULL, &scene);
    if (!status)
        status = ag_scene_load(scene, path, NULL);
    if (!status)
        status = ag_renderer_render(renderer, scene, NULL, &options, &image, NULL);
    double took = now_ms() - start;
    ag_image_destroy(image);
    ag_scene_destroy(scene);
    return status ? -1 : took;
}

static int series(ag_renderer *renderer, const char *folder, const char *what, const char *ending,
                  unsigned smallest, void (*write)(FILE *, unsigned))
{
    double ms[4];
    printf("%s:", what);
    for (unsigned i = 0; i < 4; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/argand-bench-scale%s", folder, ending);
        FILE *f = fopen(path, "wb");
        if (!f) {
            perror(path);
            return 1;
        }
        write(f, smallest << i);
        fclose(f);
        ms[i] = measure(renderer, path);
        double again = measure(renderer, path);
        ms[i] = again >= 0 && again < ms[i] ? again : ms[i];
        remove(path);
        if (ms[i] < 0)
            return 1;
        printf(" %u in %.0f ms%s", smallest << i, ms[i], i < 3 ? "," : "");
    }
    printf("; %.2f times linear growth\n", ms[3] / ms[0] / 8);
    return 0;
}

int main(int argc, char **argv)
{
    const char *folder = argc > 1 ? argv[1] : "/tmp";
    ag_device *device = NULL;
    ag_renderer *renderer = NULL;
    if (ag_device_create(NULL, &device) || ag_renderer_create(device, &renderer))
        return 1;
    int failed = series(renderer, folder, "nodes", ".gltf", 2500, write_nodes);
    failed |= series(renderer, folder, "triangles", ".glb", 250000, write_triangles);
    ag_renderer_destroy(renderer);
    ag_device_destroy(device);
    return failed;
}
