// Written scenes: read back they are the same, and written again the same bytes.
#include "gltf_kit.h"

#include "base/file.h"
#include "image/image.h"

#include <argand/renderer.h>
#include <dirent.h>
#include <jansson.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#define OK(call) assert_int_equal(call, AG_OK)

// ---- What is the same --------------------------------------------------------------------

static void same_floats(const float *a, const float *b, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!(a[i] >= b[i] && a[i] <= b[i]))
            fail_msg("%zu: %.9g became %.9g", i, (double)a[i], (double)b[i]);
}

static void same_text(const char *a, const char *b)
{
    assert_int_equal(a == NULL, b == NULL);
    if (a)
        assert_string_equal(a, b);
}

static void same_mesh(const scene_mesh *a, const scene_mesh *b)
{
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_int_equal(a->index_count, b->index_count);
    assert_int_equal(a->has_colors, b->has_colors);
    assert_memory_equal(a->indices, b->indices, a->index_count * sizeof *a->indices);
    assert_memory_equal(a->vertices, b->vertices, a->vertex_count * sizeof *a->vertices);
    same_floats(a->min, b->min, 3);
    same_floats(a->max, b->max, 3);
}

static void same_image(const ag_image *a, const ag_image *b)
{
    assert_int_equal(a->width, b->width);
    assert_int_equal(a->height, b->height);
    assert_memory_equal(a->pixels, b->pixels, (size_t)4 * a->width * a->height);
}

static void same_use(const ag_scene *sa, const ag_texture_use *a, const ag_scene *sb,
                     const ag_texture_use *b)
{
    assert_int_equal(a->texture.id == 0, b->texture.id == 0);
    if (!a->texture.id)
        return;
    const scene_texture *ta = &sa->textures[a->texture.id - 1],
                        *tb = &sb->textures[b->texture.id - 1];
    same_image(ta->image, tb->image);
    assert_int_equal(ta->desc.wrap_u, tb->desc.wrap_u);
    assert_int_equal(ta->desc.wrap_v, tb->desc.wrap_v);
    assert_int_equal(ta->desc.mag, tb->desc.mag);
    assert_int_equal(ta->desc.min, tb->desc.min);
    assert_int_equal(ta->desc.no_mips, tb->desc.no_mips);
    if (!ta->desc.no_mips)
        assert_int_equal(ta->desc.mip, tb->desc.mip);
    assert_int_equal(a->uv_set, b->uv_set);
    same_floats(a->offset, b->offset, 2);
    same_floats(a->scale, b->scale, 2);
    same_floats(&a->rotation_rad, &b->rotation_rad, 1);
}

// Everything but what a texture that is not there would scale.
static void same_material(const ag_scene *sa, const ag_material_desc *a, const ag_scene *sb,
                          const ag_material_desc *b)
{
    ag_material_desc x = *a, y = *b;
    ag_texture_use *ux[MATERIAL_TEXTURES], *uy[MATERIAL_TEXTURES];
    material_textures(&x, ux);
    material_textures(&y, uy);
    same_text(x.name, y.name);
    if (!x.normal_texture.texture.id)
        y.normal_scale = x.normal_scale;
    if (!x.occlusion_texture.texture.id)
        y.occlusion_strength = x.occlusion_strength;
    for (int i = 0; i < MATERIAL_TEXTURES; i++) {
        same_use(sa, ux[i], sb, uy[i]);
        *ux[i] = *uy[i];
    }
    x.name = y.name;
    assert_memory_equal(&x, &y, sizeof x);
}

static void same_instances(const ag_scene *a, const ag_scene *b)
{
    assert_int_equal(a->instances_count, b->instances_count);
    for (size_t i = 0; i < a->instances_count; i++) {
        const scene_instance *x = &a->instances[i], *y = &b->instances[i];
        same_text(x->name, y->name);
        same_floats(x->world, y->world, 16);
        same_mesh(&a->meshes[x->mesh], &b->meshes[y->mesh]);
        same_material(a, &a->materials[x->material], b, &b->materials[y->material]);
    }
}

