// The glTF 2.0 importer: what its files share.
//
// A gltf_file is one import.  It reads the container, checks buffers, buffer views
// and accessors once, and then fills a scene.  Every message names the file and the
// place in it ("helmet.gltf: accessors[3].count: ...").
// "Spec" in comments: Khronos, glTF 2.0.1 specification, by section.
#ifndef AG_SCENE_GLTF_H
#define AG_SCENE_GLTF_H

#include "scene/scene.h"

#include <jansson.h>

#define GLTF_NONE UINT32_MAX // no index given

// The container of a .glb (spec 4.4).
enum {
    GLB_MAGIC = 0x46546C67,      // "glTF"
    GLB_CHUNK_JSON = 0x4E4F534A, // "JSON"
    GLB_CHUNK_BIN = 0x004E4942,  // "BIN\0"
};

// ---- gltf_accessor.c, gltf_file.c: binary data ------------------------------------

typedef struct gltf_buffer {
    const uint8_t *data; // NULL when the file gives no source
    size_t size;
    void *owned; // what to free(), or NULL
} gltf_buffer;

typedef struct gltf_view {
    const uint8_t *data;
    size_t size;
    size_t stride; // 0 = tightly packed
} gltf_view;

typedef enum gltf_component {
    GLTF_BYTE = 5120,
    GLTF_UBYTE = 5121,
    GLTF_SHORT = 5122,
    GLTF_USHORT = 5123,
    GLTF_UINT = 5125,
    GLTF_FLOAT = 5126,
} gltf_component;

typedef struct gltf_accessor {
    const uint8_t *data; // NULL -> zeros
    size_t stride;
    uint32_t count;
    gltf_component component;
    uint32_t rows, columns; // columns is 1 but for matrices
    size_t column_stride;   // bytes: columns of matrices start at multiples of 4
    bool normalized;
    uint32_t sparse_count; // elements that replace others; 0 = none
    gltf_component sparse_component;
    const uint8_t *sparse_indices; // strictly rising, all below `count`
    const uint8_t *sparse_values;  // tightly packed
} gltf_accessor;

// ---- gltf_light.c: the extensions that hold lights, each in a list of its own --------

typedef enum gltf_light_extension {
    GLTF_LIGHT_PUNCTUAL,
    GLTF_LIGHT_AREA,
    GLTF_LIGHT_ARGAND,
    GLTF_LIGHT_EXTENSIONS,
} gltf_light_extension;

// ---- gltf_node.c ---------------------------------------------------------------------

typedef struct gltf_node {
    uint32_t parent, mesh, skin, camera;   // GLTF_NONE = none
    uint32_t light[GLTF_LIGHT_EXTENSIONS]; // the same
    double world[16];                      // column major; local until resolved
} gltf_node;

typedef struct gltf_skin {
    double (*joints)[16]; // world from bind pose; NULL until first used
    size_t joint_count;
    bool mirrored; // most of its joints mirror
} gltf_skin;

// ---- Pictures and materials ----------------------------------------------------------

// The numbers of OpenGL that samplers use.
enum {
    GLTF_NEAREST = 9728,
    GLTF_LINEAR = 9729,
    GLTF_NEAREST_MIPMAP_NEAREST = 9984,
    GLTF_LINEAR_MIPMAP_NEAREST = 9985,
    GLTF_NEAREST_MIPMAP_LINEAR = 9986,
    GLTF_LINEAR_MIPMAP_LINEAR = 9987,
    GLTF_REPEAT = 10497,
    GLTF_CLAMP_TO_EDGE = 33071,
    GLTF_MIRRORED_REPEAT = 33648,
};

typedef struct gltf_texture {
    bool used;
    uint32_t image; // GLTF_NONE: none that can be read
    ag_texture_desc desc;
    ag_texture texture; // once added
} gltf_texture;

typedef struct gltf_image {
    bool used;
    bool adopted;    // by the scene
    uint32_t same;   // the image that stands for it: itself, or one with the same source
    ag_image *image; // once decoded
} gltf_image;

typedef struct gltf_material {
    bool used;
    ag_material_desc desc; // until added its texture ids are file indices + 1
    ag_material material;  // once added
} gltf_material;

