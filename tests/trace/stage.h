// Small scenes whose traced pictures are known beforehand, and how well a picture is known.
#ifndef TESTS_TRACE_STAGE_H
#define TESTS_TRACE_STAGE_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <argand/argand.h>

#define OK(call) assert_int_equal(call, AG_OK)

static const double pi = 3.14159265358979323846;

// ---- Scenes ------------------------------------------------------------------------

// Nothing around it.
static inline ag_scene *stage_dark(void)
{
    ag_scene *scene;
    const ag_environment_desc none = { .kind = AG_ENVIRONMENT_NONE };
    OK(ag_scene_create(NULL, &scene));
    OK(ag_scene_set_environment(scene, &none));
    return scene;
}

static inline void stage_surround_image(ag_scene *scene, uint32_t width, uint32_t height,
                                        const float (*pixels)[4], float rotation_rad)
{
    const ag_image_desc image_desc = { width, height, AG_FORMAT_RGBA32F, pixels };
    ag_image *image;
    OK(ag_image_create(NULL, &image_desc, &image));
    const ag_environment_desc desc = { .kind = AG_ENVIRONMENT_IMAGE,
                                       .image = image,
                                       .rotation_rad = rotation_rad };
    OK(ag_scene_set_environment(scene, &desc));
    ag_image_destroy(image);
}

// An environment of one radiance.
static inline void stage_surround(ag_scene *scene, float radiance)
{
    enum { W = 16, H = 8 };
    float pixels[W * H][4];
    for (int i = 0; i < W * H; i++)
        memcpy(pixels[i], (float[4]) { radiance, radiance, radiance, 1 }, sizeof *pixels);
    stage_surround_image(scene, W, H, (const float(*)[4])pixels, 0);
}

// A lambertian surface, exactly: radiance = albedo * irradiance / pi.
static inline ag_material_desc stage_matte(float albedo)
{
    ag_material_desc m = ag_material_default();
    memcpy(m.base_color, (float[4]) { albedo, albedo, albedo, 1 }, sizeof m.base_color);
    m.metallic = 0;
    m.specular = 0;
    return m;
}

static inline ag_material_desc stage_metal(float f0, float roughness)
{
    ag_material_desc m = ag_material_default();
    memcpy(m.base_color, (float[4]) { f0, f0, f0, 1 }, sizeof m.base_color);
    m.roughness = roughness;
    return m;
}

static inline void stage_glow(ag_material_desc *m, float nit)
{
    for (int i = 0; i < 3; i++)
        m->emissive[i] = nit;
}