// What the kind does not name does not count.
static void same_light(const ag_light_desc *a, const ag_light_desc *b)
{
    bool punctual = a->kind <= AG_LIGHT_DIRECTIONAL, ambient = light_is_ambient(a->kind);
    assert_int_equal(a->kind, b->kind);
    same_text(a->name, b->name);
    same_floats(&a->intensity, &b->intensity, 1);
    same_floats(a->color, b->color, 3);
    if (light_has_position(a->kind)) {
        same_floats(a->position, b->position, 3);
        same_floats(&a->range_m, &b->range_m, 1);
    }
    if (a->kind != AG_LIGHT_POINT && a->kind != AG_LIGHT_SPHERE && a->kind != AG_LIGHT_AMBIENT &&
        a->kind != AG_LIGHT_HARMONICS)
        same_floats(a->direction, b->direction, 3);
    if (!punctual && !ambient)
        assert_int_equal(a->hidden, b->hidden);
    float ra[3], rb[3], ua[3], ub[3];
    light_axes(a, ra, ua);
    light_axes(b, rb, ub);
    if (a->kind == AG_LIGHT_RECT) {
        same_floats(ra, rb, 3);
        same_floats(ua, ub, 3);
    }
    if (a->kind == AG_LIGHT_SPHERE || a->kind == AG_LIGHT_DISK || a->kind == AG_LIGHT_TUBE)
        same_floats(&a->radius_m, &b->radius_m, 1);
    if (a->kind == AG_LIGHT_TUBE)
        same_floats(&a->length_m, &b->length_m, 1);
    if (a->kind == AG_LIGHT_SPOT) {
        same_floats(&a->cone_inner_rad, &b->cone_inner_rad, 1);
        same_floats(&a->cone_outer_rad, &b->cone_outer_rad, 1);
    }
    if (a->kind == AG_LIGHT_SUN)
        same_floats(&a->angular_radius_rad, &b->angular_radius_rad, 1);
    if (a->kind == AG_LIGHT_HEMISPHERIC)
        same_floats(a->ground_color, b->ground_color, 3);
    if (a->kind == AG_LIGHT_HARMONICS)
        same_floats(&a->harmonics[0][0], &b->harmonics[0][0], 27);
}

static void same_camera(const ag_camera_desc *a, const ag_camera_desc *b)
{
    const float x[] = { a->height_m > 0 ? 0 : a->fov_y_rad, a->height_m, a->near_m, a->far_m };
    const float y[] = { b->fov_y_rad, b->height_m, b->near_m, b->far_m };
    same_text(a->name, b->name);
    same_floats(a->position, b->position, 3);
    same_floats(a->target, b->target, 3);
    same_floats(a->up, b->up, 3);
    same_floats(x, y, 4);
}

static void same_surround(const ag_scene *a, const ag_scene *b)
{
    assert_int_equal(a->environment_kind, b->environment_kind);
    same_floats(&a->environment_rotation_rad, &b->environment_rotation_rad, 1);
    same_floats(&a->environment_intensity, &b->environment_intensity, 1);
    same_floats(&a->exposure, &b->exposure, 1);
    assert_int_equal(a->environment == NULL, b->environment == NULL);
    for (size_t i = 0; a->environment && i < a->environment->width * a->environment->height; i++)
        same_floats((const float *)a->environment->pixels + 4 * i,
                    (const float *)b->environment->pixels + 4 * i, 3);
}

static void same_scene(const ag_scene *a, const ag_scene *b)
{
    same_instances(a, b);
    assert_int_equal(a->lights_count, b->lights_count);
    for (size_t i = 0; i < a->lights_count; i++)
        same_light(&a->lights[i], &b->lights[i]);
    assert_int_equal(a->cameras_count, b->cameras_count);
    for (size_t i = 0; i < a->cameras_count; i++)
        same_camera(&a->cameras[i], &b->cameras[i]);
    same_surround(a, b);
}

