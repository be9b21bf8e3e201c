// The subcommands of argand(1), one file each.
#ifndef CLI_COMMANDS_H
#define CLI_COMMANDS_H

#include "options.h"

#include <stddef.h>

// How the process ends; documented in argand(1).
typedef enum exit_code {
    EXIT_DONE = 0,
    EXIT_FAILED = 1, // one sentence on standard error says why
    EXIT_USAGE = 2,  // the command line makes no sense
} exit_code;

typedef struct command {
    const char *name;
    const char *operands; // "FILE|demo:NAME"
    const char *about;    // one line
    const char *lesson;   // what `argand help NAME` says below the usage; may be NULL
    option_tables options;
    const char *more;                        // what it says below the options; may be NULL
    const char *examples;                    // and last; may be NULL
    exit_code (*run)(int argc, char **argv); // arguments behind the command's name
} command;

extern const command command_render, command_reference, command_compare, command_validate,
    command_view, command_convert, command_info, command_devices, command_demo, command_help;

// Command `index`, NULL past the last.
const command *command_at(size_t index);

// The command of this name, or NULL.
const command *command_find(const char *name);

// Say on standard error that there is no such command, and which one may be meant.
exit_code command_unknown(const char *name);

// The few lines that `argand` alone prints.
void help_short(void);

// What `argand help NAME` and `argand NAME --help` print.
void help_command(const command *command);

#endif