// What is said at most once a file.
enum {
    GLTF_WARNED_MODE = 1,
    GLTF_WARNED_REST = 2,
    GLTF_WARNED_POSITION = 4,
    GLTF_WARNED_RANGE = 8,
    GLTF_WARNED_UV = 16,
    GLTF_WARNED_FINITE = 32,
    GLTF_WARNED_IMAGE = 64,
    GLTF_WARNED_ROTATION = 128,
    GLTF_WARNED_SKIN = 256,
    GLTF_WARNED_EXTRAS = 512,
    GLTF_WARNED_SPOT = 1024,
    GLTF_WARNED_ANISOTROPY = 2048,
};

typedef struct gltf_file {
    ag_scene *scene;
    ag_log log;
    const char *path; // as the caller wrote it
    char *folder;     // its real path, ending in '/'; NULL until needed
    ag_load_options options;
    json_t *root;
    void *bytes; // the file itself; NULL once it is not needed
    size_t size;
    size_t total_size;  // of the file and the buffers beside it
    const uint8_t *bin; // the binary chunk of a .glb
    size_t bin_size;
    size_t vertex_budget, work_budget; // see gltf_charge
    unsigned warned;
    double decode_ms;

    gltf_buffer *buffers;
    gltf_view *views;
    gltf_accessor *accessors;
    gltf_node *nodes;
    gltf_skin *skins;
    gltf_texture *textures;
    gltf_image *images;
    gltf_material *materials;
    size_t buffer_count, view_count, accessor_count, node_count, skin_count, texture_count,
        image_count, material_count, mesh_count, camera_count;
    size_t light_count[GLTF_LIGHT_EXTENSIONS];
    uint32_t *reached; // nodes of the chosen scene, parents first
    size_t reached_count;
    ag_mesh **meshes;    // per mesh, per primitive: what was made of it for plain nodes
    json_t *meshes_made; // what makes up a primitive -> id of its scene mesh
} gltf_file;

// Import `bytes` (the contents of the file `path`, from malloc, taken over) into `scene`.
// On failure the scene may hold a part of it: the caller rolls back.
AG_CHECK ag_status gltf_import(ag_scene *scene, const char *path, void *bytes, size_t size,
                               const ag_load_options *options, double *decode_ms);

// ---- gltf_json.c: a place in the file, and typed values there ---------------------------

// A JSON value and how one gets there.  Lives on the stack of who walks the file; `up`
// is the place that holds it.
typedef struct gltf_at {
    gltf_file *file;
    const struct gltf_at *up;
    const char *key; // NULL -> an item of an array
    size_t index;
    const json_t *json; // NULL when absent
} gltf_at;

gltf_at gltf_root(gltf_file *file);
gltf_at gltf_member(const gltf_at *object, const char *key);
gltf_at gltf_item(const gltf_at *array, size_t index);
size_t gltf_length(const gltf_at *array); // 0 when absent

// "path: place: sentence" as an error, or as a warning.
__attribute__((format(printf, 3, 4), warn_unused_result)) ag_status
gltf_fail(const gltf_at *at, ag_status status, const char *format, ...);
__attribute__((format(printf, 2, 3))) void gltf_warn(const gltf_at *at, const char *format, ...);
// The same, but only the first time that `bit` is given.
__attribute__((format(printf, 3, 4))) void gltf_warn_once(const gltf_at *at, unsigned bit,
                                                          const char *format, ...);
AG_CHECK ag_status gltf_no_memory(const gltf_at *at);

// Each reads `object`'s member `key`.  Where it is absent they succeed and leave what
// they would write as it was: the caller sets the default first.
AG_CHECK ag_status gltf_object(const gltf_at *object, const char *key, gltf_at *value);
AG_CHECK ag_status gltf_array(const gltf_at *object, const char *key, gltf_at *value);
AG_CHECK ag_status gltf_objects(const gltf_at *object, const char *key, gltf_at *value);
AG_CHECK ag_status gltf_bool(const gltf_at *object, const char *key, bool *value);
AG_CHECK ag_status gltf_string(const gltf_at *object, const char *key, const char **value);
AG_CHECK ag_status gltf_uint(const gltf_at *object, const char *key, uint64_t max, uint64_t *value);
AG_CHECK ag_status gltf_float(const gltf_at *object, const char *key, float *value);
AG_CHECK ag_status gltf_doubles(const gltf_at *object, const char *key, size_t count,
                                double *values);
