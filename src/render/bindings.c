// What shaders see: descriptor layouts, and the set that one frame binds.
#include "render/bindings.h"

#include "interop/scene.glsl"

#define IMAGE VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
#define UNIFORM VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
#define STORAGE VK_DESCRIPTOR_TYPE_STORAGE_BUFFER
#define TEXELS VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER

static ag_status create_shading_layouts(gpu_device *device, bindings *b)
{
    const VkShaderStageFlags compute = VK_SHADER_STAGE_COMPUTE_BIT;
    const VkDescriptorSetLayoutBinding listed[] = {
        { 0, TEXELS, 1, compute, NULL },  { 1, TEXELS, 1, compute, NULL },
        { 2, TEXELS, 1, compute, NULL },  { 3, TEXELS, 1, compute, NULL },
        { 4, STORAGE, 1, compute, NULL },
    };
    ag_status status = gpu_set_layout_create(device, listed, 5, &b->listed_set);
    const VkDescriptorSetLayout shading[] = { b->frame_set, b->material_set, b->listed_set };
    if (!status)
        status =
            gpu_pipeline_layout_create(device, shading, 3, compute, sizeof(gpu_list), &b->shading);
    return status;
}

static ag_status create_metering_layouts(gpu_device *device, bindings *b)
{
    const VkShaderStageFlags compute = VK_SHADER_STAGE_COMPUTE_BIT;
    const VkDescriptorSetLayoutBinding meter[] = { { 0, STORAGE, 1, compute, NULL },
                                                   { 1, STORAGE, 1, compute, NULL } };
    ag_status status = gpu_set_layout_create(device, meter, 2, &b->meter_set);
    return status ? status
                  : gpu_pipeline_layout_create(device, &b->meter_set, 1, compute, sizeof(gpu_meter),
                                               &b->metering);
}

static ag_status create_layouts(gpu_device *device, bindings *b)
{
    const VkShaderStageFlags vertex = VK_SHADER_STAGE_VERTEX_BIT,
                             fragment = VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;
    const VkDescriptorSetLayoutBinding frame[] = {
        { 0, UNIFORM, 1, vertex | fragment, NULL },
        { 1, IMAGE, 1, fragment, NULL },
        { 2, IMAGE, 1, fragment, NULL },
        { 3, IMAGE, 1, fragment, NULL },
        { 4, UNIFORM, 1, fragment, NULL },
        { 5, IMAGE, 1, fragment, NULL },
        { 6, STORAGE, 1, vertex | fragment, NULL },
        { 7, STORAGE, 1, fragment, NULL },
        { 8, IMAGE, 1, fragment, NULL },
    };
    VkDescriptorSetLayoutBinding material[1 + GPU_TEXTURE_COUNT] = { { 0, UNIFORM, 1, fragment,
                                                                       NULL } };
    for (uint32_t i = 1; i <= GPU_TEXTURE_COUNT; i++)
        material[i] = (VkDescriptorSetLayoutBinding) { i, IMAGE, 1, fragment, NULL };
    const VkDescriptorSetLayoutBinding picture[] = { { 0, IMAGE, 1, fragment, NULL } };

    ag_status status = gpu_set_layout_create(device, frame, 9, &b->frame_set);
    if (!status)
        status = gpu_set_layout_create(device, material, 1 + GPU_TEXTURE_COUNT, &b->material_set);
    if (!status)
        status = gpu_set_layout_create(device, picture, 1, &b->picture_set);
    const VkDescriptorSetLayout surfaces[] = { b->frame_set, b->material_set };
    if (!status)
        status = gpu_pipeline_layout_create(device, surfaces, 2, 0, 0, &b->surfaces);
    if (!status)
        status =
            gpu_pipeline_layout_create(device, &b->picture_set, 1, VK_SHADER_STAGE_FRAGMENT_BIT,
                                       sizeof(gpu_resolve), &b->pictures);
    if (!status)
        status = gpu_pipeline_layout_create(device, &b->picture_set, 1,
                                            vertex | VK_SHADER_STAGE_FRAGMENT_BIT,
                                            sizeof(gpu_layer), &b->layers);
    if (!status)
        status = create_metering_layouts(device, b);
    return status ? status : create_shading_layouts(device, b);
}

static ag_status create_samplers(gpu_device *device, bindings *b)
{
    VkSamplerCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
        .magFilter = VK_FILTER_LINEAR,
        .minFilter = VK_FILTER_LINEAR,
        .mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR,
        .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
        .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
        .addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
        .maxLod = VK_LOD_CLAMP_NONE,
    };
    ag_status status = gpu_check(device, vkCreateSampler(device->device, &info, NULL, &b->linear),
                                 "vkCreateSampler");
    info.addressModeU = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    if (!status)
        status = gpu_check(device, vkCreateSampler(device->device, &info, NULL, &b->panorama),
                           "vkCreateSampler");
    return status;
}

