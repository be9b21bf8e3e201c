// Is a file one JSON value with these parts in it?
//
//   json_has FILE key.key.0[=value]...
#include <jansson.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const json_t *step_into(const json_t *from, const char *key)
{
    if (json_is_array(from))
        return json_array_get(from, strtoul(key, NULL, 10));
    return json_object_get(from, key);
}

static const json_t *find(const json_t *from, char *path)
{
    char *rest;
    for (char *key = strtok_r(path, ".", &rest); key && from; key = strtok_r(NULL, ".", &rest))
        from = step_into(from, key);
    return from;
}

static bool is_value(const json_t *json, const char *wanted)
{
    if (json_is_string(json))
        return strcmp(json_string_value(json), wanted) == 0;
    char *text = json_dumps(json, JSON_ENCODE_ANY);
    bool same = text && strcmp(text, wanted) == 0;
    free(text);
    return same;
}

static bool check(const json_t *root, char *wanted)
{
    char *value = strchr(wanted, '=');
    if (value)
        *value++ = 0;
    char path[256];
    snprintf(path, sizeof path, "%s", wanted);
    const json_t *json = find(root, path);
    if (!json || json_is_null(json))
        fprintf(stderr, "%s is missing\n", wanted);
    else if (value && !is_value(json, value))
        fprintf(stderr, "%s is not %s\n", wanted, value);
    else
        return true;
    return false;
}

int main(int argc, char **argv)
{
    json_error_t error;
    json_t *root = json_load_file(argv[1], JSON_REJECT_DUPLICATES, &error);
    if (!root) {
        fprintf(stderr, "%s: line %d: %s\n", argv[1], error.line, error.text);
        return 1;
    }
    bool good = true;
    for (int i = 2; i < argc; i++)
        good = check(root, argv[i]) && good;
    json_decref(root);
    return good ? 0 : 1;
}
