// Pipelines, graphics ones for dynamic rendering, and the layouts they are made with.
#include "gpu/pipeline.h"

enum { CONSTANTS_MAX = 16 };

static ag_status create_module(gpu_device *device, gpu_shader shader, VkShaderModule *module)
{
    const VkShaderModuleCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
        .codeSize = shader.bytes,
        .pCode = shader.words,
    };
    return gpu_check(device, vkCreateShaderModule(device->device, &info, NULL, module),
                     "vkCreateShaderModule");
}

static VkPipelineColorBlendAttachmentState blend_state(gpu_blend blend)
{
    return (VkPipelineColorBlendAttachmentState) {
        .blendEnable = blend != GPU_BLEND_NONE,
        .srcColorBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstColorBlendFactor =
            blend == GPU_BLEND_OVER ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE,
        .srcAlphaBlendFactor = VK_BLEND_FACTOR_ONE,
        .dstAlphaBlendFactor =
            blend == GPU_BLEND_OVER ? VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA : VK_BLEND_FACTOR_ONE,
        .colorWriteMask = 0xf,
    };
}

// Specialisation constants 0, 1, ...
typedef struct constants {
    VkSpecializationMapEntry entries[CONSTANTS_MAX];
    VkSpecializationInfo info;
} constants;

static void init_constants(const uint32_t *values, uint32_t count, constants *c)
{
    for (uint32_t i = 0; i < count; i++)
        c->entries[i] = (VkSpecializationMapEntry) { i, i * 4, 4 };
    c->info = (VkSpecializationInfo) { count, c->entries, count * 4ul, values };
}

static ag_status create_pipeline(gpu_device *device, const gpu_pipeline_desc *desc,
                                 VkShaderModule vertex, VkShaderModule fragment,
                                 VkPipeline *pipeline)
{
    constants special;
    init_constants(desc->constants, desc->constant_count, &special);
    const VkPipelineShaderStageCreateInfo stages[] = {
        { .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
          .stage = VK_SHADER_STAGE_VERTEX_BIT,
          .module = vertex,
          .pName = "main" },
        { .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
          .stage = VK_SHADER_STAGE_FRAGMENT_BIT,
          .module = fragment,
          .pName = "main",
          .pSpecializationInfo = &special.info },
    };
    const VkPipelineVertexInputStateCreateInfo no_vertices = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO
    };
    const VkPipelineInputAssemblyStateCreateInfo assembly = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
    };
    const VkPipelineViewportStateCreateInfo viewport = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .scissorCount = 1,
    };
    const VkPipelineRasterizationStateCreateInfo raster = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .lineWidth = 1.0f,
    };
    const VkPipelineMultisampleStateCreateInfo samples = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples =
            desc->samples ? (VkSampleCountFlagBits)desc->samples : VK_SAMPLE_COUNT_1_BIT,
    };
    const VkPipelineDepthStencilStateCreateInfo depth = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = desc->depth_test,
        .depthWriteEnable = desc->depth_write,
        .depthCompareOp = VK_COMPARE_OP_GREATER_OR_EQUAL,
    };
    const VkPipelineColorBlendAttachmentState attachment = blend_state(desc->blend);
    const VkPipelineColorBlendStateCreateInfo blend = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = 1,
        .pAttachments = &attachment,
    };
    const VkDynamicState dynamic[] = { VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                       VK_DYNAMIC_STATE_CULL_MODE, VK_DYNAMIC_STATE_FRONT_FACE };
    const VkPipelineDynamicStateCreateInfo dynamics = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO,
        .dynamicStateCount = sizeof dynamic / sizeof *dynamic,
        .pDynamicStates = dynamic,
    };
    const VkPipelineRenderingCreateInfo rendering = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
        .colorAttachmentCount = 1,
        .pColorAttachmentFormats = &desc->color_format,
        .depthAttachmentFormat = desc->has_depth ? VK_FORMAT_D32_SFLOAT : VK_FORMAT_UNDEFINED,
    };
    const VkGraphicsPipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
        .pNext = &rendering,
        .stageCount = 2,
        .pStages = stages,
        .pVertexInputState = desc->vertices ? desc->vertices : &no_vertices,
        .pInputAssemblyState = &assembly,
        .pViewportState = &viewport,
        .pRasterizationState = &raster,
        .pMultisampleState = &samples,
        .pDepthStencilState = &depth,
        .pColorBlendState = &blend,
        .pDynamicState = &dynamics,
        .layout = desc->layout,
    };
    return gpu_check(
        device,
        vkCreateGraphicsPipelines(device->device, device->pipeline_cache, 1, &info, NULL, pipeline),
        "vkCreateGraphicsPipelines");
}

ag_status gpu_pipeline_create(gpu_device *device, const gpu_pipeline_desc *desc,
                              VkPipeline *pipeline)
{
    VkShaderModule vertex = VK_NULL_HANDLE, fragment = VK_NULL_HANDLE;
    *pipeline = VK_NULL_HANDLE;
    ag_status status = create_module(device, desc->vertex, &vertex);
    if (!status)
        status = create_module(device, desc->fragment, &fragment);
    if (!status)
        status = create_pipeline(device, desc, vertex, fragment, pipeline);
    vkDestroyShaderModule(device->device, vertex, NULL);
    vkDestroyShaderModule(device->device, fragment, NULL);
    return status;
}

ag_status gpu_compute_create(gpu_device *device, const gpu_compute_desc *desc, VkPipeline *pipeline)
{
    VkShaderModule module = VK_NULL_HANDLE;
    *pipeline = VK_NULL_HANDLE;
    ag_status status = create_module(device, desc->shader, &module);
    if (status)
        return status;
    constants special;
    init_constants(desc->constants, desc->constant_count, &special);
    const VkComputePipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = { .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                   .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                   .module = module,
                   .pName = "main",
                   .pSpecializationInfo = &special.info },
        .layout = desc->layout,
    };
    status = gpu_check(
        device,
        vkCreateComputePipelines(device->device, device->pipeline_cache, 1, &info, NULL, pipeline),
        "vkCreateComputePipelines");
    vkDestroyShaderModule(device->device, module, NULL);
    return status;
}

ag_status gpu_set_layout_create(gpu_device *device, const VkDescriptorSetLayoutBinding *bindings,
                                uint32_t count, VkDescriptorSetLayout *layout)
{
    const VkDescriptorSetLayoutCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = count,
        .pBindings = bindings,
    };
    return gpu_check(device, vkCreateDescriptorSetLayout(device->device, &info, NULL, layout),
                     "vkCreateDescriptorSetLayout");
}

ag_status gpu_pipeline_layout_create(gpu_device *device, const VkDescriptorSetLayout *sets,
                                     uint32_t count, VkShaderStageFlags stages, uint32_t push_bytes,
                                     VkPipelineLayout *layout)
{
    const VkPushConstantRange range = { stages, 0, push_bytes };
    const VkPipelineLayoutCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
        .setLayoutCount = count,
        .pSetLayouts = sets,
        .pushConstantRangeCount = push_bytes ? 1 : 0,
        .pPushConstantRanges = &range,
    };
    return gpu_check(device, vkCreatePipelineLayout(device->device, &info, NULL, layout),
                     "vkCreatePipelineLayout");
}
