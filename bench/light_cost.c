// What a light costs: nanoseconds an evaluation of each method, side by side, on a Vulkan device.
//
//   bench_light_cost [DEVICE]      as for argand(1); default cpu
//
// On a CPU it is processor time over all threads, on a GPU the time from submission to the end.
// What the loop around the method takes is subtracted.
#include "bake/dfg.h"
#include "bake/ltc.h"
#include "gpu/pipeline.h"
#include "gpu/upload.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static const uint32_t code[] =
#include "light_cost.comp.inc"
    ;

static const char *const method_name[] = { "loop", // METHOD of light_cost.comp
                                           "point light",
                                           "sphere, representative point",
                                           "sphere, LTC",
                                           "sphere, LTC, its table fetched",
                                           "sphere, LTC, both tables fetched",
                                           "sphere, closed form",
                                           "tube, representative point",
                                           "disk, LTC",
                                           "rectangle, LTC",
                                           "tube, LTC",
                                           "disk, sectors",
                                           "rectangle, sectors",
                                           "tube, sectors" };

enum { METHODS = sizeof method_name / sizeof *method_name, LIGHTS = 16, RUNS = 7 };

typedef struct rig {
    gpu_device *device;
    uint32_t groups; // of 64 invocations
    gpu_buffer out;
    gpu_image tables[2]; // LTC, DFG
    VkSampler sampler;
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkShaderModule module;
    VkDescriptorPool pool;
    VkDescriptorSet set;
} rig;

static void must(bool good, const char *what)
{
    if (good)
        return;
    fprintf(stderr, "bench_light_cost: %s failed\n", what);
    exit(1);
}

static void make_tables(rig *r)
{
    static uint16_t dfg[BAKE_DFG_SIZE * BAKE_DFG_SIZE * 2];
    bake_dfg(dfg);
    const void *data[] = { bake_ltc_table, dfg };
    const gpu_image_desc desc[] = {
        { .format = VK_FORMAT_R16G16B16A16_SFLOAT,
          .width = BAKE_LTC_SIZE,
          .height = BAKE_LTC_SIZE },
        { .format = VK_FORMAT_R16G16_SFLOAT, .width = BAKE_DFG_SIZE, .height = BAKE_DFG_SIZE },
    };
    gpu_upload upload;
    must(!gpu_upload_begin(r->device, &upload), "an upload");
    for (int i = 0; i < 2; i++) {
        gpu_image_desc d = desc[i];
        d.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
        must(!gpu_image_create(r->device, &d, &r->tables[i]), "an image");
        gpu_upload_image_begin(&upload, &r->tables[i]);
        must(!gpu_upload_image_level(&upload, &r->tables[i], 0, 0, i ? 4 : 8, data[i]), "a copy");
        gpu_upload_image_end(&upload, &r->tables[i]);
    }
    must(!gpu_upload_end(&upload), "an upload");
    gpu_upload_finish(&upload);
    const VkSamplerCreateInfo sampler = {
        .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
        .magFilter = VK_FILTER_LINEAR,
        .minFilter = VK_FILTER_LINEAR,
        .addressModeU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
        .addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
    };
    must(!vkCreateSampler(r->device->device, &sampler, NULL, &r->sampler), "a sampler");
}

static void make_layout(rig *r)
{
    const VkDescriptorSetLayoutBinding bindings[] = {
        { 0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL },
        { 1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL },
        { 2, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL },
    };
    must(!gpu_set_layout_create(r->device, bindings, 3, &r->set_layout), "a set layout");
    must(!gpu_pipeline_layout_create(r->device, &r->set_layout, 1, 0, 0, &r->layout), "a layout");
    const VkShaderModuleCreateInfo module = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
        .codeSize = sizeof code,
        .pCode = code,
    };
    must(!vkCreateShaderModule(r->device->device, &module, NULL, &r->module), "a shader");
}