// ---- There and back ----------------------------------------------------------------------

static void same_files(const kit *k, const char *first, const char *second)
{
    void *a, *b;
    size_t size_a, size_b;
    OK(file_read(NULL, kit_path(k, first), SIZE_MAX, &a, &size_a));
    OK(file_read(NULL, kit_path(k, second), SIZE_MAX, &b, &size_b));
    assert_int_equal(size_a, size_b);
    assert_memory_equal(a, b, size_a);
    free(a);
    free(b);
}

// The structure of a file as a stranger to Argand sees it.
static void check_structure(const kit *k, const char *name)
{
    char command[2048];
    snprintf(command, sizeof command, "python3 '%s' '%s'", GLB_CHECK, kit_path(k, name));
    if (system(command) != 0)
        fail_msg("%s is not sound", name);
}

// Written, read into k->scene, compared, and written again.
static void round_trip(kit *k, const ag_scene *scene)
{
    OK(ag_scene_save(scene, kit_path(k, "first.glb")));
    ag_status status = kit_load_path(k, kit_path(k, "first.glb"), NULL);
    if (status || k->warnings)
        print_error("said: %s", k->said);
    OK(status);
    assert_int_equal(k->warnings, 0);
    same_scene(scene, k->scene);
    OK(ag_scene_save(k->scene, kit_path(k, "second.glb")));
    same_files(k, "first.glb", "second.glb");
}

static void built_in_scenes(void **state)
{
    kit *k = *state;
    const char *name, *about;
    ag_render_options unused;
    for (size_t i = 0; ag_scene_demo(i, &name, &about); i++)
        for (int look = AG_LOOK_TEXT; look <= AG_LOOK_ARGAND; look++) {
            if (look == AG_LOOK_ARGAND && !ag_demo_look(name, &unused))
                continue; // it is the same
            ag_scene *scene;
            OK(ag_scene_create(NULL, &scene));
            OK(ag_scene_load_demo(scene, name, (ag_look)look));
            round_trip(k, scene);
            if (look == AG_LOOK_TEXT)
                check_structure(k, "first.glb");
            ag_scene_destroy(scene);
        }
}

// A scene of one triangle; noise fills what is given.
static ag_scene *make_scene(ag_mesh *mesh)
{
    static const float positions[] = { 0.1f, -2.7f, 1e-7f, 1, 0, 0, 0, 1, 0 };
    static const float normals[] = { 0.2f, 0.7f, 0.3f, 0, -3, 0, 1e-20f, 0, 1 };
    static const float tangents[] = { 1, 2, 3, -1, 1, 0, 0, 1, 0, 0.3f, 0, 1 };
    static const float uvs[] = { 0.1f, 0.2f, 1, 0, 0, 1 };
    static const float colors[] = { 0.1f, 0.2f, 0.3f, 0.4f, 1, 1, 1, 1, 0, 0, 0.5f, 0.001f };
    const ag_mesh_desc desc = { .positions = positions,
                                .normals = normals,
                                .tangents = tangents,
                                .uvs = { uvs, uvs },
                                .colors = colors,
                                .vertex_count = 3 };
    ag_scene *scene;
    OK(ag_scene_create(NULL, &scene));
    OK(ag_scene_add_mesh(scene, &desc, mesh));
    return scene;
}

static void show(ag_scene *scene, ag_mesh mesh, const ag_material_desc *desc, const float *world)
{
    ag_material material = { 0 };
    ag_instance instance;
    if (desc)
        OK(ag_scene_add_material(scene, desc, &material));
    OK(ag_scene_add_instance(scene, mesh, material, world, &instance));
}

