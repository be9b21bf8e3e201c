// argand devices: what can compute.
#include "commands.h"
#include "console.h"
#include "json.h"

#include <stdio.h>
#include <stdlib.h>

typedef struct devices_request {
    bool json;
} devices_request;

static const option options[] = {
    { "--json", NULL, NULL, "", "print one JSON object", offsetof(devices_request, json), NULL,
      NULL, 0 },
    { 0 },
};

static const char *kind_name(ag_device_kind kind)
{
    switch (kind) {
    case AG_DEVICE_DISCRETE: return "discrete";
    case AG_DEVICE_INTEGRATED: return "integrated";
    case AG_DEVICE_VIRTUAL: return "virtual";
    case AG_DEVICE_CPU: return "cpu";
    default: return "other";
    }
}

static void print_text(const ag_device_info *infos, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const ag_device_info *d = &infos[i];
        printf("%zu  %s (%s), %s\n", i, d->name, kind_name(d->kind), d->driver);
        if (d->usable)
            printf("   %.1f GiB, pictures up to %ux%u pixels without tiles\n",
                   (double)d->memory_bytes / 1073741824.0, d->max_size, d->max_size);
        else
            printf("   not usable: it lacks %s\n", d->missing);
    }
}

static void print_json(const ag_device_info *infos, size_t count)
{
    json j = { .file = stdout };
    json_open(&j, NULL, '{');
    json_open(&j, "devices", '[');
    for (size_t i = 0; i < count; i++) {
        const ag_device_info *d = &infos[i];
        json_open(&j, NULL, '{');
        json_text(&j, "name", d->name);
        json_text(&j, "driver", d->driver);
        json_text(&j, "kind", kind_name(d->kind));
        json_bool(&j, "usable", d->usable);
        json_text(&j, "missing", d->usable ? NULL : d->missing);
        json_count(&j, "max_size", d->max_size);
        json_count(&j, "memory_bytes", d->memory_bytes);
        json_close(&j, '}');
    }
    json_close(&j, ']');
    json_close(&j, '}');
}

static ag_status list(const ag_log *log, bool as_json)
{
    size_t count = 0;
    ag_status status = ag_device_list(log, NULL, 0, &count);
    if (status)
        return status;
    size_t capacity = count;
    ag_device_info *infos = calloc(capacity + 1, sizeof *infos);
    if (!infos)
        return AG_ERROR_MEMORY;
    status = ag_device_list(log, infos, capacity, &count);
    if (count > capacity)
        count = capacity;
    if (!status && as_json)
        print_json(infos, count);
    else if (!status)
        print_text(infos, count);
    free(infos);
    return status;
}

static exit_code run(int argc, char **argv)
{
    devices_request request = { 0 };
    option_set set = {
        .command = &command_devices,
        .fields = &request,
    };
    if (!options_parse(&set, argc, argv))
        return EXIT_USAGE;
    if (set.help) {
        help_command(&command_devices);
        return EXIT_DONE;
    }
    console shown;
    console_init(&shown, AG_LOG_WARNING, false);
    ag_log log = console_log(&shown);
    ag_status status = list(&log, request.json);
    console_finish(&shown);
    return status ? EXIT_FAILED : EXIT_DONE;
}

const command command_devices = {
    .name = "devices",
    .operands = "",
    .about = "list the Vulkan devices; their numbers serve --device",
    .options = { options },
    .run = run,
};
