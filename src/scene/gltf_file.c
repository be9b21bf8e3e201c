// The file itself: .glb container (spec 4.4) or JSON text, its asset header, buffers
// and buffer views (spec 3.6.1).
#include "scene/gltf.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint32_t read_u32(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

// Find the two chunks; whatever follows them is to be ignored.
static ag_status open_container(gltf_file *file, const char **text, size_t *length)
{
    gltf_at at = gltf_root(file);
    const uint8_t *bytes = file->bytes;
    if (file->size < 20)
        return gltf_fail(&at, AG_ERROR_FORMAT, "ends within its header");
    uint32_t version = read_u32(bytes + 4), total = read_u32(bytes + 8);
    if (version != 2)
        return gltf_fail(&at, AG_ERROR_UNSUPPORTED, "is binary glTF %u; only 2 is read", version);
    if (total > file->size || total < 20)
        return gltf_fail(&at, AG_ERROR_FORMAT, "has %zu bytes where its header says %u", file->size,
                         total);
    size_t offset = 12;
    for (unsigned chunk = 0; chunk < 2 && total - offset >= 8; chunk++) {
        size_t size = read_u32(bytes + offset);
        uint32_t type = read_u32(bytes + offset + 4);
        offset += 8;
        if (size > total - offset)
            return gltf_fail(&at, AG_ERROR_FORMAT, "ends within its chunk %u", chunk);
        if (chunk == 0 && type != GLB_CHUNK_JSON)
            return gltf_fail(&at, AG_ERROR_FORMAT, "its first chunk is not JSON");
        if (chunk == 0) {
            *text = (const char *)bytes + offset;
            *length = size;
        } else if (type == GLB_CHUNK_BIN) {
            file->bin = bytes + offset;
            file->bin_size = size;
        }
        offset += size;
    }
    return AG_OK;
}

static ag_status check_asset(gltf_file *file)
{
    gltf_at root = gltf_root(file), asset;
    ag_status status = gltf_require(&root, "asset");
    if (!status)
        status = gltf_object(&root, "asset", &asset);
    if (!status)
        status = gltf_require(&asset, "version");
    const char *version = "", *needed = "2.0";
    if (!status)
        status = gltf_string(&asset, "version", &version);
    if (!status)
        status = gltf_string(&asset, "minVersion", &needed);
    if (status)
        return status;
    if (strncmp(version, "2.", 2) != 0)
        return gltf_fail(&asset, AG_ERROR_UNSUPPORTED, "is glTF %.20s; only 2.0 is read", version);
    if (strcmp(needed, "2.0") != 0)
        return gltf_fail(&asset, AG_ERROR_UNSUPPORTED, "needs glTF %.20s; only 2.0 is read",
                         needed);
    return AG_OK;
}

ag_status gltf_file_open(gltf_file *file)
{
    gltf_at at = gltf_root(file);
    const char *text = file->bytes;
    size_t length = file->size;
    bool binary = file->size >= 4 && read_u32(file->bytes) == GLB_MAGIC;
    ag_status status = binary ? open_container(file, &text, &length) : AG_OK;
    if (status)
        return status;
    size_t space = 0;
    while (space < length && strchr(" \t\r\n", text[space]) && text[space])
        space++;
    if (space == length || text[space] != '{')
        return gltf_fail(&at, AG_ERROR_FORMAT,
                         file->size ? "is neither .gltf nor .glb" : "is empty");
    json_error_t error;
    file->root = json_loadb(text, length, JSON_REJECT_DUPLICATES, &error);
    if (!file->root)
        return gltf_fail(&at, AG_ERROR_FORMAT, "its JSON is broken in line %d, column %d: %s",
                         error.line, error.column, error.text);
    if (!binary) { // all of it is in the tree now
        free(file->bytes);
        file->bytes = NULL;
    }
    return check_asset(file);
}

// The bytes of a data URI are needed once only: let go of the text.
static void forget_uri(const gltf_at *buffer)
{
    json_object_del((json_t *)buffer->json, "uri");
}

