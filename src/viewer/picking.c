// Picking: the light or material that is looked at, changed and moved.
#include "state.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const float reach_px = 10;          // of lights, about their marks
static const double stronger = 1.25;       // intensity, a step
static const double larger = 1.15;         // radius, a step
static const float finer = 1.0f / 20;      // roughness and metalness, a step
static const float first_radius_m = 0.05f; // of a point light that becomes a sphere

// ---- What is there -----------------------------------------------------------

static float instance_radius(const ag_scene *scene, ag_instance instance)
{
    ag_instance_info info;
    if (!ag_scene_instance(scene, instance.id - 1, &info))
        return 1;
    float sum = 0;
    for (int i = 0; i < 3; i++) {
        float side = info.bounds_max[i] - info.bounds_min[i];
        sum += side * side;
    }
    return sqrtf(sum) / 2;
}

static float light_radius(const ag_light_desc *l)
{
    float r = l->radius_m + l->width_m / 2 + l->height_m / 2 + l->length_m / 2;
    return r > 0 ? r : first_radius_m;
}

static selection select_light(const ag_scene *scene, size_t index)
{
    ag_light_desc light;
    selection s = { .kind = PICK_LIGHT, .index = index };
    if (ag_scene_light(scene, index, &light)) {
        memcpy(s.place, light.position, sizeof s.place);
        s.radius = light_radius(&light);
    }
    return s;
}

// ---- What lies under the pointer -------------------------------------------------

static ag_status look_job(void *context, worker *self)
{
    (void)self;
    looking *l = context;
    ag_pick pick;
    ag_status status = ag_scene_pick(l->scene, &l->camera, l->width, l->height, l->place[0],
                                     l->place[1], l->reach, &pick);
    if (status)
        return status;
    if (pick.kind == AG_PICK_LIGHT) {
        l->found = select_light(l->scene, pick.light.id - 1);
    } else if (pick.kind == AG_PICK_SURFACE && pick.material.id) {
        l->found = (selection) { .kind = PICK_MATERIAL,
                                 .index = pick.material.id - 1,
                                 .radius = instance_radius(l->scene, pick.instance) };
        memcpy(l->found.place, pick.position, sizeof l->found.place);
    }
    return AG_OK;
}

// Not while a look is at work: it reads what is set here.
static void begin_look(viewer *v)
{
    looking *l = &v->looking;
    l->at_work = l->wanted;
    l->wanted = LOOK_NONE;
    screen_size(v->screen, &l->width, &l->height);
    if (!l->width || !l->height) {
        l->at_work = LOOK_NONE;
        return;
    }
    l->scene = v->document.scene;
    l->camera = navigation_camera(&v->navigation);
    l->place[0] = (float)l->at[0];
    l->place[1] = (float)l->at[1];
    l->reach = reach_px * screen_scale(v->screen);
    l->found = (selection) { 0 };
    worker_start(l->worker, look_job, l);
}

void picking_look(viewer *v, look_use use, const double at[2])
{
    looking *l = &v->looking;
    l->wanted = v->document.scene ? use : LOOK_NONE;
    l->at[0] = at[0];
    l->at[1] = at[1];
    if (l->wanted && !worker_is_busy(l->worker))
        begin_look(v);
}

void picking_collect(viewer *v)
{
    looking *l = &v->looking;
    ag_status status;
    if (!worker_collect(l->worker, &status))
        return;
    look_use use = l->at_work;
    l->at_work = LOOK_NONE;
    pointer_found(v, use, l->found);
    if (l->wanted)
        begin_look(v);
}

bool picking_holds(const viewer *v)
{
    return v->looking.wanted > LOOK_HOVER || v->looking.at_work > LOOK_HOVER;
}

void picking_pick(viewer *v, selection what)
{
    v->picked = what;
    v->picked.hovers = false;
    v->layers_stale = true;
}

static bool stands_somewhere(const ag_light_desc *l)
{
    return l->kind == AG_LIGHT_POINT || l->kind == AG_LIGHT_SPOT ||
           (l->kind >= AG_LIGHT_SPHERE && l->kind <= AG_LIGHT_TUBE);
}