static ag_texture add_texture(ag_scene *scene, uint32_t width, unsigned seed,
                              const ag_texture_desc *how)
{
    uint8_t *pixels = malloc(4 * width * width);
    for (uint32_t i = 0; i < 4 * width * width; i++)
        pixels[i] = (uint8_t)((i * 37 + seed * 101) ^ (i >> 3));
    const ag_image_desc image = { width, width, AG_FORMAT_RGBA8, pixels };
    ag_texture_desc desc = *how;
    ag_image *made;
    ag_texture texture;
    OK(ag_image_create(NULL, &image, &made));
    desc.image = made;
    OK(ag_scene_add_texture(scene, &desc, &texture));
    ag_image_destroy(made);
    free(pixels);
    return texture;
}

// Each choice and number of a material, away from its default.
static void materials(void **state)
{
    kit *k = *state;
    ag_mesh mesh;
    ag_scene *scene = make_scene(&mesh);
    for (int i = 0; i < 12; i++) {
        ag_material_desc d = ag_material_default();
        float x = 1.0f / (float)(i + 3);
        d.base_color[i % 4] = d.metallic = d.roughness = d.specular = d.diffuse_roughness = x;
        d.emissive[i % 3] = 12345.678f * x;
        d.emissive[(i + 1) % 3] = i % 2 ? x : 3e38f * x;
        d.ior = i % 3 ? 1 + x : 0;
        d.specular_color[i % 3] = 7 * x;
        d.diffuse = (ag_diffuse)(i % 3);
        d.distribution = (ag_distribution)(i % 2);
        d.shadowing = (ag_shadowing)(i / 2 % 2);
        d.fresnel = (ag_fresnel)(i % 3);
        d.layering = (ag_layering)(i % 4);
        d.shininess = 1000 * x;
        d.conductor_n[i % 3] = d.conductor_k[1] = 2 * x;
        d.f82_tint[2] = d.reflectiveness = x;
        d.single_bounce = i % 2;
        d.alpha_mode = (ag_alpha_mode)(i % 3);
        d.alpha_cutoff = i % 2 ? 0.5f : x;
        d.double_sided = i % 4 == 1;
        d.unlit = i % 4 == 3;
        d.anisotropy = i % 2 ? x : 0;
        d.anisotropy_rotation_rad = x;
        d.name = i ? "gold \"leaf\" \xc3\xbc" : NULL;
        show(scene, mesh, &d, NULL);
    }
    show(scene, mesh, NULL, NULL);
    round_trip(k, scene);
    assert_int_equal(k->scene->meshes_count, 1); // shared by all of them
    // One whose tangents are any, under a material that would compute others.
    const float triangle[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    const float turned[6] = { 0, 0, 0, 1, 1, 0 };
    const ag_mesh_desc any = {
        .positions = triangle, .uvs = { turned }, .vertex_count = 3, .skip_tangents = true
    };
    ag_material_desc brushed = ag_material_default();
    brushed.anisotropy = 0.5f;
    OK(ag_scene_add_mesh(scene, &any, &mesh));
    show(scene, mesh, &brushed, NULL);
    round_trip(k, scene);
    check_structure(k, "first.glb");
    ag_scene_destroy(scene);
}

static void textures(void **state)
{
    static const ag_texture_desc how[4] = {
        { 0 },
        { .wrap_u = AG_WRAP_CLAMP, .wrap_v = AG_WRAP_MIRROR, .mag = AG_FILTER_NEAREST },
        { .min = AG_FILTER_NEAREST, .no_mips = true },
        { .min = AG_FILTER_NEAREST, .mip = AG_FILTER_NEAREST, .wrap_v = AG_WRAP_CLAMP },
    };
    kit *k = *state;
    ag_mesh mesh;
    ag_scene *scene = make_scene(&mesh);
    ag_texture made[9], shared;
    for (unsigned i = 0; i < 9; i++)
        made[i] = add_texture(scene, 5 + i, i, &how[i % 4]);
    // One image in two textures.
    OK(scene_adopt_texture(scene, scene->images[3], &how[2], &shared));
    for (int i = 0; i < MATERIAL_TEXTURES; i++) {
        ag_material_desc d = ag_material_default();
        ag_texture_use *uses[MATERIAL_TEXTURES];
        material_textures(&d, uses);
        d.normal_scale = -0.3f;
        d.occlusion_strength = 0.7f;
        *uses[i] = (ag_texture_use) { .texture = made[i + 1], .uv_set = (uint32_t)i % 2 };
        *uses[(i + 1) % MATERIAL_TEXTURES] =
            (ag_texture_use) { .texture = i % 2 ? shared : made[3],
                               .offset = { 0.1f, -3 },
                               .rotation_rad = 0.3f * (float)(i % 3),
                               .scale = { 2, i % 3 ? 1 : 0.1f } };
        show(scene, mesh, &d, NULL);
    }
    round_trip(k, scene);
    assert_int_equal(k->scene->textures_count, 8); // made[0] and made[8] are not seen
    assert_int_equal(k->scene->images_count, 7);
    check_structure(k, "first.glb");
    ag_scene_destroy(scene);
}

// Plain, turned, mirrored, flat, far, and squeezed to nothing: the last one only is lost.
static void places(void **state)
{
    static const float worlds[][16] = {
        { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.1f, 1e9f, -3, 1 },
        { 2, 0, 0, 0, 0, -0.7f, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 },
        { 0.6f, 0.8f, 0, 0, -0.8f, 0.6f, 0, 0, 0, 0, 1, 0, 1, 2, 3, 1 },
        { 1, 0.3f, 0, 0, 0, 1, 0.7f, 0, 1e-7f, 0, 1, 0, 1, 2, 3, 1 },
        { 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 },
        { 1e-12f, 0, 0, 0, 0, 1e-12f, 0, 0, 0, 0, 1e-12f, 0, 0, 0, 0, 1 },
    };
    static const float nothing[16] = { [0] = 1, [15] = 1 };
    kit *k = *state;
    ag_mesh mesh, unseen;
    ag_scene *scene = make_scene(&mesh);
    for (size_t i = 0; i < sizeof worlds / sizeof *worlds; i++)
        show(scene, mesh, NULL, worlds[i]);
    OK(ag_scene_name_instance(scene, (ag_instance) { 2 }, "mirror"));
    round_trip(k, scene);
    // What is not seen is not written.
    const float triangle[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    const ag_mesh_desc desc = { .positions = triangle, .vertex_count = 3 };
    ag_material_desc plain = ag_material_default();
    OK(ag_scene_add_mesh(scene, &desc, &unseen));
    show(scene, unseen, &plain, nothing);
    OK(ag_scene_save(scene, kit_path(k, "second.glb")));
    same_files(k, "first.glb", "second.glb");
    check_structure(k, "first.glb");
    ag_scene_destroy(scene);
}

static void lights(void **state)
{
    kit *k = *state;
    ag_mesh mesh;
    ag_scene *scene = make_scene(&mesh);
    show(scene, mesh, NULL, NULL);
    OK(ag_scene_name_instance(scene, (ag_instance) { 1 }, "\xff is no UTF-8"));
    OK(ag_scene_save(scene, kit_path(k, "first.glb")));
    OK(kit_load_path(k, kit_path(k, "first.glb"), NULL));
    assert_null(k->scene->instances[0].name);
    OK(ag_scene_name_instance(scene, (ag_instance) { 1 }, NULL));
    for (int i = 0; i < 4 * (AG_LIGHT_HARMONICS + 1); i++) {
        float x = 1.0f / (float)(i + 3);
        ag_light_desc d = {
            .kind = (ag_light_kind)(i / 4),
            .position = { x, (float)-i, 3 },
            .direction = { i % 4 ? x : 0, i % 4 == 3 ? 0 : -1, i % 4 > 1 ? 0.3f : 0 },
            .up = { 1, x, 0.1f },
            .color = { x, 0, 1 },
            .intensity = 1000 * x,
            .range_m = i % 2 ? 20 * x : 0,
            .cone_inner_rad = x,
            .cone_outer_rad = i % 2 ? 1.3f : 1.57079632679f,
            .radius_m = x,
            .width_m = 3 * x,
            .height_m = 0.7f,
            .length_m = 1.1f,
            .angular_radius_rad = 0.3f * x,
            .ground_color = { 0, x, 1 },
            .hidden = i % 2,
            .name = i % 3 ? "lamp" : NULL,
        };
        for (int t = 0; t < 27; t++)
            d.harmonics[t / 3][t % 3] = x * (float)(t - 9);
        ag_light light;
        OK(ag_scene_add_light(scene, &d, &light));
    }
    OK(ag_scene_set_exposure(scene, 1.0f / 3.0f));
    round_trip(k, scene);
    check_structure(k, "first.glb");
    ag_scene_destroy(scene);
}

// Weights above 1, which KHR_lights_punctual has not, become intensity: the light is the same.
static void strong_colors(void **state)
{
    kit *k = *state;
    ag_mesh mesh;
    ag_scene *scene = make_scene(&mesh);
    ag_light light;
    const ag_light_desc point = { .color = { 1.7f, 0.3f, 9 }, .intensity = 1.1f };
    show(scene, mesh, NULL, NULL);
    OK(ag_scene_add_light(scene, &point, &light));
    OK(ag_scene_save(scene, kit_path(k, "first.glb")));
    OK(kit_load_path(k, kit_path(k, "first.glb"), NULL));
    const ag_light_desc *read = &k->scene->lights[0];
    for (int i = 0; i < 3; i++) {
        assert_true(read->color[i] <= 1);
        kit_near(read->color[i] * read->intensity, (double)(point.color[i] * point.intensity), 0);
    }
    ag_scene_destroy(scene);
}

static void cameras(void **state)
{
    static const ag_camera_desc descs[] = {
        { .position = { 1, 2, 3 }, .fov_y_rad = 0.3f, .name = "front" },
        { .position = { 100.1f, 2, 3 }, .target = { 99, 0.1f, 0.7f }, .up = { 0.1f, 1, 0 } },
        { .position = { 0, 5, 0 }, .near_m = 0.1f, .far_m = 17.3f },
        { .position = { 0, 5, 1e4f }, .far_m = 0.5f },
        { .position = { 1, 2, 3 }, .height_m = 2.2f },
        { .position = { 1, 2, 3 }, .height_m = 2.2f, .far_m = 1e-3f },
        { .position = { 1, 2, 3 }, .height_m = 2.2f, .near_m = 0.1f, .far_m = 7 },
        { .position = { 1e-3f, 2e-3f, 3e-3f }, .up = { 0, 0, -7 } },
    };
    kit *k = *state;
    ag_mesh mesh;
    ag_scene *scene = make_scene(&mesh);
    ag_camera camera;
    show(scene, mesh, NULL, NULL);
    for (size_t i = 0; i < sizeof descs / sizeof *descs; i++)
        OK(ag_scene_add_camera(scene, &descs[i], &camera));
    round_trip(k, scene);
    check_structure(k, "first.glb");
    ag_scene_destroy(scene);
}

static void environments(void **state)
{
    static const float pixels[4][4] = {
        { 0.1f, 1e12f, 0, 1 }, { 1, 2, 3, 0.5f }, { 1e-5f, 0, 0, 1 }, { 7, 7, 1.0f / 3, 1 }
    };
    const ag_image_desc image = { 2, 2, AG_FORMAT_RGBA32F, pixels };
    kit *k = *state;
    ag_mesh mesh;
    ag_scene *scene = make_scene(&mesh);
    ag_image *made;
    show(scene, mesh, NULL, NULL);
    OK(ag_image_create(NULL, &image, &made));
    for (int kind = 0; kind <= AG_ENVIRONMENT_NONE; kind++) {
        const ag_environment_desc plain = { .kind = (ag_environment_kind)kind, .image = made };
        ag_environment_desc turned = plain;
        turned.rotation_rad = 0.7f;
        turned.intensity = 0.1f;
        OK(ag_scene_set_environment(scene, &turned));
        round_trip(k, scene);
        OK(ag_scene_set_environment(scene, &plain));
        round_trip(k, scene);
    }
    ag_image_destroy(made);
    check_structure(k, "first.glb");
    ag_scene_destroy(scene);
}

// Nothing at all, and a mesh of more vertices than 16 bits count.
static void extremes(void **state)
{
    enum { VERTICES = 65537 };
    kit *k = *state;
    ag_scene *scene;
    OK(ag_scene_create(NULL, &scene));
    OK(ag_scene_save(scene, kit_path(k, "first.glb")));
    check_structure(k, "first.glb");
    OK(kit_load_path(k, kit_path(k, "first.glb"), NULL));
    assert_int_equal(k->warnings, 1); // there is no surface
    float *positions = calloc(3 * VERTICES, sizeof *positions);
    uint32_t indices[6] = { 0, 1, 2, 3, 65535, 65536 };
    for (size_t i = 0; i < 3 * VERTICES; i++)
        positions[i] = (float)(i * i % 1009) / 7;
    for (uint32_t count = VERTICES - 2; count <= VERTICES; count++) {
        indices[5] = count - 1;
        indices[4] = count - 2;
        const ag_mesh_desc desc = { .positions = positions,
                                    .normals = positions,
                                    .vertex_count = count,
                                    .indices = indices,
                                    .index_count = 6 };
        ag_mesh mesh;
        OK(ag_scene_add_mesh(scene, &desc, &mesh));
        show(scene, mesh, NULL, NULL);
    }
    round_trip(k, scene);
    free(positions);
    check_structure(k, "first.glb");
    ag_scene_destroy(scene);
}

// ---- What fails --------------------------------------------------------------------------

static unsigned count_files(const char *path)
{
    unsigned count = 0;
    DIR *folder = opendir(path);
    for (struct dirent *entry; folder && (entry = readdir(folder));)
        count += entry->d_name[0] != '.';
    closedir(folder);
    return count;
}

// One sentence that names the file; nothing new lies in the folder.
static void fails(kit *k, const char *path, ag_status status, const char *part)
{
    unsigned before = count_files(k->folder);
    k->said[0] = 0;
    k->errors = 0;
    assert_int_equal(ag_scene_save(k->scene, path), status);
    if (k->errors != 1 || !strstr(k->said, part) || !strstr(k->said, path))
        fail_msg("said: %s", k->said);
    assert_int_equal(count_files(k->folder), before);
}

static void bad_places(void **state)
{
    kit *k = *state;
    char path[1024];
    kit_loads(k, kit_document(36, "", "", "", ""), kit_triangle, 36, 0);
    strcpy(path, kit_path(k, "inner"));
    assert_int_equal(mkdir(path, 0777), 0);
    fails(k, path, AG_ERROR_FILE, "Is a directory");
    strcpy(path, kit_path(k, "none/x.glb"));
    fails(k, path, AG_ERROR_FILE, "No such file or directory");
    strcpy(path, kit_path(k, "model.glb/x.glb"));
    fails(k, path, AG_ERROR_FILE, "Not a directory");
}

// A full disk, as the process sees it: the file that was there stays.
static void full_disk(void **state)
{
    kit *k = *state;
    char path[1024];
    struct rlimit before, small;
    struct stat was, is;
    kit_loads(k, kit_document(36, "", "", "", ""), kit_triangle, 36, 0);
    strcpy(path, kit_path(k, "model.glb"));
    assert_int_equal(stat(path, &was), 0);
    getrlimit(RLIMIT_FSIZE, &before);
    signal(SIGXFSZ, SIG_IGN);
    small = before;
    small.rlim_cur = 100;
    setrlimit(RLIMIT_FSIZE, &small);
    fails(k, path, AG_ERROR_FILE, "File too large");
    setrlimit(RLIMIT_FSIZE, &before);
    assert_int_equal(stat(path, &is), 0);
    assert_int_equal(was.st_size, is.st_size);
    assert_int_equal(was.st_ino, is.st_ino);
}

static int allocations_left;

static void *allocate(size_t size)
{
    return allocations_left-- > 0 ? malloc(size) : NULL;
}

// Wherever the memory for the JSON ends it is told, and nothing is written.
static void no_memory(void **state)
{
    kit *k = *state;
    ag_mesh mesh;
    ag_scene *scene = make_scene(&mesh);
    ag_material_desc d = ag_material_default();
    ag_light light;
    ag_camera camera;
    d.emissive[0] = 7;
    d.diffuse = AG_DIFFUSE_EON;
    d.specular = 0.5f;
    d.base_color_texture.texture = add_texture(scene, 4, 1, &(ag_texture_desc) { 0 });
    show(scene, mesh, &d, NULL);
    OK(ag_scene_add_light(scene, &(ag_light_desc) { .kind = AG_LIGHT_HARMONICS }, &light));
    OK(ag_scene_add_light(scene, &(ag_light_desc) { .kind = AG_LIGHT_SPHERE }, &light));
    OK(ag_scene_add_camera(scene, &(ag_camera_desc) { .position = { 0, 0, 1 } }, &camera));
    OK(ag_scene_set_exposure(scene, 2));
    round_trip(k, scene);
    unlink(kit_path(k, "first.glb"));
    scene->log = k->scene->log;
    json_set_alloc_funcs(allocate, free);
    ag_status status = AG_ERROR_MEMORY;
    int count = 0;
    for (; status == AG_ERROR_MEMORY; count++) {
        k->said[0] = 0;
        allocations_left = count;
        status = ag_scene_save(scene, kit_path(k, "first.glb"));
        bool told = strstr(k->said, "no memory to write it") != NULL;
        assert_int_equal(told, status == AG_ERROR_MEMORY);
        assert_int_equal(access(kit_path(k, "first.glb"), F_OK) == 0, status == AG_OK);
    }
    json_set_alloc_funcs(malloc, free);
    OK(status);
    assert_true(count > 200);
    same_files(k, "first.glb", "second.glb");
    ag_scene_destroy(scene);
}

static void released_images(void **state)
{
    kit *k = *state;
    ag_mesh mesh;
    ag_scene *scene = make_scene(&mesh);
    ag_material_desc d = ag_material_default();
    d.normal_texture.texture = add_texture(scene, 4, 1, &(ag_texture_desc) { 0 });
    show(scene, mesh, &d, NULL);
    round_trip(k, scene);
    free(k->scene->images[0]->pixels); // as ag_renderer_take does
    k->scene->images[0]->pixels = NULL;
    char path[1024];
    strcpy(path, kit_path(k, "third.glb"));
    fails(k, path, AG_ERROR_ARGUMENT, "images were released");
    ag_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(built_in_scenes), cmocka_unit_test(materials),
        cmocka_unit_test(textures),        cmocka_unit_test(places),
        cmocka_unit_test(lights),          cmocka_unit_test(strong_colors),
        cmocka_unit_test(cameras),         cmocka_unit_test(environments),
        cmocka_unit_test(extremes),        cmocka_unit_test(bad_places),
        cmocka_unit_test(full_disk),       cmocka_unit_test(released_images),
        cmocka_unit_test(no_memory),
    };
    return cmocka_run_group_tests(tests, kit_setup, kit_teardown);
}
