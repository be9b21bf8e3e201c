// The textures of a scene on the device.
//
// An image is uploaded once for each way of reading it: the ways differ in how mips are
// made and in the channels that are worth keeping.
#ifndef AG_RENDER_TEXTURES_H
#define AG_RENDER_TEXTURES_H

#include "gpu/upload.h"
#include "scene/scene.h"

typedef enum texture_kind {
    TEXTURE_COLOR,              // sRGB-coded; alpha means nothing
    TEXTURE_COLOR_ALPHA,        // sRGB-coded, with alpha
    TEXTURE_ROUGHNESS_METALLIC, // G, B
    TEXTURE_NORMAL,             // R, G; the third follows from the length
    TEXTURE_OCCLUSION,          // R
    TEXTURE_SPECULAR,           // A
    TEXTURE_KINDS,
} texture_kind;

typedef struct textures {
    gpu_image *images; // [image of the scene][texture_kind]; empty where not used
    size_t image_count;
    uint32_t *image_of; // [texture of the scene]: index of its image
    VkSampler *samplers;
    size_t sampler_count, sampler_capacity;
    ag_texture_desc *sampler_descs; // what samplers[i] was made for
    size_t sampler_desc_capacity;
    gpu_image white; // stands in for a texture that is not there,
    gpu_image flat;  // this one for a normal map
} textures;

// `release`: give an image's pixels in host memory back as soon as it is uploaded.
// On failure what is half made stays for textures_destroy, after the upload is finished: the
// device may still be copying into it.
AG_CHECK ag_status textures_create(gpu_device *device, const ag_scene *scene, bool release,
                                   gpu_upload *upload, textures *t);
// Add what materials that were set since read besides: only where it is at hand, on the device or
// in the scene.
bool textures_at_hand(const ag_scene *scene, const textures *t);
AG_CHECK ag_status textures_complete(gpu_device *device, const ag_scene *scene, bool release,
                                     gpu_upload *upload, textures *t);
void textures_destroy(gpu_device *device, textures *t); // zero is allowed

// The way that a material reads texture `slot` (GPU_TEXTURE_).
texture_kind textures_kind(const ag_material_desc *material, uint32_t slot);

// The use that a material makes of texture `slot`.
const ag_texture_use *textures_use(const ag_material_desc *material, uint32_t slot);

// What to bind for it; an image that changes nothing where the material has none.
AG_CHECK ag_status textures_bind(gpu_device *device, textures *t, const ag_scene *scene,
                                 const ag_texture_use *use, texture_kind kind, VkImageView *view,
                                 VkSampler *sampler);

#endif
