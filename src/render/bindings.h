// What shaders see: descriptor layouts, and the set that one frame binds.
#ifndef AG_RENDER_BINDINGS_H
#define AG_RENDER_BINDINGS_H

#include "gpu/buffer.h"
#include "gpu/image.h"
#include "gpu/pipeline.h"

typedef struct bindings {
    VkDescriptorSetLayout frame_set, material_set, picture_set, listed_set, meter_set;
    VkPipelineLayout surfaces; // frame, material; also the background's
    VkPipelineLayout pictures; // picture; push constants gpu_resolve
    VkPipelineLayout layers;   // picture; push constants gpu_layer
    VkPipelineLayout shading;  // frame, material, listed; push constants gpu_list
    VkPipelineLayout metering; // meter; push constants gpu_meter
    VkSampler linear;          // clamped, between mips
    VkSampler panorama;        // wraps around, clamped above and below
    VkDescriptorPool pool;     // of the sets below
    VkDescriptorSet frame, picture, sum, listed, meter;
} bindings;

AG_CHECK ag_status bindings_create(gpu_device *device, bindings *b);
void bindings_destroy(gpu_device *device, bindings *b); // zero is allowed

void bindings_write_image(gpu_device *device, VkDescriptorSet set, uint32_t binding,
                          VkImageView view, VkSampler sampler);
void bindings_write_buffer(gpu_device *device, VkDescriptorSet set, uint32_t binding,
                           VkDescriptorType type, VkBuffer buffer, VkDeviceSize offset,
                           VkDeviceSize size);
void bindings_write_texels(gpu_device *device, VkDescriptorSet set, uint32_t binding,
                           VkBufferView view);

#endif
