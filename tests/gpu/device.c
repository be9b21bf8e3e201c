// Devices: listing, choosing, refusing.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kit.h"

#include "gpu/buffer.h"
#include "gpu/instance.h"

static char said[1024];

static void remember(void *user, ag_log_level level, const char *sentence)
{
    (void)user;
    if (level == AG_LOG_ERROR)
        snprintf(said, sizeof said, "%s", sentence);
}

static const ag_log memory_log = { .write = remember };

static void list_counts_and_fills(void **state)
{
    (void)state;
    ag_device_info infos[GPU_DEVICES_MAX];
    size_t count, again;
    assert_int_equal(ag_device_list(NULL, NULL, 0, &count), AG_OK);
    assert_true(count >= 1);
    assert_int_equal(ag_device_list(NULL, infos, GPU_DEVICES_MAX, &again), AG_OK);
    assert_int_equal(again, count);
    for (size_t i = 0; i < count; i++) {
        assert_true(infos[i].name[0]);
        assert_int_equal(infos[i].usable, infos[i].missing[0] == 0);
    }
}

static const ag_device_info shelf[] = {
    { .name = "llvmpipe (LLVM)", .kind = AG_DEVICE_CPU, .usable = true },
    { .name = "Integrated", .kind = AG_DEVICE_INTEGRATED, .usable = true },
    { .name = "Big GPU", .kind = AG_DEVICE_DISCRETE, .usable = true },
    { .name = "Old GPU", .kind = AG_DEVICE_DISCRETE, .missing = "Vulkan 1.3" },
};

static uint32_t choose(const char *select, uint32_t count)
{
    uint32_t index = 99;
    ag_status status = gpu_device_select(&memory_log, select, shelf, count, &index);
    return status ? 100 : index;
}

static void selection(void **state)
{
    (void)state;
    assert_int_equal(choose(NULL, 4), 2);
    assert_int_equal(choose("auto", 2), 1);
    assert_int_equal(choose("auto", 1), 0);
    assert_int_equal(choose("cpu", 4), 0);
    assert_int_equal(choose("1", 4), 1);
    assert_int_equal(choose("BIG", 4), 2);
    assert_int_equal(choose("gpu", 4), 2); // the usable one of two
    assert_int_equal(choose("old", 4), 100);
    assert_non_null(strstr(said, "Vulkan 1.3"));
    assert_int_equal(choose("no such", 4), 100);
    assert_non_null(strstr(said, "no such"));
    assert_int_equal(choose("7", 4), 100);
    assert_int_equal(choose("", 4), 2);
}

static void unknown_device_is_refused(void **state)
{
    (void)state;
    const ag_device_desc desc = { .log = &memory_log, .select = "no such device" };
    ag_device *device = (ag_device *)&desc;
    assert_int_equal(ag_device_create(&desc, &device), AG_ERROR_DEVICE);
    assert_null(device);
    assert_non_null(strstr(said, "argand devices"));
}

// Blocks are shared, freed when empty, and pieces never overlap.
static void memory_pieces_are_apart(void **state)
{
    gpu_device *device = *state;
    enum { COUNT = 200 };
    gpu_buffer buffers[COUNT];
    for (int i = 0; i < COUNT; i++) {
        VkDeviceSize size = (VkDeviceSize)(i % 7 + 1) * 100000;
        assert_int_equal(gpu_buffer_create(device, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                           GPU_MEMORY_UPLOAD, &buffers[i]),
                         AG_OK);
        memset(buffers[i].memory.mapped, i, size);
    }
    for (int i = 0; i < COUNT; i++) {
        const unsigned char *bytes = buffers[i].memory.mapped;
        assert_int_equal(bytes[0], i);
        assert_int_equal(bytes[buffers[i].size - 1], i);
    }
    for (int i = 0; i < COUNT; i++)
        gpu_buffer_destroy(device, &buffers[(i * 37) % COUNT]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        KIT_TEST(list_counts_and_fills),
        KIT_TEST(selection),
        KIT_TEST(unknown_device_is_refused),
        KIT_TEST(memory_pieces_are_apart),
    };
    return cmocka_run_group_tests(tests, kit_open, kit_close);
}
