// Pictures and layers shown in a window of the application.
#include <argand/window.h>

#include "base/clock.h"
#include "base/log.h"
#include "gpu/swapchain.h"
#include "image/image.h"
#include "render/pixels.h"
#include "render/renderer.h"
#include "scene/picture.h"

#include <stdlib.h>
#include <string.h>

// An image on the device, and what it was made from.
typedef struct slot {
    gpu_image image;
    VkDescriptorSet set;
    uint64_t version;
} slot;

struct ag_window {
    ag_renderer *renderer;
    gpu_swapchain swapchain;
    gpu_commands commands;
    gpu_buffer staging;
    VkDescriptorPool pool;
    slot picture, layers[AG_LAYERS_MAX];
    bool has_picture;
};

// ---- Making one --------------------------------------------------------------

static ag_status make_surface(ag_window *w, const ag_window_desc *desc)
{
    gpu_device *device = w->renderer->device;
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (!device->windows)
        return log_fail(&device->log, AG_ERROR_ARGUMENT,
                        "the device was not opened for windows; set ag_device_desc.windows");
    int result = desc->create_surface(desc->user, device->instance, &surface);
    if (result != VK_SUCCESS)
        return log_fail(&device->log, AG_ERROR_DEVICE,
                        "no surface could be made of the window, Vulkan code %d", result);
    return gpu_swapchain_create(device, surface, &w->swapchain);
}

static ag_status make_sets(ag_window *w)
{
    enum { SETS = 1 + AG_LAYERS_MAX };
    gpu_device *device = w->renderer->device;
    const VkDescriptorPoolSize size = { VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, SETS };
    const VkDescriptorPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = SETS,
        .poolSizeCount = 1,
        .pPoolSizes = &size,
    };
    ag_status status =
        gpu_check(device, vkCreateDescriptorPool(device->device, &pool, NULL, &w->pool),
                  "vkCreateDescriptorPool");
    if (status)
        return status;
    VkDescriptorSetLayout layouts[SETS];
    VkDescriptorSet sets[SETS];
    for (int i = 0; i < SETS; i++)
        layouts[i] = w->renderer->bindings.picture_set;
    const VkDescriptorSetAllocateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
        .descriptorPool = w->pool,
        .descriptorSetCount = SETS,
        .pSetLayouts = layouts,
    };
    status = gpu_check(device, vkAllocateDescriptorSets(device->device, &info, sets),
                       "vkAllocateDescriptorSets");
    for (int i = 0; i < AG_LAYERS_MAX && !status; i++)
        w->layers[i].set = sets[i];
    if (!status)
        w->picture.set = sets[AG_LAYERS_MAX];
    return status;
}

ag_status ag_window_create(ag_renderer *renderer, const ag_window_desc *desc, ag_window **out)
{
    gpu_device *device = renderer->device;
    *out = NULL;
    ag_window *w = calloc(1, sizeof *w);
    if (!w)
        return log_fail(&device->log, AG_ERROR_MEMORY, "no memory for a window");
    w->renderer = renderer;
    ag_status status = make_surface(w, desc);
    if (!status)
        status = make_sets(w);
    if (!status)
        status = gpu_commands_create(device, &w->commands);
    if (status) {
        ag_window_destroy(w);
        return status;
    }
    *out = w;
    return AG_OK;
}

void ag_window_destroy(ag_window *w)
{
    if (!w)
        return;
    gpu_device *device = w->renderer->device;
    gpu_commands_destroy(device, &w->commands);
    gpu_swapchain_destroy(device, &w->swapchain);
    for (int i = 0; i < AG_LAYERS_MAX; i++)
        gpu_image_destroy(device, &w->layers[i].image);
    gpu_image_destroy(device, &w->picture.image);
    gpu_buffer_destroy(device, &w->staging);
    vkDestroyDescriptorPool(device->device, w->pool, NULL);
    free(w);
}

// ---- Images on the device ----------------------------------------------------

// Have an image of this size in the slot; what it showed is lost when it is made anew.
static ag_status fit_slot(ag_window *w, slot *s, uint32_t width, uint32_t height)
{
    gpu_device *device = w->renderer->device;
    if (s->image.image && s->image.desc.width == width && s->image.desc.height == height)
        return AG_OK;
    gpu_image_destroy(device, &s->image);
    s->version = 0;
    const gpu_image_desc desc = {
        .format = VK_FORMAT_R8G8B8A8_UNORM,
        .width = width,
        .height = height,
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
    };
    ag_status status = gpu_image_create(device, &desc, &s->image);
    if (status)
        return status;
    gpu_barrier_image(&w->commands, &s->image, GPU_ACCESS_NONE, GPU_ACCESS_SAMPLED);
    bindings_write_image(device, s->set, 0, s->image.view, w->renderer->bindings.linear);
    return AG_OK;
}

