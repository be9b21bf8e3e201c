// A scene is plain CPU data: meshes, materials, textures, instances, lights,
// cameras and one environment.  No graphics device is needed to hold one.
//
// Ownership: what is passed in is copied unless a field says "borrowed".
// Threads:   one writer, or many readers; never both at once.
// Units:     metres, radians, candela, lux, nit; linear Rec. 709 colours;
//            right-handed, +Y up (glTF 2.0).
#ifndef ARGAND_SCENE_H
#define ARGAND_SCENE_H

#include <argand/base.h>
#include <argand/image.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ag_scene ag_scene;

// Names of things inside one scene; 0 = none.  Those of each kind are counted in the order in
// which they were added: ag_scene_light(scene, i, ...) asks for the light of id i + 1, and so of
// each kind.  An id that the scene never gave out is AG_ERROR_ARGUMENT.
typedef struct ag_texture {
    uint32_t id;
} ag_texture;
typedef struct ag_material {
    uint32_t id;
} ag_material;
typedef struct ag_mesh {
    uint32_t id;
} ag_mesh;
typedef struct ag_instance {
    uint32_t id;
} ag_instance;
typedef struct ag_light {
    uint32_t id;
} ag_light;
typedef struct ag_camera {
    uint32_t id;
} ag_camera;

// Make an empty scene; NULL log -> stderr.
AG_CHECK ag_status ag_scene_create(const ag_log *log, ag_scene **scene);
AG_API void ag_scene_destroy(ag_scene *scene); // NULL is allowed

// ---- Filling it ------------------------------------------------------------

typedef struct ag_load_options {
    uint32_t scene;       // of a file with several, 1 = the first; 0 -> the file's default
    ag_progress progress; // stages "load", "decode"
    bool skip_images; // for a first look, soon: materials without their textures, and dark where
                      // a texture says what shines
} ag_load_options;

// Read a glTF 2.0 file (.gltf with its files, or .glb) and append it.  Its nodes are
// flattened; skins and morph targets are applied in the pose that the file gives.  The
// environment and the exposure of the scene become the file's, if it has them (ARGAND_lights).
// Files beside it are read only from its own folder and below.  NULL options ->
// defaults.  AG_ERROR_UNSUPPORTED names a required extension that is not known.
AG_CHECK ag_status ag_scene_load(ag_scene *scene, const char *path, const ag_load_options *options);

// Some built-in scenes come from a text, whose shading and exposure they have; see
// ag_demo_look().  The others are the same in both looks.
typedef enum ag_look {
    AG_LOOK_TEXT = 0, // the text's, its errors corrected (docs/errata.md)
    AG_LOOK_ARGAND,   // surfaces that conserve energy
} ag_look;

// Append a scene that is built in ("spheres", say) with its lights and one camera, fitted
// to square pictures; its environment, and its exposure if it has one, replace those of the
// scene.  AG_ERROR_ARGUMENT for an unknown name lists those there are.
AG_CHECK ag_status ag_scene_load_demo(ag_scene *scene, const char *name, ag_look look);

// The built-in scenes: name and one line about demo `index`; false past the last.
AG_API bool ag_scene_demo(size_t index, const char **name, const char **about);

typedef enum ag_wrap {
    AG_WRAP_REPEAT = 0,
    AG_WRAP_MIRROR,
    AG_WRAP_CLAMP,
} ag_wrap;

typedef enum ag_filter {
    AG_FILTER_LINEAR = 0,
    AG_FILTER_NEAREST,
} ag_filter;

typedef struct ag_texture_desc {
    const ag_image *image; // RGBA8; copied
    ag_wrap wrap_u, wrap_v;
    ag_filter mag, min, mip;
    bool no_mips;
} ag_texture_desc;

// Add a texture.  AG_ERROR_ARGUMENT without an RGBA8 image.
AG_CHECK ag_status ag_scene_add_texture(ag_scene *scene, const ag_texture_desc *desc,
                                        ag_texture *texture);

