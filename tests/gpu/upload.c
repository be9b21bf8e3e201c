// What is uploaded is what the device has: buffers and images larger than a staging slot.
#include <stdlib.h>
#include <string.h>

#include "kit.h"

#include "gpu/upload.h"

static uint8_t byte_at(size_t i)
{
    return (uint8_t)(i * 2654435761u >> 13);
}

static uint8_t *pattern(size_t size)
{
    uint8_t *bytes = malloc(size);
    for (size_t i = 0; i < size; i++)
        bytes[i] = byte_at(i);
    return bytes;
}

static void buffer_arrives(void **state)
{
    gpu_device *device = *state;
    const size_t size = (20u << 20) + 17, offset = 12;
    uint8_t *bytes = pattern(size);
    gpu_buffer buffer;
    gpu_upload upload;
    assert_int_equal(gpu_buffer_create(device, size + offset, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                       GPU_MEMORY_READBACK, &buffer),
                     AG_OK);
    assert_int_equal(gpu_upload_begin(device, &upload), AG_OK);
    assert_int_equal(gpu_upload_buffer(&upload, &buffer, offset, bytes, size), AG_OK);
    assert_int_equal(gpu_upload_end(&upload), AG_OK);
    gpu_upload_finish(&upload);
    assert_memory_equal((char *)buffer.memory.mapped + offset, bytes, size);
    gpu_buffer_destroy(device, &buffer);
    free(bytes);
}

static void read_level(gpu_device *device, const gpu_image *image, uint32_t mip,
                       const gpu_buffer *to)
{
    gpu_commands commands;
    assert_int_equal(gpu_commands_create(device, &commands), AG_OK);
    assert_int_equal(gpu_commands_begin(device, &commands), AG_OK);
    gpu_barrier_image(&commands, image, GPU_ACCESS_SAMPLED, GPU_ACCESS_TRANSFER_READ);
    const VkBufferImageCopy region = {
        .imageSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, mip, 0, 1 },
        .imageExtent = { image->desc.width >> mip, image->desc.height >> mip, 1 },
    };
    vkCmdCopyImageToBuffer(commands.buffer, image->image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                           to->buffer, 1, &region);
    gpu_barrier_image(&commands, image, GPU_ACCESS_TRANSFER_READ, GPU_ACCESS_SAMPLED);
    gpu_barrier_memory(&commands, GPU_ACCESS_TRANSFER_WRITE, GPU_ACCESS_HOST_READ);
    assert_int_equal(gpu_commands_submit(device, &commands), AG_OK);
    assert_int_equal(gpu_commands_wait(device, &commands), AG_OK);
    gpu_commands_destroy(device, &commands);
}

static void image_arrives(void **state)
{
    gpu_device *device = *state;
    const uint32_t width = 2600, height = 1800;
    const size_t sizes[2] = { (size_t)width * height * 4, (size_t)(width / 2) * (height / 2) * 4 };
    uint8_t *bytes = pattern(sizes[0]);
    const gpu_image_desc desc = {
        .format = VK_FORMAT_R8G8B8A8_UNORM,
        .width = width,
        .height = height,
        .mips = 2,
        .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
                 VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
    };
    gpu_image image;
    gpu_buffer back;
    gpu_upload upload;
    assert_int_equal(gpu_image_create(device, &desc, &image), AG_OK);
    assert_int_equal(gpu_buffer_create(device, sizes[0], VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                       GPU_MEMORY_READBACK, &back),
                     AG_OK);
    assert_int_equal(gpu_upload_begin(device, &upload), AG_OK);
    gpu_upload_image_begin(&upload, &image);
    for (uint32_t mip = 0; mip < 2; mip++)
        assert_int_equal(gpu_upload_image_level(&upload, &image, mip, 0, 4, bytes + mip), AG_OK);
    gpu_upload_image_end(&upload, &image);
    assert_int_equal(gpu_upload_end(&upload), AG_OK);
    gpu_upload_finish(&upload);
    for (uint32_t mip = 0; mip < 2; mip++) {
        read_level(device, &image, mip, &back);
        assert_memory_equal(back.memory.mapped, bytes + mip, sizes[mip]);
    }
    gpu_image_destroy(device, &image);
    gpu_buffer_destroy(device, &back);
    free(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = { KIT_TEST(buffer_arrives), KIT_TEST(image_arrives) };
    return cmocka_run_group_tests(tests, kit_open, kit_close);
}