static bool fresh(const slot *s, const ag_layer *layer)
{
    return layer->version && s->version == layer->version &&
           s->image.desc.width == layer->image->width &&
           s->image.desc.height == layer->image->height;
}

static VkDeviceSize bytes_of(const ag_image *image)
{
    return (VkDeviceSize)image->width * image->height * 4;
}

static ag_status check_layers(const ag_window *w, const ag_show_options *show)
{
    const ag_log *log = &w->renderer->device->log;
    uint32_t limit = w->renderer->device->info.max_size;
    if (show->layer_count > AG_LAYERS_MAX)
        return log_fail(log, AG_ERROR_ARGUMENT, "%u layers are more than %d", show->layer_count,
                        AG_LAYERS_MAX);
    for (uint32_t i = 0; i < show->layer_count; i++) {
        const ag_image *image = show->layers[i].image;
        if (image && image->format != AG_FORMAT_RGBA8)
            return log_fail(log, AG_ERROR_ARGUMENT, "layer %u is no image of RGBA8", i);
        if (image && (image->width > limit || image->height > limit))
            return log_fail(log, AG_ERROR_ARGUMENT, "layer %u is larger than %u px", i, limit);
    }
    return AG_OK;
}

static void copy_to_slot(ag_window *w, slot *s, const ag_image *image, VkDeviceSize offset)
{
    memcpy((char *)w->staging.memory.mapped + offset, image->pixels, bytes_of(image));
    const VkBufferImageCopy region = {
        .bufferOffset = offset,
        .imageSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1 },
        .imageExtent = { image->width, image->height, 1 },
    };
    gpu_barrier_image(&w->commands, &s->image, GPU_ACCESS_SAMPLED, GPU_ACCESS_TRANSFER_WRITE);
    vkCmdCopyBufferToImage(w->commands.buffer, w->staging.buffer, s->image.image,
                           VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region);
    gpu_barrier_image(&w->commands, &s->image, GPU_ACCESS_TRANSFER_WRITE, GPU_ACCESS_SAMPLED);
}

// Bring the layers' images that are not yet there.
static ag_status bring_layers(ag_window *w, const ag_show_options *show)
{
    VkDeviceSize size = 0;
    for (uint32_t i = 0; i < show->layer_count; i++)
        if (show->layers[i].image && !fresh(&w->layers[i], &show->layers[i]))
            size += bytes_of(show->layers[i].image);
    ag_status status =
        gpu_buffer_ensure(w->renderer->device, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                          GPU_MEMORY_UPLOAD, &w->staging);
    VkDeviceSize offset = 0;
    for (uint32_t i = 0; i < show->layer_count && !status; i++) {
        const ag_layer *layer = &show->layers[i];
        slot *s = &w->layers[i];
        if (!layer->image || fresh(s, layer))
            continue;
        status = fit_slot(w, s, layer->image->width, layer->image->height);
        if (status)
            return status;
        copy_to_slot(w, s, layer->image, offset);
        offset += bytes_of(layer->image);
        s->version = layer->version;
    }
    return status;
}

// What was to be brought to them may not have come.
static void drop_layers(ag_window *w)
{
    ag_status status = gpu_commands_wait(w->renderer->device, &w->commands);
    (void)status; // a device that is lost does not use them either
    for (int i = 0; i < AG_LAYERS_MAX; i++) {
        gpu_image_destroy(w->renderer->device, &w->layers[i].image);
        w->layers[i].version = 0;
    }
}

// ---- Drawing -----------------------------------------------------------------

static void barrier_to_window(const ag_window *w, gpu_access before, gpu_access after)
{
    const gpu_swapchain *s = &w->swapchain;
    const gpu_image image = { .image = s->images[s->current],
                              .desc = { .format = s->format.format } };
    gpu_barrier_image(&w->commands, &image, before, after);
}

static int32_t clamp_px(float v, uint32_t limit)
{
    return !(v > 0) ? 0 : v < (float)limit ? (int32_t)v : (int32_t)limit;
}

static void set_clip(const ag_window *w, const float clip[4])
{
    const VkExtent2D e = w->swapchain.extent;
    VkRect2D area = { { 0, 0 }, e };
    if (clip[0] != 0 || clip[1] != 0 || clip[2] != 0 || clip[3] != 0) {
        int32_t left = clamp_px(clip[0], e.width), right = clamp_px(clip[2], e.width);
        int32_t top = clamp_px(clip[1], e.height), bottom = clamp_px(clip[3], e.height);
        area = (VkRect2D) { { left, top },
                            { (uint32_t)(right > left ? right - left : 0),
                              (uint32_t)(bottom > top ? bottom - top : 0) } };
    }
    vkCmdSetScissor(w->commands.buffer, 0, 1, &area);
}