static void make_set(rig *r)
{
    VkDevice device = r->device->device;
    const VkDescriptorPoolSize sizes[] = { { VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1 },
                                           { VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 2 } };
    const VkDescriptorPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = 1,
        .poolSizeCount = 2,
        .pPoolSizes = sizes,
    };
    must(!vkCreateDescriptorPool(device, &pool, NULL, &r->pool), "a descriptor pool");
    const VkDescriptorSetAllocateInfo allocate = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = r->pool,
        .descriptorSetCount = 1,
        .pSetLayouts = &r->set_layout,
    };
    must(!vkAllocateDescriptorSets(device, &allocate, &r->set), "a descriptor set");
    const VkDescriptorBufferInfo buffer = { r->out.buffer, 0, VK_WHOLE_SIZE };
    const VkDescriptorImageInfo images[] = {
        { r->sampler, r->tables[0].view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL },
        { r->sampler, r->tables[1].view, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL },
    };
    for (uint32_t i = 0; i < 3; i++) {
        const VkWriteDescriptorSet write = {
            .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
            .dstSet = r->set,
            .dstBinding = i,
            .descriptorCount = 1,
            .descriptorType =
                i ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
            .pBufferInfo = i ? NULL : &buffer,
            .pImageInfo = i ? &images[i - 1] : NULL,
        };
        vkUpdateDescriptorSets(device, 1, &write, 0, NULL);
    }
}

static VkPipeline make_pipeline(const rig *r, uint32_t method)
{
    const uint32_t constants[] = { method, LIGHTS };
    const VkSpecializationMapEntry entries[] = { { 0, 0, 4 }, { 1, 4, 4 } };
    const VkSpecializationInfo info = { 2, entries, sizeof constants, constants };
    const VkComputePipelineCreateInfo desc = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .layout = r->layout,
        .stage = { .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                   .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                   .module = r->module,
                   .pName = "main",
                   .pSpecializationInfo = &info },
    };
    VkPipeline pipeline;
    must(!vkCreateComputePipelines(r->device->device, VK_NULL_HANDLE, 1, &desc, NULL, &pipeline),
         "a pipeline");
    return pipeline;
}

static double now_ns(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec * 1e9 + (double)t.tv_nsec;
}

// The least of some runs, an evaluation; the first one compiles.
static double measure(const rig *r, uint32_t method)
{
    clockid_t clock =
        r->device->info.kind == AG_DEVICE_CPU ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC;
    VkPipeline pipeline = make_pipeline(r, method);
    gpu_commands commands;
    must(!gpu_commands_create(r->device, &commands), "a command buffer");
    double least = 1e30;
    for (int i = 0; i <= RUNS; i++) {
        must(!gpu_commands_begin(r->device, &commands), "recording");
        vkCmdBindPipeline(commands.buffer, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        vkCmdBindDescriptorSets(commands.buffer, VK_PIPELINE_BIND_POINT_COMPUTE, r->layout, 0, 1,
                                &r->set, 0, NULL);
        vkCmdDispatch(commands.buffer, r->groups, 1, 1);
        double start = now_ns(clock);
        must(!gpu_commands_submit(r->device, &commands), "submission");
        must(!gpu_commands_wait(r->device, &commands), "waiting");
        double ns = now_ns(clock) - start;
        least = i && ns < least ? ns : least;
    }
    gpu_commands_destroy(r->device, &commands);
    vkDestroyPipeline(r->device->device, pipeline, NULL);
    return least / (64.0 * r->groups * LIGHTS);
}

static void destroy(rig *r)
{
    VkDevice device = r->device->device;
    vkDestroyDescriptorPool(device, r->pool, NULL);
    vkDestroyShaderModule(device, r->module, NULL);
    vkDestroyPipelineLayout(device, r->layout, NULL);
    vkDestroyDescriptorSetLayout(device, r->set_layout, NULL);
    vkDestroySampler(device, r->sampler, NULL);
    for (int i = 0; i < 2; i++)
        gpu_image_destroy(r->device, &r->tables[i]);
    gpu_buffer_destroy(r->device, &r->out);
    ag_device_destroy(r->device);
}

int main(int argc, char **argv)
{
    const ag_device_desc desc = { .select = argc > 1 ? argv[1] : "cpu" };
    rig r = { 0 };
    if (ag_device_create(&desc, &r.device))
        return 1;
    bool is_cpu = r.device->info.kind == AG_DEVICE_CPU;
    r.groups = is_cpu ? 512 : 65535;
    must(!gpu_buffer_create(r.device, r.groups * 64ull * 8, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                            GPU_MEMORY_DEVICE, &r.out),
         "a buffer");
    make_tables(&r);
    make_layout(&r);
    make_set(&r);
    printf("%s: ns an evaluation (%s)\n", r.device->info.name,
           is_cpu ? "processor time" : "from submission to end");
    double loop = measure(&r, 0);
    for (uint32_t i = 1; i < METHODS; i++)
        printf("%-36s %8.*f\n", method_name[i], is_cpu ? 1 : 4, measure(&r, i) - loop);
    destroy(&r);
    return 0;
}
