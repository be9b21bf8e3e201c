// Import of glTF 2.0: the steps in their order, all or nothing.
#include "scene/gltf.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/log.h"

#include <stdlib.h>

enum { FILE_LIMIT_GIB = 16 };

ag_status gltf_progress(gltf_file *file, const char *stage, double fraction)
{
    const ag_progress *progress = &file->options.progress;
    if (!progress->update || progress->update(progress->user, stage, fraction))
        return AG_OK;
    return log_fail(&file->log, AG_ERROR_CANCELLED, "%s: loading was cancelled", file->path);
}

ag_status gltf_charge(const gltf_at *at, size_t *budget, size_t count)
{
    if (count > *budget)
        return gltf_fail(at, AG_ERROR_FORMAT,
                         "the meshes need more memory or work than a file of this size justifies");
    *budget -= count;
    return AG_OK;
}

// Generous: a strip's index of one byte may be a triangle, skinned crowds repeat what
// they are made of, and tiny files may ask for zeros.
static void grant_budgets(gltf_file *file)
{
    file->vertex_budget = ((size_t)4 << 20) + 16 * file->total_size;
    file->work_budget = ((size_t)64 << 20) + 64 * file->total_size;
}

static void finish(gltf_file *file)
{
    for (size_t i = 0; i < file->buffer_count; i++)
        free(file->buffers[i].owned);
    for (size_t i = 0; i < file->image_count; i++)
        if (!file->images[i].adopted)
            ag_image_destroy(file->images[i].image);
    for (size_t i = 0; file->skins && i < file->skin_count; i++)
        free(file->skins[i].joints);
    for (size_t i = 0; file->meshes && i < file->mesh_count; i++)
        free(file->meshes[i]);
    free(file->buffers);
    free(file->views);
    free(file->accessors);
    free(file->nodes);
    free(file->skins);
    free(file->textures);
    free(file->images);
    free(file->materials);
    free(file->meshes);
    free(file->reached);
    free(file->folder);
    free(file->bytes);
    json_decref(file->meshes_made);
    json_decref(file->root);
}

static ag_status read_structure(gltf_file *file)
{
    ag_status status = gltf_file_open(file);
    if (!status)
        status = gltf_extensions_read(file);
    if (!status)
        status = gltf_buffers_read(file);
    grant_budgets(file);
    if (!status)
        status = gltf_accessors_read(file);
    if (!status)
        status = gltf_nodes_read(file);
    return status ? status : gltf_scene_choose(file);
}

static ag_status fill_scene(gltf_file *file)
{
    bool textured = !file->options.skip_images;
    ag_status status = gltf_materials_read(file);
    if (!status && textured)
        status = gltf_textures_read(file);
    if (!status)
        status = gltf_progress(file, "load", 0.5);
    if (!status && textured)
        status = gltf_images_decode(file);
    if (!status && textured)
        status = gltf_textures_add(file);
    if (!status)
        status = gltf_materials_add(file);
    if (!status)
        status = gltf_instances_add(file);
    return status;
}

ag_status gltf_import(ag_scene *scene, const char *path, void *bytes, size_t size,
                      const ag_load_options *options, double *decode_ms)
{
    gltf_file file = { .scene = scene,
                       .log = scene->log,
                       .path = path,
                       .bytes = bytes,
                       .size = size,
                       .total_size = size };
    if (options)
        file.options = *options;
    ag_status status = gltf_progress(&file, "load", 0.0);
    if (!status)
        status = read_structure(&file);
    if (!status)
        status = fill_scene(&file);
    if (!status)
        status = gltf_progress(&file, "load", 1.0);
    if (!status)
        status = gltf_surround_read(&file);
    *decode_ms = file.decode_ms;
    finish(&file);
    return status;
}

ag_status ag_scene_load(ag_scene *scene, const char *path, const ag_load_options *options)
{
    double begin = clock_ms(), decode_ms = 0.0;
    scene_mark mark = scene_mark_now(scene);
    void *bytes = NULL;
    size_t size = 0;
    ag_status status = file_read(&scene->log, path, (size_t)FILE_LIMIT_GIB << 30, &bytes, &size);
    if (!status)
        status = gltf_import(scene, path, bytes, size, options, &decode_ms);
    if (status) {
        scene_rollback(scene, mark);
        return status;
    }
    scene->decode_ms += decode_ms;
    scene->load_ms += clock_ms() - begin - decode_ms;
    return AG_OK;
}
