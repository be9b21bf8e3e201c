// The scene of the texts on specular lighting and on sphere lights: 13 meshes, and 30 spheres of
// five materials from rough to smooth, between seven lamps.
//
// Positions, sizes, materials and lamps are theirs.  The shapes' vertices, the texels' order, the
// cameras, the exposures and the second one's environment they do not print.
#include <argand/eye.h>

#include "image/image.h"
#include "scene/demo.h"

static const float pi = 3.14159265359f;

// ---- Shapes ------------------------------------------------------------------

enum shape { TRIANGLE, QUAD, CUBE, SPHERE, SHAPES };

static ag_mesh make_triangle(stage *s, float size)
{
    const float positions[] = { -size, -size, 0, size, -size, 0, 0, size, 0 };
    const float normals[] = { 0, 0, 1, 0, 0, 1, 0, 0, 1 };
    const float uvs[] = { 0, 1, 1, 1, 0.5f, 0 };
    const ag_mesh_desc desc = {
        .positions = positions, .normals = normals, .uvs = { uvs }, .vertex_count = 3
    };
    ag_mesh mesh = { 0 };
    if (s->status == AG_OK)
        s->status = ag_scene_add_mesh(s->scene, &desc, &mesh);
    return mesh;
}

static void make_shapes(stage *s, ag_mesh shapes[SHAPES])
{
    const float size = 0.25f;
    shapes[TRIANGLE] = make_triangle(s, size);
    shapes[QUAD] = stage_panel(s, 2 * size, 2 * size, 1.0f);
    shapes[CUBE] = stage_box(s, (vec3) { size, size, size }, 0.0f);
    shapes[SPHERE] = stage_sphere(s, size, 64, 40);
}

// ---- Materials ---------------------------------------------------------------

enum texture { RED_YELLOW_GREEN_BLACK, BLUE_CYAN_MAGENTA_WHITE, TEXTURES };

static ag_texture make_texture(stage *s, const uint8_t texels[4][4])
{
    const ag_image image = { 2, 2, AG_FORMAT_RGBA8, (void *)(uintptr_t)texels };
    const ag_texture_desc desc = { .image = &image, .mag = AG_FILTER_NEAREST, .no_mips = true };
    ag_texture texture = { 0 };
    if (s->status == AG_OK)
        s->status = ag_scene_add_texture(s->scene, &desc, &texture);
    return texture;
}

static void make_textures(stage *s, ag_texture textures[TEXTURES])
{
    static const uint8_t texels[TEXTURES][4][4] = {
        { { 255, 0, 0, 255 }, { 255, 255, 0, 255 }, { 0, 255, 0, 255 }, { 0, 0, 0, 255 } },
        { { 0, 0, 255, 255 }, { 0, 255, 255, 255 }, { 255, 0, 255, 255 }, { 255, 255, 255, 255 } },
    };
    for (int i = 0; i < TEXTURES; i++)
        textures[i] = make_texture(s, texels[i]);
}

// One lobe of single bounces, blended linearly with the base.
static ag_material_desc plain(stage *s)
{
    ag_material_desc desc = ag_material_default();
    desc.double_sided = true;
    if (s->look == AG_LOOK_TEXT) {
        desc.layering = AG_LAYERING_BLEND;
        desc.single_bounce = true;
    }
    return desc;
}

static ag_material dielectric(stage *s, ag_texture texture, vec3 albedo, float roughness,
                              float reflectiveness)
{
    ag_material_desc desc = plain(s);
    vec3_store(albedo, desc.base_color);
    desc.base_color_texture.texture = texture;
    desc.metallic = 0.0f;
    desc.roughness = roughness;
    desc.reflectiveness = reflectiveness;
    if (s->look == AG_LOOK_TEXT) // reflectance .5, more than any dielectric has
        desc.ior = (1.0f + sqrtf(0.5f)) / (1.0f - sqrtf(0.5f));
    return stage_material(s, desc);
}

typedef struct conductor {
    float n[3], k[3];
} conductor;

