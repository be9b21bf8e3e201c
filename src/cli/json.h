// Writes JSON to a stream; an object a line deep is enough to read by eye.
#ifndef CLI_JSON_H
#define CLI_JSON_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef struct json {
    FILE *file;
    unsigned depth;
    bool filled; // something stands before in the innermost object or array
} json;

// `key` NULL inside an array and for the outermost value.
void json_open(json *j, const char *key, char bracket);     // '{' or '['
void json_close(json *j, char bracket);                     // '}' or ']'
void json_text(json *j, const char *key, const char *text); // NULL -> null
void json_real(json *j, const char *key, double value);     // null when it is not finite
void json_count(json *j, const char *key, uint64_t value);
void json_bool(json *j, const char *key, bool value);

#endif
