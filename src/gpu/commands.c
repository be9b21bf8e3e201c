// Commands: recorded, submitted, waited for.
#include "gpu/commands.h"

const gpu_access GPU_ACCESS_NONE = { VK_PIPELINE_STAGE_2_NONE, 0, VK_IMAGE_LAYOUT_UNDEFINED };
const gpu_access GPU_ACCESS_COLOR = {
    VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT,
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
};
const gpu_access GPU_ACCESS_DEPTH = {
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
};
const gpu_access GPU_ACCESS_SAMPLED = {
    VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    VK_ACCESS_2_SHADER_SAMPLED_READ_BIT,
    VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
};
const gpu_access GPU_ACCESS_TRANSFER_READ = {
    VK_PIPELINE_STAGE_2_COPY_BIT,
    VK_ACCESS_2_TRANSFER_READ_BIT,
    VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
};
const gpu_access GPU_ACCESS_TRANSFER_WRITE = {
    VK_PIPELINE_STAGE_2_COPY_BIT,
    VK_ACCESS_2_TRANSFER_WRITE_BIT,
    VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
};
const gpu_access GPU_ACCESS_HOST_READ = {
    VK_PIPELINE_STAGE_2_HOST_BIT,
    VK_ACCESS_2_HOST_READ_BIT,
    VK_IMAGE_LAYOUT_UNDEFINED,
};
const gpu_access GPU_ACCESS_COMPUTE_WRITE = {
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    VK_ACCESS_2_SHADER_WRITE_BIT,
    VK_IMAGE_LAYOUT_UNDEFINED,
};
const gpu_access GPU_ACCESS_GEOMETRY = {
    VK_PIPELINE_STAGE_2_VERTEX_INPUT_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
        VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_2_INDEX_READ_BIT |
        VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_UNIFORM_READ_BIT,
    VK_IMAGE_LAYOUT_UNDEFINED,
};

ag_status gpu_commands_create(gpu_device *device, gpu_commands *commands)
{
    *commands = (gpu_commands) { 0 };
    const VkCommandBufferAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
        .commandPool = device->command_pool,
        .level = VK_COMMAND_BUFFER_LEVEL_PRIMARY,
        .commandBufferCount = 1,
    };
    ag_status status =
        gpu_check(device, vkAllocateCommandBuffers(device->device, &info, &commands->buffer),
                  "vkAllocateCommandBuffers");
    if (status)
        return status;
    const VkFenceCreateInfo fence = { .sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO };
    status = gpu_check(device, vkCreateFence(device->device, &fence, NULL, &commands->fence),
                       "vkCreateFence");
    if (status)
        gpu_commands_destroy(device, commands);
    return status;
}

void gpu_commands_destroy(gpu_device *device, gpu_commands *commands)
{
    if (commands->pending)
        vkWaitForFences(device->device, 1, &commands->fence, VK_TRUE, UINT64_MAX);
    vkDestroyFence(device->device, commands->fence, NULL);
    if (commands->buffer)
        vkFreeCommandBuffers(device->device, device->command_pool, 1, &commands->buffer);
    *commands = (gpu_commands) { 0 };
}

ag_status gpu_commands_wait(gpu_device *device, gpu_commands *commands)
{
    if (!commands->pending)
        return AG_OK;
    commands->pending = false;
    ag_status status =
        gpu_check(device, vkWaitForFences(device->device, 1, &commands->fence, VK_TRUE, UINT64_MAX),
                  "vkWaitForFences");
    if (status)
        return status;
    return gpu_check(device, vkResetFences(device->device, 1, &commands->fence), "vkResetFences");
}

ag_status gpu_commands_begin(gpu_device *device, gpu_commands *commands)
{
    ag_status status = gpu_commands_wait(device, commands);
    // What was recorded before may have been given up half-way.
    if (!status)
        status =
            gpu_check(device, vkResetCommandBuffer(commands->buffer, 0), "vkResetCommandBuffer");
    if (status)
        return status;
    const VkCommandBufferBeginInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
        .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT,
    };
    return gpu_check(device, vkBeginCommandBuffer(commands->buffer, &info), "vkBeginCommandBuffer");
}

ag_status gpu_commands_submit(gpu_device *device, gpu_commands *commands)
{
    return gpu_commands_submit_between(device, commands, VK_NULL_HANDLE, VK_NULL_HANDLE);
}

ag_status gpu_commands_submit_between(gpu_device *device, gpu_commands *commands,
                                      VkSemaphore before, VkSemaphore after)
{
    ag_status status =
        gpu_check(device, vkEndCommandBuffer(commands->buffer), "vkEndCommandBuffer");
    if (status)
        return status;
    const VkCommandBufferSubmitInfo buffer = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
        .commandBuffer = commands->buffer,
    };
    const VkSemaphoreSubmitInfo wait = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
        .semaphore = before,
        .stageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    };
    const VkSemaphoreSubmitInfo signal = {
        .sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO,
        .semaphore = after,
        .stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
    };
    const VkSubmitInfo2 info = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
        .waitSemaphoreInfoCount = before ? 1 : 0,
        .pWaitSemaphoreInfos = &wait,
        .signalSemaphoreInfoCount = after ? 1 : 0,
        .pSignalSemaphoreInfos = &signal,
        .commandBufferInfoCount = 1,
        .pCommandBufferInfos = &buffer,
    };
    VkResult result = vkQueueSubmit2(device->queue, 1, &info, commands->fence);
    status = gpu_check(device, result, "vkQueueSubmit2");
    commands->pending = !status;
    return status;
}

void gpu_barrier_image(const gpu_commands *commands, const gpu_image *image, gpu_access before,
                       gpu_access after)
{
    const VkImageMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = before.stage,
        .srcAccessMask = before.access,
        .dstStageMask = after.stage,
        .dstAccessMask = after.access,
        .oldLayout = before.layout,
        .newLayout = after.layout,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image->image,
        .subresourceRange = { gpu_format_aspect(image->desc.format), 0, VK_REMAINING_MIP_LEVELS, 0,
                              VK_REMAINING_ARRAY_LAYERS },
    };
    const VkDependencyInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .imageMemoryBarrierCount = 1,
        .pImageMemoryBarriers = &barrier,
    };
    vkCmdPipelineBarrier2(commands->buffer, &info);
}

void gpu_barrier_memory(const gpu_commands *commands, gpu_access before, gpu_access after)
{
    const VkMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = before.stage,
        .srcAccessMask = before.access,
        .dstStageMask = after.stage,
        .dstAccessMask = after.access,
    };
    const VkDependencyInfo info = {
        .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
        .memoryBarrierCount = 1,
        .pMemoryBarriers = &barrier,
    };
    vkCmdPipelineBarrier2(commands->buffer, &info);
}
