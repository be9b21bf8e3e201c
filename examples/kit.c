// What the examples share: a few shapes, and the way from a scene to a file.
#include "kit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void check(ag_status status)
{
    if (status)
        exit(1);
}

// ---- Pictures --------------------------------------------------------------

kit kit_open(int argc, char **argv)
{
    unsigned size = argc > 2 ? (unsigned)strtoul(argv[2], NULL, 10) : 0; // 0: the default
    kit k = { .folder = argc > 1 ? argv[1] : ".", .options = { .width = size, .height = size } };
    check(ag_device_create(NULL, &k.device)); // the best GPU, else the processor
    check(ag_renderer_create(k.device, &k.renderer));
    return k;
}

void kit_finish(kit *k, ag_scene *scene, const ag_camera_desc *camera, const char *name)
{
    char path[1024];
    ag_image *image;
    snprintf(path, sizeof path, "%s/%s.png", k->folder, name);
    check(ag_renderer_render(k->renderer, scene, camera, &k->options, &image, NULL));
    check(ag_image_save(NULL, image, path, NULL));
    printf("%s\n", path);
    ag_image_destroy(image);
    ag_scene_destroy(scene);
}

void kit_close(kit *k)
{
    ag_renderer_destroy(k->renderer); // children first
    ag_device_destroy(k->device);
}

ag_scene *make_scene(ag_environment_kind kind, float intensity)
{
    ag_scene *scene;
    const ag_environment_desc surroundings = { .kind = kind, .intensity = intensity };
    check(ag_scene_create(NULL, &scene));
    check(ag_scene_set_environment(scene, &surroundings));
    return scene;
}

// ---- Shapes ----------------------------------------------------------------

// A surface given by a function of (u, v): where it is, and its normal.
typedef struct surface {
    void (*at)(const struct surface *s, float u, float v, float position[3], float normal[3]);
    float radius, tube;
} surface;

// A grid of columns by rows cells, two triangles each, counter-clockwise seen from outside when
// u runs to the right and v downwards.
static ag_mesh make_grid(ag_scene *scene, const surface *s, unsigned columns, unsigned rows)
{
    unsigned vertices = (columns + 1) * (rows + 1), count = 0;
    float(*positions)[3] = calloc(vertices, sizeof *positions);
    float(*normals)[3] = calloc(vertices, sizeof *normals), (*uvs)[2] = calloc(vertices, 8);
    uint32_t *indices = calloc(columns * rows, 6 * sizeof *indices);
    for (unsigned i = 0; i < vertices; i++) {
        float u = (float)(i % (columns + 1)) / (float)columns;
        float v = (float)(i / (columns + 1)) / (float)rows;
        s->at(s, u, v, positions[i], normals[i]);
        uvs[i][0] = u;
        uvs[i][1] = v;
        if (u == 1 || v == 1)
            continue; // the last ones begin no cell
        const uint32_t below = i + columns + 1;
        const uint32_t cell[6] = { i, below, below + 1, i, below + 1, i + 1 };
        memcpy(indices + count, cell, sizeof cell);
        count += 6;
    }
    ag_mesh mesh;
    check(ag_scene_add_mesh(scene,
                            &(ag_mesh_desc) { .positions = positions[0],
                                              .normals = normals[0],
                                              .uvs = { uvs[0] },
                                              .vertex_count = vertices,
                                              .indices = indices,
                                              .index_count = count },
                            &mesh));
    free(positions); // the scene has a copy
    free(normals);
    free(uvs);
    free(indices);
    return mesh;
}

static void ball_at(const surface *s, float u, float v, float position[3], float normal[3])
{
    float theta = KIT_PI * v, phi = 2 * KIT_PI * u;
    normal[0] = sinf(theta) * sinf(phi);
    normal[1] = cosf(theta);
    normal[2] = sinf(theta) * cosf(phi);
    for (int i = 0; i < 3; i++)
        position[i] = s->radius * normal[i];
}

static void ring_at(const surface *s, float u, float v, float position[3], float normal[3])
{
    float phi = 2 * KIT_PI * u, theta = 2 * KIT_PI * (0.25f - v);
    normal[0] = cosf(theta) * sinf(phi);
    normal[1] = sinf(theta);
    normal[2] = cosf(theta) * cosf(phi);
    position[0] = s->radius * sinf(phi) + s->tube * normal[0];
    position[1] = s->tube * normal[1];
    position[2] = s->radius * cosf(phi) + s->tube * normal[2];
}

ag_mesh make_ball(ag_scene *scene, float radius, unsigned segments)
{
    return make_grid(scene, &(surface) { ball_at, radius, 0 }, segments, segments * 5 / 8);
}