void picking_next_light(viewer *v)
{
    ag_light_desc light;
    const ag_scene *scene = v->document.scene;
    if (!scene || !ag_scene_light(scene, 0, &light)) {
        viewer_say(v, false, "the scene has no lights; --light adds some");
        return;
    }
    size_t next = v->picked.kind == PICK_LIGHT ? v->picked.index + 1 : 0;
    if (!ag_scene_light(scene, next, &light)) {
        next = 0;
        (void)ag_scene_light(scene, next, &light);
    }
    picking_pick(v, select_light(scene, next));
}

// ---- Changes -----------------------------------------------------------------

// Changes wait until nobody reads the scene, and are summed up meanwhile.
static void ask(viewer *v, double strength, double size)
{
    if (!v->picked.kind) {
        viewer_say(v, false, "nothing is picked: click a light or a surface, or press L");
        return;
    }
    v->change.strength += strength;
    v->change.size += size;
    v->change.wanted = true;
}

void picking_strengthen(viewer *v, double steps)
{
    ask(v, steps, 0);
}

void picking_enlarge(viewer *v, double steps)
{
    ask(v, 0, steps);
}

static void change_light(const change *c, ag_light_desc *l)
{
    l->intensity *= (float)pow(stronger, c->strength);
    if (c->size > 0 && l->kind == AG_LIGHT_POINT) { // of the same light: it only gets a body
        l->kind = AG_LIGHT_SPHERE;
        l->radius_m = first_radius_m;
    }
    float factor = (float)pow(larger, c->size);
    l->radius_m *= factor;
    l->width_m *= factor;
    l->height_m *= factor;
    if (l->kind == AG_LIGHT_SUN)
        l->angular_radius_rad = fminf(l->angular_radius_rad * factor, 1.5f);
    for (int i = 0; i < 3; i++)
        l->position[i] += c->move[i];
}