static void draw_slot(const ag_window *w, const slot *s, const float place[4], const float clip[4],
                      float opacity)
{
    VkCommandBuffer cmd = w->commands.buffer;
    VkPipelineLayout layout = w->renderer->bindings.layers;
    const float x = 2 / (float)w->swapchain.extent.width;
    const float y = 2 / (float)w->swapchain.extent.height;
    const gpu_layer push = { { place[0] * x - 1, place[1] * y - 1, (place[0] + place[2]) * x - 1,
                               (place[1] + place[3]) * y - 1 },
                             opacity };
    set_clip(w, clip);
    vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &s->set, 0, NULL);
    vkCmdPushConstants(cmd, layout, VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                       sizeof push, &push);
    vkCmdDraw(cmd, 6, 1, 0, 0);
}

static void draw_all(const ag_window *w, const ag_show_options *show)
{
    static const float unclipped[4];
    const VkExtent2D e = w->swapchain.extent;
    const float whole[4] = { 0, 0, (float)e.width, (float)e.height };
    if (w->has_picture)
        draw_slot(w, &w->picture, whole, unclipped, 0);
    for (uint32_t i = 0; i < show->layer_count; i++) {
        const ag_layer *layer = &show->layers[i];
        if (!layer->image)
            continue;
        const float place[4] = { layer->x, layer->y,
                                 layer->width > 0 ? layer->width : (float)layer->image->width,
                                 layer->height > 0 ? layer->height : (float)layer->image->height };
        draw_slot(w, &w->layers[i], place, layer->clip, 1);
    }
}

static void begin_drawing(const ag_window *w, const float backdrop[3])
{
    VkCommandBuffer cmd = w->commands.buffer;
    const gpu_swapchain *s = &w->swapchain;
    const VkRenderingAttachmentInfo color = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = s->views[s->current],
        .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
        .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
        .clearValue.color.float32 = { backdrop[0], backdrop[1], backdrop[2], 1 },
    };
    const VkRenderingInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
        .renderArea = { { 0, 0 }, s->extent },
        .layerCount = 1,
        .colorAttachmentCount = 1,
        .pColorAttachments = &color,
    };
    const VkViewport viewport = { 0, 0, (float)s->extent.width, (float)s->extent.height, 0, 1 };
    vkCmdBeginRendering(cmd, &info);
    vkCmdSetViewport(cmd, 0, 1, &viewport);
    vkCmdSetCullMode(cmd, VK_CULL_MODE_NONE);
    vkCmdSetFrontFace(cmd, VK_FRONT_FACE_COUNTER_CLOCKWISE);
}