// One use of a texture.  uv' = offset + R(rotation) (scale * uv), the order of
// KHR_texture_transform; a zero scale means (1, 1).
typedef struct ag_texture_use {
    ag_texture texture;
    uint32_t uv_set; // 0 or 1
    float offset[2];
    float rotation_rad; // counter-clockwise
    float scale[2];
} ag_texture_use;

typedef enum ag_alpha_mode {
    AG_ALPHA_OPAQUE = 0,
    AG_ALPHA_MASK,
    AG_ALPHA_BLEND,
} ag_alpha_mode;

// How a surface reflects.  Zero is the default of each choice; together the defaults conserve
// energy.  docs/physics.md has the formulas and their papers.
typedef enum ag_diffuse {
    AG_DIFFUSE_LAMBERT = 0,
    AG_DIFFUSE_OREN_NAYAR, // Oren & Nayar 1994, their A and B; loses light as it gets rough
    AG_DIFFUSE_EON,        // energy-preserving Oren-Nayar; Portsmouth, Kutz & Hill 2025
} ag_diffuse;

typedef enum ag_distribution {
    AG_DISTRIBUTION_GGX = 0, // Trowbridge & Reitz 1975; anisotropic where `anisotropy` is not 0
    AG_DISTRIBUTION_BLINN,   // specular_color (n.h)^shininess: neither Fresnel nor shadowing,
                             // nor image light; the base is not lessened for it
} ag_distribution;

typedef enum ag_shadowing {
    AG_SHADOWING_SMITH = 0, // height-correlated; Heitz 2014
    AG_SHADOWING_SCHLICK,   // Schlick 1994 with k = (roughness + 1)^2 / 8 under lights and
                            // alpha / 2 under image light; Karis 2013
} ag_shadowing;

typedef enum ag_fresnel {
    AG_FRESNEL_SCHLICK = 0, // Schlick 1994
    AG_FRESNEL_CONDUCTOR,   // the metal's part exactly, from conductor_n and conductor_k; it
                            // takes no base_color
    AG_FRESNEL_F82,         // the metal's part lowered at 82 degrees by f82_tint; Kutz, Hasan &
                            // Edmondson 2021
} ag_fresnel;

// What the base receives under the lobe.
typedef enum ag_layering {
    AG_LAYERING_ALBEDO = 0, // all that the lobe leaves of the light, by its albedo
    AG_LAYERING_FRESNEL,    // (1 - F)(1 - metallic), F of each light's half vector
    AG_LAYERING_GLTF,       // the same with the dielectric's F (glTF 2.0, appendix B)
    AG_LAYERING_BLEND,      // lobe times reflectiveness, base times 1 - reflectiveness, metallic
                            // or not
} ag_layering;

// The metallic-roughness material of glTF 2.0 with KHR_materials_unlit,
// _emissive_strength, _ior, _specular and _anisotropy.  A factor that multiplies has no
// natural zero, so start from ag_material_default().
typedef struct ag_material_desc {
    float base_color[4];       // linear, with alpha
    float metallic, roughness; // [0, 1], perceptual roughness
    float emissive[3];         // nit, strength included
    float normal_scale;
    float occlusion_strength; // [0, 1]
    float ior;                // of the dielectric; 0 = specular everywhere 1 (KHR_materials_ior)
    float specular;           // [0, 1]
    float specular_color[3];  // linear, >= 0
    ag_diffuse diffuse;
    float diffuse_roughness; // EON: [0, 1]; Oren-Nayar: sigma, [0, pi/2] rad
    ag_distribution distribution;
    float shininess; // Blinn's exponent, >= 0
    // KHR_materials_anisotropy: alpha = roughness^2 becomes mix(alpha, 1, anisotropy^2) along
    // the tangent turned counter-clockwise by the rotation.
    float anisotropy; // [0, 1]
    float anisotropy_rotation_rad;
    ag_shadowing shadowing;
    ag_fresnel fresnel;
    float conductor_n[3], conductor_k[3]; // index of refraction > 0 and extinction >= 0 of R, G, B
    float f82_tint[3];                    // [0, 1], of Schlick's value at 82 degrees
    ag_layering layering;
    float reflectiveness; // [0, 1], AG_LAYERING_BLEND
    bool single_bounce;   // light that hits the microfacets twice is lost
    ag_alpha_mode alpha_mode;
    float alpha_cutoff;
    bool double_sided;
    bool unlit;
    ag_texture_use base_color_texture;         // sRGB, alpha
    ag_texture_use metallic_roughness_texture; // G roughness, B metallic
    ag_texture_use normal_texture;             // tangent space, +Y up
    ag_texture_use occlusion_texture;          // R
    ag_texture_use emissive_texture;           // sRGB
    ag_texture_use specular_texture;           // A
    ag_texture_use specular_color_texture;     // sRGB
    const char *name;                          // NULL -> none
} ag_material_desc;

