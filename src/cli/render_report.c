// What `argand render` tells when it is done.
#include "render_report.h"

#include "exposure_report.h"
#include "json.h"
#include "task.h"

#include <stdio.h>

static void print_device(json *j, const ag_device_info *device)
{
    static const char *const kinds[] = { "other", "discrete", "integrated", "virtual", "cpu" };
    json_open(j, "device", '{');
    json_text(j, "name", device->name);
    json_text(j, "driver", device->driver);
    json_text(j, "kind", (size_t)device->kind < 5 ? kinds[device->kind] : kinds[0]);
    json_close(j, '}');
}

static void print_stages(json *j, const render_report *r)
{
    json_open(j, "ms", '{');
    json_real(j, "device", r->device_ms);
    json_real(j, "load", r->scene.load_ms);
    json_real(j, "decode", r->scene.decode_ms);
    json_real(j, "environment", r->environment_ms);
    json_real(j, "bake", r->stats.bake_ms);
    json_real(j, "compile", r->stats.compile_ms);
    json_real(j, "upload", r->take_ms + r->stats.upload_ms);
    json_real(j, "frame", r->stats.frame_ms);
    json_real(j, "readback", r->stats.readback_ms);
    json_real(j, "bloom", r->stats.bloom_ms);
    json_real(j, "encode", r->encode_ms);
    json_real(j, "total", r->total_ms);
    json_close(j, '}');
}

static void print_json(const render_report *r, const shot_request *request)
{
    json j = { .file = stdout };
    json_open(&j, NULL, '{');
    json_text(&j, "argand", ag_version());
    json_text(&j, "input", request->input);
    json_text(&j, "output", request->output);
    json_count(&j, "width", request->size.width);
    json_count(&j, "height", request->size.height);
    report_exposure(&j, r->exposure);
    print_device(&j, &r->device);
    json_count(&j, "triangles", r->stats.triangles);
    json_count(&j, "instances", r->stats.instances);
    json_count(&j, "draws", r->stats.draws);
    json_count(&j, "tiles", r->stats.tiles);
    json_count(&j, "samples", r->stats.samples);
    json_bool(&j, "environment_cached", r->stats.environment_cached);
    print_stages(&j, r);
    json_count(&j, "peak_memory_bytes", peak_memory_bytes());
    if (request->validate)
        json_count(&j, "validation_messages", r->validation_messages);
    json_close(&j, '}');
}

void render_report_print(const render_report *r, const shot_request *request)
{
    char words[32];
    if (request->json)
        print_json(r, request);
    else if (!request->quiet)
        printf("%s: %ux%u pixels in %.2f s on %s%s\n", request->output, request->size.width,
               request->size.height, r->total_ms / 1e3, r->device.name,
               exposure_words(&request->eye, r->exposure, words));
}
