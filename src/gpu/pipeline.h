// Pipelines, graphics ones for dynamic rendering, and the layouts they are made with.
#ifndef AG_GPU_PIPELINE_H
#define AG_GPU_PIPELINE_H

#include "gpu/device.h"

typedef struct gpu_shader {
    const uint32_t *words;
    size_t bytes;
} gpu_shader;

typedef enum gpu_blend {
    GPU_BLEND_NONE = 0,
    GPU_BLEND_OVER, // premultiplied source over destination
    GPU_BLEND_ADD,
} gpu_blend;

typedef struct gpu_pipeline_desc {
    gpu_shader vertex, fragment;
    VkPipelineLayout layout;
    const VkPipelineVertexInputStateCreateInfo *vertices; // NULL -> none
    VkFormat color_format;
    bool depth_test, depth_write; // reversed: nearer is greater
    bool has_depth;               // a depth attachment is there
    uint32_t samples;             // 0 -> 1
    gpu_blend blend;
    const uint32_t *constants; // specialisation constants 0, 1, ... of the fragment shader
    uint32_t constant_count;
} gpu_pipeline_desc;

// Viewport, scissor, cull mode and front face are dynamic.
AG_CHECK ag_status gpu_pipeline_create(gpu_device *device, const gpu_pipeline_desc *desc,
                                       VkPipeline *pipeline);

typedef struct gpu_compute_desc {
    gpu_shader shader;
    VkPipelineLayout layout;
    const uint32_t *constants; // specialisation constants 0, 1, ...
    uint32_t constant_count;
} gpu_compute_desc;

AG_CHECK ag_status gpu_compute_create(gpu_device *device, const gpu_compute_desc *desc,
                                      VkPipeline *pipeline);

AG_CHECK ag_status gpu_set_layout_create(gpu_device *device,
                                         const VkDescriptorSetLayoutBinding *bindings,
                                         uint32_t count, VkDescriptorSetLayout *layout);

// `push_bytes` of push constants, seen by `stages`.
AG_CHECK ag_status gpu_pipeline_layout_create(gpu_device *device, const VkDescriptorSetLayout *sets,
                                              uint32_t count, VkShaderStageFlags stages,
                                              uint32_t push_bytes, VkPipelineLayout *layout);

#endif
