// A device under validation for tests; any message of the layer fails the test.
#ifndef TESTS_GPU_KIT_H
#define TESTS_GPU_KIT_H

#include <argand/argand.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

// For cmocka's group setup and teardown.  $ARGAND_TEST_DEVICE chooses another device.
static inline int kit_open(void **state)
{
    const char *select = getenv("ARGAND_TEST_DEVICE");
    const ag_device_desc desc = { .select = select ? select : "cpu", .validate = true };
    ag_device *device;
    if (ag_device_create(&desc, &device) != AG_OK)
        return -1;
    *state = device;
    return 0;
}

static inline int kit_close(void **state)
{
    ag_device *device = *state;
    uint32_t messages = ag_device_validation_messages(device);
    ag_device_destroy(device);
    if (messages)
        print_error("the validation layer gave %u messages\n", messages);
    return messages ? -1 : 0;
}

// After every test, so that the message is blamed on the right one.
static inline int kit_check(void **state)
{
    uint32_t messages = ag_device_validation_messages(*state);
    if (messages)
        print_error("the validation layer gave %u messages\n", messages);
    return messages ? -1 : 0;
}

#define KIT_TEST(function) cmocka_unit_test_setup_teardown(function, NULL, kit_check)

#endif