// glTF's defaults: white, metallic 1, roughness 1, ior 1.5, everything else neutral;
// shininess 100, reflectiveness .5, the conductor's index that of no particular metal.
AG_API ag_material_desc ag_material_default(void);

// Add a material; what lies outside the ranges above is clamped to them (an ior between 0
// and 1 to 1).  AG_ERROR_ARGUMENT on a number that is not finite, a texture that is not in
// the scene, or a uv set above 1.
AG_CHECK ag_status ag_scene_add_material(ag_scene *scene, const ag_material_desc *desc,
                                         ag_material *material);

// Make another of a material that was added, for all instances that have it; checked as if added
// anew.  The default one, of id 0, stays as it is.
AG_CHECK ag_status ag_scene_set_material(ag_scene *scene, ag_material material,
                                         const ag_material_desc *desc);

// Triangles.  `normals` NULL -> flat (the vertices are split); `tangents` NULL ->
// computed from the normals and uv set 0 as MikkTSpace does; the rest NULL -> zero,
// colours white.  Counter-clockwise corners face the viewer; (u, v) = (0, 0) is the top left
// of an image; the bitangent w cross(normal, tangent) points to its top.
typedef struct ag_mesh_desc {
    const float *positions; // [vertex_count][3] m
    const float *normals;   // [vertex_count][3] unit
    const float *tangents;  // [vertex_count][4] unit, w = handedness
    const float *uvs[2];    // [vertex_count][2]
    const float *colors;    // [vertex_count][4] linear
    uint32_t vertex_count;
    const uint32_t *indices; // [index_count]; NULL -> 0, 1, 2, ...
    uint32_t index_count;    // a multiple of 3
    uint32_t tangent_uv_set; // the uv set that computed tangents follow
    bool skip_tangents;      // neither normal map nor anisotropy: any frame will do
} ag_mesh_desc;

// Add a mesh.  Normals and tangents are made unit; those without a direction, and uvs and
// colours that are not finite, are mended.  AG_ERROR_ARGUMENT without a whole triangle;
// AG_ERROR_FORMAT on an index out of range or a position that is not finite.
AG_CHECK ag_status ag_scene_add_mesh(ag_scene *scene, const ag_mesh_desc *desc, ag_mesh *mesh);

// Show a mesh with a material (0 -> the default one).  `world` is a column-major
// affine matrix, its bottom row taken as 0 0 0 1; NULL -> identity.  Mirroring and
// flattening matrices are allowed.  AG_ERROR_ARGUMENT on an unknown id or a number that is
// not finite.
AG_CHECK ag_status ag_scene_add_instance(ag_scene *scene, ag_mesh mesh, ag_material material,
                                         const float world[16], ag_instance *instance);

// Give an instance a name; NULL takes it away.  Those of files have their nodes', or else their
// meshes'.
AG_CHECK ag_status ag_scene_name_instance(ag_scene *scene, ag_instance instance, const char *name);

