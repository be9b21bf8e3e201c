// The scene itself: made, taken back, summed up and freed.  What it holds is added by
// texture.c, material.c, mesh.c, light.c, camera.c and environment.c.
#include "scene/scene.h"

#include "base/array.h"
#include "base/clock.h"
#include "base/hash.h"
#include "base/log.h"
#include "scene/vector.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

// Scenes may follow each other at one address, so the time takes part.
static uint64_t make_id(const ag_scene *scene)
{
    struct {
        const ag_scene *address;
        double ms;
    } seed = { scene, clock_ms() };
    return hash_bytes(&seed, sizeof seed, 0);
}

ag_status ag_scene_create(const ag_log *log, ag_scene **scene)
{
    *scene = NULL;
    ag_log to = log_resolve(log);
    ag_scene *made = calloc(1, sizeof *made);
    if (!made ||
        !array_reserve(&made->materials, &made->materials_capacity, 1, sizeof *made->materials)) {
        free(made);
        return log_fail(&to, AG_ERROR_MEMORY, "There is no memory for a scene.");
    }
    made->log = to;
    made->materials[made->materials_count++] = ag_material_default();
    made->environment_kind = AG_ENVIRONMENT_STUDIO;
    made->environment_intensity = made->exposure = 1.0f;
    made->id = make_id(made);
    made->revision = made->materials_revision = made->environment_revision = 1;
    *scene = made;
    return AG_OK;
}

void ag_scene_destroy(ag_scene *scene)
{
    if (!scene)
        return;
    scene_rollback(scene, (scene_mark) { 0 });
    ag_image_destroy(scene->environment);
    free(scene->images);
    free(scene->textures);
    free(scene->materials);
    free(scene->meshes);
    free(scene->instances);
    free(scene->lights);
    free(scene->cameras);
    free(scene->extensions);
    free(scene);
}

scene_mark scene_mark_now(const ag_scene *scene)
{
    return (scene_mark) {
        .images = scene->images_count,
        .textures = scene->textures_count,
        .materials = scene->materials_count,
        .meshes = scene->meshes_count,
        .instances = scene->instances_count,
        .lights = scene->lights_count,
        .cameras = scene->cameras_count,
        .extensions = scene->extensions_count,
    };
}

void scene_rollback(ag_scene *scene, scene_mark mark)
{
    while (scene->images_count > mark.images)
        ag_image_destroy(scene->images[--scene->images_count]);
    while (scene->meshes_count > mark.meshes) {
        scene_mesh *mesh = &scene->meshes[--scene->meshes_count];
        free(mesh->vertices);
        free(mesh->indices);
    }
    while (scene->cameras_count > mark.cameras)
        name_free(scene->cameras[--scene->cameras_count].name);
    while (scene->materials_count > mark.materials)
        name_free(scene->materials[--scene->materials_count].name);
    while (scene->instances_count > mark.instances)
        name_free(scene->instances[--scene->instances_count].name);
    while (scene->lights_count > mark.lights)
        name_free(scene->lights[--scene->lights_count].name);
    scene->textures_count = mark.textures;
    scene->extensions_count = mark.extensions;
    scene->revision++;
}

// ---- Names -----------------------------------------------------------------

bool name_set(const char **name, const char *text)
{
    if (text && *name && strcmp(text, *name) == 0)
        return true;
    char *copy = text ? strdup(text) : NULL;
    if (text && !copy)
        return false;
    name_free(*name);
    *name = copy;
    return true;
}

void name_free(const char *name)
{
    free((char *)(uintptr_t)name);
}

// ---- Bounds ----------------------------------------------------------------

static float clamp_to_float(double value)
{
    return (float)fmin(fmax(value, -(double)FLT_MAX), (double)FLT_MAX);
}

// Widen `min`, `max` by one instance's box: Arvo 1990, "Transforming Axis-Aligned Bounding
// Boxes" (Graphics Gems).
static void include_instance(const ag_scene *scene, const scene_instance *instance, float min[3],
                             float max[3])
{
    const scene_mesh *mesh = &scene->meshes[instance->mesh];
    for (int row = 0; row < 3; row++) {
        double low = (double)instance->world[12 + row], high = low;
        for (int column = 0; column < 3; column++) {
            double m = (double)instance->world[4 * column + row];
            double a = m * (double)mesh->min[column], b = m * (double)mesh->max[column];
            low += fmin(a, b);
            high += fmax(a, b);
        }
        min[row] = fminf(min[row], clamp_to_float(low));
        max[row] = fmaxf(max[row], clamp_to_float(high));
    }
}

void instance_bounds(const ag_scene *scene, const scene_instance *instance, float min[3],
                     float max[3])
{
    for (int i = 0; i < 3; i++) {
        min[i] = FLT_MAX;
        max[i] = -FLT_MAX;
    }
    include_instance(scene, instance, min, max);
}

bool scene_bounds(const ag_scene *scene, float min[3], float max[3])
{
    bool any = scene->instances_count > 0;
    for (int i = 0; i < 3; i++) {
        min[i] = any ? FLT_MAX : 0.0f;
        max[i] = any ? -FLT_MAX : 0.0f;
    }
    for (size_t i = 0; i < scene->instances_count; i++)
        include_instance(scene, &scene->instances[i], min, max);
    return any;
}

// ---- Exposure ----------------------------------------------------------------

ag_status ag_scene_set_exposure(ag_scene *scene, float exposure)
{
    if (!(exposure > 0.0f && isfinite(exposure)))
        return log_fail(&scene->log, AG_ERROR_ARGUMENT, "An exposure of %g is not above 0.",
                        (double)exposure);
    scene->exposure = exposure;
    return AG_OK;
}

float ag_scene_exposure(const ag_scene *scene)
{
    return scene->exposure;
}

// ---- Asking ----------------------------------------------------------------

ag_scene_summary ag_scene_summarize(const ag_scene *scene)
{
    ag_scene_summary summary = {
        .meshes = (uint32_t)scene->meshes_count,
        .materials = (uint32_t)scene->materials_count - 1, // without the default one
        .textures = (uint32_t)scene->textures_count,
        .instances = (uint32_t)scene->instances_count,
        .lights = (uint32_t)scene->lights_count,
        .cameras = (uint32_t)scene->cameras_count,
        .load_ms = scene->load_ms,
        .decode_ms = scene->decode_ms,
    };
    for (size_t i = 0; i < scene->instances_count; i++) {
        const scene_mesh *mesh = &scene->meshes[scene->instances[i].mesh];
        summary.vertices += mesh->vertex_count;
        summary.triangles += mesh->index_count / 3;
    }
    scene_bounds(scene, summary.bounds_min, summary.bounds_max);
    return summary;
}

bool ag_scene_extension(const ag_scene *scene, size_t index, ag_extension_info *info)
{
    if (index >= scene->extensions_count)
        return false;
    const scene_extension *extension = &scene->extensions[index];
    *info = (ag_extension_info) { .name = extension->name,
                                  .required = extension->required,
                                  .supported = extension->supported };
    return true;
}
