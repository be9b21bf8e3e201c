// Small scenes whose pictures are known beforehand.
#ifndef TESTS_RENDER_STAGE_H
#define TESTS_RENDER_STAGE_H

#include <stdlib.h>
#include <string.h>

#include "kit.h"

#define OK(call) assert_int_equal(call, AG_OK)

static inline void assert_close(float value, float wanted, float tolerance)
{
    if (!(fabsf(value - wanted) <= tolerance)) {
        print_error("%.7g is not %.7g within %g\n", (double)value, (double)wanted,
                    (double)tolerance);
        fail();
    }
}

// A scene with nothing around it.
static inline ag_scene *stage_dark(void)
{
    ag_scene *scene;
    const ag_environment_desc none = { .kind = AG_ENVIRONMENT_NONE };
    OK(ag_scene_create(NULL, &scene));
    OK(ag_scene_set_environment(scene, &none));
    return scene;
}

// An environment of one colour.
static inline void stage_surround(ag_scene *scene, float r, float g, float b)
{
    enum { W = 64, H = 32 };
    float(*pixels)[4] = malloc(sizeof(float[4]) * W * H);
    for (int i = 0; i < W * H; i++)
        memcpy(pixels[i], (float[4]) { r, g, b, 1 }, sizeof *pixels);
    const ag_image_desc image_desc = { W, H, AG_FORMAT_RGBA32F, pixels };
    ag_image *image;
    OK(ag_image_create(NULL, &image_desc, &image));
    const ag_environment_desc desc = { .kind = AG_ENVIRONMENT_IMAGE, .image = image };
    OK(ag_scene_set_environment(scene, &desc));
    ag_image_destroy(image);
    free(pixels);
}

// A rectangle facing +Z at depth z, from (x0, y0) to (x1, y1), with vertex colours
// (NULL: white) in the order of its corners: counter-clockwise from the lower left.
static inline ag_mesh stage_quad(ag_scene *scene, float x0, float y0, float x1, float y1, float z,
                                 const float colors[4][4])
{
    const float positions[4][3] = { { x0, y0, z }, { x1, y0, z }, { x1, y1, z }, { x0, y1, z } };
    const float normals[4][3] = { { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 }, { 0, 0, 1 } };
    const float uvs[4][2] = { { 0, 1 }, { 1, 1 }, { 1, 0 }, { 0, 0 } };
    const uint32_t indices[6] = { 0, 1, 2, 0, 2, 3 };
    const ag_mesh_desc desc = {
        .positions = &positions[0][0],
        .normals = &normals[0][0],
        .uvs = { &uvs[0][0] },
        .colors = colors ? &colors[0][0] : NULL,
        .vertex_count = 4,
        .indices = indices,
        .index_count = 6,
    };
    ag_mesh mesh;
    OK(ag_scene_add_mesh(scene, &desc, &mesh));
    return mesh;
}

static inline void stage_show(ag_scene *scene, ag_mesh mesh, const ag_material_desc *material)
{
    ag_material id;
    ag_instance instance;
    OK(ag_scene_add_material(scene, material, &id));
    OK(ag_scene_add_instance(scene, mesh, id, NULL, &instance));
}

static inline ag_material_desc stage_unlit(float r, float g, float b, float a)
{
    ag_material_desc m = ag_material_default();
    m.unlit = true;
    memcpy(m.base_color, (float[4]) { r, g, b, a }, sizeof m.base_color);
    return m;
}

// Matte and nothing else: radiance = albedo * irradiance / pi.
static inline ag_material_desc stage_matte(float albedo)
{
    ag_material_desc m = ag_material_default();
    memcpy(m.base_color, (float[4]) { albedo, albedo, albedo, 1 }, sizeof m.base_color);
    m.metallic = 0;
    m.specular = 0;
    return m;
}

// Orthographic, looking along -Z at the square from -1 to 1 (higher than wide: cut).
static inline ag_camera_desc stage_flat_camera(void)
{
    return (ag_camera_desc) { .position = { 0, 0, 5 }, .height_m = 2 };
}

static inline ag_image *stage_render(ag_device *device, const ag_scene *scene,
                                     const ag_camera_desc *camera, const ag_render_options *options)
{
    ag_renderer *renderer;
    ag_image *image;
    OK(ag_renderer_create(device, &renderer));
    OK(ag_renderer_render(renderer, scene, camera, options, &image, NULL));
    ag_renderer_destroy(renderer);
    return image;
}

static inline const float *stage_float(const ag_image *image, uint32_t x, uint32_t y)
{
    return (const float *)ag_image_pixels(image) + 4 * ((size_t)y * ag_image_width(image) + x);
}

static inline const uint8_t *stage_byte(const ag_image *image, uint32_t x, uint32_t y)
{
    return (const uint8_t *)ag_image_pixels(image) + 4 * ((size_t)y * ag_image_width(image) + x);
}

#endif
