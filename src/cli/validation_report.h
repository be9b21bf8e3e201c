// What `argand validate` tells: a page to look through, and numbers.
#ifndef CLI_VALIDATION_REPORT_H
#define CLI_VALIDATION_REPORT_H

#include "validation.h"

typedef struct validation_report {
    const validation *scenes;
    size_t count;
    const char *device; // its name
    float max_flip;     // 0 = no limit
    double total_ms;
} validation_report;

// The page, one HTML text that needs nothing else; the caller's to free() either way.  False: no
// memory.
bool validation_report_page(const validation_report *report, char **page, size_t *size);

// The numbers, as one JSON object on standard output, or a line a scene.
void validation_report_print(const validation_report *report, const shot_request *request);

#endif
