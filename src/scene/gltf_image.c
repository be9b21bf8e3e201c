// Images (spec 3.8.3): found, decoded on all cores, each once.
#include "base/clock.h"
#include "base/log.h"
#include "base/threads.h"
#include "scene/gltf.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

// What all decoded images of a file may take together.
static const uint64_t PIXEL_BYTES_MAX = (uint64_t)8 << 30;

typedef struct decode_job {
    uint32_t image;
    const void *data; // in a buffer view, or NULL
    size_t size;
    const char *uri; // else
    ag_status status;
    log_buffer log;
} decode_job;

typedef struct decode_work {
    gltf_file *file;
    decode_job *jobs;
    size_t count;
    pthread_t caller;
    atomic_size_t done;
    atomic_bool stop;
    atomic_ullong pixel_bytes;
    ag_status cancelled;
} decode_work;

// The bytes of a file are let go as soon as they are decoded.
static ag_status decode_source(const gltf_file *file, const ag_log *log, const decode_job *job,
                               ag_image **image)
{
    char where[64], name[512];
    void *owned = NULL;
    const void *data = job->data;
    size_t size = job->size;
    snprintf(where, sizeof where, "images[%u]", job->image);
    snprintf(name, sizeof name, "%.400s: %s", file->path, where);
    ag_status status = AG_OK;
    if (!data) {
        status = gltf_uri_read(file, log, where, job->uri, &owned, &size);
        data = owned;
    }
    if (!status)
        status = ag_image_load_memory(log, name, data, size, image);
    free(owned);
    if (!status && ag_image_format(*image) != AG_FORMAT_RGBA8)
        status = log_fail(log, AG_ERROR_UNSUPPORTED, "%s: is not PNG, JPEG or WebP", name);
    return status;
}

static ag_status check_total(decode_work *work, const ag_log *log, const decode_job *job)
{
    const ag_image *image = work->file->images[job->image].image;
    unsigned long long bytes =
        (unsigned long long)ag_image_width(image) * ag_image_height(image) * 4;
    if (atomic_fetch_add(&work->pixel_bytes, bytes) + bytes <= PIXEL_BYTES_MAX)
        return AG_OK;
    return log_fail(log, AG_ERROR_UNSUPPORTED,
                    "%s: images[%u]: the images take more than %llu GiB together", work->file->path,
                    job->image, (unsigned long long)(PIXEL_BYTES_MAX >> 30));
}

static void decode(void *context, size_t index)
{
    decode_work *work = context;
    decode_job *job = &work->jobs[index];
    if (atomic_load(&work->stop))
        return;
    ag_log log = log_to_buffer(&job->log);
    job->status = decode_source(work->file, &log, job, &work->file->images[job->image].image);
    if (!job->status)
        job->status = check_total(work, &log, job);
    if (job->status)
        atomic_store(&work->stop, true);
    size_t done = atomic_fetch_add(&work->done, 1) + 1;
    if (pthread_equal(pthread_self(), work->caller) && !work->cancelled) {
        work->cancelled = gltf_progress(work->file, "decode", (double)done / (double)work->count);
        if (work->cancelled)
            atomic_store(&work->stop, true);
    }
}

static ag_status find_source(const gltf_at *at, decode_job *job)
{
    gltf_file *file = at->file;
    uint32_t view = GLTF_NONE;
    ag_status status = gltf_index(at, "bufferView", file->view_count, "buffer views", &view);
    if (!status)
        status = gltf_string(at, "uri", &job->uri);
    if (status)
        return status;
    job->image = (uint32_t)at->index;
    if (view != GLTF_NONE) {
        job->data = file->views[view].data;
        job->size = file->views[view].size;
        return AG_OK;
    }
    if (!job->uri)
        return gltf_fail(at, AG_ERROR_FORMAT, "has neither a uri nor a bufferView");
    return gltf_uri_is_data(job->uri) ? AG_OK : gltf_uri_prepare(file);
}

// The image that has the same source, if one came before; `known` remembers.
static uint32_t find_same(const decode_job *job, json_t *known)
{
    char key[600];
    if (job->uri && gltf_uri_is_data(job->uri))
        return job->image;
    if (job->data)
        snprintf(key, sizeof key, "%p %zu", job->data, job->size);
    else if (snprintf(key, sizeof key, "file %s", job->uri) >= (int)sizeof key)
        return job->image;
    const json_t *before = json_object_get(known, key);
    if (before)
        return (uint32_t)json_integer_value(before);
    // Without memory it is decoded twice, no more.
    (void)json_object_set_new_nocheck(known, key, json_integer(job->image));
    return job->image;
}

static ag_status gather(decode_work *work, const gltf_at *images)
{
    gltf_file *file = work->file;
    json_t *known = json_object();
    ag_status status = known ? AG_OK : gltf_no_memory(images);
    for (size_t i = 0; i < file->image_count && !status; i++) {
        gltf_at at = gltf_item(images, i);
        if (!file->images[i].used)
            continue;
        decode_job *job = &work->jobs[work->count];
        *job = (decode_job) { 0 };
        status = find_source(&at, job);
        file->images[i].same = status ? (uint32_t)i : find_same(job, known);
        if (file->images[i].same == i)
            work->count++;
    }
    json_decref(known);
    return status;
}

// Largest first, so that no core is left with a long one at the end.
static int compare_jobs(const void *a, const void *b)
{
    const decode_job *first = a, *second = b;
    if (first->size != second->size)
        return first->size > second->size ? -1 : 1;
    return first->image < second->image ? -1 : 1;
}

// All sentences, on the caller's thread; the first failure counts.
static ag_status collect(decode_work *work)
{
    for (size_t i = 0; i < work->count; i++) {
        log_flush(&work->file->log, &work->jobs[i].log);
        if (work->jobs[i].status)
            return work->jobs[i].status;
    }
    return work->cancelled;
}

ag_status gltf_images_decode(gltf_file *file)
{
    gltf_at root = gltf_root(file), images = gltf_member(&root, "images");
    double begin = clock_ms();
    size_t used = 0;
    for (size_t i = 0; i < file->image_count; i++)
        used += file->images[i].used;
    decode_work work = { .file = file, .caller = pthread_self() };
    work.jobs = calloc(used + 1, sizeof *work.jobs);
    if (!work.jobs)
        return gltf_no_memory(&images);
    ag_status status = gather(&work, &images);
    if (!status)
        status = gltf_progress(file, "decode", 0.0);
    if (!status) {
        qsort(work.jobs, work.count, sizeof *work.jobs, compare_jobs);
        parallel_for(work.count, decode, &work);
        status = collect(&work);
    }
    free(work.jobs);
    file->decode_ms = clock_ms() - begin;
    return status ? status : gltf_progress(file, "decode", 1.0);
}
