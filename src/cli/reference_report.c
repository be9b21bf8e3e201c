// What `argand reference` tells when it is done.
#include "reference_report.h"

#include "exposure_report.h"
#include "json.h"
#include "task.h"

#include <math.h>
#include <stdio.h>

static void print_stages(json *j, const reference_report *r)
{
    json_open(j, "ms", '{');
    json_real(j, "load", r->scene.load_ms);
    json_real(j, "decode", r->scene.decode_ms);
    json_real(j, "environment", r->environment_ms);
    json_real(j, "prepare", r->tracing.state.prepare_ms);
    json_real(j, "trace", r->tracing.state.trace_ms);
    json_real(j, "encode", r->encode_ms);
    json_real(j, "total", r->total_ms);
    json_close(j, '}');
}

static void print_json(const reference_report *r, const reference_request *request)
{
    const ag_reference_state *state = &r->tracing.state;
    double noise = state->samples > 1 ? (double)state->noise : (double)NAN; // not known
    json j = { .file = stdout };
    json_open(&j, NULL, '{');
    json_text(&j, "argand", ag_version());
    json_text(&j, "input", request->shot.input);
    json_text(&j, "output", request->shot.output);
    json_count(&j, "width", request->shot.size.width);
    json_count(&j, "height", request->shot.size.height);
    report_exposure(&j, r->exposure);
    json_count(&j, "triangles", r->scene.triangles);
    json_count(&j, "instances", r->scene.instances);
    json_count(&j, "seed", request->seed);
    json_count(&j, "samples", state->samples);
    json_real(&j, "noise", noise);
    json_bool(&j, "interrupted", r->tracing.interrupted);
    json_count(&j, "rays", state->rays);
    json_real(&j, "rays_per_second", (double)state->rays / state->trace_ms * 1e3);
    print_stages(&j, r);
    json_count(&j, "peak_memory_bytes", peak_memory_bytes());
    json_close(&j, '}');
}

void reference_report_print(const reference_report *r, const reference_request *request)
{
    char words[32];
    const shot_request *shot = &request->shot;
    const ag_reference_state *state = &r->tracing.state;
    if (shot->json)
        print_json(r, request);
    if (shot->json || shot->quiet)
        return;
    printf("%s: %ux%u pixels, %u sample%s each, ", shot->output, shot->size.width,
           shot->size.height, state->samples, state->samples == 1 ? "" : "s");
    if (state->samples > 1)
        printf("%.2g %% noise, ", (double)state->noise * 100);
    printf("in %.2f s%s\n", r->total_ms / 1e3, exposure_words(&shot->eye, r->exposure, words));
}
