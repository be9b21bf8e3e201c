// What `argand reference` tells when it is done.
#ifndef CLI_REFERENCE_REPORT_H
#define CLI_REFERENCE_REPORT_H

#include "reference_options.h"
#include "tracing.h"

typedef struct reference_report {
    ag_scene_summary scene;
    tracing tracing;
    float exposure;        // that it was made with
    double environment_ms; // reading its file, beside the loading
    double encode_ms;
    double total_ms; // from the start of the process's work to the finished file
} reference_report;

// One line for people, or with --json one object, on standard output.
void reference_report_print(const reference_report *report, const reference_request *request);

#endif
