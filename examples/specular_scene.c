// What stands in the scenes of the texts on specular lighting and on sphere lights.
#include "specular_scene.h"

#include <math.h>
#include <string.h>

const ag_camera_desc specular_camera = { .position = { -0.25f, 0.75f, 1.85f },
                                         .target = { -0.02f, 0, -1.2f },
                                         .fov_y_rad = 1.06f };

// Four texels, shown as four fields: no mips, no filter.
static ag_texture make_fields(ag_scene *scene, const uint32_t rgba[4])
{
    uint8_t texels[16];
    for (int i = 0; i < 16; i++)
        texels[i] = (uint8_t)(rgba[i / 4] >> (24 - i % 4 * 8));
    const ag_image_desc desc = {
        .width = 2, .height = 2, .format = AG_FORMAT_RGBA8, .pixels = texels
    };
    ag_image *image;
    ag_texture texture;
    check(ag_image_create(NULL, &desc, &image));
    check(ag_scene_add_texture(
        scene, &(ag_texture_desc) { .image = image, .mag = AG_FILTER_NEAREST, .no_mips = true },
        &texture));
    ag_image_destroy(image); // the scene has a copy
    return texture;
}

// The text blends one specular lobe linearly with the diffuse base, and lets light bounce once.
static ag_material_desc blended(ag_material_desc desc, float reflectiveness)
{
    desc.layering = AG_LAYERING_BLEND;
    desc.reflectiveness = reflectiveness;
    desc.single_bounce = true;
    desc.double_sided = true;
    return desc;
}

// Its dielectrics reflect half of the light that meets them head on: an index of 5.8.
static ag_material textured(ag_scene *scene, ag_texture texture, ag_material_desc desc,
                            float reflectiveness)
{
    desc.ior = (1 + sqrtf(0.5f)) / (1 - sqrtf(0.5f));
    desc.base_color_texture.texture = texture;
    return make_material(scene, blended(desc, reflectiveness));
}

// The reflectance of a metal, head on, from its index n + ik at red, green and blue.
static ag_material metal(ag_scene *scene, const float n[3], const float k[3], float roughness)
{
    float f0[3];
    for (int i = 0; i < 3; i++)
        f0[i] = (powf(n[i] - 1, 2) + k[i] * k[i]) / (powf(n[i] + 1, 2) + k[i] * k[i]);
    return make_material(scene, blended(paint(f0[0], f0[1], f0[2], 1, roughness), 1));
}

static void build_shapes(ag_scene *scene, const ag_texture textures[2])
{
    const float corners[9] = { -0.25f, -0.25f, 0, 0.25f, -0.25f, 0, 0, 0.25f, 0 };
    const float uvs[6] = { 0, 1, 1, 1, 0.5f, 0 };
    const ag_mesh_desc desc = { .positions = corners, .uvs = { uvs }, .vertex_count = 3 };
    ag_mesh triangle, quad = make_panel(scene, 0.5f, 0.5f), cube = make_box(scene, 0.25f);
    ag_mesh ball = make_ball(scene, 0.25f, 64);
    check(ag_scene_add_mesh(scene, &desc, &triangle));

    const ag_material_desc white = paint(1, 1, 1, 0, 0.1f), lilac = paint(0.75f, 0.5f, 1, 0, 0.1f);
    ag_material warm = textured(scene, textures[0], white, 0.25f);
    ag_material cool = textured(scene, textures[1], white, 0.25f);
    ag_material pale = textured(scene, textures[1], lilac, 0.25f);
    show(scene, triangle, warm, 0.25f, 0, -1.25f);
    show(scene, triangle, pale, 0.25f, -0.25f, -2);
    show(scene, quad, pale, -0.25f, 0.25f, -3);
    show(scene, quad, warm, 1.5f, 0, -2.6f);
    show(scene, quad, cool, -1.5f, 0, -2.6f);
    for (float y = 0.5f; y >= -0.5f; y -= 1) {
        show(scene, cube, warm, 1, y, -2.5f);
        show(scene, cube, cool, -1, y, -2.5f);
        show(scene, ball, warm, 2, y, -2.5f);
        show(scene, ball, cool, -2, y, -2.5f);
    }
}

// One column: two textured dielectrics, silver, gold and copper.
static void build_column(ag_scene *scene, ag_mesh ball, const ag_texture textures[2], float x,
                         float roughness)
{
    static const float n[3][3] = { { 0.15865f, 0.14215f, 0.13533f },
                                   { 0.18601f, 0.59580f, 1.4120f },
                                   { 0.28046f, 0.85418f, 1.3284f } };
    static const float k[3][3] = { { 3.8929f, 3.0051f, 2.3276f },
                                   { 3.3762f, 2.0765f, 1.7827f },
                                   { 3.5587f, 2.4518f, 2.2949f } };
    for (int row = 0; row < 5; row++) {
        ag_material material =
            row < 2 ? textured(scene, textures[row], paint(1, 1, 1, 0, roughness), 0.75f)
                    : metal(scene, n[row - 2], k[row - 2], roughness);
        show(scene, ball, material, x, 0.5f - 0.25f * (float)row, -0.75f);
    }
}

void build_specular(ag_scene *scene, float least_roughness)
{
    const ag_texture textures[2] = {
        make_fields(scene, (uint32_t[]) { 0xff0000ff, 0xffff00ff, 0x00ff00ff, 0x000000ff }),
        make_fields(scene, (uint32_t[]) { 0x0000ffff, 0x00ffffff, 0xff00ffff, 0xffffffff }),
    };
    build_shapes(scene, textures);
    ag_mesh ball = make_ball(scene, 0.125f, 64);
    for (int i = 0; i < 6; i++)
        build_column(scene, ball, textures, 0.5f - 0.25f * (float)i,
                     fmaxf(1 - 0.2f * (float)i, least_roughness));
}

ag_light_desc lamp(int index, ag_light_kind kind, float radius)
{
    static const float lamps[LAMPS][2][3] = {
        { { 0, 0, 0 }, { 0.5f, 0.5f, 0.5f } },
        { { 0.25f, -0.25f, -1.9f }, { 0.025f, 0.025f, 0.025f } },
        { { -0.25f, 0.25f, -2.9f }, { 0.025f, 0.025f, 0.025f } },
        { { 1.5f, 0, -2.5f }, { 0.125f, 0.125f, 0.025f } },
        { { -1.5f, 0, -2.5f }, { 0.125f, 0.025f, 0.025f } },
        { { -1, 0, -2.9f }, { 0.25f, 0.25f, 0.25f } },
        { { 1, 0, -2.9f }, { 0.25f, 0.25f, 0.25f } },
    };
    ag_light_desc light = { .kind = kind, .intensity = 1, .radius_m = radius };
    memcpy(light.position, lamps[index][0], sizeof light.position);
    memcpy(light.color, lamps[index][1], sizeof light.color); // weights: they need not end at 1
    return light;
}
