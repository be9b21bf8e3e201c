// What the host hands to the shaders: one text, scalar block layout on both sides.
#ifndef AG_INTEROP_SCENE_GLSL
#define AG_INTEROP_SCENE_GLSL

#ifdef GL_core_profile
#extension GL_EXT_scalar_block_layout : require
#define float2 vec2
#define float3 vec3
#define float4 vec4
#define float4x4 mat4
#define STRUCT_BEGIN(name) struct name {
#define STRUCT_END(name)   };
#else
#include <stdint.h>
typedef uint32_t uint;
typedef struct float2 {
    float x, y;
} float2;
typedef struct float3 {
    float x, y, z;
} float3;
typedef struct float4 {
    float x, y, z, w;
} float4;
typedef struct float4x4 {
    float m[4][4]; // column major
} float4x4;
#define STRUCT_BEGIN(name) typedef struct name {
#define STRUCT_END(name) \
    }                    \
    name;
#endif

// The kinds of gpu_light, in the order in which they stand.
#define GPU_LIGHT_POINT       0u
#define GPU_LIGHT_SPOT        1u
#define GPU_LIGHT_DIRECTIONAL 2u
#define GPU_LIGHT_SUN         3u
#define GPU_LIGHT_SPHERE      4u // this and those that follow have a body
#define GPU_LIGHT_RECT        5u
#define GPU_LIGHT_DISK        6u
#define GPU_LIGHT_TUBE        7u

// Groups of kinds that are computed alike, in the same order.
#define GPU_LIGHTS_PUNCTUAL 0
#define GPU_LIGHTS_CAP      1 // sun, sphere
#define GPU_LIGHTS_RECT     2
#define GPU_LIGHTS_DISK     3
#define GPU_LIGHTS_TUBE     4
#define GPU_LIGHT_GROUPS    5

#define GPU_LIGHTS_NEAR 8 // punctual ones that are also in a uniform buffer

STRUCT_BEGIN(gpu_light)
    float3 position; // m, world space
    float inverse_range2;
    float3 intensity; // cd (punctual, sphere), lux (directional, sun), nit
    uint kind;
    float3 direction; // unit, the way the light travels; along a tube
    float radius;     // m; sine of a sun's angular radius
    float3 x;         // half the width of a rectangle, a disk; half a tube's axis
    float cone_scale; // light_spot_cone(); cosine of a sun's angular radius
    float3 y;         // half the height
    float cone_offset;
    float3 radiance; // nit, of the body; 0 = hidden
STRUCT_END(gpu_light)

// The grid that is laid around a light's body, halved a few times for small ones; an odd number
// of rows, so that none of its points is on a tube's middle.  The level stands in the upper bits
// of a vertex's index.
#define GPU_BODY_COLUMNS     48
#define GPU_BODY_ROWS        25
#define GPU_BODY_LEVELS      3
#define GPU_BODY_LEVEL_SHIFT 12
#define GPU_BODY_TRIANGLES   (GPU_BODY_COLUMNS * GPU_BODY_ROWS * 2) // at most

// Under many lights the picture is cut into clusters, GPU_CLUSTERS tiles across, as many down,
// as many slices of depth.  Each has a first and GPU_LIGHT_GROUPS ends in a list of lights,
// which follows the clusters in their buffer.
#define GPU_CLUSTERS      32
#define GPU_CLUSTER_WORDS 6

// One view of the scene.
STRUCT_BEGIN(gpu_frame)
    float4x4 clip_from_world;
    // Point (x, y) of clip space, each in [-1, 1], is seen from `eye` along
    // ray_center + x ray_x + y ray_y; an orthographic view looks along ray_center.
    float3 eye;
    float orthographic; // 1 or 0
    float3 ray_center;
    float footprint; // of a sample: 1 = the whole pixel; less where frames are summed
    float3 ray_x;
    float environment_intensity;
    float3 ray_y;
    float environment_cos; // of the environment's rotation about +Y
    float environment_sin;
    float environment_mips; // levels of the prefiltered cube
    uint first_body;        // of the lights
    float3 sh[9];                      // radiance of the environment, order 2
    float3 ambient[9];                 // ambient_light of ambient.glsl
    uint light_ends[GPU_LIGHT_GROUPS]; // where each group of lights ends
    uint cluster_tile_x, cluster_tile_y; // px
    // m along the line of sight = dot(depth.xyz, position) + depth.w
    float4 depth;
    // A depth of z m is in slice log2(z) slice_scale + slice_offset of the clusters.
    float slice_scale;
    float slice_offset;
    float2 pixel; // its size in clip space
    // Factors of a picture's parts: what shines into the eye itself; bases and lobes of surfaces
    // under the environment, its intensity included.
    float seen, environment_base, environment_lobe;
    float3 red, green, blue; // what a unit of light of each channel is in the picture
STRUCT_END(gpu_frame)

// Read as a vertex's attributes.
STRUCT_BEGIN(gpu_instance)
    float4 rows[3]; // of the affine matrix world_from_object
