// Fuzz target: the glTF importer, without files beside the one given.
#include "scene/gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void count_errors(void *user, ag_log_level level, const char *sentence)
{
    (void)sentence;
    if (level == AG_LOG_ERROR)
        ++*(unsigned *)user;
}

static void require(bool holds)
{
    if (!holds)
        abort();
}

// What the renderer relies on without looking.
static void check_mesh(const scene_mesh *mesh)
{
    require(mesh->index_count > 0 && mesh->index_count % 3 == 0);
    for (uint32_t i = 0; i < mesh->index_count; i++)
        require(mesh->indices[i] < mesh->vertex_count);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const scene_vertex *v = &mesh->vertices[i];
        for (int c = 0; c < 3; c++)
            require(isfinite(v->position[c]) && fabsf(v->normal[c]) <= 1.001f &&
                    fabsf(v->tangent[c]) <= 1.001f);
        require(fabsf(v->tangent[3]) == 1.0f);
        for (int c = 0; c < 4; c++)
            require(isfinite(v->uv[c / 2][c % 2]));
    }
}

static void check_scene(const ag_scene *scene)
{
    for (size_t i = 0; i < scene->meshes_count; i++)
        check_mesh(&scene->meshes[i]);
    for (size_t i = 0; i < scene->instances_count; i++) {
        const scene_instance *instance = &scene->instances[i];
        require(instance->mesh < scene->meshes_count);
        require(instance->material < scene->materials_count);
        for (int c = 0; c < 16; c++)
            require(isfinite(instance->world[c]));
    }
    for (size_t i = 0; i < scene->textures_count; i++)
        require(scene->textures[i].image != NULL);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    unsigned errors = 0;
    const ag_log log = { .write = count_errors, .user = &errors };
    ag_scene *scene;
    require(ag_scene_create(&log, &scene) == AG_OK);
    void *bytes = malloc(size ? size : 1);
    require(bytes != NULL);
    if (size)
        memcpy(bytes, data, size);
    double decode_ms;
    ag_status status =
        gltf_import(scene, "/no/such/folder/fuzz.gltf", bytes, size, NULL, &decode_ms);
    require(errors == (status != AG_OK));
    if (status == AG_OK)
        check_scene(scene);
    ag_scene_destroy(scene);
    return 0;
}