typedef enum ag_light_kind {
    AG_LIGHT_POINT = 0,
    AG_LIGHT_SPOT,
    AG_LIGHT_DIRECTIONAL,
    AG_LIGHT_SUN,         // a disk in the sky: a directional light of some angular radius
    AG_LIGHT_SPHERE,      // shines from its whole surface
    AG_LIGHT_DISK,        // shines from its front
    AG_LIGHT_RECT,        // shines from its front
    AG_LIGHT_TUBE,        // a cylinder between two half spheres, shines from its whole surface
    AG_LIGHT_AMBIENT,     // the same from everywhere; diffuse only, as are those that follow
    AG_LIGHT_HEMISPHERIC, // one colour from above, one from below
    AG_LIGHT_HARMONICS,   // spherical harmonics of order 1 or 2
} ag_light_kind;

// What a kind does not name below it ignores.
typedef struct ag_light_desc {
    ag_light_kind kind;
    // m, world space: point and spot; the centre of a sphere, disk, rectangle or tube.
    float position[3];
    // Spot, directional, sun, disk, rectangle: the way the light travels; 0 -> (0, 0, -1).
    // Tube: along its axis; 0 -> +X.  Hemispheric: to where `color` is; 0 -> +Y.
    float direction[3];
    float up[3];    // rectangle: its height's direction, made square to `direction`; 0 -> +Y
    float color[3]; // linear Rec. 709 weights, >= 0; all 0 -> white
    // cd (point, spot, sphere), lux on a surface that faces it (directional, sun), nit (disk,
    // rectangle, tube, ambient, hemispheric, harmonics).  A sphere of intensity I and radius R
    // has the radiance I / (pi R^2): as it shrinks it becomes a point light.
    float intensity;
    float range_m; // of lights with a position: no light beyond; 0 -> unbounded
    float cone_inner_rad, cone_outer_rad; // spot, from the axis; outer 0 -> pi/4
    float radius_m;                       // sphere, disk, tube
    float width_m, height_m;              // rectangle
    float length_m;                       // tube, between the centres of its half spheres
    float angular_radius_rad;             // sun, below pi/2; 0 -> 0.00465, the real one's
    float ground_color[3];                // hemispheric: weights of the light from below, >= 0
    // Harmonics: what a surface of unit normal n = (x, y, z) receives, irradiance over pi, is
    // the light times the sum of these times 1, x, y, z, xy, yz, 3z^2 - 1, xz, x^2 - y^2.  A
    // sum over all lights that is negative counts as 0.  See ag_light_harmonics().
    float harmonics[9][3];
    bool hidden;      // its body is not seen, only its light
    const char *name; // NULL -> none
} ag_light_desc;

// Add a light; one of intensity 0 is dark.  Spheres, disks, rectangles, tubes and suns are
// themselves seen, with the radiance that lights the scene, unless they are hidden (suns: as
// part of the background; pictures hold at most 60000 exposed); bodies do not count for the
// scene's bounds.  AG_ERROR_ARGUMENT on a number that is not finite, a
// negative intensity, range, size or colour, a spot's cone that is not
// 0 <= inner < outer <= pi/2, or a sun as large as the sky.
AG_CHECK ag_status ag_scene_add_light(ag_scene *scene, const ag_light_desc *desc, ag_light *light);

// Make another of a light that was added, be it of another kind; checked as if added anew.
AG_CHECK ag_status ag_scene_set_light(ag_scene *scene, ag_light light, const ag_light_desc *desc);

// `harmonics` of a light from the radiance's coefficients L_00, L_1-1, L_10, L_11, L_2-2 .. L_22
// (real spherical harmonics about y, z, x; Ramamoorthi & Hanrahan 2001, eq. 3), by their eq. 10.
AG_API void ag_light_harmonics(const float radiance[9][3], float harmonics[9][3]);

// The exposure that pictures of the scene have unless they ask for another: a linear factor;
// 1 in a new scene.  AG_ERROR_ARGUMENT unless it is finite and positive.
AG_CHECK ag_status ag_scene_set_exposure(ag_scene *scene, float exposure);
AG_API float ag_scene_exposure(const ag_scene *scene);

