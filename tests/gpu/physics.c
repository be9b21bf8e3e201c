// The physics gives the same numbers on the GPU as in C.
#include <stdlib.h>

#include "kit.h"

#include "cases.h"
#include "gpu/commands.h"

static const uint32_t code[] =
#include "cases.comp.inc"
    ;

typedef struct rig {
    gpu_device *device;
    gpu_buffer in, out;
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkShaderModule module;
    VkPipeline pipeline;
    VkDescriptorPool pool;
    VkDescriptorSet set;
} rig;

static void make_pipeline(rig *r)
{
    VkDevice device = r->device->device;
    const VkDescriptorSetLayoutBinding bindings[] = {
        { 0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL },
        { 1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, NULL },
    };
    const VkDescriptorSetLayoutCreateInfo set = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
        .bindingCount = 2,
        .pBindings = bindings,
    };
    assert_int_equal(vkCreateDescriptorSetLayout(device, &set, NULL, &r->set_layout), VK_SUCCESS);
    const VkPushConstantRange range = { VK_SHADER_STAGE_COMPUTE_BIT, 0, 4 };
    const VkPipelineLayoutCreateInfo layout = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
        .setLayoutCount = 1,
        .pSetLayouts = &r->set_layout,
        .pushConstantRangeCount = 1,
        .pPushConstantRanges = &range,
    };
    assert_int_equal(vkCreatePipelineLayout(device, &layout, NULL, &r->layout), VK_SUCCESS);
    const VkShaderModuleCreateInfo module = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
        .codeSize = sizeof code,
        .pCode = code,
    };
    assert_int_equal(vkCreateShaderModule(device, &module, NULL, &r->module), VK_SUCCESS);
    const VkComputePipelineCreateInfo pipeline = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .layout = r->layout,
        .stage = { .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                   .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                   .module = r->module,
                   .pName = "main" },
    };
    assert_int_equal(
        vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &pipeline, NULL, &r->pipeline),
        VK_SUCCESS);
}

static void make_set(rig *r)
{
    VkDevice device = r->device->device;
    const VkDescriptorPoolSize size = { VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2 };
    const VkDescriptorPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = 1,
        .poolSizeCount = 1,
        .pPoolSizes = &size,
    };
    assert_int_equal(vkCreateDescriptorPool(device, &pool, NULL, &r->pool), VK_SUCCESS);
    const VkDescriptorSetAllocateInfo set = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = r->pool,
        .descriptorSetCount = 1,
        .pSetLayouts = &r->set_layout,
    };
    assert_int_equal(vkAllocateDescriptorSets(device, &set, &r->set), VK_SUCCESS);
    const VkBuffer buffers[] = { r->in.buffer, r->out.buffer };
    for (uint32_t i = 0; i < 2; i++) {
        const VkDescriptorBufferInfo info = { buffers[i], 0, VK_WHOLE_SIZE };
        const VkWriteDescriptorSet write = {
            .sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
            .dstSet = r->set,
            .dstBinding = i,
            .descriptorCount = 1,
            .descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
            .pBufferInfo = &info,
        };
        vkUpdateDescriptorSets(device, 1, &write, 0, NULL);
    }
}

static void dispatch(rig *r)
{
    gpu_commands commands;
    const uint32_t count = CASES_INPUTS;
    assert_int_equal(gpu_commands_create(r->device, &commands), AG_OK);
    assert_int_equal(gpu_commands_begin(r->device, &commands), AG_OK);
    vkCmdBindPipeline(commands.buffer, VK_PIPELINE_BIND_POINT_COMPUTE, r->pipeline);
    vkCmdBindDescriptorSets(commands.buffer, VK_PIPELINE_BIND_POINT_COMPUTE, r->layout, 0, 1,
                            &r->set, 0, NULL);
    vkCmdPushConstants(commands.buffer, r->layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, 4, &count);
    vkCmdDispatch(commands.buffer, (count * cases_count() + 63) / 64, 1, 1);
    const gpu_access shader = { VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                VK_ACCESS_2_SHADER_WRITE_BIT, VK_IMAGE_LAYOUT_UNDEFINED };
    gpu_barrier_memory(&commands, shader, GPU_ACCESS_HOST_READ);
    assert_int_equal(gpu_commands_submit(r->device, &commands), AG_OK);
    assert_int_equal(gpu_commands_wait(r->device, &commands), AG_OK);
    gpu_commands_destroy(r->device, &commands);
}

static void destroy(rig *r)
{
    VkDevice device = r->device->device;
    vkDestroyDescriptorPool(device, r->pool, NULL);
    vkDestroyPipeline(device, r->pipeline, NULL);
    vkDestroyShaderModule(device, r->module, NULL);
    vkDestroyPipelineLayout(device, r->layout, NULL);
    vkDestroyDescriptorSetLayout(device, r->set_layout, NULL);
    gpu_buffer_destroy(r->device, &r->in);
    gpu_buffer_destroy(r->device, &r->out);
}

// The worst input of one case, measured by how far float C itself is from double C: both
// are floats, neither is the truth.
static void compare(uint32_t id, const float *gpu)
{
    double worst = 0;
    uint32_t at = 0;
    for (uint32_t i = 0; i < CASES_INPUTS; i++) {
        float u[4];
        cases_input(i, u);
        double truth = cases_double(id, u), c = (double)cases_float(id, u);
        double allowed = 2e-5 * (1 + fabs(truth)) + 8 * fabs(c - truth);
        double error = fabs((double)gpu[i] - truth) / allowed;
        if (!(error <= worst)) { // also NaN
            worst = error;
            at = i;
        }
    }
    if (!(worst <= 1)) {
        float u[4];
        cases_input(at, u);
        print_error("case %u, input %u (%g %g %g %g): GPU %.9g, C %.9g, exact %.9g\n", id, at,
                    (double)u[0], (double)u[1], (double)u[2], (double)u[3], (double)gpu[at],
                    (double)cases_float(id, u), cases_double(id, u));
        fail();
    }
}

static void gpu_agrees_with_c(void **state)
{
    rig r = { .device = *state };
    const VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    assert_int_equal(
        gpu_buffer_create(r.device, CASES_INPUTS * 16, storage, GPU_MEMORY_UPLOAD, &r.in), AG_OK);
    assert_int_equal(gpu_buffer_create(r.device, (VkDeviceSize)CASES_INPUTS * cases_count() * 4,
                                       storage, GPU_MEMORY_READBACK, &r.out),
                     AG_OK);
    for (uint32_t i = 0; i < CASES_INPUTS; i++)
        cases_input(i, (float *)r.in.memory.mapped + 4 * i);
    make_pipeline(&r);
    make_set(&r);
    dispatch(&r);
    for (uint32_t id = 0; id < cases_count(); id++)
        compare(id, (const float *)r.out.memory.mapped + (size_t)id * CASES_INPUTS);
    destroy(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = { KIT_TEST(gpu_agrees_with_c) };
    return cmocka_run_group_tests(tests, kit_open, kit_close);
}