static float clamp01(float x)
{
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

static ag_status apply(viewer *v)
{
    ag_scene *scene = v->document.scene;
    const change *c = &v->change;
    uint32_t id = (uint32_t)v->picked.index + 1;
    ag_light_desc light;
    ag_material_desc material;
    if (v->picked.kind == PICK_LIGHT && ag_scene_light(scene, v->picked.index, &light)) {
        change_light(c, &light);
        memcpy(v->picked.place, light.position, sizeof v->picked.place);
        return ag_scene_set_light(scene, (ag_light) { id }, &light);
    }
    if (v->picked.kind == PICK_MATERIAL && ag_scene_material(scene, v->picked.index, &material)) {
        material.roughness = clamp01(material.roughness + finer * (float)c->strength);
        material.metallic = clamp01(material.metallic + finer * (float)c->size);
        return ag_scene_set_material(scene, (ag_material) { id }, &material);
    }
    return AG_OK;
}

void picking_step(viewer *v)
{
    if (!v->change.wanted || !v->document.scene || !viewer_can_edit(v))
        return;
    ag_status status = apply(v); // a failure is told, and the scene is as it was
    (void)status;
    v->change = (change) { 0 };
    v->edited = true;
    v->moved = v->now;
    viewer_redraw(v);
}

// The point under the pointer in the plane through `place` that faces the camera.
static bool point_in_plane(const viewer *v, const float place[3], const double at[2], float out[3])
{
    uint32_t width, height;
    screen_size(v->screen, &width, &height);
    ag_camera_desc camera = navigation_camera(&v->navigation);
    ag_ray middle = ag_camera_ray(&camera, width, height, (float)width / 2, (float)height / 2);
    ag_ray ray = ag_camera_ray(&camera, width, height, (float)at[0], (float)at[1]);
    const float *n = middle.direction;
    float along = 0, depth = 0;
    for (int i = 0; i < 3; i++) {
        along += n[i] * ray.direction[i];
        depth += n[i] * (place[i] - ray.origin[i]);
    }
    if (!(along > 1e-4f))
        return false;
    for (int i = 0; i < 3; i++)
        out[i] = ray.origin[i] + ray.direction[i] * depth / along;
    return true;
}

void picking_drag(viewer *v, const double from[2], const double to[2])
{
    float before[3] = { 0 }, after[3] = { 0 };
    if (!point_in_plane(v, v->picked.place, from, before) ||
        !point_in_plane(v, v->picked.place, to, after))
        return;
    for (int i = 0; i < 3; i++)
        v->change.move[i] += after[i] - before[i];
    v->change.wanted = true;
}

// ---- Words and marks -----------------------------------------------------------

static const char *const light_names[] = {
    [AG_LIGHT_POINT] = "point",
    [AG_LIGHT_SPOT] = "spot",
    [AG_LIGHT_DIRECTIONAL] = "directional",
    [AG_LIGHT_SUN] = "sun",
    [AG_LIGHT_SPHERE] = "sphere",
    [AG_LIGHT_DISK] = "disk",
    [AG_LIGHT_RECT] = "rectangle",
    [AG_LIGHT_TUBE] = "tube",
    [AG_LIGHT_AMBIENT] = "ambient",
    [AG_LIGHT_HEMISPHERIC] = "hemispheric",
    [AG_LIGHT_HARMONICS] = "harmonics",
};

static const char *unit_of(ag_light_kind kind)
{
    switch (kind) {
    case AG_LIGHT_POINT:
    case AG_LIGHT_SPOT:
    case AG_LIGHT_SPHERE: return "cd";
    case AG_LIGHT_DIRECTIONAL:
    case AG_LIGHT_SUN: return "lx";
    default: return "nit";
    }
}

static void describe_light(const ag_light_desc *l, size_t index, hud_state *s)
{
    snprintf(s->thing, sizeof s->thing, "Light %zu: %s%s%s", index, light_names[l->kind],
             l->name ? " " : "", l->name ? l->name : "");
    int used = snprintf(s->about_thing, sizeof s->about_thing, "%.4g %s", (double)l->intensity,
                        unit_of(l->kind));
    if (l->radius_m > 0)
        snprintf(s->about_thing + used, sizeof s->about_thing - (size_t)used, " · radius %.3g m",
                 (double)l->radius_m);
    else if (l->kind == AG_LIGHT_RECT)
        snprintf(s->about_thing + used, sizeof s->about_thing - (size_t)used, " · %.3g × %.3g m",
                 (double)l->width_m, (double)l->height_m);
}

static void describe_material(const ag_material_desc *m, size_t index, hud_state *s)
{
    if (m->name)
        snprintf(s->thing, sizeof s->thing, "Material: %s", m->name);
    else
        snprintf(s->thing, sizeof s->thing, "Material %zu", index);
    snprintf(s->about_thing, sizeof s->about_thing, "roughness %.2f%s · metalness %.2f%s",
             (double)m->roughness, m->metallic_roughness_texture.texture.id ? " × texture" : "",
             (double)m->metallic, m->metallic_roughness_texture.texture.id ? " × texture" : "");
}

void picking_describe(const viewer *v, hud_state *s)
{
    const selection *p = v->picked.kind ? &v->picked : &v->hovered;
    ag_light_desc light;
    ag_material_desc material;
    s->thing[0] = s->about_thing[0] = 0;
    if (p->kind == PICK_LIGHT && ag_scene_light(v->document.scene, p->index, &light))
        describe_light(&light, p->index, s);
    else if (p->kind == PICK_MATERIAL && ag_scene_material(v->document.scene, p->index, &material))
        describe_material(&material, p->index, s);
}

// Where the light that is picked is seen; false: nowhere.
static bool mark_place(const viewer *v, const ag_show_options *show, size_t index, float at[2])
{
    ag_light_desc light;
    return ag_scene_light(v->document.scene, index, &light) && stands_somewhere(&light) &&
           ag_camera_project(&v->ordered_camera, show->width, show->height, light.position, at);
}

uint32_t picking_marks(const viewer *v, const ag_show_options *show, ag_layer *layers)
{
    float at[2];
    if (v->picked.kind != PICK_LIGHT || !v->document.scene ||
        !mark_place(v, show, v->picked.index, at))
        return 0;
    float size = (float)ag_image_width(v->ring) * screen_scale(v->screen);
    layers[0] = (ag_layer) { .image = v->ring,
                             .x = at[0] - size / 2,
                             .y = at[1] - size / 2,
                             .width = size,
                             .height = size,
                             .version = 2 };
    return 1;
}