typedef struct ag_camera_desc {
    float position[3], target[3]; // m
    float up[3];                  // 0 -> +Y
    float fov_y_rad;              // vertical, perspective; 0 -> 45 degrees unless height_m is set
    float height_m;               // of an orthographic view; 0 -> perspective
    float near_m, far_m;          // 0 -> fitted to the scene
    const char *name;             // copied; NULL -> none
} ag_camera_desc;

// Add a camera.  AG_ERROR_ARGUMENT on a number that is not finite, a target at its
// position, a field of view that is not below pi, or far not beyond near.
AG_CHECK ag_status ag_scene_add_camera(ag_scene *scene, const ag_camera_desc *desc,
                                       ag_camera *camera);

typedef enum ag_environment_kind {
    AG_ENVIRONMENT_STUDIO = 0, // a procedural room with soft boxes
    AG_ENVIRONMENT_SKY,        // a procedural clear sky without a sun disk
    AG_ENVIRONMENT_IMAGE,
    AG_ENVIRONMENT_NONE, // black
} ag_environment_kind;

typedef struct ag_environment_desc {
    ag_environment_kind kind;
    const ag_image *image; // equirectangular, RGBA32F, nit; centre = +X, top = +Y; copied
    float rotation_rad;    // counter-clockwise about +Y, seen from above
    float intensity;       // factor; 0 -> 1
} ag_environment_desc;

// Set what surrounds the scene; a new scene has the studio.  Pixels that are negative or
// NaN become black.  AG_ERROR_ARGUMENT on AG_ENVIRONMENT_IMAGE without an RGBA32F image, a
// negative intensity, or a number that is not finite.
AG_CHECK ag_status ag_scene_set_environment(ag_scene *scene, const ag_environment_desc *desc);

// ---- Keeping it ------------------------------------------------------------

// Write the scene as glTF 2.0 in its binary form (.glb), whatever the path's ending, so that
// ag_scene_load reads back what is seen: instances with their meshes, materials and textures
// (as PNG), lights, cameras, environment and exposure, all numbers exactly.  What glTF and its
// ratified extensions have no word for stands in extensions of Argand's own (docs/gltf.md).
// Lost are: what no instance shows, files' hierarchies, skins and morph targets (their pose
// stays), and the format of images.  The file appears whole or not at all: it is written
// beside its place and renamed.  Reads the scene only.  AG_ERROR_FILE where it cannot be
// written, AG_ERROR_ARGUMENT when the scene's images were released (ag_renderer_take),
// AG_ERROR_UNSUPPORTED above 4 GiB.
AG_CHECK ag_status ag_scene_save(const ag_scene *scene, const char *path);

// Prepare what surrounds the scene for shading, on all cores, so that the first picture finds it in
// the disk cache: some hundred milliseconds once, a look where it is known already.  Reads the
// scene.  `progress` (NULL -> not wanted): stage "bake".  AG_ERROR_MEMORY.
AG_CHECK ag_status ag_scene_bake(const ag_scene *scene, const ag_progress *progress);

// ---- Asking it -------------------------------------------------------------

typedef struct ag_scene_summary {
    uint32_t meshes, materials, textures, instances, lights, cameras;
    uint64_t vertices, triangles;       // as drawn: summed over the instances
    float bounds_min[3], bounds_max[3]; // m; all zero when nothing is visible
    double load_ms, decode_ms;          // spent in ag_scene_load so far
} ag_scene_summary;

AG_API ag_scene_summary ag_scene_summarize(const ag_scene *scene);

// Extension `index` (from 0) of those that loaded files name; false past the last.  `name`
// is borrowed: it lives as long as the scene is not changed.
typedef struct ag_extension_info {
    const char *name;
    bool required;
    bool supported;
} ag_extension_info;
AG_API bool ag_scene_extension(const ag_scene *scene, size_t index, ag_extension_info *info);

// In all of these `name` is borrowed, may be NULL, and lives until the thing gets another one or
// the scene ends.

