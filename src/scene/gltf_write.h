// The glTF 2.0 writer: what its files share.
//
// A gltf_writer is one .glb on its way: its JSON is built as a tree, its binary chunk gathered
// as a list of pieces, each of them a buffer view.  What cannot be made for lack of memory
// leaves a mark that is looked at once, at the end.
#ifndef AG_SCENE_GLTF_WRITE_H
#define AG_SCENE_GLTF_WRITE_H

#include "base/file.h"
#include "scene/gltf.h"

typedef struct gltf_piece {
    void *data; // owned
    size_t size;
} gltf_piece;

typedef struct gltf_writer {
    const ag_scene *scene;
    ag_log log;
    const char *path; // for messages
    json_t *root;
    json_t *used; // the extensions, as keys in the order of their first use
    bool no_memory;
    SCENE_ARRAY(gltf_piece, pieces);
    size_t bin_size;
    // Indices in the file of what the scene holds; GLTF_NONE = left out, or not yet there.
    uint32_t *materials, *textures, *images;
    json_t **primitives; // of each of the scene's meshes, without a material; owned
    bool *tangents;      // whether a material in use needs those of the mesh
} gltf_writer;

// Put the whole file into `to`, which stays open.
AG_CHECK ag_status gltf_write(const ag_scene *scene, const char *path, file_writer *to);

// ---- gltf_write_json.c -------------------------------------------------------------------

// Give `object` a member.  The value is taken over; NULL counts as a lack of memory.
void gltf_put(gltf_writer *w, json_t *object, const char *key, json_t *value);
// Numbers are written as decimals that are read back as the same floats.
json_t *gltf_numbers(gltf_writer *w, const float *values, size_t count); // the caller's
void gltf_put_floats(gltf_writer *w, json_t *object, const char *key, const float *values,
                     size_t count);
void gltf_put_float(gltf_writer *w, json_t *object, const char *key, float value);
void gltf_put_index(gltf_writer *w, json_t *object, const char *key, size_t value);
void gltf_put_word(gltf_writer *w, json_t *object, const char *key, const char *word);
// NULL is allowed; what is not UTF-8 cannot stand in JSON and is left out.
void gltf_put_name(gltf_writer *w, json_t *object, const char *name);
void gltf_put_true(gltf_writer *w, json_t *object, const char *key);
// Only what differs from what readers assume.
void gltf_put_floats_unless(gltf_writer *w, json_t *object, const char *key, const float *values,
                            size_t count, const float *assumed);
void gltf_put_float_unless(gltf_writer *w, json_t *object, const char *key, float value,
                           float assumed);
// An object or array made beforehand, unless it is empty.
void gltf_put_unless_empty(gltf_writer *w, json_t *object, const char *key, json_t *value);
// The same as an extension of the object.
void gltf_put_extension_unless_empty(gltf_writer *w, json_t *object, const char *name,
                                     json_t *value);
// The member's object, made where there is none yet.
json_t *gltf_put_object(gltf_writer *w, json_t *object, const char *key);
// The object's extension, likewise; it is listed as used.
json_t *gltf_put_extension(gltf_writer *w, json_t *object, const char *name);

// Append to the list `key` of `object`; its index there.
uint32_t gltf_append(gltf_writer *w, json_t *object, const char *key, json_t *item);

// A buffer view of these bytes, which are taken over; `target` 0 = none.  Its index.
uint32_t gltf_add_view(gltf_writer *w, void *data, size_t size, int target);

// ---- Parts of the file, in their order ---------------------------------------------------

// Which materials, textures and images are shown, and what they need.
void gltf_write_choose(gltf_writer *w);
AG_CHECK ag_status gltf_write_images(gltf_writer *w);
void gltf_write_textures(gltf_writer *w);
void gltf_write_materials(gltf_writer *w);
void gltf_write_instances(gltf_writer *w);
void gltf_write_lights(gltf_writer *w);
void gltf_write_cameras(gltf_writer *w);
AG_CHECK ag_status gltf_write_surround(gltf_writer *w);

// gltf_write_mesh.c: the primitive of a scene's mesh, written when it is first asked for;
// borrowed.
json_t *gltf_write_primitive(gltf_writer *w, uint32_t mesh);

// gltf_write_node.c: a new node at `world`, seen in the scene; borrowed.
json_t *gltf_write_node(gltf_writer *w, const float world[16], const char *name);
// Whether there is something of it to see; readers leave out the rest.
bool gltf_write_shows(const scene_instance *instance);

// gltf_material_argand.c
void gltf_material_write_argand(gltf_writer *w, json_t *material, const ag_material_desc *desc);

#endif
