// A scene written as glTF 2.0 in its binary form, whole or not at all.
#include "scene/gltf_write.h"

#include "base/log.h"
#include "image/image.h"

#include <stdlib.h>
#include <string.h>

// ---- What is written ---------------------------------------------------------------------

static bool allocate(gltf_writer *w)
{
    const ag_scene *scene = w->scene;
    w->root = json_object();
    w->used = json_object();
    w->materials = malloc((scene->materials_count + 1) * sizeof *w->materials);
    w->textures = malloc((scene->textures_count + 1) * sizeof *w->textures);
    w->images = malloc((scene->images_count + 1) * sizeof *w->images);
    w->primitives = calloc(scene->meshes_count + 1, sizeof *w->primitives);
    w->tangents = calloc(scene->meshes_count + 1, sizeof *w->tangents);
    return w->root && w->used && w->materials && w->textures && w->images && w->primitives &&
           w->tangents;
}

static void finish(gltf_writer *w)
{
    for (size_t i = 0; i < w->pieces_count; i++)
        free(w->pieces[i].data);
    for (size_t i = 0; w->primitives && i < w->scene->meshes_count; i++)
        json_decref(w->primitives[i]);
    free(w->pieces);
    free(w->materials);
    free(w->textures);
    free(w->images);
    free(w->primitives);
    free(w->tangents);
    json_decref(w->used);
    json_decref(w->root);
}

static void begin(gltf_writer *w)
{
    json_t *asset = gltf_put_object(w, w->root, "asset");
    gltf_put_word(w, asset, "version", "2.0");
    gltf_put_word(w, asset, "generator", "Argand");
    gltf_put(w, w->root, "extensionsUsed", json_array());
    gltf_put_index(w, w->root, "scene", 0);
    gltf_append(w, w->root, "scenes", json_object());
}

static void list_extensions(gltf_writer *w)
{
    json_t *list = json_array(), *unused;
    const char *name;
    json_object_foreach(w->used, name, unused) if (json_array_append_new(list, json_string(name)) !=
                                                   0) w->no_memory = true;
    if (json_array_size(list) == 0)
        json_object_del(w->root, "extensionsUsed");
    gltf_put_unless_empty(w, w->root, "extensionsUsed", list);
}

static void put_buffer(gltf_writer *w)
{
    if (w->bin_size == 0)
        return;
    json_t *buffer = json_object();
    gltf_put_index(w, buffer, "byteLength", w->bin_size);
    gltf_append(w, w->root, "buffers", buffer);
}

static ag_status fill(gltf_writer *w)
{
    if (!allocate(w)) {
        w->no_memory = true;
        return AG_OK;
    }
    begin(w);
    gltf_write_choose(w);
    gltf_write_materials(w);
    gltf_write_textures(w);
    gltf_write_instances(w);
    gltf_write_lights(w);
    gltf_write_cameras(w);
    ag_status status = gltf_write_images(w);
    if (!status)
        status = gltf_write_surround(w);
    put_buffer(w);
    list_extensions(w);
    return status;
}

// ---- The container (spec 4.4) ------------------------------------------------------------

static ag_status put_words(file_writer *to, const uint32_t *words, size_t count)
{
    uint8_t bytes[12];
    for (size_t i = 0; i < 4 * count; i++)
        bytes[i] = (uint8_t)(words[i / 4] >> 8 * (i % 4));
    return file_writer_put(to, bytes, 4 * count);
}

// To the next multiple of 4.
static ag_status pad(file_writer *to, size_t size, char with)
{
    const char padding[3] = { with, with, with };
    return file_writer_put(to, padding, (4 - size % 4) % 4);
}

static ag_status put_chunks(const gltf_writer *w, const char *text, size_t length, file_writer *to)
{
    size_t json_size = (length + 3) / 4 * 4, bin_part = w->bin_size ? 8 + w->bin_size : 0;
    size_t total = 20 + json_size + bin_part;
    if (total > UINT32_MAX)
        return log_fail(&w->log, AG_ERROR_UNSUPPORTED,
                        "%s: would take %zu bytes, and a .glb holds at most 4 GiB", w->path, total);
    const uint32_t head[] = { GLB_MAGIC, 2, (uint32_t)total };
    const uint32_t json_head[] = { (uint32_t)json_size, GLB_CHUNK_JSON };
    const uint32_t bin_head[] = { (uint32_t)w->bin_size, GLB_CHUNK_BIN };
    ag_status status = put_words(to, head, 3);
    if (!status)
        status = put_words(to, json_head, 2);
    if (!status)
        status = file_writer_put(to, text, length);
    if (!status)
        status = pad(to, length, ' ');
    if (!status && w->bin_size)
        status = put_words(to, bin_head, 2);
    for (size_t i = 0; i < w->pieces_count && !status; i++) {
        status = file_writer_put(to, w->pieces[i].data, w->pieces[i].size);
        if (!status)
            status = pad(to, w->pieces[i].size, 0);
    }
    return status;
}

ag_status gltf_write(const ag_scene *scene, const char *path, file_writer *to)
{
    gltf_writer w = { .scene = scene, .log = scene->log, .path = path };
    ag_status status = fill(&w);
    char *text = NULL;
    if (!status && !w.no_memory)
        text = json_dumps(w.root, JSON_COMPACT | JSON_REAL_PRECISION(9));
    if (!status && !text)
        status = log_fail(&w.log, AG_ERROR_MEMORY, "%s: there is no memory to write it", path);
    if (!status)
        status = put_chunks(&w, text, strlen(text), to);
    free(text);
    finish(&w);
    return status;
}

ag_status ag_scene_save(const ag_scene *scene, const char *path)
{
    file_writer *writer;
    ag_status status = file_writer_open(&scene->log, path, &writer);
    if (status)
        return status;
    status = gltf_write(scene, path, writer);
    if (status) {
        file_writer_abandon(writer);
        return status;
    }
    return file_writer_commit(writer);
}
