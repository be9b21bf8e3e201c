// Lights of the command line: 'sphere at=0,2,1 radius=0.1 intensity=100'.
#ifndef CLI_LIGHTS_H
#define CLI_LIGHTS_H

#include <argand/argand.h>

enum { LIGHTS_MOST = 256 };

typedef struct light_list {
    ag_light_desc lights[LIGHTS_MOST];
    size_t count;
    char complaint[400]; // about the last one that could not be read
} light_list;

// Reads a kind and its keys, parted by blanks, and appends a light to `field`, a light_list.
// An option_reader (options.h).
const char *lights_read(const char *value, void *field);

// The word for a kind, and the unit of its intensity.
const char *light_kind_word(ag_light_kind kind);
const char *light_unit(ag_light_kind kind);

// What `argand help render` teaches about them.
extern const char lights_lesson[];

#endif