static ag_status record(ag_window *w, const ag_show_options *show)
{
    ag_renderer *r = w->renderer;
    const pipeline_key key = { .kind = PIPELINE_LAYER,
                               .format = w->swapchain.format.format,
                               .constants.samples = 1 };
    VkPipeline pipeline;
    ag_status status = pipelines_get(r->device, &r->bindings, &r->pipelines, &key, &pipeline);
    if (status)
        return status;
    gpu_access dropped = GPU_ACCESS_COLOR; // the same stage: after the image was acquired
    dropped.access = 0;
    dropped.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    const gpu_access shown = { VK_PIPELINE_STAGE_2_NONE, 0, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR };
    barrier_to_window(w, dropped, GPU_ACCESS_COLOR);
    begin_drawing(w, show->backdrop);
    vkCmdBindPipeline(w->commands.buffer, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    draw_all(w, show);
    vkCmdEndRendering(w->commands.buffer);
    barrier_to_window(w, GPU_ACCESS_COLOR, shown);
    return AG_OK;
}

// ---- Showing -----------------------------------------------------------------

// Bloom is made on the host; the picture comes back from there.
static ag_status bring_bloomed(ag_window *w, const ag_scene *scene, const ag_camera_desc *camera,
                               const ag_render_options *options, ag_render_stats *stats)
{
    gpu_device *device = w->renderer->device;
    ag_image *image;
    ag_status status = ag_renderer_render(w->renderer, scene, camera, options, &image, stats);
    if (status)
        return status;
    status = gpu_commands_begin(device, &w->commands); // waits for the last time
    if (!status)
        status = gpu_buffer_ensure(device, bytes_of(image), VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                   GPU_MEMORY_UPLOAD, &w->staging);
    if (!status) {
        copy_to_slot(w, &w->picture, image, 0);
        status = gpu_commands_submit(device, &w->commands);
    }
    ag_image_destroy(image);
    return status;
}

// Have an image of this size for the picture, ready to be drawn into.
static ag_status fit_picture(ag_window *w, uint32_t width, uint32_t height)
{
    gpu_device *device = w->renderer->device;
    ag_status status = gpu_commands_begin(device, &w->commands);
    if (!status)
        status = fit_slot(w, &w->picture, width, height);
    if (!status)
        status = gpu_commands_submit(device, &w->commands);
    if (status) // it may not be in the layout that it is taken to have
        gpu_image_destroy(device, &w->picture.image);
    return status;
}

static ag_status make_picture(ag_window *w, const ag_scene *scene, const ag_camera_desc *camera,
                              const ag_render_options *options, ag_render_stats *stats)
{
    gpu_device *device = w->renderer->device;
    ag_render_options checked = options ? *options : (ag_render_options) { 0 };
    checked.format = AG_FORMAT_RGBA8;
    ag_status status = picture_check(scene, &checked);
    if (!status &&
        (checked.width > device->info.max_size || checked.height > device->info.max_size))
        status = log_fail(&device->log, AG_ERROR_ARGUMENT,
                          "%ux%u px are more than the device shows at once, %u", checked.width,
                          checked.height, device->info.max_size);
    w->has_picture = false;
    if (!status)
        status = fit_picture(w, checked.width, checked.height);
    if (!status && checked.bloom > 0)
        status = bring_bloomed(w, scene, camera, &checked, stats);
    else if (!status)
        status = renderer_draw_into(w->renderer, scene, camera, &checked, &w->picture.image, stats);
    w->has_picture = !status;
    return status;
}

static ag_status present(ag_window *w, const ag_show_options *show)
{
    gpu_device *device = w->renderer->device;
    ag_status status = check_layers(w, show);
    if (status)
        return status;
    status = gpu_commands_begin(device, &w->commands); // waits for the last time
    if (!status)
        status = bring_layers(w, show);
    bool ready = false;
    if (!status)
        status = gpu_swapchain_acquire(device, &w->swapchain, show->width, show->height, &ready);
    if (!status && ready)
        status = record(w, show);
    if (!status)
        status = ready ? gpu_swapchain_present(device, &w->swapchain, &w->commands)
                       : gpu_commands_submit(device, &w->commands);
    if (status) {
        w->swapchain.stale = true; // an image may have been acquired in vain
        drop_layers(w);
    }
    return status;
}

ag_status ag_window_show(ag_window *w, const ag_scene *scene, const ag_camera_desc *camera,
                         const ag_render_options *options, const ag_show_options *show,
                         ag_render_stats *stats)
{
    ag_render_stats unwanted;
    if (!stats)
        stats = &unwanted;
    *stats = (ag_render_stats) { 0 };
    if (!show->width || !show->height)
        return AG_OK;
    ag_status status = scene ? make_picture(w, scene, camera, options, stats) : AG_OK;
    double start = clock_ms();
    if (!status)
        status = present(w, show);
    stats->show_ms = clock_ms() - start;
    return status;
}

// ---- Taking it back ------------------------------------------------------------

static ag_status read_picture(ag_window *w, const gpu_buffer *to)
{
    gpu_device *device = w->renderer->device;
    const gpu_image *from = &w->picture.image;
    ag_status status = gpu_commands_begin(device, &w->commands); // waits for the last time
    if (status)
        return status;
    const VkBufferImageCopy region = {
        .imageSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1 },
        .imageExtent = { from->desc.width, from->desc.height, 1 },
    };
    gpu_barrier_image(&w->commands, from, GPU_ACCESS_SAMPLED, GPU_ACCESS_TRANSFER_READ);
    vkCmdCopyImageToBuffer(w->commands.buffer, from->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           to->buffer, 1, &region);
    gpu_barrier_image(&w->commands, from, GPU_ACCESS_TRANSFER_READ, GPU_ACCESS_SAMPLED);
    gpu_barrier_memory(&w->commands, GPU_ACCESS_TRANSFER_WRITE, GPU_ACCESS_HOST_READ);
    status = gpu_commands_submit(device, &w->commands);
    return status ? status : gpu_commands_wait(device, &w->commands);
}

ag_status ag_window_picture(ag_window *w, ag_image **picture)
{
    gpu_device *device = w->renderer->device;
    gpu_buffer pixels = { 0 };
    *picture = NULL;
    if (!w->has_picture)
        return log_fail(&device->log, AG_ERROR_ARGUMENT, "the window shows no picture");
    const uint32_t width = w->picture.image.desc.width, height = w->picture.image.desc.height;
    ag_status status =
        gpu_buffer_create(device, (VkDeviceSize)width * height * 4,
                          VK_BUFFER_USAGE_TRANSFER_DST_BIT, GPU_MEMORY_READBACK, &pixels);
    if (!status)
        status = read_picture(w, &pixels);
    const ag_image_desc desc = { width, height, AG_FORMAT_RGBA8, NULL };
    if (!status)
        status = ag_image_create(&device->log, &desc, picture);
    if (!status)
        pixels_place(pixels.memory.mapped, (view_rect) { 0, 0, width, height }, *picture);
    gpu_buffer_destroy(device, &pixels);
    return status;
}
