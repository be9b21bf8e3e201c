// A material's textures as a ray reads them: at full resolution, bilinear between texels.
#ifndef AG_TRACE_TEXTURE_H
#define AG_TRACE_TEXTURE_H

#include "physics/lang.glsl"
#include "scene/scene.h"

typedef struct texture_use {
    const uint8_t *pixels; // RGBA; NULL -> none
    uint32_t stride;       // bytes from texel to texel
    int width, height;
    uint8_t wrap_u, wrap_v; // ag_wrap
    bool nearest;
    uint8_t uv_set;
    float u[3], v[3]; // rows of the transform
} texture_use;

typedef struct texture_set {
    bool alike; // all that are there have the same place everywhere
    texture_use base_color, metallic_roughness, normal, emissive, specular, specular_color;
    uint8_t *woven; // those that are alike, texel beside texel: a place of all is in one line of
                    // the cache; NULL -> each by itself
} texture_set;

// AG_ERROR_ARGUMENT where the scene's images were given to a renderer.
AG_CHECK ag_status texture_set_init(const ag_scene *scene, const ag_material_desc *material,
                                    texture_set *set);

void texture_set_finish(texture_set *set); // zero is allowed

// Weave textures that are alike into one; where there is no memory they stay as they are.  At most
// `limit` bytes; says how many it took.
size_t texture_set_weave(texture_set *set, size_t limit);

// Where a texture is read: four texels and their weights.
typedef struct texture_place {
    size_t texel[4];
    float weight[4];
} texture_place;

// Of the mesh's coordinates `uv` (both sets).  A texture that is not there has no place.
texture_place texture_find(const texture_use *use, const vec2 uv[2]);

// Tell the memory that a set will be read there.
void texture_set_expect(const texture_set *set, const vec2 uv[2]);

// Whether two textures that are there have the same place everywhere.
bool texture_alike(const texture_use *a, const texture_use *b);

// Each channel in [0, 1] as it is coded; white where there is no texture.
vec4 texture_read(const texture_use *use, const texture_place *place);

// The same with R, G, B decoded by a table of sRGB.
vec4 texture_read_color(const texture_use *use, const texture_place *place,
                        const float decode[256]);

#endif
