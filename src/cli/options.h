// Options of a command line, described by a table from which the parser, the help and the
// error messages all come.
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H

#include <stdbool.h>
#include <stddef.h>

// A word that an option takes, and the number it stands for; a list ends with NULL.
typedef struct choice {
    const char *word;
    int value;
} choice;

// Reads `value` into `field`.  NULL when all is well, else what is wrong with it, to stand
// behind "--size: '12'": "is not WxH".
typedef const char *option_reader(const char *value, void *field);

typedef struct option {
    const char *name;    // "--size"
    const char *letter;  // "-o", or NULL
    const char *value;   // how the help writes its value: "WxH"; NULL -> a switch
    const char *example; // a value that works, for the message
    const char *about;   // one line of help
    size_t offset;       // of the field in the command's options
    option_reader *read; // NULL with choices (an int field), or without a value (a bool field)
    const choice *choices;
    size_t seen_offset; // of a bool that says that the option was given; 0 = not wanted
} option;

// Tables of options, each ending with one without a name; the list of them ends with NULL.
typedef const option *option_tables[6];

typedef struct option_set {
    const struct command *command; // whose options they are
    void *fields;                  // where the offsets lead
    const char **operands;         // room for `operand_capacity` of them
    size_t operand_capacity, operand_count;
    bool help; // --help or -h was given; the rest is not looked at then
} option_set;

// Parse; false after one sentence on standard error.
bool options_parse(option_set *set, int argc, char **argv);

#endif