static const conductor silver = { { 0.15865f, 0.14215f, 0.13533f }, { 3.8929f, 3.0051f, 2.3276f } };
static const conductor gold = { { 0.18601f, 0.59580f, 1.4120f }, { 3.3762f, 2.0765f, 1.7827f } };
static const conductor copper = { { 0.28046f, 0.85418f, 1.3284f }, { 3.5587f, 2.4518f, 2.2949f } };

static ag_material metal(stage *s, const conductor *c, float roughness)
{
    ag_material_desc desc = plain(s);
    for (int i = 0; i < 3; i++) {
        float n = c->n[i], k2 = c->k[i] * c->k[i];
        desc.base_color[i] = ((n - 1) * (n - 1) + k2) / ((n + 1) * (n + 1) + k2);
        desc.conductor_n[i] = n;
        desc.conductor_k[i] = c->k[i];
    }
    desc.roughness = roughness;
    desc.reflectiveness = 1.0f;
    if (s->look == AG_LOOK_ARGAND)
        desc.fresnel = AG_FRESNEL_CONDUCTOR;
    return stage_material(s, desc);
}

// ---- What stands there ---------------------------------------------------------

static void show_meshes(stage *s, const ag_texture textures[TEXTURES])
{
    static const struct {
        vec3 at;
        enum shape shape;
        enum texture texture;
        vec3 albedo;
    } meshes[13] = {
        { { 0.25f, 0, -1.25f }, TRIANGLE, RED_YELLOW_GREEN_BLACK, { 1, 1, 1 } },
        { { 0.25f, -0.25f, -2 }, TRIANGLE, BLUE_CYAN_MAGENTA_WHITE, { 0.75f, 0.5f, 1 } },
        { { -0.25f, 0.25f, -3 }, QUAD, BLUE_CYAN_MAGENTA_WHITE, { 0.75f, 0.5f, 1 } },
        { { 1.5f, 0, -2.6f }, QUAD, RED_YELLOW_GREEN_BLACK, { 1, 1, 1 } },
        { { -1.5f, 0, -2.6f }, QUAD, BLUE_CYAN_MAGENTA_WHITE, { 1, 1, 1 } },
        { { 1, 0.5f, -2.5f }, CUBE, RED_YELLOW_GREEN_BLACK, { 1, 1, 1 } },
        { { 1, -0.5f, -2.5f }, CUBE, RED_YELLOW_GREEN_BLACK, { 1, 1, 1 } },
        { { -1, 0.5f, -2.5f }, CUBE, BLUE_CYAN_MAGENTA_WHITE, { 1, 1, 1 } },
        { { -1, -0.5f, -2.5f }, CUBE, BLUE_CYAN_MAGENTA_WHITE, { 1, 1, 1 } },
        { { 2, 0.5f, -2.5f }, SPHERE, RED_YELLOW_GREEN_BLACK, { 1, 1, 1 } },
        { { 2, -0.5f, -2.5f }, SPHERE, RED_YELLOW_GREEN_BLACK, { 1, 1, 1 } },
        { { -2, 0.5f, -2.5f }, SPHERE, BLUE_CYAN_MAGENTA_WHITE, { 1, 1, 1 } },
        { { -2, -0.5f, -2.5f }, SPHERE, BLUE_CYAN_MAGENTA_WHITE, { 1, 1, 1 } },
    };
    ag_mesh shapes[SHAPES];
    make_shapes(s, shapes);
    for (int i = 0; i < 13; i++) {
        ag_texture texture = textures[meshes[i].texture];
        ag_material material = dielectric(s, texture, meshes[i].albedo, 0.1f, 0.25f);
        stage_show(s, shapes[meshes[i].shape], material, meshes[i].at);
    }
}

static ag_material row_material(stage *s, int row, const ag_texture textures[TEXTURES],
                                float roughness)
{
    static const conductor *const metals[] = { &silver, &gold, &copper };
    if (row < TEXTURES)
        return dielectric(s, textures[row], (vec3) { 1, 1, 1 }, roughness, 0.75f);
    return metal(s, metals[row - TEXTURES], roughness);
}

