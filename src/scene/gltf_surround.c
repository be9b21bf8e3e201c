// What surrounds a scene, both ways: the environment and the exposure of ARGAND_lights
// (docs/ARGAND_lights.md).
#include <argand/eye.h>

#include "scene/gltf_write.h"

#include "base/log.h"
#include "image/codec.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const kinds[] = {
    [AG_ENVIRONMENT_STUDIO] = "studio",
    [AG_ENVIRONMENT_SKY] = "sky",
    [AG_ENVIRONMENT_IMAGE] = "image",
    [AG_ENVIRONMENT_NONE] = "none",
};

// ---- Reading -----------------------------------------------------------------------------

static ag_status read_kind(const gltf_at *at, ag_environment_kind *kind)
{
    gltf_at type_at = gltf_member(at, "type");
    const char *type = "";
    ag_status status = gltf_require(at, "type");
    if (!status)
        status = gltf_string(at, "type", &type);
    if (status)
        return status;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (strcmp(kinds[i], type) == 0) {
            *kind = (ag_environment_kind)i;
            return AG_OK;
        }
    return gltf_fail(&type_at, AG_ERROR_FORMAT, "\"%.20s\" is not a kind of environment", type);
}

// `*owned` is the caller's to free(), whatever comes.
static ag_status find_bytes(const gltf_at *at, void **owned, const void **data, size_t *size)
{
    gltf_file *file = at->file;
    const char *uri = NULL;
    uint32_t view = GLTF_NONE;
    ag_status status = gltf_index(at, "bufferView", file->view_count, "buffer views", &view);
    if (!status)
        status = gltf_string(at, "uri", &uri);
    if (status)
        return status;
    if (view == GLTF_NONE && !uri)
        return gltf_fail(at, AG_ERROR_FORMAT, "has neither a uri nor a bufferView");
    if (view != GLTF_NONE) {
        *data = file->views[view].data;
        *size = file->views[view].size;
        return AG_OK;
    }
    if (!gltf_uri_is_data(uri))
        status = gltf_uri_prepare(file);
    if (!status)
        status = gltf_uri_read(file, &file->log, "environment.uri", uri, owned, size);
    *data = *owned;
    return status;
}

static ag_status read_image(const gltf_at *at, ag_image **image)
{
    gltf_file *file = at->file;
    char name[512];
    void *owned = NULL;
    const void *data = NULL;
    size_t size = 0;
    snprintf(name, sizeof name, "%.400s: environment", file->path);
    ag_status status = find_bytes(at, &owned, &data, &size);
    if (!status)
        status = ag_image_load_memory(&file->log, name, data, size, image);
    free(owned);
    if (!status && ag_image_format(*image) != AG_FORMAT_RGBA32F)
        return gltf_fail(at, AG_ERROR_UNSUPPORTED, "its image is neither Radiance HDR nor OpenEXR");
    return status;
}

static ag_status read_environment(const gltf_at *extension)
{
    gltf_at at;
    ag_image *image = NULL;
    ag_environment_desc desc = { .intensity = 1.0f };
    ag_status status = gltf_object(extension, "environment", &at);
    if (status || !at.json)
        return status;
    status = read_kind(&at, &desc.kind);
    if (!status)
        status = gltf_float(&at, "rotation", &desc.rotation_rad);
    if (!status)
        status = gltf_float_in(&at, "intensity", FLT_MIN, FLT_MAX, &desc.intensity);
    if (!status && desc.kind == AG_ENVIRONMENT_IMAGE)
        status = read_image(&at, &image);
    desc.image = image;
    if (!status)
        status = ag_scene_set_environment(at.file->scene, &desc);
    ag_image_destroy(image);
    return status;
}

// `ev100` counts as a camera does: the luminance that saturates, 1.2 * 2^EV100, becomes 1
// (docs/physics.md).
static ag_status read_exposure(const gltf_at *extension, float *result)
{
    gltf_at exposure;
    float ev100 = 0.0f, factor = 1.0f;
    ag_status status = gltf_object(extension, "exposure", &exposure);
    if (status || !exposure.json)
        return status;
    bool in_ev = gltf_member(&exposure, "ev100").json,
         in_factor = gltf_member(&exposure, "factor").json;
    if (in_ev == in_factor)
        return gltf_fail(&exposure, AG_ERROR_FORMAT, "must have either ev100 or factor");
    status = gltf_float_in(&exposure, "ev100", -32.0f, 32.0f, &ev100);
    if (!status)
        status = gltf_float_in(&exposure, "factor", 1e-30f, 1e30f, &factor);
    *result = in_ev ? ag_exposure_from_ev100(ev100) : factor;
    return status;
}

ag_status gltf_surround_read(gltf_file *file)
{
    gltf_at root = gltf_root(file), extension;
    float exposure = 0.0f;
    ag_status status = gltf_extension(&root, "ARGAND_lights", &extension);
    if (!status)
        status = read_exposure(&extension, &exposure);
    if (!status)
        status = read_environment(&extension);
    return status || exposure == 0.0f ? status : ag_scene_set_exposure(file->scene, exposure);
}

// ---- Writing -----------------------------------------------------------------------------

// OpenEXR keeps all of it; alpha means nothing around a scene.
static ag_status add_image(gltf_writer *w, json_t *environment)
{
    const ag_image_layer layer = { .image = w->scene->environment, .channels = "RGB" };
    file_writer *memory;
    void *data;
    size_t size;
    ag_status status = file_writer_open_memory(&w->log, w->path, &memory);
    if (status)
        return status;
    const ag_image_save_options options = { 0 };
    status = image_encode_exr_layers(&w->log, w->path, &layer, 1, &options, memory);
    if (status) {
        file_writer_abandon(memory);
        return status;
    }
    file_writer_take(memory, &data, &size);
    gltf_put_index(w, environment, "bufferView", gltf_add_view(w, data, size, 0));
    return AG_OK;
}

ag_status gltf_write_surround(gltf_writer *w)
{
    const ag_scene *scene = w->scene;
    json_t *environment = json_object();
    ag_status status = AG_OK;
    gltf_put_float_unless(w, environment, "rotation", scene->environment_rotation_rad, 0.0f);
    gltf_put_float_unless(w, environment, "intensity", scene->environment_intensity, 1.0f);
    if (scene->environment_kind == AG_ENVIRONMENT_IMAGE)
        status = add_image(w, environment);
    if (scene->environment_kind != AG_ENVIRONMENT_STUDIO || json_object_size(environment)) {
        gltf_put_word(w, environment, "type", kinds[scene->environment_kind]);
        gltf_put(w, gltf_put_extension(w, w->root, "ARGAND_lights"), "environment",
                 json_incref(environment));
    }
    if (scene->exposure != 1.0f)
        gltf_put_float(
            w, gltf_put_object(w, gltf_put_extension(w, w->root, "ARGAND_lights"), "exposure"),
            "factor", scene->exposure);
    json_decref(environment);
    return status;
}
