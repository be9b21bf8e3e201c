// What the file asks for beyond glTF 2.0 core (spec 3.12).
#include "base/array.h"
#include "base/log.h"
#include "scene/gltf.h"

#include <stdio.h>
#include <string.h>

enum { EXTENSIONS_MAX = 256 };

// Read, or sound to ignore: variants name other materials to choose, XMP says who made it.
static bool is_supported(const char *name)
{
    static const char *const known[] = {
        "ARGAND_cameras",           "ARGAND_lights",
        "ARGAND_materials",         "EXT_lights_area",
        "EXT_texture_webp",         "KHR_lights_punctual",
        "KHR_materials_anisotropy", "KHR_materials_emissive_strength",
        "KHR_materials_ior",        "KHR_materials_specular",
        "KHR_materials_unlit",      "KHR_materials_variants",
        "KHR_mesh_quantization",    "KHR_texture_transform",
        "KHR_xmp_json_ld",
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (strcmp(known[i], name) == 0)
            return true;
    return false;
}

static scene_extension *find(ag_scene *scene, size_t first, const char *name)
{
    for (size_t i = first; i < scene->extensions_count; i++)
        if (strcmp(scene->extensions[i].name, name) == 0)
            return &scene->extensions[i];
    return NULL;
}

static ag_status add(const gltf_at *at, size_t first, bool required)
{
    ag_scene *scene = at->file->scene;
    scene_extension extension = { .required = required };
    if (!json_is_string(at->json))
        return gltf_fail(at, AG_ERROR_FORMAT, "is not a string");
    snprintf(extension.name, sizeof extension.name, "%s", json_string_value(at->json));
    extension.supported = is_supported(extension.name);
    if (required && !extension.supported)
        return gltf_fail(at, AG_ERROR_UNSUPPORTED,
                         "the file requires the extension %s, which is not supported",
                         extension.name);
    scene_extension *known = find(scene, first, extension.name);
    if (known) {
        known->required |= required;
        return AG_OK;
    }
    if (scene->extensions_count - first >= EXTENSIONS_MAX)
        return gltf_fail(at, AG_ERROR_FORMAT, "is one extension too many; %d are read",
                         EXTENSIONS_MAX);
    if (!array_reserve(&scene->extensions, &scene->extensions_capacity, scene->extensions_count + 1,
                       sizeof extension))
        return gltf_no_memory(at);
    scene->extensions[scene->extensions_count++] = extension;
    return AG_OK;
}

ag_status gltf_extensions_read(gltf_file *file)
{
    static const char *const lists[] = { "extensionsRequired", "extensionsUsed" };
    gltf_at root = gltf_root(file);
    size_t first = file->scene->extensions_count;
    for (int l = 0; l < 2; l++) {
        gltf_at list;
        ag_status status = gltf_array(&root, lists[l], &list);
        for (size_t i = 0; !status && i < gltf_length(&list); i++) {
            gltf_at item = gltf_item(&list, i);
            status = add(&item, first, l == 0);
        }
        if (status)
            return status;
    }
    for (size_t i = first; i < file->scene->extensions_count; i++) {
        const scene_extension *extension = &file->scene->extensions[i];
        if (!extension->supported)
            log_write(&file->log, AG_LOG_WARNING, "%s: %s is not supported; it is left out",
                      file->path, extension->name);
    }
    return AG_OK;
}