AG_CHECK ag_status gltf_floats(const gltf_at *object, const char *key, size_t count, float *values);
// A number kept within [min, max], with a warning when it was not.
AG_CHECK ag_status gltf_float_in(const gltf_at *object, const char *key, float min, float max,
                                 float *value);
AG_CHECK ag_status gltf_floats_in(const gltf_at *object, const char *key, size_t count, float min,
                                  float max, float *values);
// An index below `count`, of things called `what`.
AG_CHECK ag_status gltf_index(const gltf_at *object, const char *key, size_t count,
                              const char *what, uint32_t *index);
AG_CHECK ag_status gltf_item_float(const gltf_at *item, float *value);
AG_CHECK ag_status gltf_item_index(const gltf_at *item, size_t count, const char *what,
                                   uint32_t *index);
// The member's object in `extensions`; absent when the file does not use it.
AG_CHECK ag_status gltf_extension(const gltf_at *object, const char *name, gltf_at *value);
// Fails where `key` is absent.
AG_CHECK ag_status gltf_require(const gltf_at *object, const char *key);

// ---- gltf_uri.c ----------------------------------------------------------------------------

bool gltf_uri_is_data(const char *uri);
// The bytes of a data URI or of a file in the folder of the glTF file or below; the
// caller's to free().  `log` may be a worker's; `where` names the place.
AG_CHECK ag_status gltf_uri_read(const gltf_file *file, const ag_log *log, const char *where,
                                 const char *uri, void **data, size_t *size);
// Find the real path of the file's folder; to be done before workers read URIs.
AG_CHECK ag_status gltf_uri_prepare(gltf_file *file);

// ---- Steps of the import, in their order ---------------------------------------------------

AG_CHECK ag_status gltf_file_open(gltf_file *file); // container, JSON, asset
AG_CHECK ag_status gltf_extensions_read(gltf_file *file);
AG_CHECK ag_status gltf_buffers_read(gltf_file *file); // and buffer views
AG_CHECK ag_status gltf_accessors_read(gltf_file *file);
AG_CHECK ag_status gltf_nodes_read(gltf_file *file);     // hierarchy and world matrices
AG_CHECK ag_status gltf_scene_choose(gltf_file *file);   // fills `reached`
AG_CHECK ag_status gltf_materials_read(gltf_file *file); // those in use
AG_CHECK ag_status gltf_textures_read(gltf_file *file);  // those in use
AG_CHECK ag_status gltf_images_decode(gltf_file *file);  // on all cores
AG_CHECK ag_status gltf_textures_add(gltf_file *file);
AG_CHECK ag_status gltf_materials_add(gltf_file *file);
AG_CHECK ag_status gltf_instances_add(gltf_file *file);
AG_CHECK ag_status gltf_lights_add(gltf_file *file, uint32_t node);
AG_CHECK ag_status gltf_camera_add(gltf_file *file, uint32_t node);
AG_CHECK ag_status gltf_surround_read(gltf_file *file); // into the scene; the last step

AG_CHECK ag_status gltf_progress(gltf_file *file, const char *stage, double fraction);

// gltf_material_argand.c: ARGAND_materials of a material.
AG_CHECK ag_status gltf_material_read_argand(const gltf_at *material, ag_material_desc *desc);

// Take `count` off one of the file's budgets, which grow with its size, so that a small
// file cannot take memory or time without bound by naming the same bytes again and again:
// vertices kept in the scene, and rows read.
AG_CHECK ag_status gltf_charge(const gltf_at *at, size_t *budget, size_t count);

// Read elements [first, first + count) as floats, `width` a row: what the accessor has
// less of is left as it is in `out`.  Integers are normalised when the accessor says so
// or `normalize` does.
void gltf_accessor_floats(const gltf_accessor *accessor, size_t first, size_t count, size_t width,
                          bool normalize, float *out);
bool gltf_all_finite(const float *values, size_t count);
// The same for unsigned integers.
AG_CHECK ag_status gltf_accessor_uints(const gltf_at *at, const gltf_accessor *accessor,
                                       size_t first, size_t count, size_t width, uint32_t *out);

