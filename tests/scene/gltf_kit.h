// Small glTF files made in a folder of their own, loaded, and what was said about them.
#ifndef TESTS_SCENE_GLTF_KIT_H
#define TESTS_SCENE_GLTF_KIT_H

#include "scene/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

typedef struct kit {
    char folder[64];
    char said[16384]; // every sentence of the last load
    unsigned errors, warnings;
    ag_scene *scene; // of the last load
} kit;

int kit_setup(void **state);
int kit_teardown(void **state);

// JSON with ' for ", formatted; borrowed until the next call but seven.
__attribute__((format(printf, 1, 2))) const char *kit_json(const char *format, ...);

// Write folder/name.
void kit_write(const kit *k, const char *name, const void *data, size_t size);
void kit_write_text(const kit *k, const char *name, const char *text);
const char *kit_path(const kit *k, const char *name);

// Make model.glb of JSON text and a binary chunk (NULL: none) and load it.
ag_status kit_load_glb(kit *k, const char *json, const void *bin, size_t size);
ag_status kit_load_path(kit *k, const char *path, const ag_load_options *options);
ag_status kit_load_bytes(kit *k, const void *bytes, size_t size);

// The same, which must succeed, with so many warnings.
void kit_loads(kit *k, const char *json, const void *bin, size_t size, unsigned warnings);
// The same, which must fail with one sentence that names the file and holds `part`, and
// leave nothing behind.
void kit_fails(kit *k, ag_status status, const char *part, const char *json, const void *bin,
               size_t size);

// A whole .glb in memory, to free().
void *kit_make_glb(const char *json, const void *bin, size_t bin_size, size_t *size);

// One triangle (0,0,0) (1,0,0) (0,1,0) as three floats each: 36 bytes.
extern const float kit_triangle[9];
// Its document: asset, scene, node, mesh, one view over all of `size` bytes; `more` is
// put at the end of the root object, `primitive` in the primitive after POSITION's
// attributes, `attributes` behind POSITION.
const char *kit_document(size_t size, const char *attributes, const char *primitive,
                         const char *accessors, const char *more);

void kit_near(float value, double expected, double tolerance);

#endif
