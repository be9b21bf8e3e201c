// The textures of a scene on the device.
//
// An image is uploaded once for each way of reading it: as colours, as data or as
// normals, which differ in their format and in how their mips are made.
#ifndef AG_RENDER_TEXTURES_H
#define AG_RENDER_TEXTURES_H

#include "gpu/upload.h"
#include "scene/scene.h"

typedef enum texture_kind {
    TEXTURE_COLOR, // sRGB-coded
    TEXTURE_DATA,
    TEXTURE_NORMAL,
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
    gpu_image white; // stands in for a texture that is not there
} textures;

AG_CHECK ag_status textures_create(gpu_device *device, const ag_scene *scene, gpu_upload *upload,
                                   textures *t);
void textures_destroy(gpu_device *device, textures *t); // zero is allowed

// The kind of a material's texture (GPU_TEXTURE_).
texture_kind textures_kind(uint32_t slot);

// The use that a material makes of texture `slot` (GPU_TEXTURE_).
const ag_texture_use *textures_use(const ag_material_desc *material, uint32_t slot);

// What to bind for it; the white image where the material has none.
AG_CHECK ag_status textures_bind(gpu_device *device, textures *t, const ag_scene *scene,
                                 const ag_texture_use *use, texture_kind kind, VkImageView *view,
                                 VkSampler *sampler);

#endif