static ag_status create_sets(gpu_device *device, bindings *b)
{
    const VkDescriptorPoolSize sizes[] = {
        { UNIFORM, 2 }, { IMAGE, 7 }, { STORAGE, 5 }, { TEXELS, 4 }
    };
    const VkDescriptorPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = 5,
        .poolSizeCount = sizeof sizes / sizeof *sizes,
        .pPoolSizes = sizes,
    };
    ag_status status =
        gpu_check(device, vkCreateDescriptorPool(device->device, &pool, NULL, &b->pool),
                  "vkCreateDescriptorPool");
    if (status)
        return status;
    const VkDescriptorSetLayout layouts[] = { b->frame_set, b->picture_set, b->picture_set,
                                              b->listed_set, b->meter_set };
    VkDescriptorSet sets[5];
    const VkDescriptorSetAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = b->pool,
        .descriptorSetCount = 5,
        .pSetLayouts = layouts,
    };
    status = gpu_check(device, vkAllocateDescriptorSets(device->device, &info, sets),
                       "vkAllocateDescriptorSets");
    if (status)
        return status;
    b->frame = sets[0];
    b->picture = sets[1];
    b->sum = sets[2];
    b->listed = sets[3];
    b->meter = sets[4];
    return AG_OK;
}

ag_status bindings_create(gpu_device *device, bindings *b)
{
    *b = (bindings) { 0 };
    ag_status status = create_layouts(device, b);
    if (!status)
        status = create_samplers(device, b);
    if (!status)
        status = create_sets(device, b);
    if (status)
        bindings_destroy(device, b);
    return status;
}

void bindings_destroy(gpu_device *device, bindings *b)
{
    vkDestroyDescriptorPool(device->device, b->pool, NULL);
    vkDestroySampler(device->device, b->linear, NULL);
    vkDestroySampler(device->device, b->panorama, NULL);
    vkDestroyPipelineLayout(device->device, b->surfaces, NULL);
    vkDestroyPipelineLayout(device->device, b->pictures, NULL);
    vkDestroyPipelineLayout(device->device, b->layers, NULL);
    vkDestroyPipelineLayout(device->device, b->shading, NULL);
    vkDestroyPipelineLayout(device->device, b->metering, NULL);
    vkDestroyDescriptorSetLayout(device->device, b->meter_set, NULL);
    vkDestroyDescriptorSetLayout(device->device, b->listed_set, NULL);
    vkDestroyDescriptorSetLayout(device->device, b->frame_set, NULL);
    vkDestroyDescriptorSetLayout(device->device, b->material_set, NULL);
    vkDestroyDescriptorSetLayout(device->device, b->picture_set, NULL);
    *b = (bindings) { 0 };
}

void bindings_write_image(gpu_device *device, VkDescriptorSet set, uint32_t binding,
                          VkImageView view, VkSampler sampler)
{
    const VkDescriptorImageInfo info = { sampler, view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL };
    const VkWriteDescriptorSet write = {
        .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
        .dstSet = set,
        .dstBinding = binding,
        .descriptorCount = 1,
        .descriptorType = IMAGE,
        .pImageInfo = &info,
    };
    vkUpdateDescriptorSets(device->device, 1, &write, 0, NULL);
}

void bindings_write_buffer(gpu_device *device, VkDescriptorSet set, uint32_t binding,
                           VkDescriptorType type, VkBuffer buffer, VkDeviceSize offset,
                           VkDeviceSize size)
{
    const VkDescriptorBufferInfo info = { buffer, offset, size };
    const VkWriteDescriptorSet write = {
        .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
        .dstSet = set,
        .dstBinding = binding,
        .descriptorCount = 1,
        .descriptorType = type,
        .pBufferInfo = &info,
    };
    vkUpdateDescriptorSets(device->device, 1, &write, 0, NULL);
}

void bindings_write_texels(gpu_device *device, VkDescriptorSet set, uint32_t binding,
                           VkBufferView view)
{
    const VkWriteDescriptorSet write = {
        .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
        .dstSet = set,
        .dstBinding = binding,
        .descriptorCount = 1,
        .descriptorType = TEXELS,
        .pTexelBufferView = &view,
    };
    vkUpdateDescriptorSets(device->device, 1, &write, 0, NULL);
}
