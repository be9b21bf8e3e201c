// Writes JSON (RFC 8259) to a stream.
#include "json.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

// The length of the UTF-8 sequence at `s` (RFC 3629, section 4), 0 when it is none.
static size_t sequence(const unsigned char *s)
{
    size_t length = s[0] < 0x80                   ? 1
                    : s[0] >= 0xc2 && s[0] < 0xe0 ? 2
                    : s[0] >= 0xe0 && s[0] < 0xf0 ? 3
                    : s[0] >= 0xf0 && s[0] < 0xf5 ? 4
                                                  : 0;
    for (size_t i = 1; i < length; i++)
        if ((s[i] & 0xc0) != 0x80)
            return 0;
    bool overlong = (s[0] == 0xe0 && s[1] < 0xa0) || (s[0] == 0xf0 && s[1] < 0x90);
    bool surrogate = s[0] == 0xed && s[1] >= 0xa0;
    bool beyond = s[0] == 0xf4 && s[1] >= 0x90;
    return overlong || surrogate || beyond ? 0 : length;
}

static void write_string(FILE *file, const char *text)
{
    const unsigned char *s = (const unsigned char *)text;
    fputc('"', file);
    while (*s) {
        size_t length = sequence(s);
        if (length == 0)
            fputs("\\ufffd", file); // a file's name may hold any bytes
        else if (*s == '"' || *s == '\\')
            fprintf(file, "\\%c", *s);
        else if (*s == '<')
            fputs("\\u003c", file); // lest the text end a script that it stands in
        else if (*s < 0x20 || *s == 0x7f)
            fprintf(file, "\\u%04x", *s);
        else
            fwrite(s, 1, length, file);
        s += length ? length : 1;
    }
    fputc('"', file);
}

static void indent(json *j)
{
    fputc('\n', j->file);
    for (unsigned i = 0; i < j->depth; i++)
        fputs("  ", j->file);
}

static void begin(json *j, const char *key)
{
    if (j->filled)
        fputc(',', j->file);
    if (j->depth)
        indent(j);
    j->filled = true;
    if (key) {
        write_string(j->file, key);
        fputs(": ", j->file);
    }
}

void json_open(json *j, const char *key, char bracket)
{
    begin(j, key);
    fputc(bracket, j->file);
    j->depth++;
    j->filled = false;
}

void json_close(json *j, char bracket)
{
    j->depth--;
    if (j->filled)
        indent(j);
    fputc(bracket, j->file);
    if (j->depth == 0)
        fputc('\n', j->file);
    j->filled = true;
}

void json_text(json *j, const char *key, const char *text)
{
    begin(j, key);
    if (text)
        write_string(j->file, text);
    else
        fputs("null", j->file);
}

void json_real(json *j, const char *key, double value)
{
    begin(j, key);
    if (isfinite(value))
        fprintf(j->file, "%.6g", value);
    else
        fputs("null", j->file);
}

void json_count(json *j, const char *key, uint64_t value)
{
    begin(j, key);
    fprintf(j->file, "%" PRIu64, value);
}

void json_bool(json *j, const char *key, bool value)
{
    begin(j, key);
    fputs(value ? "true" : "false", j->file);
}