// A row a material, from roughness 1 on the right to the least on the left.
static void show_spheres(stage *s, const ag_texture textures[TEXTURES], float least_roughness)
{
    enum { COLUMNS = 6, ROWS = 5 };
    ag_mesh sphere = stage_sphere(s, 0.125f, 64, 40);
    for (int column = 0; column < COLUMNS; column++) {
        float roughness = fmaxf(1.0f - (float)column / (COLUMNS - 1), least_roughness);
        for (int row = 0; row < ROWS; row++) {
            vec3 at = { 0.5f - 0.25f * (float)column, 0.5f - 0.25f * (float)row, -0.75f };
            stage_show(s, sphere, row_material(s, row, textures, roughness), at);
        }
    }
}

// ---- Lamps -------------------------------------------------------------------

enum { LAMPS = 7 };

static const struct {
    vec3 at, intensity; // W/sr
} lamps[LAMPS] = {
    { { 0, 0, 0 }, { 0.5f, 0.5f, 0.5f } },
    { { 0.25f, -0.25f, -1.9f }, { 0.025f, 0.025f, 0.025f } },
    { { -0.25f, 0.25f, -2.9f }, { 0.025f, 0.025f, 0.025f } },
    { { 1.5f, 0, -2.5f }, { 0.125f, 0.125f, 0.025f } },
    { { -1.5f, 0, -2.5f }, { 0.125f, 0.025f, 0.025f } },
    { { -1, 0, -2.9f }, { 0.25f, 0.25f, 0.25f } },
    { { 1, 0, -2.9f }, { 0.25f, 0.25f, 0.25f } },
};

static const float bulb_radius = 0.0125f;

static ag_light_desc lamp(int i, ag_light_kind kind, float radius)
{
    ag_light_desc desc = { .kind = kind, .intensity = 1.0f, .radius_m = radius };
    vec3_store(lamps[i].at, desc.position);
    vec3_store(lamps[i].intensity, desc.color);
    return desc;
}

// A point light that glows: its intensity is spread over the disk that a bulb shows.
static void hang_point(stage *s, int i, ag_mesh bulb)
{
    stage_light(s, lamp(i, AG_LIGHT_POINT, 0.0f));
    ag_material_desc desc = ag_material_default();
    vec3 radiance = vec3_scale(lamps[i].intensity, 1.0f / (pi * bulb_radius * bulb_radius));
    vec3_store((vec3) { 0, 0, 0 }, desc.base_color);
    vec3_store(radiance, desc.emissive);
    stage_show(s, bulb, stage_material(s, desc), lamps[i].at);
}

static void hang_points(stage *s)
{
    ag_mesh bulb = stage_sphere(s, bulb_radius, 32, 20);
    for (int i = 0; i < LAMPS; i++)
        hang_point(s, i, bulb);
}

static void hang_spheres(stage *s, float first_radius)
{
    for (int i = 0; i < LAMPS; i++)
        stage_light(s, lamp(i, AG_LIGHT_SPHERE, i == 0 ? first_radius : bulb_radius));
}

// ---- The scenes ----------------------------------------------------------------

// Lights are radiometric: the luminance is 683 lm/W times their light, and what saturates is
// 1.2 * 2^EV.
static void expose(stage *s, float ev100)
{
    stage_exposure(s, 683.0f * ag_exposure_from_ev100(ev100));
}

static void show(stage *s, float least_roughness)
{
    ag_texture textures[TEXTURES];
    make_textures(s, textures);
    show_meshes(s, textures);
    show_spheres(s, textures, least_roughness);
    stage_view(s, (ag_camera_desc) { .position = { -0.25f, 0.75f, 1.85f },
                                     .target = { -0.02f, 0.0f, -1.2f },
                                     .fov_y_rad = 1.06f });
}

void demo_specular(stage *s)
{
    show(s, 0.01f);
    if (s->look == AG_LOOK_TEXT)
        hang_points(s);
    else
        hang_spheres(s, bulb_radius);
    stage_environment(s, AG_ENVIRONMENT_NONE);
    expose(s, 8.0f);
}

void demo_sphere_lights(stage *s)
{
    show(s, 0.1f);
    hang_spheres(s, 0.075f);
    stage_surround(s, AG_ENVIRONMENT_STUDIO, 0.2f);
    expose(s, 8.0f);
}
