// The list of subcommands.
#include "commands.h"

#include "text.h"

#include <stdio.h>
#include <string.h>

static const command *const list[] = {
    &command_view,    &command_render, &command_reference, &command_compare, &command_validate,
    &command_convert, &command_info,   &command_devices,   &command_demo,    &command_help,
};

const command *command_at(size_t index)
{
    return index < sizeof list / sizeof *list ? list[index] : NULL;
}

const command *command_find(const char *name)
{
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        if (strcmp(list[i]->name, name) == 0)
            return list[i];
    return NULL;
}

exit_code command_unknown(const char *name)
{
    const char *names[sizeof list / sizeof *list];
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        names[i] = list[i]->name;
    const char *near = text_nearest(name, names, sizeof list / sizeof *list);
    if (strchr(name, '.') || strchr(name, '/') || strncmp(name, "demo:", 5) == 0)
        fprintf(stderr, "argand: '%s' is not a command; try: argand render %s -o picture.png\n",
                name, name);
    else if (near)
        fprintf(stderr, "argand: '%s' is not a command; did you mean '%s'?\n", name, near);
    else
        fprintf(stderr, "argand: '%s' is not a command; `argand help` lists them.\n", name);
    return EXIT_USAGE;
}