static ag_status read_source(const gltf_at *at, gltf_buffer *buffer)
{
    gltf_file *file = at->file;
    const char *uri = NULL;
    ag_status status = gltf_string(at, "uri", &uri);
    if (status)
        return status;
    if (!uri) {
        if (at->index == 0 && file->bin) {
            buffer->data = file->bin;
            buffer->size = file->bin_size;
        }
        return AG_OK;
    }
    char where[64];
    snprintf(where, sizeof where, "buffers[%zu].uri", at->index);
    if (!gltf_uri_is_data(uri))
        status = gltf_uri_prepare(file);
    if (!status)
        status = gltf_uri_read(file, &file->log, where, uri, &buffer->owned, &buffer->size);
    buffer->data = buffer->owned;
    if (!status && gltf_uri_is_data(uri))
        forget_uri(at);
    return status;
}

static ag_status read_buffer(const gltf_at *at, gltf_buffer *buffer)
{
    uint64_t length = 0;
    gltf_at length_at = gltf_member(at, "byteLength");
    ag_status status = gltf_require(at, "byteLength");
    if (!status)
        status = gltf_uint(at, "byteLength", (uint64_t)1 << 53, &length);
    if (!status)
        status = read_source(at, buffer);
    if (status)
        return status;
    if (buffer->data && length > buffer->size)
        return gltf_fail(&length_at, AG_ERROR_FORMAT, "%llu bytes, but there are only %zu",
                         (unsigned long long)length, buffer->size);
    if (buffer->data)
        buffer->size = (size_t)length;
    if (buffer->owned)
        at->file->total_size += buffer->size;
    return AG_OK;
}

static ag_status read_view(const gltf_at *at, gltf_view *view)
{
    gltf_file *file = at->file;
    uint64_t offset = 0, length = 0, stride = 0;
    uint32_t index = 0;
    ag_status status = gltf_require(at, "buffer");
    if (!status)
        status = gltf_index(at, "buffer", file->buffer_count, "buffers", &index);
    if (!status)
        status = gltf_require(at, "byteLength");
    if (!status)
        status = gltf_uint(at, "byteLength", (uint64_t)1 << 53, &length);
    if (!status)
        status = gltf_uint(at, "byteOffset", (uint64_t)1 << 53, &offset);
    if (!status)
        status = gltf_uint(at, "byteStride", 252, &stride);
    if (status)
        return status;
    const gltf_buffer *buffer = &file->buffers[index];
    if (!buffer->data)
        return gltf_fail(at, AG_ERROR_FORMAT, "its buffers[%u] has no uri and no binary chunk",
                         index);
    if (offset > buffer->size || length > buffer->size - offset)
        return gltf_fail(at, AG_ERROR_FORMAT, "reaches beyond the %zu bytes of buffers[%u]",
                         buffer->size, index);
    *view = (gltf_view) { buffer->data + offset, (size_t)length, (size_t)stride };
    return AG_OK;
}

ag_status gltf_buffers_read(gltf_file *file)
{
    gltf_at root = gltf_root(file), buffers, views;
    ag_status status = gltf_objects(&root, "buffers", &buffers);
    if (!status)
        status = gltf_objects(&root, "bufferViews", &views);
    if (status)
        return status;
    file->buffers = calloc(gltf_length(&buffers) + 1, sizeof *file->buffers);
    file->views = calloc(gltf_length(&views) + 1, sizeof *file->views);
    if (!file->buffers || !file->views)
        return gltf_no_memory(&root);
    file->buffer_count = gltf_length(&buffers);
    file->view_count = gltf_length(&views);
    for (size_t i = 0; i < file->buffer_count && !status; i++) {
        gltf_at at = gltf_item(&buffers, i);
        status = read_buffer(&at, &file->buffers[i]);
    }
    for (size_t i = 0; i < file->view_count && !status; i++) {
        gltf_at at = gltf_item(&views, i);
        status = read_view(&at, &file->views[i]);
    }
    return status;
}