// ---- Meshes ------------------------------------------------------------------------------

// Arrays as ag_mesh_desc takes them, all owned; NULL = absent.
typedef struct gltf_geometry {
    float *positions, *normals, *tangents, *uvs[2], *colors;
    uint32_t *indices;
    size_t vertex_count, index_count;
    size_t element_count; // of the accessors, all alike
    size_t first;         // the accessors' element that is vertex 0
} gltf_geometry;
void gltf_geometry_finish(gltf_geometry *geometry);

// gltf_index.c: fill indices, index_count, first and vertex_count with the triangles of
// `primitive`, whose accessors have geometry->element_count elements.  index_count is 0
// where there is no surface.
AG_CHECK ag_status gltf_triangles_read(const gltf_at *primitive, gltf_geometry *geometry);

// gltf_attribute.c.  The accessor of an attribute; absent -> *accessor is NULL.
AG_CHECK ag_status gltf_attribute_find(const gltf_at *attributes, const char *name,
                                       const gltf_accessor **accessor);

// The morph targets of a primitive and how much of each is added.
typedef struct gltf_morph {
    gltf_at targets;
    float *weights; // owned
    size_t count;
} gltf_morph;
AG_CHECK ag_status gltf_morph_read(const gltf_at *primitive, const gltf_at *mesh, uint32_t node,
                                   gltf_morph *morph);

// Which attribute: rows of `width`, of which the file gives at least `least`; the rest
// is 1.
typedef struct gltf_attribute {
    const char *name;
    size_t width, least;
    bool normalize; // integers are fractions even where the accessor does not say so
} gltf_attribute;
// Read one with its morph targets (NULL = none) applied, a row for each vertex of
// `geometry`, into a new array; absent -> *out stays NULL.
AG_CHECK ag_status gltf_attribute_read(const gltf_at *attributes, const gltf_attribute *attribute,
                                       const gltf_morph *morph, const gltf_geometry *geometry,
                                       float **out);

// gltf_skin.c: pose `geometry` by a skin, into world space.  *posed is false when the
// primitive has no joints.
AG_CHECK ag_status gltf_skin_apply(const gltf_at *primitive, uint32_t skin, gltf_geometry *geometry,
                                   bool *posed);

// gltf_mesh.c: the scene mesh of a primitive, posed for `node`.  *mesh stays zero where
// there is nothing to draw; *posed says that it is in world space.
AG_CHECK ag_status gltf_primitive_add(const gltf_at *primitive, uint32_t node, ag_mesh *mesh,
                                      bool *posed);

// ---- Lights --------------------------------------------------------------------------------

AG_CHECK ag_status gltf_lights_count(gltf_file *file);                      // fills light_count
AG_CHECK ag_status gltf_lights_of_node(const gltf_at *at, gltf_node *node); // which it holds

// A word of `type`; a list ends with NULL.
typedef struct gltf_light_kind {
    const char *type;
    ag_light_kind kind;
} gltf_light_kind;
AG_CHECK ag_status gltf_light_read_kind(const gltf_at *light, const gltf_light_kind *kinds,
                                        ag_light_kind *kind);

// Read what each extension has besides colour and intensity.
AG_CHECK ag_status gltf_light_read_area(const gltf_at *light, ag_light_desc *desc);
AG_CHECK ag_status gltf_light_read_argand(const gltf_at *light, ag_light_desc *desc);
extern const gltf_light_kind gltf_light_argand_kinds[];

// ---- gltf_matrix.c: column-major 4x4 in double -----------------------------------------------

void gltf_matrix_identity(double m[16]);
void gltf_matrix_multiply(const double a[16], const double b[16], double out[16]); // a * b
void gltf_matrix_compose(const double t[3], const double q[4], const double s[3], double m[16]);
double gltf_matrix_determinant(const double m[16]); // of the upper left 3x3
// The cofactors of the upper left 3x3: what turns normals, up to scale and the sign of
// the determinant, and needs no inverse.
void gltf_matrix_cofactor(const double m[16], double c[9]);
// Squeezed to a line or a point there is no surface left; scale 0 hides things so.
bool gltf_matrix_is_collapsed(const double m[16]);

#endif