// Light `index` (from 0) as it was added or last set, defaults filled in and directions made
// unit; false past the last.
AG_API bool ag_scene_light(const ag_scene *scene, size_t index, ag_light_desc *desc);

// Material `index` (from 0; the default one is not among them) as it was added or last set,
// clamped to its ranges; false past the last.
AG_API bool ag_scene_material(const ag_scene *scene, size_t index, ag_material_desc *desc);

typedef struct ag_instance_info {
    ag_mesh mesh;
    ag_material material; // 0: the default one
    float world[16];
    float bounds_min[3], bounds_max[3]; // m, world space
    const char *name;
} ag_instance_info;

// Instance `index` (from 0); false past the last.
AG_API bool ag_scene_instance(const ag_scene *scene, size_t index, ag_instance_info *info);

// Camera `index` (from 0) as it was added, defaults filled in; false past the last.
AG_API bool ag_scene_camera(const ag_scene *scene, size_t index, ag_camera_desc *desc);

// Where a camera should stand: at target + r (sin phi sin theta, cos phi, sin phi cos theta),
// that is theta from +Z towards +X and phi from +Y.  NAN in a field -> chosen: a
// three-quarter view from slightly above (theta 0.6, phi 1.25), at the distance where the
// whole scene fits with 5 % to spare.  NAN in the target -> the centre of the scene's bounds.
// At radius 0 the camera stands on the target and looks the way it would from afar.
typedef struct ag_orbit {
    float theta_rad, phi_rad, radius_m;
    float target[3];
    float fov_y_rad; // 0 -> 45 degrees
} ag_orbit;

// All fields NAN / defaults: the automatic view.
AG_API ag_orbit ag_orbit_auto(void);

// A camera on `orbit` (NULL -> the automatic view) for pictures of `aspect` = width / height.
AG_API ag_camera_desc ag_scene_frame(const ag_scene *scene, const ag_orbit *orbit, float aspect);

// ---- Places of a picture -----------------------------------------------------
//
// In px from the upper left corner: the first pixel's centre is (.5, .5).

typedef struct ag_ray {
    float origin[3];    // m: the eye, or of an orthographic camera where it stands in its plane
    float direction[3]; // unit
} ag_ray;

// The line of sight through a place of a camera's picture of `width` by `height` px.
AG_API ag_ray ag_camera_ray(const ag_camera_desc *camera, uint32_t width, uint32_t height, float x,
                            float y);

// Where in the picture a point is; false where it lies behind the eye.
AG_API bool ag_camera_project(const ag_camera_desc *camera, uint32_t width, uint32_t height,
                              const float point[3], float place[2]);

typedef enum ag_pick_kind {
    AG_PICK_NOTHING = 0, // the background
    AG_PICK_SURFACE,
    AG_PICK_LIGHT,
} ag_pick_kind;

typedef struct ag_pick {
    ag_pick_kind kind;
    ag_instance instance; // of a surface
    ag_material material; // of a surface; 0: the default one
    ag_light light;
    float position[3]; // m, world space; zero of suns
    float normal[3];   // of a surface: its triangle's, unit, towards the eye
    float distance_m;  // from the ray's origin; INFINITY of suns
} ag_pick;

// What is seen at (x, y): the nearest surface or body of a light.  What a picture leaves out is
// not found: culled back faces, alpha below the cutoff, blended surfaces of an alpha below a half,
// hidden bodies.  But lights that stand somewhere are found first, before all else, within
// `reach_px` of their position, whatever is before it: for those that are drawn as marks; 0 ->
// none.  `camera` NULL -> ag_scene_frame's automatic view.  Some milliseconds for a million
// triangles.  AG_ERROR_ARGUMENT on an empty picture or a number that is not finite.
AG_CHECK ag_status ag_scene_pick(const ag_scene *scene, const ag_camera_desc *camera,
                                 uint32_t width, uint32_t height, float x, float y, float reach_px,
                                 ag_pick *pick);

#ifdef __cplusplus
}
#endif
#endif
