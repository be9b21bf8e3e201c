// argand help: what there is and how it is used.
#include "commands.h"

#include <stdio.h>
#include <string.h>

void help_short(void)
{
    fputs("usage: argand render FILE -o PICTURE   a picture of a glTF file\n"
          "       argand render demo:spheres -o PICTURE\n"
          "       argand view FILE                the same in a window\n"
          "       argand info FILE                what is in it\n"
          "       argand help [COMMAND]           everything else\n",
          stderr);
}

static void help_all(void)
{
    fputs("Argand makes physically based pictures of glTF files.\n\nusage: argand COMMAND ...\n\n",
          stdout);
    const command *c;
    for (size_t i = 0; (c = command_at(i)); i++)
        printf("  %-9s %s\n", c->name, c->about);
    fputs("\n  argand help COMMAND   teaches one of them\n"
          "  argand --version      prints the version\n"
          "\nexit codes: 0 done, 1 failed (one sentence on standard error says why), 2 bad usage\n",
          stdout);
}

static void print_option(const option *o)
{
    char left[48];
    snprintf(left, sizeof left, "%s%s%s%s%s", o->letter ? o->letter : "", o->letter ? ", " : "",
             o->name, o->value ? " " : "", o->value ? o->value : "");
    if (strlen(left) <= 26)
        printf("  %-26s %s\n", left, o->about);
    else
        printf("  %s\n  %-26s %s\n", left, "", o->about);
}

void help_command(const command *c)
{
    printf("usage: argand %s%s%s%s\n\nargand %s: %s.\n", c->name, *c->operands ? " " : "",
           c->operands, *c->options ? " [OPTION]..." : "", c->name, c->about);
    if (c->lesson)
        printf("\n%s", c->lesson);
    if (*c->options)
        puts("\noptions:");
    for (const option *const *table = c->options; *table; table++)
        for (const option *o = *table; o->name; o++)
            print_option(o);
    if (c->more)
        printf("\n%s", c->more);
    if (c->examples)
        printf("\nexamples:\n%s", c->examples);
}

static exit_code run(int argc, char **argv)
{
    const char *name = NULL;
    option_set set = {
        .command = &command_help,
        .operands = &name,
        .operand_capacity = 1,
    };
    if (!options_parse(&set, argc, argv))
        return EXIT_USAGE;
    const command *c = set.help ? &command_help : name ? command_find(name) : NULL;
    if (name && !c)
        return command_unknown(name);
    if (c)
        help_command(c);
    else
        help_all();
    return EXIT_DONE;
}

const command command_help = {
    .name = "help",
    .operands = "[COMMAND]",
    .about = "teach a command, with examples",
    .run = run,
};
