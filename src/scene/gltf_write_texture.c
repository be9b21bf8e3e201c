// Textures, their samplers, and their images as PNG, each once (spec 3.8).
#include "base/log.h"
#include "base/threads.h"
#include "image/image.h"
#include "scene/gltf_write.h"

#include <stdlib.h>

// ---- Samplers ----------------------------------------------------------------------------

static int wrap_of(ag_wrap wrap)
{
    return wrap == AG_WRAP_REPEAT  ? GLTF_REPEAT
           : wrap == AG_WRAP_CLAMP ? GLTF_CLAMP_TO_EDGE
                                   : GLTF_MIRRORED_REPEAT;
}

static int min_of(const ag_texture_desc *d)
{
    if (d->no_mips)
        return d->min == AG_FILTER_NEAREST ? GLTF_NEAREST : GLTF_LINEAR;
    int near = d->min == AG_FILTER_NEAREST, mip_linear = d->mip == AG_FILTER_LINEAR;
    return GLTF_NEAREST_MIPMAP_NEAREST + !near + 2 * mip_linear;
}

static void put_sampler(gltf_writer *w, json_t *texture, const ag_texture_desc *d)
{
    int mag = d->mag == AG_FILTER_NEAREST ? GLTF_NEAREST : GLTF_LINEAR, min = min_of(d);
    json_t *sampler = json_object();
    gltf_put_index(w, sampler, "magFilter", (size_t)mag);
    gltf_put_index(w, sampler, "minFilter", (size_t)min);
    if (d->wrap_u != AG_WRAP_REPEAT)
        gltf_put_index(w, sampler, "wrapS", (size_t)wrap_of(d->wrap_u));
    if (d->wrap_v != AG_WRAP_REPEAT)
        gltf_put_index(w, sampler, "wrapT", (size_t)wrap_of(d->wrap_v));
    json_t *list = json_object_get(w->root, "samplers");
    for (size_t i = 0; i < json_array_size(list); i++)
        if (json_equal(json_array_get(list, i), sampler)) {
            json_decref(sampler);
            gltf_put_index(w, texture, "sampler", i);
            return;
        }
    gltf_put_index(w, texture, "sampler", gltf_append(w, w->root, "samplers", sampler));
}

// ---- Textures ----------------------------------------------------------------------------

static size_t image_of(const ag_scene *scene, const scene_texture *texture)
{
    size_t i = 0;
    while (scene->images[i] != texture->image)
        i++;
    return i;
}

void gltf_write_textures(gltf_writer *w)
{
    uint32_t images = 0;
    for (size_t i = 0; i < w->scene->images_count; i++)
        w->images[i] = GLTF_NONE;
    for (size_t i = 0; i < w->scene->textures_count; i++) {
        if (w->textures[i] == GLTF_NONE)
            continue;
        const scene_texture *texture = &w->scene->textures[i];
        size_t image = image_of(w->scene, texture);
        if (w->images[image] == GLTF_NONE)
            w->images[image] = images++;
        json_t *made = json_object();
        gltf_put_index(w, made, "source", w->images[image]);
        put_sampler(w, made, &texture->desc);
        gltf_append(w, w->root, "textures", made);
    }
}

// ---- Images ------------------------------------------------------------------------------

typedef struct encode_job {
    const ag_image *image;
    void *data;
    size_t size;
    ag_status status;
    log_buffer log;
} encode_job;

static void encode(void *context, size_t index)
{
    encode_job *job = (encode_job *)context + index;
    ag_log log = log_to_buffer(&job->log);
    job->status =
        ag_image_save_memory(&log, job->image, "texture.png", NULL, &job->data, &job->size);
}

// The jobs in the file's order; how many.
static ag_status gather(gltf_writer *w, encode_job *jobs, size_t *count)
{
    for (size_t i = 0; i < w->scene->images_count; i++) {
        const ag_image *image = w->scene->images[i];
        if (w->images[i] == GLTF_NONE)
            continue;
        if (!image->pixels)
            return log_fail(&w->log, AG_ERROR_ARGUMENT,
                            "%s: the scene's images were released when a renderer took them; "
                            "save it before that, or load it again",
                            w->path);
        jobs[w->images[i]].image = image;
        *count += 1;
    }
    return AG_OK;
}

// The view takes the bytes over, whatever comes.
static ag_status add_image(gltf_writer *w, encode_job *job)
{
    log_flush(&w->log, &job->log);
    uint32_t view = gltf_add_view(w, job->data, job->size, 0);
    json_t *made = json_object();
    gltf_put_index(w, made, "bufferView", view);
    gltf_put_word(w, made, "mimeType", "image/png");
    gltf_append(w, w->root, "images", made);
    return job->status;
}

ag_status gltf_write_images(gltf_writer *w)
{
    size_t count = 0;
    encode_job *jobs = calloc(w->scene->images_count + 1, sizeof *jobs);
    if (!jobs) {
        w->no_memory = true;
        return AG_OK;
    }
    ag_status status = gather(w, jobs, &count);
    if (!status)
        parallel_for(count, encode, jobs);
    for (size_t i = 0; i < count; i++) {
        ag_status added = add_image(w, &jobs[i]);
        status = status ? status : added;
    }
    free(jobs);
    return status;
}