STRUCT_END(gpu_instance)

// The textures of a material, in the order of their bindings and of the bits of the
// constant TEXTURES.
#define GPU_TEXTURE_BASE_COLOR         0
#define GPU_TEXTURE_METALLIC_ROUGHNESS 1
#define GPU_TEXTURE_NORMAL             2
#define GPU_TEXTURE_OCCLUSION          3
#define GPU_TEXTURE_EMISSIVE           4
#define GPU_TEXTURE_SPECULAR           5
#define GPU_TEXTURE_SPECULAR_COLOR     6
#define GPU_TEXTURE_COUNT              7

STRUCT_BEGIN(gpu_material)
    float4 base_color;
    float3 emissive; // nit
    float metallic;
    float3 specular_color;
    float specular;
    float roughness;
    float dielectric_f0;
    float normal_scale;
    float occlusion_strength;
    float alpha_cutoff;
    float anisotropy;
    float2 anisotropy_direction; // cosine and sine of its rotation from the tangent
    float diffuse_roughness;
    float shininess;
    float reflectiveness;
    float3 conductor_n;
    float3 conductor_k;
    float3 f82_tint;
    uint uv1; // bit t: texture t uses uv set 1
    float3 uv_u[GPU_TEXTURE_COUNT]; // u' = dot(uv_u, (u, v, 1))
    float3 uv_v[GPU_TEXTURE_COUNT];
STRUCT_END(gpu_material)

// How the fragment shader of surfaces is specialised: constants 0 to 12.
STRUCT_BEGIN(gpu_surface_constants)
    uint textures;    // bit t: texture t is sampled
    uint general_uv;  // some texture has a transform or uses uv set 1
    uint alpha_mode;  // GPU_ALPHA_
    uint unlit;
    uint environment; // GPU_ENVIRONMENT_
    uint lights;      // how many punctual ones, all near
    uint tone;        // of display.glsl, or GPU_TONE_LINEAR
    uint samples;     // of a pixel
    uint groups;      // bit g: there are lights of group g, beyond the near ones
    uint clustered;
    uint ambient;
    uint method;      // GPU_METHOD_, of lights of extent
    uint model;       // SURFACE_ of surface.glsl
STRUCT_END(gpu_surface_constants)

#define GPU_ALPHA_OPAQUE 0u
#define GPU_ALPHA_MASK   1u
#define GPU_ALPHA_BLEND  2u
#define GPU_ENVIRONMENT_NONE      0u
#define GPU_ENVIRONMENT_CUBE      1u // diffuse light from the irradiance cube
#define GPU_ENVIRONMENT_HARMONICS 2u // diffuse light from order-2 spherical harmonics
#define GPU_METHOD_EXACT          0u
#define GPU_METHOD_LTC            1u
#define GPU_METHOD_REPRESENTATIVE 2u
#define GPU_TONE_LINEAR  0xffu // leave the radiance as it is: something comes after

// Constants of the passes that follow, pushed.
STRUCT_BEGIN(gpu_resolve)
    float4 background; // linear, display-referred, under the picture; alpha 0 = none
    float weight;      // of this picture in the sum
STRUCT_END(gpu_resolve)

// The picture that is metered; pushed.
STRUCT_BEGIN(gpu_meter)
    uint width, height; // px
    uint meter;         // what follows: of meter_pattern
    float x, y, radius, shorter;
    float scale; // from the picture to nit
STRUCT_END(gpu_meter)

// An image in a window; pushed.
STRUCT_BEGIN(gpu_layer)
    float4 place;  // left, top, right, bottom in clip space
    float opacity; // 1: as its alpha says; 0: its alpha is not looked at
STRUCT_END(gpu_layer)

// A place to shade.
STRUCT_BEGIN(gpu_listed)
    uint pixel; // x, and y in the upper 16 bits
    uint instance;
    uint first_index;  // of the triangle
    uint first_vertex; // of the mesh
STRUCT_END(gpu_listed)

// Which part of the list a dispatch shades; pushed.
STRUCT_BEGIN(gpu_list)
    uint first, count;
STRUCT_END(gpu_list)

#ifndef GL_core_profile
_Static_assert(sizeof(gpu_frame) == 64 + 4 * 16 + 12 + 2 * 9 * 12 + 20 + 8 + 16 + 8 + 8 + 12 + 36,
               "gpu_frame");
_Static_assert(sizeof(gpu_light) == 5 * 16 + 12, "gpu_light");
_Static_assert(sizeof(gpu_instance) == 48, "gpu_instance");
_Static_assert(sizeof(gpu_material) == 16 + 16 + 16 + 20 + 60 + 4 + 2 * GPU_TEXTURE_COUNT * 12,
               "gpu_material");
_Static_assert(sizeof(gpu_surface_constants) == 52, "gpu_surface_constants");
_Static_assert(sizeof(gpu_resolve) == 20, "gpu_resolve");
_Static_assert(sizeof(gpu_listed) == 16, "gpu_listed");
#endif

#endif
