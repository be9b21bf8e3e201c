// Faults of a device on demand: stands before Vulkan, in a test program or by LD_PRELOAD.
//
// The file that $ARGAND_TEST_FAULT names says which call fails and how, "vkQueueSubmit2 -4"; the
// call takes the file away, so that it fails once.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <vulkan/vulkan.h>

// VK_SUCCESS: none is due.
static VkResult fault_of(const char *call)
{
    const char *path = getenv("ARGAND_TEST_FAULT");
    FILE *file = path ? fopen(path, "r") : NULL;
    if (!file)
        return VK_SUCCESS;
    char name[64] = "";
    int code = 0, read = fscanf(file, "%63s %d", name, &code);
    fclose(file);
    if (read != 2 || strcmp(name, call) != 0 || unlink(path) != 0)
        return VK_SUCCESS;
    return (VkResult)code;
}

static void *next(const char *call)
{
    return dlsym(RTLD_NEXT, call);
}

VkResult vkQueueSubmit2(VkQueue queue, uint32_t count, const VkSubmitInfo2 *submits, VkFence fence)
{
    VkResult fault = fault_of("vkQueueSubmit2");
    return fault ? fault
                 : ((PFN_vkQueueSubmit2)next("vkQueueSubmit2"))(queue, count, submits, fence);
}

VkResult vkAcquireNextImageKHR(VkDevice device, VkSwapchainKHR swapchain, uint64_t timeout,
                               VkSemaphore semaphore, VkFence fence, uint32_t *index)
{
    VkResult fault = fault_of("vkAcquireNextImageKHR");
    return fault ? fault
                 : ((PFN_vkAcquireNextImageKHR)next("vkAcquireNextImageKHR"))(
                       device, swapchain, timeout, semaphore, fence, index);
}

// What is presented out of date is waited for all the same.
VkResult vkQueuePresentKHR(VkQueue queue, const VkPresentInfoKHR *info)
{
    VkResult fault = fault_of("vkQueuePresentKHR");
    VkResult result = ((PFN_vkQueuePresentKHR)next("vkQueuePresentKHR"))(queue, info);
    return fault ? fault : result;
}
