// What a scene holds, for the modules that fill, bake and render it.
//
// The arrays grow only; item i has the public id i + 1.
#ifndef AG_SCENE_SCENE_H
#define AG_SCENE_SCENE_H

#include <argand/scene.h>

// As the renderer uploads it: 64 bytes.
typedef struct scene_vertex {
    float position[3];
    float normal[3];
    float tangent[4]; // w = handedness, +1 or -1
    float uv[2][2];
    uint16_t color[4]; // linear, unorm 16
} scene_vertex;

typedef struct scene_mesh {
    scene_vertex *vertices;
    uint32_t *indices; // triangles
    uint32_t vertex_count, index_count;
    float min[3], max[3]; // m, object space
    bool has_colors;      // some colour is not white
} scene_mesh;

typedef struct scene_texture {
    ag_image *image;      // shared between textures: see scene->images
    ag_texture_desc desc; // its `image` is NULL
} scene_texture;

typedef struct scene_instance {
    uint32_t mesh;     // index
    uint32_t material; // index; the scene's materials[0] is the default one
    float world[16];   // column major
    const char *name;  // owned; NULL -> none
} scene_instance;

typedef struct scene_extension {
    char name[64];
    bool required, supported;
} scene_extension;

#define SCENE_ARRAY(type, name)                                                                    \
    type *name;                                                                                    \
    size_t name##_count, name##_capacity

struct ag_scene {
    ag_log log;
    SCENE_ARRAY(ag_image *, images); // owned; each once however many textures use it
    SCENE_ARRAY(scene_texture, textures);
    SCENE_ARRAY(ag_material_desc, materials); // [0] is the default material, id 0; names owned
    SCENE_ARRAY(scene_mesh, meshes);
    SCENE_ARRAY(scene_instance, instances);
    SCENE_ARRAY(ag_light_desc, lights);   // defaults filled in, direction normalised, name owned
    SCENE_ARRAY(ag_camera_desc, cameras); // defaults filled in, name owned
    SCENE_ARRAY(scene_extension, extensions);
    ag_environment_kind environment_kind;
    ag_image *environment; // only for AG_ENVIRONMENT_IMAGE; see scene_environment_open
    float environment_rotation_rad, environment_intensity;
    float exposure; // linear factor
    double load_ms, decode_ms;
    uint64_t id;                   // no other scene has it, also none freed before
    uint64_t revision;             // rises with meshes, textures, instances, materials added
    uint64_t materials_revision;   // rises when a material is set
    uint64_t environment_revision; // rises when the environment's kind or image changes
};

// What surrounds the scene as an RGBA32F equirectangular picture, before rotation and
// intensity; NULL for AG_ENVIRONMENT_NONE.  The procedural ones are made by this call
// (some milliseconds), so that a scene with an image of its own never pays for them.
AG_CHECK ag_status scene_environment_open(const ag_scene *scene, const ag_image **image);
void scene_environment_close(const ag_scene *scene, const ag_image *image); // NULL is allowed

// As ag_scene_add_texture, but takes the image over instead of copying it (also on
// failure).  An image already in the scene is shared.
AG_CHECK ag_status scene_adopt_texture(ag_scene *scene, ag_image *image,
                                       const ag_texture_desc *desc, ag_texture *texture);

// Make the owned `*name` a copy of `text` (both may be NULL); left alone where it says that
// already.  False without memory.
bool name_set(const char **name, const char *text);
void name_free(const char *name); // NULL is allowed

// Whether a camera's numbers are finite and in their ranges.
bool scene_camera_is_sound(const ag_camera_desc *desc);

// World-space bounds of an instance, and of everything visible; false when there is nothing.
void instance_bounds(const ag_scene *scene, const scene_instance *instance, float min[3],
                     float max[3]);
bool scene_bounds(const ag_scene *scene, float min[3], float max[3]);

// The texture uses of a material, by place, so that all are treated alike.
enum { MATERIAL_TEXTURES = 7 };
void material_textures(ag_material_desc *desc, ag_texture_use *uses[MATERIAL_TEXTURES]);

// A material's choices as the `model` of physics/surface.glsl.
uint32_t material_model(const ag_material_desc *desc);

// Whether lights of a kind stand somewhere; whether they are diffuse light from all sides.
bool light_has_position(ag_light_kind kind);
bool light_is_ambient(ag_light_kind kind);

// m, from a light's position to the farthest point of its body; 0 for lights without one.
float light_reach(const ag_light_desc *desc);

// What a body's radiance is the intensity over, m^2 or 1; 0 for lights without one.
float light_spread(const ag_light_desc *desc);

// Half axes, m: of a rectangle or disk, x cross y along the way the light travels; a tube's axis
// is x.
void light_axes(const ag_light_desc *desc, float x[3], float y[3]);

// The ambient lights together: irradiance over pi as the coefficients of ambient_light
// (physics/ambient.glsl); false where there are none.  `only`: that light alone, unless 0.
bool scene_ambient(const ag_scene *scene, ag_light only, float sum[9][3]);

// `up`, unit and square to the unit `direction`; of 0 the one that is nearest to +Y.
void light_square_up(const float direction[3], const float up[3], float square[3]);

// Whether it has a body that is seen at a place.
bool light_is_seen(const ag_light_desc *desc);

// Where scene arrays stood, to take back what a failed load appended.
typedef struct scene_mark {
    size_t images, textures, materials, meshes, instances, lights, cameras, extensions;
} scene_mark;
scene_mark scene_mark_now(const ag_scene *scene);
void scene_rollback(ag_scene *scene, scene_mark mark);

#endif
