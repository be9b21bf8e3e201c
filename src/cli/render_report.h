// What `argand render` tells when it is done.
#ifndef CLI_RENDER_REPORT_H
#define CLI_RENDER_REPORT_H

#include "shot_options.h"

typedef struct render_report {
    ag_device_info device;
    ag_scene_summary scene;
    float exposure; // that it was made with
    ag_render_stats stats;
    double device_ms;      // opening it, beside the loading
    double environment_ms; // reading its file, beside the loading
    double take_ms;        // putting the scene on the device
    double encode_ms;
    double total_ms; // from the start of the process's work to the finished file
    uint32_t validation_messages;
} render_report;

// One line for people, or with --json one object, on standard output.
void render_report_print(const render_report *report, const shot_request *request);

#endif
