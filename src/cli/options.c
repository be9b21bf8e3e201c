// Options of a command line: --name value, --name=value, -n value, operands, and "--"
// behind which everything is an operand.
#include "options.h"

#include "commands.h"
#include "text.h"

#include <stdio.h>
#include <string.h>

enum { MOST_OPTIONS = 64 };

typedef struct cursor {
    int argc, next;
    char **argv;
} cursor;

static bool is_word(const char *word, const char *name, size_t length)
{
    return word && strlen(word) == length && strncmp(word, name, length) == 0;
}

static const option *find(const option_set *set, const char *name, size_t length)
{
    for (const option *const *table = set->command->options; *table; table++)
        for (const option *o = *table; o->name; o++)
            if (is_word(o->name, name, length) || is_word(o->letter, name, length))
                return o;
    return NULL;
}

static bool unknown(const option_set *set, const char *name, size_t length)
{
    const char *names[MOST_OPTIONS];
    size_t count = 0;
    for (const option *const *table = set->command->options; *table; table++)
        for (const option *o = *table; o->name && count < MOST_OPTIONS; o++)
            names[count++] = o->name;
    char word[64];
    snprintf(word, sizeof word, "%.*s", (int)length, name);
    const char *near = text_nearest(word, names, count);
    if (near)
        fprintf(stderr, "argand: %s: there is no option '%s'; did you mean '%s'?\n",
                set->command->name, word, near);
    else
        fprintf(stderr, "argand: %s: there is no option '%s'; `argand help %s` lists them.\n",
                set->command->name, word, set->command->name);
    return false;
}

// An example with a character that the shell takes for itself is quoted.
static const char *quote_for(const option *o)
{
    return strpbrk(o->example, "# ") ? "'" : "";
}

static bool refuse(const option *o, const char *value, const char *complaint)
{
    const char *quote = quote_for(o);
    fprintf(stderr, "argand: %s: '%s' %s; try %s %s%s%s\n", o->name, value, complaint, o->name,
            quote, o->example, quote);
    return false;
}

static bool read_choice(const option *o, const char *value, int *field)
{
    char all[256];
    size_t used = 0;
    for (const choice *c = o->choices; c->word; c++) {
        if (strcmp(c->word, value) == 0) {
            *field = c->value;
            return true;
        }
        const char *between = c == o->choices ? "" : c[1].word ? ", " : " or ";
        used += (size_t)snprintf(all + used, sizeof all - used, "%s%s", between, c->word);
        if (used >= sizeof all)
            used = sizeof all - 1;
    }
    char complaint[300];
    snprintf(complaint, sizeof complaint, "is not one of %s", all);
    return refuse(o, value, complaint);
}

static bool apply(const option_set *set, const option *o, const char *value)
{
    char *field = (char *)set->fields + o->offset;
    if (o->seen_offset)
        *(bool *)((char *)set->fields + o->seen_offset) = true;
    if (!o->value) {
        *(bool *)field = true;
        return true;
    }
    if (o->choices)
        return read_choice(o, value, (int *)field);
    const char *complaint = o->read(value, field);
    return complaint ? refuse(o, value, complaint) : true;
}

static bool parse_option(option_set *set, cursor *at)
{
    const char *argument = at->argv[at->next++];
    const char *equals = strncmp(argument, "--", 2) == 0 ? strchr(argument, '=') : NULL;
    size_t length = equals ? (size_t)(equals - argument) : strlen(argument);
    const option *o = find(set, argument, length);
    if (!o)
        return unknown(set, argument, length);
    if (!o->value && equals) {
        fprintf(stderr, "argand: %s takes no value.\n", o->name);
        return false;
    }
    if (!o->value || equals)
        return apply(set, o, equals ? equals + 1 : NULL);
    // A negative number is a value, another option is not.
    if (at->next >= at->argc || strncmp(at->argv[at->next], "--", 2) == 0) {
        const char *quote = quote_for(o);
        fprintf(stderr, "argand: %s needs a value; try %s %s%s%s\n", o->name, o->name, quote,
                o->example, quote);
        return false;
    }
    return apply(set, o, at->argv[at->next++]);
}

static bool wants_help(int argc, char **argv)
{
    for (int i = 0; i < argc && strcmp(argv[i], "--") != 0; i++)
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0)
            return true;
    return false;
}

static bool add_operand(option_set *set, const char *operand)
{
    if (set->operand_count < set->operand_capacity) {
        set->operands[set->operand_count++] = operand;
        return true;
    }
    fprintf(stderr, "argand: %s: '%s' is one argument too many; `argand help %s` tells more.\n",
            set->command->name, operand, set->command->name);
    return false;
}

bool options_parse(option_set *set, int argc, char **argv)
{
    set->operand_count = 0;
    set->help = wants_help(argc, argv);
    cursor at = { argc, 0, argv };
    bool only_operands = false;
    while (!set->help && at.next < argc) {
        const char *argument = argv[at.next];
        if (!only_operands && strcmp(argument, "--") == 0) {
            only_operands = true;
            at.next++;
        } else if (!only_operands && argument[0] == '-' && argument[1]) {
            if (!parse_option(set, &at))
                return false;
        } else if (!add_operand(set, argv[at.next++])) {
            return false;
        }
    }
    return true;
}
