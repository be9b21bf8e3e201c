// Fuzz target: the glTF importer, without files beside the one given; and the writer, whose files
// must be read again, and give the same bytes when they are.
#include "scene/gltf_write.h"

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

static void hear_nothing(void *user, ag_log_level level, const char *sentence)
{
    (void)user;
    (void)level;
    (void)sentence;
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

static ag_status import(const uint8_t *data, size_t size, ag_scene **scene)
{
    unsigned errors = 0;
    const ag_log log = { .write = count_errors, .user = &errors };
    require(ag_scene_create(&log, scene) == AG_OK);
    void *bytes = malloc(size ? size : 1);
    require(bytes != NULL);
    if (size)
        memcpy(bytes, data, size);
    double decode_ms;
    ag_status status =
        gltf_import(*scene, "/no/such/folder/fuzz.gltf", bytes, size, NULL, &decode_ms);
    require(errors == (status != AG_OK));
    (*scene)->log.user = NULL;
    (*scene)->log.write = hear_nothing;
    return status;
}

static void save(const ag_scene *scene, void **data, size_t *size)
{
    file_writer *writer;
    require(file_writer_open_memory(&scene->log, "fuzz.glb", &writer) == AG_OK);
    require(gltf_write(scene, "fuzz.glb", writer) == AG_OK);
    file_writer_take(writer, data, size);
}

// There and back twice: the first time may drop what cannot be seen or split what was shared.
static void check_written(const ag_scene *scene)
{
    void *data[3];
    size_t size[3];
    save(scene, &data[0], &size[0]);
    for (int i = 1; i < 3; i++) {
        ag_scene *read;
        require(import(data[i - 1], size[i - 1], &read) == AG_OK);
        check_scene(read);
        require(read->instances_count <= scene->instances_count &&
                read->lights_count == scene->lights_count &&
                read->cameras_count == scene->cameras_count);
        save(read, &data[i], &size[i]);
        ag_scene_destroy(read);
    }
    require(size[1] == size[2] && memcmp(data[1], data[2], size[1]) == 0);
    for (int i = 0; i < 3; i++)
        free(data[i]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    ag_scene *scene;
    if (import(data, size, &scene) == AG_OK) {
        check_scene(scene);
        check_written(scene);
    }
    ag_scene_destroy(scene);
    return 0;
}
