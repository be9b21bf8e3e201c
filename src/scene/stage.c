// Builds the demo scenes.
#include "scene/stage.h"

#include "image/image.h"
#include "scene/primitive.h"

static const float identity[16] = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };

ag_mesh stage_sphere(stage *s, float radius, unsigned segments, unsigned rings)
{
    ag_mesh mesh = { 0 };
    if (s->status == AG_OK)
        s->status = primitive_sphere(s->scene, radius, segments, rings, &mesh);
    return mesh;
}

ag_mesh stage_panel(stage *s, float width, float height, float repeats)
{
    ag_mesh mesh = { 0 };
    if (s->status == AG_OK)
        s->status = primitive_panel(s->scene, width, height, repeats, &mesh);
    return mesh;
}

ag_mesh stage_box(stage *s, vec3 half, float bevel)
{
    ag_mesh mesh = { 0 };
    const float extents[3] = { half.x, half.y, half.z };
    if (s->status == AG_OK)
        s->status = primitive_box(s->scene, extents, bevel, 5, &mesh);
    return mesh;
}

ag_mesh stage_torus(stage *s, float radius, float tube)
{
    ag_mesh mesh = { 0 };
    if (s->status == AG_OK)
        s->status = primitive_torus(s->scene, radius, tube, 96, 40, &mesh);
    return mesh;
}

ag_texture stage_texture(stage *s, unsigned size, void (*texel)(float u, float v, uint8_t out[4]))
{
    ag_texture texture = { 0 };
    ag_image *image = NULL;
    ag_image_desc desc = { .width = size, .height = size, .format = AG_FORMAT_RGBA8 };
    if (s->status == AG_OK)
        s->status = ag_image_create(&s->scene->log, &desc, &image);
    if (s->status != AG_OK)
        return texture;
    uint8_t *out = image->pixels;
    for (unsigned y = 0; y < size; y++)
        for (unsigned x = 0; x < size; x++, out += 4)
            texel(((float)x + 0.5f) / (float)size, ((float)y + 0.5f) / (float)size, out);
    s->status = scene_adopt_texture(s->scene, image, &(ag_texture_desc) { 0 }, &texture);
    return texture;
}

ag_material stage_material(stage *s, ag_material_desc desc)
{
    ag_material material = { 0 };
    if (s->status == AG_OK)
        s->status = ag_scene_add_material(s->scene, &desc, &material);
    return material;
}

ag_material stage_paint(stage *s, vec3 color, float metallic, float roughness)
{
    ag_material_desc desc = ag_material_default();
    vec3_store(color, desc.base_color);
    desc.metallic = metallic;
    desc.roughness = roughness;
    return stage_material(s, desc);
}

static void show(stage *s, ag_mesh mesh, ag_material material, const float world[16])
{
    ag_instance instance;
    if (s->status == AG_OK)
        s->status = ag_scene_add_instance(s->scene, mesh, material, world, &instance);
}

void stage_show(stage *s, ag_mesh mesh, ag_material material, vec3 at)
{
    stage_show_turned(s, mesh, material, at, 0.0f, 0.0f);
}

// World = translation * rotation about Y * rotation about X.
void stage_show_turned(stage *s, ag_mesh mesh, ag_material material, vec3 at, float turn_rad,
                       float tilt_rad)
{
    float ct = cosf(turn_rad), st = sinf(turn_rad), cx = cosf(tilt_rad), sx = sinf(tilt_rad);
    const float world[16] = { ct,      0,   -st,     0, st * sx, cx,   ct * sx, 0,
                              st * cx, -sx, ct * cx, 0, at.x,    at.y, at.z,    1 };
    show(s, mesh, material,
         turn_rad == 0.0f && tilt_rad == 0.0f && vec3_is_zero(at) ? identity : world);
}

void stage_light(stage *s, ag_light_desc desc)
{
    ag_light light;
    if (s->status == AG_OK)
        s->status = ag_scene_add_light(s->scene, &desc, &light);
}

void stage_environment(stage *s, ag_environment_kind kind)
{
    stage_surround(s, kind, 1.0f);
}

void stage_surround(stage *s, ag_environment_kind kind, float intensity)
{
    const ag_environment_desc desc = { .kind = kind, .intensity = intensity };
    if (s->status == AG_OK)
        s->status = ag_scene_set_environment(s->scene, &desc);
}

void stage_exposure(stage *s, float exposure)
{
    if (s->status == AG_OK)
        s->status = ag_scene_set_exposure(s->scene, exposure);
}

void stage_camera(stage *s, float theta_rad, float phi_rad, float fov_y_rad)
{
    ag_orbit orbit = ag_orbit_auto();
    orbit.theta_rad = theta_rad;
    orbit.phi_rad = phi_rad;
    orbit.fov_y_rad = fov_y_rad;
    stage_view(s, ag_scene_frame(s->scene, &orbit, 1.0f));
}

void stage_view(stage *s, ag_camera_desc desc)
{
    desc.name = "demo";
    ag_camera camera;
    if (s->status == AG_OK)
        s->status = ag_scene_add_camera(s->scene, &desc, &camera);
}
