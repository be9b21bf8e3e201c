// argand demo: the built-in scenes.
#include "commands.h"

#include <argand/argand.h>

#include <stdio.h>

static exit_code run(int argc, char **argv)
{
    option_set set = { .command = &command_demo };
    if (!options_parse(&set, argc, argv))
        return EXIT_USAGE;
    if (set.help) {
        help_command(&command_demo);
        return EXIT_DONE;
    }
    const char *name, *about;
    for (size_t i = 0; ag_scene_demo(i, &name, &about); i++)
        printf("demo:%-20s %s\n", name, about);
    return EXIT_DONE;
}

const command command_demo = {
    .name = "demo",
    .operands = "",
    .about = "list the built-in scenes",
    .examples = "  argand render demo:spheres -o spheres.png\n",
    .run = run,
};