ag_mesh make_ring(ag_scene *scene, float radius, float tube)
{
    return make_grid(scene, &(surface) { ring_at, radius, tube }, 96, 40);
}

// Corners of a rectangle that is `right` wide and `up` high, centred on `middle`.
static void add_corners(float corners[4][3], const float middle[3], const float right[3],
                        const float up[3])
{
    for (int i = 0; i < 3; i++) {
        corners[0][i] = middle[i] - right[i] - up[i];
        corners[1][i] = middle[i] + right[i] - up[i];
        corners[2][i] = middle[i] + right[i] + up[i];
        corners[3][i] = middle[i] - right[i] + up[i];
    }
}

// Without normals every triangle is flat.
static ag_mesh add_rectangles(ag_scene *scene, float (*corners)[3], unsigned count)
{
    static const float uv[4][2] = { { 0, 1 }, { 1, 1 }, { 1, 0 }, { 0, 0 } };
    static const uint32_t cell[6] = { 0, 1, 2, 0, 2, 3 };
    float uvs[24][2];
    uint32_t indices[36];
    for (unsigned i = 0; i < 4 * count; i++)
        memcpy(uvs[i], uv[i % 4], sizeof uvs[i]);
    for (unsigned i = 0; i < 6 * count; i++)
        indices[i] = i / 6 * 4 + cell[i % 6];
    ag_mesh mesh;
    check(ag_scene_add_mesh(scene,
                            &(ag_mesh_desc) { .positions = corners[0],
                                              .uvs = { uvs[0] },
                                              .vertex_count = 4 * count,
                                              .indices = indices,
                                              .index_count = 6 * count },
                            &mesh));
    return mesh;
}

ag_mesh make_panel(ag_scene *scene, float width, float height)
{
    float corners[4][3];
    add_corners(corners, (float[3]) { 0 }, (float[3]) { width / 2, 0, 0 },
                (float[3]) { 0, height / 2, 0 });
    return add_rectangles(scene, corners, 1);
}

ag_mesh make_box(ag_scene *scene, float half)
{
    static const float sides[6][3][3] = {
        // middle, right, up
        { { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 } },   { { 1, 0, 0 }, { 0, 0, -1 }, { 0, 1, 0 } },
        { { 0, 0, -1 }, { -1, 0, 0 }, { 0, 1, 0 } }, { { -1, 0, 0 }, { 0, 0, 1 }, { 0, 1, 0 } },
        { { 0, 1, 0 }, { 1, 0, 0 }, { 0, 0, -1 } },  { { 0, -1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } },
    };
    float corners[24][3];
    for (int i = 0; i < 6; i++)
        add_corners(corners + 4 * i, sides[i][0], sides[i][1], sides[i][2]);
    for (int i = 0; i < 24 * 3; i++)
        corners[i / 3][i % 3] *= half;
    return add_rectangles(scene, corners, 6);
}

// ---- Scenes ----------------------------------------------------------------

ag_material make_material(ag_scene *scene, ag_material_desc desc)
{
    ag_material material;
    check(ag_scene_add_material(scene, &desc, &material));
    return material;
}

ag_material_desc paint(float red, float green, float blue, float metallic, float roughness)
{
    ag_material_desc desc = ag_material_default(); // a factor has no natural zero: start from it
    desc.base_color[0] = red;
    desc.base_color[1] = green;
    desc.base_color[2] = blue;
    desc.metallic = metallic;
    desc.roughness = roughness;
    return desc;
}

void show(ag_scene *scene, ag_mesh mesh, ag_material material, float x, float y, float z)
{
    show_turned(scene, mesh, material, (float[3]) { x, y, z }, 0, 0);
}

void show_turned(ag_scene *scene, ag_mesh mesh, ag_material material, const float at[3], float turn,
                 float tilt)
{
    float ct = cosf(turn), st = sinf(turn), cx = cosf(tilt), sx = sinf(tilt);
    const float world[16] = { ct,      0,   -st,     0, st * sx, cx,    ct * sx, 0, // columns
                              st * cx, -sx, ct * cx, 0, at[0],   at[1], at[2],   1 };
    ag_instance instance;
    check(ag_scene_add_instance(scene, mesh, material, world, &instance));
}

void shine(ag_scene *scene, ag_light_desc light)
{
    ag_light added;
    check(ag_scene_add_light(scene, &light, &added));
}

ag_camera_desc look_straight(const ag_scene *scene, float fov_y)
{
    ag_orbit orbit = ag_orbit_auto();
    orbit.theta_rad = 0;
    orbit.phi_rad = KIT_PI / 2;
    orbit.fov_y_rad = fov_y;
    return ag_scene_frame(scene, &orbit, 1);
}