// A parallelogram: a corner and its two sides, which turn counter-clockwise before who sees it.
static inline ag_mesh stage_quad(ag_scene *scene, const float corner[3], const float u[3],
                                 const float v[3])
{
    float positions[4][3];
    static const float at[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
    static const uint32_t indices[6] = { 0, 1, 2, 0, 2, 3 };
    for (int i = 0; i < 4; i++)
        for (int c = 0; c < 3; c++)
            positions[i][c] = corner[c] + at[i][0] * u[c] + at[i][1] * v[c];
    const ag_mesh_desc desc = {
        .positions = &positions[0][0],
        .uvs = { &at[0][0] },
        .vertex_count = 4,
        .indices = indices,
        .index_count = 6,
    };
    ag_mesh mesh;
    OK(ag_scene_add_mesh(scene, &desc, &mesh));
    return mesh;
}

// The square of half side `half` about (0, y, 0), facing up.
static inline ag_mesh stage_floor(ag_scene *scene, float y, float half)
{
    return stage_quad(scene, (float[3]) { -half, y, half }, (float[3]) { 2 * half, 0, 0 },
                      (float[3]) { 0, 0, -2 * half });
}

// A ball of `rows` by twice as many columns about the origin, seen from outside or from inside;
// with the normals of the sphere, or those of its facets.
static inline ag_mesh stage_ball(ag_scene *scene, int rows, float radius, bool inside, bool smooth)
{
    const int columns = 2 * rows;
    size_t count = (size_t)((rows + 1) * (columns + 1)), filled = 0;
    float(*positions)[3] = malloc(count * sizeof *positions);
    float(*normals)[3] = malloc(count * sizeof *normals);
    uint32_t *indices = malloc((size_t)(6 * rows * columns) * sizeof *indices);
    for (int i = 0; i <= rows; i++)
        for (int k = 0; k <= columns; k++) {
            double theta = pi * i / rows, phi = 2 * pi * (k % columns) / columns;
            const double n[3] = { i % rows ? sin(theta) * cos(phi) : 0, cos(theta),
                                  i % rows ? -sin(theta) * sin(phi) : 0 };
            for (int c = 0; c < 3; c++) {
                positions[i * (columns + 1) + k][c] = (float)(n[c] * (double)radius);
                normals[i * (columns + 1) + k][c] = (float)(inside ? -n[c] : n[c]);
            }
        }
    for (int i = 0; i < rows; i++)
        for (int k = 0; k < columns; k++) {
            uint32_t a = (uint32_t)(i * (columns + 1) + k), b = a + (uint32_t)columns + 1;
            const uint32_t out[6] = { a, b, b + 1, a, b + 1, a + 1 };
            for (int c = 0; c < 6; c++)
                if (c < 3 ? i < rows - 1 : i > 0) // those at the poles have no area
                    indices[filled++] = out[c < 3 ? (inside ? 2 - c : c) : (inside ? 8 - c : c)];
        }
    const ag_mesh_desc desc = {
        .positions = &positions[0][0],
        .normals = smooth ? &normals[0][0] : NULL,
        .vertex_count = (uint32_t)count,
        .indices = indices,
        .index_count = (uint32_t)filled,
        .skip_tangents = true,
    };
    ag_mesh mesh;
    OK(ag_scene_add_mesh(scene, &desc, &mesh));
    free(positions);
    free(normals);
    free(indices);
    return mesh;
}

static inline void stage_show(ag_scene *scene, ag_mesh mesh, const ag_material_desc *material,
                              const float world[16])
{
    ag_material id;
    ag_instance instance;
    OK(ag_scene_add_material(scene, material, &id));
    OK(ag_scene_add_instance(scene, mesh, id, world, &instance));
}

// The eye does not see its body.
static inline ag_light stage_light(ag_scene *scene, const ag_light_desc *desc)
{
    ag_light light;
    ag_light_desc hidden = *desc;
    hidden.hidden = true;
    OK(ag_scene_add_light(scene, &hidden, &light));
    return light;
}

// ---- Pictures ----------------------------------------------------------------------

// All pixels see the same place, the origin, from aslant.
static inline ag_camera_desc stage_pinpoint(void)
{
    return (ag_camera_desc) { .position = { 2, 3, 1 }, .height_m = 1e-4f };
}

static inline ag_render_options stage_linear(uint32_t width, uint32_t height)
{
    return (ag_render_options) {
        .width = width,
        .height = height,
        .format = AG_FORMAT_RGBA32F,
        .background = AG_BACKGROUND_TRANSPARENT,
    };
}

static inline ag_reference *stage_traced(const ag_scene *scene, const ag_camera_desc *camera,
                                         const ag_render_options *picture,
                                         const ag_reference_options *options, uint32_t samples)
{
    ag_reference *reference;
    OK(ag_reference_create(scene, camera, picture, options, &reference));
    OK(ag_reference_trace(reference, &(ag_reference_goal) { .samples = samples }));
    return reference;
}

static inline ag_image *stage_trace(const ag_scene *scene, const ag_camera_desc *camera,
                                    const ag_render_options *picture,
                                    const ag_reference_options *options, uint32_t samples)
{
    ag_image *image;
    ag_reference *reference = stage_traced(scene, camera, picture, options, samples);
    OK(ag_reference_picture(reference, &image));
    ag_reference_destroy(reference);
    return image;
}

static inline const float *stage_pixel(const ag_image *image, uint32_t x, uint32_t y)
{
    return (const float *)ag_image_pixels(image) + 4 * ((size_t)y * ag_image_width(image) + x);
}

// ---- What is known of them -----------------------------------------------------------

// A mean over pixels that see the same, and its standard error by how they differ: each has
// samples of its own.
typedef struct estimate {
    double mean, error;
} estimate;

static inline estimate stage_estimate_in(const ag_image *image, int channel, uint32_t left,
                                         uint32_t top, uint32_t right, uint32_t bottom)
{
    double sum = 0, square = 0, n = (double)(right - left) * (bottom - top);
    for (uint32_t y = top; y < bottom; y++)
        for (uint32_t x = left; x < right; x++)
            sum += (double)stage_pixel(image, x, y)[channel];
    for (uint32_t y = top; y < bottom; y++)
        for (uint32_t x = left; x < right; x++)
            square += pow((double)stage_pixel(image, x, y)[channel] - sum / n, 2);
    return (estimate) { sum / n, sqrt(square / (n * (n - 1))) };
}

static inline estimate stage_estimate(const ag_image *image, int channel)
{
    return stage_estimate_in(image, channel, 0, 0, ag_image_width(image), ag_image_height(image));
}

static inline bool stage_agrees(const char *what, estimate e, double wanted, double slack)
{
    bool agrees = fabs(e.mean - wanted) <= 4 * e.error + slack;
    if (!agrees)
        print_error("%s: %.7g +- %.2g is not %.7g within %g\n", what, e.mean, e.error, wanted,
                    slack);
    return agrees;
}

// Within four standard errors and a slack.
#define assert_agrees(what, e, wanted, slack) assert_true(stage_agrees(what, e, wanted, slack))

#endif
